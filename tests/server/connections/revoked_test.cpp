#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/server/fixture.h"
#include "tests/support/temporary_folder.h"

/// What happens to dances when their token is revoked.
namespace choreo::revoked_test {

class RevokedTest : public ServerTest {
 protected:
  // Lines of the tokens "a" and "b".
  static constexpr const char* kAlice =
      "ca978112ca1bbdcafac231b39a23dc4da786eff8147c4e72b9807785afee48bb alice\n";
  static constexpr const char* kBob =
      "3e23e8160039594a33894f6564e1b1348bbd7a0088d42c4acb73eeaed59c009d bob\n";

  RevokedTest() {
    Write(std::string(kAlice) + kBob);
    Start(1, [this](ServerConfig& config) { config.tokens = folder_ / "tokens"; });
  }
  void Write(const std::string& lines) const {
    std::ofstream(folder_ / "tokens.new") << lines;
    std::filesystem::rename(folder_ / "tokens.new", folder_ / "tokens");
  }
  /// Starts a dance of three seconds that waits after its first second, past a key.
  std::unique_ptr<DanceClient> Begin(const std::string& token) {
    auto client = std::make_unique<DanceClient>(
        stub(), std::nullopt,
        std::map<std::string, std::string>{{"authorization", "Bearer " + token}});
    v1::DanceConfig config = Config();
    config.set_frames(90);
    config.set_generate_until(0);
    client->Send(config);
    client->SendKeyframe(Key("a", 20));
    client->SendGenerateUntil(30);
    EXPECT_TRUE(client->ReadFrames(30));
    return client;
  }

  const TemporaryFolder folder_;
};

TEST_F(RevokedTest, ItEndsAndGoesOnWithAnotherToken) {
  const auto whole = Begin("b");
  whole->SendGenerateUntil(90);
  const Answer::Joined wanted = whole->Finish().Join();
  const auto hers = Begin("a"), his = Begin("b");
  Write(kBob);
  while (hers->ReadOne()) continue;
  const Answer& answer = hers->Finish();
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_THAT(answer.status.error_message(), testing::HasSubstr("has been revoked"));
  EXPECT_EQ(DetailsOf(answer.status).error_info->reason(), "TOKEN_NEEDED");
  EXPECT_TRUE(DetailsOf(answer.status).retry_info) << "so clients come back with a renewed token";

  his->SendGenerateUntil(90);
  EXPECT_EQ(his->Finish().Join(), wanted) << "nobody else is disturbed";
  ASSERT_FALSE(answer.continuations.empty());
  v1::DanceConfig config = Config();
  config.set_frames(90);
  *config.mutable_continuation() = answer.continuations.back();
  DanceClient resumed(stub(), std::nullopt, {{"authorization", "Bearer b"}});
  resumed.Send(config);
  const Answer::Joined rest = resumed.Finish().Join();
  ASSERT_TRUE(resumed.answer().status.ok()) << resumed.answer().status.error_message();
  EXPECT_EQ(rest.first_frame + rest.count, 90);
  const auto at = static_cast<std::ptrdiff_t>(3 * rest.first_frame);
  EXPECT_EQ(std::vector(wanted.root_positions.begin() + at, wanted.root_positions.end()),
            rest.root_positions);
}

}  // namespace choreo::revoked_test
