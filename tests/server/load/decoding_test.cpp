#include <gmock/gmock.h>
#include <sndfile.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <iterator>
#include <thread>

#include "tests/server/fixture.h"
#include "tests/support/temporary_folder.h"

namespace choreo::decoding_test {

class DecodingTest : public ServerTest {
 protected:
  static constexpr int kRate = 191'999, kChannels = 8;

  // A silent FLAC file whose header states `told_seconds`; 0: unknown. Ten minutes are 3.6 MB and
  // take most of a minute to decode: it has very many samples, and a ratio of rates with too many
  // filters to cache.
  static std::string Silence(int seconds, int told_seconds) {
    constexpr int kWritten = 191'990;  // FLAC's writers want whole tens
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "silence.flac";
    SF_INFO info{};
    info.samplerate = kWritten;
    info.channels = kChannels;
    info.format = SF_FORMAT_FLAC | SF_FORMAT_PCM_16;
    SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
    double quickest = 0;
    sf_command(file, SFC_SET_COMPRESSION_LEVEL, &quickest, sizeof quickest);
    const std::vector<int16_t> second(kWritten * kChannels);
    for (int i = 0; i < seconds; ++i) sf_writef_short(file, second.data(), kWritten);
    sf_close(file);
    std::ifstream stream(path, std::ios::binary);
    std::string bytes(std::istreambuf_iterator<char>(stream), {});
    // The 8 bytes at 18: 20 bits of rate, 3 of channels - 1, 5 of bits - 1, 36 of samples. What
    // follows is a sum over the samples; 0 is none.
    const auto samples = static_cast<uint64_t>(told_seconds) * kRate;
    const uint64_t head =
        uint64_t{kRate} << 44 | uint64_t{kChannels - 1} << 41 | uint64_t{15} << 36 | samples;
    for (size_t i = 0; i < 8; ++i) bytes[18 + i] = static_cast<char>(head >> (56 - 8 * i));
    std::fill_n(bytes.begin() + 26, 16, '\0');
    return bytes;
  }

  static v1::GenerateTransitionRequest Transition() {
    v1::GenerateTransitionRequest request;
    *request.mutable_config() = Config();
    request.set_frames(20);
    return request;
  }
};

// Two files keep both decoding threads busy.
TEST_F(DecodingTest, DoesNotBlockOthersAndEndsWithItsCall) {
  Start(1, [](ServerConfig& config) { config.io_threads = 2; });
  const auto slowest = [this] {
    double slowest_s = 0;
    for (int i = 0; i < 20; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      const Answer answer = Generate(Transition());
      EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
      slowest_s = std::max(slowest_s, took.count());
    }
    return slowest_s;
  };
  const double alone_s = slowest();

  const std::string file = Silence(600, 0);
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

  const double beside_s = slowest();
  ExpectEventually([this] { return server->calls() == 2; }, "only the two are left");
  EXPECT_TRUE(other.answer().frames.empty());
  std::cout << "the slowest of 20 transitions beside two files of 600 s, " << kChannels
            << " channels, " << kRate << " Hz took " << 1e3 * beside_s << " ms, alone "
            << 1e3 * alone_s << " ms\n";

  context.TryCancel();
  EXPECT_EQ(one->Finish().error_code(), grpc::StatusCode::CANCELLED);
  other.Cancel();
  ExpectIdle();
}

// A header alone causes no refusal, and the size that it states is never allocated.
TEST_F(DecodingTest, FileWithAnExcessiveHeaderIsReadToItsEnd) {
  Start();
  v1::GenerateTransitionRequest heavy = Transition();
  heavy.mutable_config()->mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_FILE);
  heavy.mutable_audio()->set_data(Silence(1, 600));
  EXPECT_TRUE(Generate(heavy).status.ok());
}

}  // namespace choreo::decoding_test
