#include <sndfile.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "tests/server/fixture.h"
#include "tests/support/temporary_folder.h"

namespace choreo {
namespace {

class DecodingTest : public ServerTest {
 protected:
  // Ten minutes of nothing, in a hundred kilobytes that take most of a minute: the filters of this
  // ratio of rates are too many to be kept.
  static std::string LongSilence() {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "silence.flac";
    SF_INFO info{};
    info.samplerate = 191'990;
    info.channels = 1;
    info.format = SF_FORMAT_FLAC | SF_FORMAT_PCM_16;
    SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
    const std::vector<int16_t> second(191'990);
    for (int i = 0; i < 600; ++i) sf_writef_short(file, second.data(), info.samplerate);
    sf_close(file);
    std::ifstream bytes(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(bytes), {}};
  }

  static v1::GenerateTransitionRequest Transition() {
    v1::GenerateTransitionRequest request;
    *request.mutable_config() = Config();
    request.set_frames(20);
    return request;
  }
};

TEST_F(DecodingTest, HoldsUpNobodyElseAndEndsWithItsCall) {
  Start(16, [](ServerConfig& config) { config.io_threads = 2; });
  const std::string file = LongSilence();
  v1::GenerateTransitionRequest heavy = Transition();
  heavy.mutable_config()->mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_FILE);
  heavy.mutable_audio()->set_data(file);
  grpc::ClientContext context;
  const auto one = stub().GenerateTransition(&context, heavy);
  DanceClient other(stub());
  other.Send(heavy.config());
  for (size_t at = 0; at < file.size(); at += 1 << 20) {
    other.SendAudio(file.substr(at, 1 << 20), static_cast<int64_t>(at));
  }
  other.SendEndOfAudio();
  ASSERT_TRUE(other.ReadHeader());
  ExpectEventually([this] { return server->calls() == 2; }, "both are there");

  for (int i = 0; i < 20; ++i) {
    const Answer answer = Generate(Transition());
    ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  }
  ExpectEventually([this] { return server->calls() == 2; }, "only the two are left");
  EXPECT_TRUE(other.answer().frames.empty());

  context.TryCancel();
  EXPECT_EQ(one->Finish().error_code(), grpc::StatusCode::CANCELLED);
  other.Cancel();
  ExpectIdle();
}

}  // namespace
}  // namespace choreo
