#include <gmock/gmock.h>

#include <limits>
#include <thread>

#include "model/audio/decode/decode.h"
#include "model/audio/music/music_analysis.h"
#include "tests/server/fixture.h"

namespace choreo::stream_test {

class StreamTest : public ServerTest {
 protected:
  v1::DanceConfig MusicConfig(uint64_t seed = 7) {
    v1::DanceConfig config = Config(seed);
    *config.mutable_audio_format() = MusicFormat();
    return config;
  }

  // A dance with music and two keys; `chunk` bytes of music a message.
  Answer MusicDance(uint64_t seed, size_t chunk, const std::vector<double>& beats = {},
                    const MusicAnalysis& music = {}) {
    DanceClient client(stub());
    v1::DanceConfig config = MusicConfig(seed);
    config.set_music_id(music.id);
    config.mutable_music_energies()->Add(music.energies.begin(), music.energies.end());
    for (const double beat : beats) config.add_music_beats(beat);
    client.Send(config);
    client.SendKeyframe(Key("a", 30));
    client.SendKeyframe(Key("b", 70, -0.2, 0.9, 1.5F));
    const std::string samples = Music(3);
    for (size_t at = 0; at < samples.size(); at += chunk) {
      client.SendAudio(samples.substr(at, chunk), static_cast<int64_t>(at / 2));
    }
    client.SendEndOfAudio();
    client.SendKeyframesComplete();
    return client.Finish();
  }
};

TEST_F(StreamTest, DancesThroughItsKeys) {
  Start();
  DanceClient client(stub());
  client.Send(Config());
  client.SendKeyframe(Key("a", 40));
  client.SendKeyframe(Key("b", 90, -0.2, 0.9, 1.5F));
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();

  ASSERT_TRUE(answer.header);
  EXPECT_EQ(answer.header->model(), "fake");
  EXPECT_EQ(answer.header->fingerprint(), "fake-1");
  EXPECT_EQ(answer.header->seed(), 7U);
  EXPECT_EQ(answer.header->frame_rate(), 30);
  EXPECT_EQ(answer.header->encoding(), v1::ROTATION_ENCODING_AXIS_ANGLE);
  EXPECT_EQ(answer.header->skeleton().joint_names_size(), 24);
  EXPECT_TRUE(answer.header->exact_resume());

  const Answer::Joined joined = answer.Join();
  EXPECT_EQ(joined.first_frame, 0);
  ASSERT_EQ(joined.count, 91);
  ASSERT_EQ(joined.rotations.size(), 91U * 72U);
  // The frame of key a is key a.
  EXPECT_NEAR(joined.root_positions[40 * 3 + 0], 0.3, 1e-5);
  EXPECT_NEAR(joined.root_positions[40 * 3 + 2], 0.4, 1e-5);
  const auto elbow = static_cast<size_t>(Skeleton::Smpl24().left_elbow);
  EXPECT_NEAR(joined.rotations[40 * 72 + 3 * elbow + 1], 0.8, 1e-5);
  EXPECT_NEAR(joined.rotations[90 * 72 + 3 * elbow + 1], 1.5, 1e-5);

  EXPECT_EQ(answer.ReachedKeys(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(answer.continuations.size(), 2U);
  EXPECT_EQ(answer.continuations[0].frame(), 41);
  EXPECT_EQ(answer.continuations[0].seed(), 7U);
  EXPECT_EQ(answer.continuations[0].root_positions_size(), 30);

  ASSERT_TRUE(answer.summary);
  const v1::QualityReport& report = answer.summary->report();
  EXPECT_EQ(report.frames(), 91);
  ASSERT_EQ(report.keyframes_size(), 2);
  EXPECT_EQ(report.keyframes(1).id(), "b");
  EXPECT_EQ(report.keyframes(1).frame(), 90);
  EXPECT_GT(report.keyframes(1).errors().raw_error_m(), 0);
  EXPECT_LE(report.keyframes(1).errors().final_error_m(), 1e-3);
  EXPECT_LE(report.keyframes(1).errors().final_error_deg(), 0.1);
  EXPECT_FALSE(report.has_beat_hit_rate());
  EXPECT_GT(answer.summary->timing().first_frame_latency_s(), 0);
  EXPECT_GT(answer.summary->timing().real_time_factor(), 0);
  ExpectIdle();
}

TEST_F(StreamTest, FramesFlowWhileMusicArrives) {
  Start();
  DanceClient client(stub());
  client.Send(MusicConfig());
  client.SendKeyframesComplete();
  const std::string music = Music(4);
  const size_t half = music.size() / 4 * 2;  // two seconds, whole samples
  client.SendAudio(music.substr(0, half), 0);
  // Nothing else is sent: two seconds of music make frames, but for the declared latency.
  ASSERT_TRUE(client.ReadHeader());
  const int ready = 60 - client.answer().header->latency_frames();
  ASSERT_GT(ready, 30);
  ASSERT_TRUE(client.ReadFrames(ready));
  EXPECT_FALSE(client.answer().summary);

  client.SendAudio(music.substr(half), static_cast<int64_t>(half / 2));
  client.SendEndOfAudio();
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.Join().count, 120);
  EXPECT_TRUE(answer.summary);
}

TEST_F(StreamTest, AnotherFingerprintIsRefusedUnlessAllowed) {
  Start();
  const Answer whole = MusicDance(21, 1 << 20);
  ASSERT_FALSE(whole.continuations.empty());
  v1::DanceConfig config = Config();
  *config.mutable_continuation() = whole.continuations[0];
  config.mutable_continuation()->set_fingerprint("other");
  config.set_frames(60);
  v1::StreamDanceRequest request;
  *request.mutable_config() = config;
  const Answer refused = Dance({request});
  EXPECT_EQ(refused.status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_NE(refused.status.error_message().find("other"), std::string::npos);

  request.mutable_config()->set_allow_inexact_resume(true);
  const Answer allowed = Dance({request});
  ASSERT_TRUE(allowed.status.ok()) << allowed.status.error_message();
  EXPECT_FALSE(allowed.header->exact_resume());
  ASSERT_FALSE(allowed.events.empty());
  EXPECT_EQ(allowed.events[0].warning().code(), v1::WARNING_CODE_INEXACT_RESUME);

  request.mutable_config()->mutable_continuation()->set_skeleton("spider8");
  EXPECT_EQ(Dance({request}).status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
}

// Beats go on where the longest music has ended.
TEST_F(StreamTest, TheLastBeatOfAContinuationMayLieAfterAllMusic) {
  Start();
  const Answer whole = MusicDance(21, 1 << 20);
  ASSERT_FALSE(whole.continuations.empty());
  v1::StreamDanceRequest request;
  *request.mutable_config() = Config();
  request.mutable_config()->set_frames(60);
  v1::Continuation& from = *request.mutable_config()->mutable_continuation();
  from = whole.continuations[0];
  from.set_last_beat(601.5);
  EXPECT_TRUE(Dance({request}).status.ok());
  for (const double beat : {-1.0, 3601.0, std::numeric_limits<double>::quiet_NaN()}) {
    from.set_last_beat(beat);
    EXPECT_THAT(Dance({request}).status.error_message(),
                testing::HasSubstr("config.continuation.last_beat: "));
  }
}

TEST_F(StreamTest, OutputRateAndEncoding) {
  Start();
  DanceClient client(stub());
  v1::DanceConfig config = Config();
  config.set_frame_rate(60);
  config.set_encoding(v1::ROTATION_ENCODING_QUATERNION);
  client.Send(config);
  client.SendKeyframe(Key("a", 30));
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.header->frame_rate(), 60);
  EXPECT_EQ(answer.header->model_frame_rate(), 30);
  EXPECT_EQ(answer.header->encoding(), v1::ROTATION_ENCODING_QUATERNION);
  const Answer::Joined joined = answer.Join();
  EXPECT_EQ(joined.count, 61);
  ASSERT_EQ(joined.rotations.size(), static_cast<size_t>(joined.count) * 96);
  for (size_t i = 0; i < joined.rotations.size(); i += 4) {
    const float* q = &joined.rotations[i];
    ASSERT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-5);
  }
}

// A WAV file in pieces, its bytes cut anywhere, dances as its samples do with its beats and
// energies.
TEST_F(StreamTest, FilesDanceAsTheirSamples) {
  Start();
  const std::string music = Music(3);
  const std::string file = Wav(music);
  DanceClient client(stub());
  v1::DanceConfig config = Config(13);
  config.mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_FILE);
  client.Send(config);
  client.SendKeyframe(Key("a", 30));
  client.SendKeyframe(Key("b", 70, -0.2, 0.9, 1.5F));
  constexpr size_t kPiece = 33'333;
  for (size_t at = 0; at < file.size(); at += kPiece) {
    client.SendAudio(file.substr(at, kPiece), static_cast<int64_t>(at));
  }
  const Answer& answer = client.Finish();  // half-closing ends file and keys
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  // The server knows the beats of a file, every half second, and some of them begin bars.
  std::vector<double> beats;
  int downbeats = 0;
  for (const auto& event : answer.events) {
    if (event.has_beat()) {
      beats.push_back(event.time());
      EXPECT_EQ(event.beat().source(), v1::BEAT_SOURCE_FOUND);
      EXPECT_GT(event.beat().confidence(), 0.5);
      EXPECT_LT(event.beat().confidence(), 1);
    }
    downbeats += event.beat().downbeat();
  }
  EXPECT_GE(downbeats, 1);
  EXPECT_LE(downbeats, std::ssize(beats) / 2 + 1);
  ASSERT_GE(beats.size(), 3U);
  for (size_t i = 1; i < beats.size(); ++i) EXPECT_NEAR(beats[i] - beats[i - 1], 0.5, 0.06);
  EXPECT_TRUE(answer.summary->report().has_beat_coverage());
  MusicAnalysis heard = AnalyseMusic(DecodeMono(std::as_bytes(std::span(file)), [] {}));
  EXPECT_TRUE(answer.Join() == MusicDance(13, 1 << 20, beats, heard).Join());
  EXPECT_FALSE(answer.Join() == MusicDance(13, 1 << 20, {}, heard).Join());
  MusicAnalysis other = heard;
  other.energies.clear();
  EXPECT_FALSE(answer.Join() == MusicDance(13, 1 << 20, beats, other).Join());
  ++heard.id;
  EXPECT_FALSE(answer.Join() == MusicDance(13, 1 << 20, beats, heard).Join())
      << "other music is danced otherwise";
}

// Dances to new music are on the beat, and the answer gives the source of each beat.
TEST_F(StreamTest, DetectsBeatsOfLiveMusic) {
  Start();
  DanceClient client(stub());
  client.Send(MusicConfig());
  client.SendKeyframesComplete();
  const std::string music = Music(14);
  for (size_t at = 0; at < music.size(); at += 4410)
    client.SendAudio(music.substr(at, 4410), static_cast<int64_t>(at / 2));
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  int beats = 0, heard = 0;
  for (const v1::Event& event : answer.events) {
    if (!event.has_beat()) continue;
    ++beats;
    heard += event.beat().source() == v1::BEAT_SOURCE_HEARD;
    EXPECT_NEAR(event.time(), 0.5 * std::round(2 * event.time()), 0.07);
    EXPECT_GT(event.beat().confidence(), 0);
    EXPECT_TRUE(event.beat().source() == v1::BEAT_SOURCE_HEARD ||
                event.beat().source() == v1::BEAT_SOURCE_PREDICTED);
  }
  EXPECT_GE(beats, 10);
  EXPECT_GT(heard, beats / 2);
  EXPECT_TRUE(answer.summary->report().has_beat_hit_rate());
}

TEST_F(StreamTest, BeatsMayComeAheadOfTheFrontier) {
  Start();
  DanceClient client(stub());
  v1::DanceConfig config = Config();
  config.set_frames(120);
  config.set_generate_until(30);
  client.Send(config);
  ASSERT_TRUE(client.ReadFrames(30));
  v1::StreamDanceRequest beats;
  for (const double time : {0.5, 1.5, 2.0, 2.5}) beats.mutable_music_beats()->add_times(time);
  beats.mutable_music_beats()->add_downbeats(2.5);
  beats.mutable_music_beats()->set_confidence(0.5);
  client.Send(beats);
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  std::vector<double> times, downbeats;
  std::vector<v1::WarningCode> warnings;
  for (const v1::Event& event : answer.events) {
    if (event.has_beat()) times.push_back(event.time());
    if (event.beat().downbeat()) downbeats.push_back(event.time());
    if (event.has_warning()) warnings.push_back(event.warning().code());
  }
  EXPECT_EQ(times, (std::vector<double>{2.0, 2.5})) << "the transition under way has none";
  EXPECT_EQ(downbeats, std::vector{2.5});
  EXPECT_EQ(warnings, std::vector{v1::WARNING_CODE_BEATS_TOO_LATE});
}

TEST_F(StreamTest, PassagesMayComeAheadOfTheFrontier) {
  Start();
  const auto dance = [this](std::optional<double> like) {
    DanceClient client(stub());
    v1::DanceConfig config = Config();
    config.set_frames(240);
    config.set_generate_until(30);
    config.set_variation(0);
    client.Send(config);
    EXPECT_TRUE(client.ReadFrames(30));
    if (like) {
      v1::StreamDanceRequest request;
      v1::MusicPassage* passage = request.mutable_music_passages()->add_passages();
      passage->set_from(4);
      passage->set_to(8);
      passage->set_like(*like);
      client.Send(request);
    }
    const Answer& answer = client.Finish();
    EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
    return answer.Join();
  };
  const Answer::Joined apart = dance(std::nullopt), again = dance(0);
  constexpr size_t kBefore = 120 * 72;  // rotations of four seconds
  EXPECT_TRUE(std::equal(apart.rotations.begin(), apart.rotations.begin() + kBefore,
                         again.rotations.begin()));
  EXPECT_FALSE(apart == again);
}

TEST_F(StreamTest, WithoutASeedOneIsDrawnAndReported) {
  Start();
  auto seed = [this] {
    DanceClient client(stub());
    client.Send(v1::DanceConfig());
    client.SendKeyframe(Key("a", 5));
    return client.Finish().header->seed();
  };
  EXPECT_NE(seed(), seed());
}

}  // namespace choreo::stream_test
