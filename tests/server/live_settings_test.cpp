#include "server/live_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

/// What a running server takes over from settings that have changed.
namespace choreo::live_settings_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class LiveSettingsTest : public testing::Test {
 protected:
  ServerConfig Read(const std::string& settings, std::vector<const char*> flags = {}) {
    std::ofstream(file) << settings;
    flags.insert(flags.begin(), {"choreod", "--config", file.c_str()});
    return RereadConfig(static_cast<int>(flags.size()), flags.data());
  }

  TemporaryFolder folder;
  const std::string file = (folder / "choreod.toml").string();
};

TEST_F(LiveSettingsTest, LimitsAreUsedAtOnceAndOthersWait) {
  ServerConfig config = Read("max-streams = 5\nidle-seconds = 30\nio-threads = 2\n");
  const ServerConfig fresh = Read("max-streams = 7\nlog-level = \"debug\"\nio-threads = 3\n");
  SettingsChange change = TakeOver(fresh, &config);
  EXPECT_THAT(change.used,
              ElementsAre("idle-seconds is the default, was 30",
                          "log-level is debug, was the default", "max-streams is 7, was 5"));
  EXPECT_THAT(change.waiting, ElementsAre("io-threads is 3, was 2"));
  EXPECT_EQ(config.max_streams, 7);
  EXPECT_EQ(config.idle_seconds, ServerConfig().idle_seconds);
  EXPECT_EQ(config.log_level, "debug");
  EXPECT_EQ(config.io_threads, 2);
  change = TakeOver(fresh, &config);
  EXPECT_THAT(change.used, IsEmpty());
  EXPECT_THAT(change.waiting, ElementsAre("io-threads is 3, was 2")) << "it still waits";
}

TEST_F(LiveSettingsTest, AFlagStillOverridesTheFile) {
  ServerConfig config = Read("max-streams = 5\n", {"--max-streams", "9"});
  EXPECT_THAT(TakeOver(Read("max-streams = 7\n", {"--max-streams", "9"}), &config).used, IsEmpty());
  EXPECT_EQ(config.max_streams, 9);
}

TEST_F(LiveSettingsTest, ABadSettingIsNamedWithItsLine) {
  ExpectError(ErrorCode::kInvalidArgument, file + ":2: --max-streams: -1",
              [&] { Read("workers = 1\nmax-streams = -1\n"); });
}

// A writer may have failed, or the disk was full.
TEST_F(LiveSettingsTest, AFileThatSetsNothingIsRefused) {
  for (const char* empty : {"", "\n", "# max-streams = 5\n"})
    ExpectError(ErrorCode::kInvalidArgument, "--config: " + file + " sets nothing",
                [&] { Read(empty); });
}

}  // namespace choreo::live_settings_test
