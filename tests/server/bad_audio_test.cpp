#include <limits>

#include "tests/server/bad_stream.h"

namespace choreo::bad_audio_test {

INSTANTIATE_TEST_SUITE_P(
    Audio, BadStreamTest,
    testing::Values(
        BadStreamCase{
            "Gap",
            [](const KeyMessage&) {
              return Requests{MusicConfigRequest(), AudioRequest(100, 0), AudioRequest(100, 101)};
            },
            grpc::StatusCode::OUT_OF_RANGE,
            "audio.first_sample",
            {"101", "100"}},
        BadStreamCase{
            "Overlap",
            [](const KeyMessage&) {
              return Requests{MusicConfigRequest(), AudioRequest(100, 0), AudioRequest(100, 99)};
            },
            grpc::StatusCode::OUT_OF_RANGE,
            "audio.first_sample",
            {"99", "100"}},
        BadStreamCase{"LateStart",
                      [](const KeyMessage&) {
                        v1::StreamDanceRequest config = MusicConfigRequest();
                        config.mutable_config()->mutable_audio_format()->set_first_sample(5000);
                        return Requests{config};
                      },
                      grpc::StatusCode::OUT_OF_RANGE,
                      "config.audio_format.first_sample",
                      {"5000", "0"}},
        BadStreamCase{"NaN",
                      [](const KeyMessage&) {
                        v1::StreamDanceRequest audio = AudioRequest(100, 0);
                        const float nan = std::numeric_limits<float>::quiet_NaN();
                        audio.mutable_audio()->mutable_data()->replace(
                            4 * 42, 4, reinterpret_cast<const char*>(&nan), 4);
                        return Requests{MusicConfigRequest(), audio};
                      },
                      kInvalidStatus,
                      "audio.data",
                      {"nan", "42"}},
        BadStreamCase{"HalfASample",
                      [](const KeyMessage&) {
                        v1::StreamDanceRequest audio = AudioRequest(100, 0);
                        audio.mutable_audio()->mutable_data()->pop_back();
                        return Requests{MusicConfigRequest(), audio};
                      },
                      kInvalidStatus,
                      "audio.data",
                      {"399", "4 bytes"}},
        BadStreamCase{"WithoutFormat",
                      [](const KeyMessage&) {
                        return Requests{ConfigRequest(), AudioRequest(100, 0)};
                      },
                      kInvalidStatus,
                      "audio",
                      {"config.audio_format"}},
        BadStreamCase{"None",
                      [](const KeyMessage&) { return Requests{MusicConfigRequest()}; },
                      kInvalidStatus,
                      "audio",
                      {"without a sample"}},
        BadStreamCase{
            "EmptyPieces",
            [](const KeyMessage&) {
              return Requests{MusicConfigRequest(), AudioRequest(0, 0), AudioRequest(0, 0)};
            },
            kInvalidStatus,
            "audio",
            {"without a sample"}},
        BadStreamCase{"TooLong",
                      [](const KeyMessage&) {
                        v1::StreamDanceRequest config = MusicConfigRequest();
                        config.mutable_config()->mutable_audio_format()->set_sample_rate(8000);
                        Requests requests = {config};
                        // 600 s and a second more, in pieces of a minute.
                        for (int64_t at = 0; at <= 600; at += 60) {
                          requests.push_back(AudioRequest(8000 * (at < 600 ? 60 : 1), 8000 * at));
                        }
                        return requests;
                      },
                      kInvalidStatus,
                      "audio.data",
                      {"600 s"}}),
    NameOf);

// Music as a file, in one piece.
auto WithFile(std::string bytes) {
  return [bytes = std::move(bytes)](const KeyMessage&) {
    v1::StreamDanceRequest config = ConfigRequest();
    config.mutable_config()->mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_FILE);
    v1::StreamDanceRequest audio;
    audio.mutable_audio()->set_data(bytes);
    return Requests{config, audio};
  };
}

// A test's static functions, for the cases.
struct Files : ServerTest {
  void TestBody() override {}
  static std::string WithNaN() {
    std::vector<float> samples(1000, 0.1F);
    samples[77] = std::numeric_limits<float>::quiet_NaN();
    return Wav({reinterpret_cast<const char*>(samples.data()), 4 * samples.size()}, 4);
  }
  static std::string WithoutSamples() { return Wav(""); }
};

INSTANTIATE_TEST_SUITE_P(
    File, BadStreamTest,
    testing::Values(
        BadStreamCase{"None",
                      [](const KeyMessage&) { return Requests{WithFile("")({}).front()}; },
                      kInvalidStatus,
                      "audio",
                      {"0 bytes"}},
        BadStreamCase{"Empty", WithFile(""), kInvalidStatus, "audio", {"0 bytes"}},
        BadStreamCase{"WithoutSamples",
                      WithFile(Files::WithoutSamples()),
                      kInvalidStatus,
                      "audio",
                      {"0 samples"}},
        BadStreamCase{"NotAudio",
                      WithFile("<html>this is no music, but a page about it</html>"),
                      kInvalidStatus,
                      "audio",
                      {"not", "WAV"}},
        BadStreamCase{
            "NaN", WithFile(Files::WithNaN()), kInvalidStatus, "audio.data", {"nan", "sample 77"}}),
    NameOf);

class MessageLimitTest : public ServerTest {};

TEST_F(MessageLimitTest, OversizeMessagesAreRefused) {
  Start();
  const Answer answer = Dance({MusicConfigRequest(), AudioRequest(5 << 20, 0)});
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_NE(answer.status.error_message().find(std::to_string(16 << 20)), std::string::npos)
      << answer.status.error_message();
  ExpectIdle();
  v1::StreamDanceRequest key;
  *key.mutable_keyframe() = ServerTest::Key("k", 40);
  EXPECT_EQ(Dance({ConfigRequest(), key}).Join().count, 41);
}

}  // namespace choreo::bad_audio_test
