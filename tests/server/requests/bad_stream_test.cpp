#include <google/protobuf/descriptor.h>

#include <cmath>
#include <utility>

#include "server/messages/message_error.h"
#include "tests/server/requests/bad_stream.h"

namespace choreo::bad_stream_test {

/// Whether this message type has a field at `path`, or a oneof of this name.
bool IsPath(const google::protobuf::Descriptor& type, const std::string& path) {
  const size_t end = path.find('.');
  const std::string part = path.substr(0, end);
  const auto* field = type.FindFieldByName(part.substr(0, part.find('[')));
  if (field == nullptr) return end == path.npos && type.FindOneofByName(part) != nullptr;
  if (part.find('[') != part.npos && !field->is_repeated()) return false;
  if (end == path.npos) return true;
  return field->message_type() != nullptr && IsPath(*field->message_type(), path.substr(end + 1));
}

TEST(MessageErrorTest, NumbersMessagesAndOmitsTheOneAroundAPose) {
  const std::pair<const char*, const char*> names[] = {
      {"keyframe.pose.rotations[16]", "keyframes[3].rotations[16]"},
      {"keyframe.pose", "keyframes[3].pose"},
      {"keyframe.mask.joints[2]", "keyframes[3].mask.joints[2]"},
      {"keyframe", "keyframes[3]"},
      {"remove_keyframe.id", "remove_keyframes[3].id"},
      {"controls.root_path.points[3]", "controls[3].root_path.points[3]"},
      {"music_beats.times[1]", "music_beats[3].times[1]"},
  };
  for (const auto& [path, name] : names) {
    const MessageError error(InvalidArgument(path, "is bad"), 3, "k");
    EXPECT_EQ(error.field(), name);
    EXPECT_EQ(error.what(), name + std::string(": is bad"));
    EXPECT_EQ(PathInMessage(error), path);
  }
}

TEST(MessageErrorTest, PathsLeadThroughTheSentMessage) {
  const std::pair<const char*, const char*> paths[] = {
      {"config.history.poses[4].root_position[2]", "config.history.poses[4].root_position.z"},
      {"config.history.poses[0].rotations", "config.history.poses[0].rotations"},
      {"config.continuation.poses[2].rotations[1]", "config.continuation.rotations"},
      {"after[1].rotations[3]", "after[1].rotations[3]"},
      {"", ""},
  };
  for (const auto& [field, path] : paths)
    EXPECT_EQ(PathInMessage(InvalidArgument(field, "is bad")), path);
  EXPECT_EQ(PathInMessage(MessageError(InvalidArgument("keyframe.pose.root_position[1]", ""), 0)),
            "keyframe.pose.root_position.y");
}

TEST_P(BadStreamTest, IsNamedAndTheServerContinues) {
  Start();
  v1::StreamDanceRequest key;
  *key.mutable_keyframe() = Key("k", 40);
  const Answer answer = Dance(GetParam().requests(key));
  EXPECT_EQ(answer.status.error_code(), GetParam().code) << answer.status.error_message();
  EXPECT_FALSE(answer.summary);
  for (const std::string& word : GetParam().says) {
    EXPECT_NE(answer.status.error_message().find(word), std::string::npos)
        << '"' << word << "\" is not in: " << answer.status.error_message();
  }
  const Details details = DetailsOf(answer.status);
  ASSERT_TRUE(details.error_info);
  EXPECT_EQ(details.error_info->domain(), "choreo");
  ASSERT_TRUE(details.bad_request) << answer.status.error_message();
  EXPECT_EQ(details.error_info->metadata().at("field"), GetParam().field);
  const auto& violation = details.bad_request->field_violations(0);
  EXPECT_TRUE(IsPath(*v1::StreamDanceRequest::descriptor(), violation.field()))
      << violation.field();
  const std::string& message = answer.status.error_message();
  if (message.size() < 600) {  // else both are shortened
    EXPECT_EQ(GetParam().field + (": " + violation.description()), message);
  }

  const Answer good = Dance({ConfigRequest(), key});
  EXPECT_TRUE(good.status.ok()) << good.status.error_message();
  EXPECT_EQ(good.Join().count, 41);
  ExpectIdle();
}

const std::string kConfig = "config { seed: 1 }";

INSTANTIATE_TEST_SUITE_P(
    Order, BadStreamTest,
    testing::ValuesIn(std::vector<BadStreamCase>{
        {"Nothing", Sent({}), "config", {"missing"}},
        {"NoConfig", Sent({"key"}), "config", {"missing", "first"}},
        {"TwoConfigs", Sent({kConfig, kConfig}), "config", {"once"}},
        {"EmptyMessage", Sent({kConfig, ""}), "request", {"empty"}},
        {"HalfCloseAfterConfig",
         Sent({kConfig}),
         "keyframes_complete",
         {"no end", "(config.frames)"}},
        {"KeysAfterComplete",
         [](const KeyMessage& key) {
           v1::StreamDanceRequest complete;
           complete.mutable_keyframes_complete();
           return Requests{MusicConfigRequest(), key, complete, key};
         },
         "keyframes[1]",
         {"after the keys are complete"}},
        {"NoBeats", Sent({kConfig, "music_beats {}"}), "music_beats[0].times", {"empty"}},
        {"BeatsBackwards",
         Sent({kConfig, "music_beats { times: 1 }", "music_beats { times: [3, 2.5] }"}),
         "music_beats[1].times[1]",
         {"2.5 s", "3 s"}},
        {"NoPassages",
         Sent({kConfig, "music_passages {}"}),
         "music_passages[0].passages",
         {"empty"}},
        {"PassageLikeLater",
         Sent({kConfig, "music_passages { passages { from: 3 to: 5 like: 4 } }"}),
         "music_passages[0].passages[0].like",
         {"4 s", "[0, 1]"}},
        {"GenerateUntilBackwards",
         Sent({kConfig, "generate_until { frame: 50 }", "generate_until { frame: 40 }"}),
         "generate_until.frame",
         {"40", "50"}},
        {"RemovedIdThatNeverWas",
         Sent({kConfig, "key", "remove_keyframe { id: 'ghost' }"}),
         "remove_keyframes[0].id",
         {"ghost"},
         grpc::StatusCode::NOT_FOUND},
        {"RemovedTwice",
         Sent({kConfig, "generate_until { frame: 10 }", "key", "remove_keyframe { id: 'k' }",
               "remove_keyframe { id: 'k' }"}),
         "remove_keyframes[1].id",
         {"\"k\""},
         grpc::StatusCode::NOT_FOUND}}),
    NameOf);

auto WithContinuation(const std::function<void(v1::Continuation&)>& change) {
  return WithConfig([change](v1::DanceConfig& config) {
    v1::Continuation& from = *config.mutable_continuation();
    from.set_skeleton("smpl24");
    from.set_fingerprint("fake-1");
    from.mutable_root_positions()->Resize(3 * 10, 0.0F);
    from.mutable_rotations()->Resize(3 * 10 * 24, 0.0F);
    change(from);
  });
}

INSTANTIATE_TEST_SUITE_P(
    Config, BadStreamTest,
    testing::ValuesIn(std::vector<BadStreamCase>{
        {"UnknownModel",
         WithConfig("model: 'paper'"),
         "config.model",
         {"paper", "fake"},
         grpc::StatusCode::NOT_FOUND},
        // However long or odd a client's words are, the answer is one line that fits its trailers.
        {"EndlessModel",
         WithConfig("model: '" + std::string(100'000, 'x') + "'"),
         "config.model",
         {"xxx...xxx", "fake"},
         grpc::StatusCode::NOT_FOUND},
        {"ModelOfControlCharacters",
         WithConfig([](auto& c) { c.set_model(std::string("m\n\0\x7f\u00e9", 6)); }),
         "config.model",
         {"m\\x0a\\x00\\x7f\u00e9", "fake"},
         grpc::StatusCode::NOT_FOUND},
        {"FrameRate", WithConfig("frame_rate: 121"), "config.frame_rate", {"121", "120"}},
        {"FrameRateNaN", WithConfig("frame_rate: nan"), "config.frame_rate", {"nan", "120"}},
        {"Temperature", WithConfig("temperature: -0.5"), "config.temperature", {"-0.5", "[0, 2]"}},
        {"MusicDynamics",
         WithConfig("music_dynamics: 1.5"),
         "config.music_dynamics",
         {"1.5", "[0, 1]"}},
        {"Style", WithConfig("style: 'foxtrot'"), "config.style", {"foxtrot", "calm, wild"}},
        {"EndlessStyle",
         WithConfig("style: '" + std::string(257, 'x') + "'"),
         "config.style",
         {"257 bytes", "at most 256"}},
        {"Frames", WithConfig("frames: 0"), "config.frames", {"0", "108000"}},
        {"Encoding", WithConfig("encoding: 17"), "config.encoding", {"17"}},
        {"AudioEncoding",
         WithConfig("audio_format {}"),
         "config.audio_format.encoding",
         {"missing; there are AUDIO_ENCODING_PCM_F32LE, "}},
        {"SampleRate",
         WithConfig("audio_format { encoding: AUDIO_ENCODING_PCM_S16LE sample_rate: 7999 "
                    "channels: 1 }"),
         "config.audio_format.sample_rate",
         {"7999 Hz", "8000"}},
        {"NoSampleRate",
         WithConfig("audio_format { encoding: AUDIO_ENCODING_PCM_S16LE channels: 1 }"),
         "config.audio_format.sample_rate",
         {"missing"}},
        {"NoChannels",
         WithConfig("audio_format { encoding: AUDIO_ENCODING_PCM_S16LE sample_rate: 44100 }"),
         "config.audio_format.channels",
         {"missing"}},
        {"Channels",
         WithConfig("audio_format { encoding: AUDIO_ENCODING_PCM_S16LE sample_rate: 44100 "
                    "channels: 9 }"),
         "config.audio_format.channels",
         {"9", "8"}},
        {"GenerateUntil",
         WithConfig("generate_until: -1"),
         "config.generate_until",
         {"-1", "108000"}},
        {"Beats", WithConfig("music_beats: [1, 1]"), "config.music_beats[1]", {"1 s"}},
        {"Downbeats",
         WithConfig("music_beats: [1, 1.5] music_downbeats: [1.5, 2]"),
         "config.music_downbeats[1]",
         {"2 s", "not one of the beats"}},
        {"BeatsConfidence",
         Sent({kConfig, "music_beats { times: 1 confidence: 1.5 }"}),
         "music_beats[0].confidence",
         {"1.5", "[0, 1]"}},
        {"Passages",
         WithConfig("music_passages { from: 3 to: 601 }"),
         "config.music_passages[0].to",
         {"601 s", "600"}},
        {"Energies",
         WithConfig("music_energies: 2.5"),
         "config.music_energies[0]",
         {"2.5", "[-2, 2]"}},
        {"Variation", WithConfig("variation: 1.5"), "config.variation", {"1.5", "[0, 1]"}},
        {"HistoryOfAnotherSkeleton",
         WithConfig(
             [](auto& c) {
               v1::Pose* pose = c.mutable_history()->add_poses();
               pose->mutable_root_position()->set_y(1);
               pose->mutable_rotations()->Resize(3 * 23, 0.0F);
             }),
         "config.history.poses[0].rotations",
         {"23 joints", "24"}},
        {"ContinuationOfAnotherSkeleton",
         WithContinuation(
             [](auto& from) {
               from.set_skeleton("tang23");
               from.mutable_rotations()->Truncate(3 * 10 * 23);
             }),
         "config.continuation.skeleton",
         {"tang23", "smpl24"},
         grpc::StatusCode::FAILED_PRECONDITION},
        {"ContinuationOf23Joints",
         WithContinuation([](auto& from) { from.mutable_rotations()->Truncate(3 * 10 * 23); }),
         "config.continuation.rotations",
         {"690", "720"}},
        {"ShortContinuation",
         WithConfig("continuation { skeleton: 'smpl24' root_positions: 1 }"),
         "config.continuation.root_positions",
         {"1 ", "30"}},
        {"ContinuationWithHalfAStage",
         WithContinuation([](auto& from) { from.add_stage(1); }),
         "config.continuation.stage",
         {"1 ", "2"}},
        {"ContinuationOnNoStage",
         WithContinuation(
             [](auto& from) {
               from.add_stage(1);
               from.add_stage(NAN);
             }),
         "config.continuation.stage",
         {"nan", "10000"}},
        {"ContinuationFacingNowhere",
         WithContinuation([](auto& from) { from.set_front(7); }),
         "config.continuation.front",
         {"7 radians", "a turn"}}}),
    NameOf);

}  // namespace choreo::bad_stream_test
