#include <limits>

#include "tests/server/requests/bad_stream.h"

namespace choreo::bad_audio_test {

auto Pieces(const Requests& pieces) {
  return [pieces](const KeyMessage&) {
    Requests requests = {MusicConfigRequest()};
    requests.insert(requests.end(), pieces.begin(), pieces.end());
    return requests;
  };
}

// 100 samples, changed.
auto PieceWith(const std::function<void(std::string&)>& change) {
  v1::StreamDanceRequest piece = AudioRequest(100, 0);
  change(*piece.mutable_audio()->mutable_data());
  return Pieces({piece});
}

INSTANTIATE_TEST_SUITE_P(
    Audio, BadStreamTest,
    testing::ValuesIn(std::vector<BadStreamCase>{
        {"Gap",
         Pieces({AudioRequest(100, 0), AudioRequest(100, 101)}),
         "audio.first_sample",
         {"101", "100"},
         grpc::StatusCode::OUT_OF_RANGE},
        {"Overlap",
         Pieces({AudioRequest(100, 0), AudioRequest(100, 99)}),
         "audio.first_sample",
         {"99", "100"},
         grpc::StatusCode::OUT_OF_RANGE},
        {"LateStart",
         [](const KeyMessage&) {
           v1::StreamDanceRequest config = MusicConfigRequest();
           config.mutable_config()->mutable_audio_format()->set_first_sample(5000);
           return Requests{config};
         },
         "config.audio_format.first_sample",
         {"5000", "0"},
         grpc::StatusCode::OUT_OF_RANGE},
        {"StartAfterTheLongestMusic",
         [](const KeyMessage& key) {
           v1::StreamDanceRequest config = MusicConfigRequest();
           v1::History* history = config.mutable_config()->mutable_history();
           history->set_first_frame(30 * 800);
           *history->add_poses() = key.keyframe().pose();
           v1::AudioFormat* format = config.mutable_config()->mutable_audio_format();
           format->set_first_sample(int64_t{700} * format->sample_rate());
           return Requests{config};
         },
         "audio.first_sample",
         {"600 s"}},
        {"NaN",
         PieceWith([](std::string& data) {
           const float nan = std::numeric_limits<float>::quiet_NaN();
           data.replace(4 * 42, 4, reinterpret_cast<const char*>(&nan), 4);
         }),
         "audio.data",
         {"nan", "42"}},
        {"HalfASample",
         PieceWith([](std::string& data) { data.pop_back(); }),
         "audio.data",
         {"399", "4 bytes"}},
        {"WithoutFormat",
         [](const KeyMessage&) {
           return Requests{ConfigRequest(), AudioRequest(100, 0)};
         },
         "audio",
         {"without config.audio_format", R"("encoding": "AUDIO_ENCODING_FILE")",
          R"("sample_rate": 44100)"}},
        {"EndWithoutFormat",
         [](const KeyMessage&) {
           v1::StreamDanceRequest end;
           end.mutable_end_of_audio();
           return Requests{ConfigRequest(), end};
         },
         "end_of_audio",
         {R"("encoding": "AUDIO_ENCODING_FILE")"}},
        {"None", Pieces({}), "end_of_audio", {"no sample came before"}},
        {"EmptyPieces",
         Pieces({AudioRequest(0, 0), AudioRequest(0, 0)}),
         "end_of_audio",
         {"no sample came before"}},
        {"TooLong",
         [](const KeyMessage&) {
           v1::StreamDanceRequest config = MusicConfigRequest();
           config.mutable_config()->mutable_audio_format()->set_sample_rate(8000);
           Requests requests = {config};
           // 600 s and a second more, in pieces of a minute.
           for (int64_t at = 0; at <= 600; at += 60)
             requests.push_back(AudioRequest(8000 * (at < 600 ? 60 : 1), 8000 * at));
           return requests;
         },
         "audio.data",
         {"600 s"}}}),
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
    testing::ValuesIn(std::vector<BadStreamCase>{
        {"None",
         [](const KeyMessage&) { return Requests{WithFile("")({}).front()}; },
         "audio",
         {"0 bytes"}},
        {"Empty", WithFile(""), "audio", {"0 bytes"}},
        {"WithoutSamples", WithFile(Files::WithoutSamples()), "audio", {"0 samples"}},
        {"NotAudio",
         WithFile("<html>this is no music, but a page about it</html>"),
         "audio",
         {"not", "WAV"}},
        {"NaN", WithFile(Files::WithNaN()), "audio.data", {"nan", "sample 77"}}}),
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
