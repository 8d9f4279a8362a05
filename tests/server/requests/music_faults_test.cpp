#include <algorithm>
#include <string>

#include "tests/server/requests/bad_stream.h"

namespace choreo::music_faults_test {

/// Music that can be danced to, but differs from what its sender expects.
class MusicFaultsTest : public ServerTest {
 protected:
  using Requests = std::vector<v1::StreamDanceRequest>;

  static Requests WithFile(const std::string& bytes) {
    Requests requests = {ConfigRequest(), {}};
    requests[0].mutable_config()->mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_FILE);
    requests[1].mutable_audio()->set_data(bytes);
    return requests;
  }
  /// A square wave.
  static v1::StreamDanceRequest Floats(int samples, float level) {
    v1::StreamDanceRequest audio = AudioRequest(samples, 0);
    std::vector<float> levels;
    for (int i = 0; i < samples; ++i) levels.push_back(i / 50 % 2 == 0 ? level : -level);
    audio.mutable_audio()->set_data(levels.data(), 4 * levels.size());
    return audio;
  }
  static v1::StreamDanceRequest KeyAt(int64_t frame) {
    v1::StreamDanceRequest request;
    *request.mutable_keyframe() = Key("k", frame);
    return request;
  }
  /// Returns the only event with a warning of this code.
  static v1::Event TheWarning(const std::vector<v1::Event>& events, v1::WarningCode code) {
    const auto is_it = [code](const v1::Event& event) { return event.warning().code() == code; };
    EXPECT_EQ(std::ranges::count_if(events, is_it), 1);
    const auto found = std::ranges::find_if(events, is_it);
    return found == events.end() ? v1::Event() : *found;
  }
  static std::string Warnings(const std::vector<v1::Event>& events) {
    std::string all;
    for (const v1::Event& event : events) all += event.warning().message();
    return all;
  }
  static bool Says(const v1::Event& event, const std::string& text) {
    return event.warning().message().find(text) != std::string::npos;
  }
};

TEST_F(MusicFaultsTest, AFileThatEndsEarlyIsDancedWithAWarning) {
  Start();
  const std::string whole = Wav(Music(2));
  const Answer answer = Dance(WithFile(whole.substr(0, whole.size() / 2)));
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  const v1::Event event = TheWarning(answer.events, v1::WARNING_CODE_MUSIC_DAMAGED);
  EXPECT_TRUE(Says(event, "its header says 88200 bytes")) << event.warning().message();
  EXPECT_EQ(event.frame(), answer.Join().count - 1);
  EXPECT_EQ(Warnings(Dance(WithFile(whole)).events), "");
}

TEST_F(MusicFaultsTest, ATransitionToAFileThatEndsEarlyHasAWarning) {
  Start();
  const std::string whole = Wav(Music(2));
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.mutable_config()->mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_FILE);
  request.set_frames(20);
  request.mutable_audio()->set_data(whole.substr(0, whole.size() / 2));
  const Answer answer = Generate(request);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  TheWarning(answer.events, v1::WARNING_CODE_MUSIC_DAMAGED);
}

TEST_F(MusicFaultsTest, SilenceIsDancedWithAWarning) {
  Start();
  const Answer answer = Dance({MusicConfigRequest(), AudioRequest(22'050, 0)});
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  const v1::Event event = TheWarning(answer.events, v1::WARNING_CODE_MUSIC_SILENT);
  EXPECT_TRUE(Says(event, "all 1 s")) << event.warning().message();
  EXPECT_EQ(event.frame(), answer.Join().count - 1);
  EXPECT_EQ(Warnings(Dance({MusicConfigRequest(), Floats(22'050, 0.001F)}).events), "");
  TheWarning(Dance(WithFile(Wav(std::string(44'100, '\0')))).events, v1::WARNING_CODE_MUSIC_SILENT);
}

// The later of the key and the end of the music decides.
TEST_F(MusicFaultsTest, AKeyBehindTheMusicIsReachedWithAWarning) {
  Start();
  v1::StreamDanceRequest end;
  end.mutable_end_of_audio();
  const v1::StreamDanceRequest music = Floats(22'050, 0.1F);
  for (const Requests& requests : {Requests{MusicConfigRequest(), music, end, KeyAt(90)},
                                   Requests{MusicConfigRequest(), KeyAt(90), music, end}}) {
    const Answer answer = Dance(requests);
    ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
    const v1::Event event = TheWarning(answer.events, v1::WARNING_CODE_KEY_BEHIND_MUSIC);
    EXPECT_EQ(event.frame(), 90);
    EXPECT_EQ(event.warning().keyframe_id(), "k");
    EXPECT_TRUE(Says(event, "2 s behind the end")) << event.warning().message();
    EXPECT_EQ(answer.ReachedKeys(), std::vector<std::string>{"k"});
  }
  Requests asked = {MusicConfigRequest(), KeyAt(90), music, end};
  asked[0].mutable_config()->set_frames(100);
  EXPECT_EQ(Warnings(Dance(asked).events).find("behind the end"), std::string::npos);
}

TEST_F(MusicFaultsTest, FramesBeyondTheMusicAreDancedWithAWarning) {
  Start();
  v1::StreamDanceRequest end;
  end.mutable_end_of_audio();
  Requests requests = {MusicConfigRequest(), Floats(22'050, 0.1F), end};
  requests[0].mutable_config()->set_frames(90);
  const Answer answer = Dance(requests);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  const v1::Event event = TheWarning(answer.events, v1::WARNING_CODE_DANCE_BEHIND_MUSIC);
  EXPECT_EQ(event.frame(), 30);
  EXPECT_TRUE(Says(event, "it continues for 2 s in silence")) << event.warning().message();
  EXPECT_EQ(answer.Join().count, 90);
  for (const int frames : {29, 30, 31}) {
    requests[0].mutable_config()->set_frames(frames);
    EXPECT_EQ(Warnings(Dance(requests).events), "") << frames;
  }
}

TEST_F(MusicFaultsTest, BeatsBehindTheMusicAreWarnedOf) {
  Start();
  const auto dance = [&](std::vector<double> beats) {
    Requests requests = {MusicConfigRequest(), Floats(22'050, 0.1F)};
    requests[0].mutable_config()->mutable_music_beats()->Add(beats.begin(), beats.end());
    return Dance(requests);
  };
  const Answer answer = dance({0.5, 1, 1.5, 2});
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  const v1::Event event = TheWarning(answer.events, v1::WARNING_CODE_BEATS_BEHIND_MUSIC);
  EXPECT_EQ(event.frame(), 30);
  EXPECT_TRUE(Says(event, "2 given beats lie behind the end of the music at 1 s, from 1.5 s on"))
      << event.warning().message();
  EXPECT_EQ(Warnings(dance({0.5, 1, 1.02}).events), "");
}

TEST_F(MusicFaultsTest, FloatsThatAreScaledAsIntegersAreRefused) {
  Start();
  const Answer answer = Dance({MusicConfigRequest(), Floats(100, 8000)});
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_NE(answer.status.error_message().find("sample 0 of channel 0 is 8000, full scale is -1 "
                                               "to 1, the limit 100"),
            std::string::npos)
      << answer.status.error_message();
  EXPECT_TRUE(Dance({MusicConfigRequest(), Floats(22'050, 99)}).status.ok());
}

}  // namespace choreo::music_faults_test
