#include <google/protobuf/descriptor.h>

#include <cmath>
#include <utility>

#include "server/message_error.h"
#include "tests/server/bad_stream.h"

namespace choreo::bad_stream_test {

void FillContinuation(v1::Continuation* from) {
  from->set_skeleton("smpl24");
  from->set_fingerprint("fake-1");
  from->mutable_root_positions()->Resize(3 * 10, 0.0F);
  from->mutable_rotations()->Resize(3 * 10 * 24, 0.0F);
}

/// Whether such a message has a field there, or alternatives of this name.
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

INSTANTIATE_TEST_SUITE_P(
    Order, BadStreamTest,
    testing::Values(BadStreamCase{"Nothing",
                                  [](const KeyMessage&) { return Requests{}; },
                                  kInvalidStatus,
                                  "config",
                                  {"missing"}},
                    BadStreamCase{"NoConfig",
                                  [](const KeyMessage& key) { return Requests{key}; },
                                  kInvalidStatus,
                                  "config",
                                  {"missing", "first"}},
                    BadStreamCase{"TwoConfigs",
                                  [](const KeyMessage&) {
                                    return Requests{ConfigRequest(), ConfigRequest()};
                                  },
                                  kInvalidStatus,
                                  "config",
                                  {"once"}},
                    BadStreamCase{"EmptyMessage",
                                  [](const KeyMessage&) {
                                    return Requests{ConfigRequest(), v1::StreamDanceRequest()};
                                  },
                                  kInvalidStatus,
                                  "request",
                                  {"empty"}},
                    BadStreamCase{"HalfCloseAfterConfig",
                                  [](const KeyMessage&) { return Requests{ConfigRequest()}; },
                                  kInvalidStatus,
                                  "keyframes_complete",
                                  {"no end"}},
                    BadStreamCase{"KeysAfterComplete",
                                  [](const KeyMessage& key) {
                                    v1::StreamDanceRequest complete;
                                    complete.mutable_keyframes_complete();
                                    v1::StreamDanceRequest config = MusicConfigRequest();
                                    return Requests{config, key, complete, key};
                                  },
                                  kInvalidStatus,
                                  "keyframes[1]",
                                  {"keyframes_complete"}},
                    BadStreamCase{"NoBeats",
                                  [](const KeyMessage&) {
                                    v1::StreamDanceRequest beats;
                                    beats.mutable_music_beats();
                                    return Requests{ConfigRequest(), beats};
                                  },
                                  kInvalidStatus,
                                  "music_beats[0].times",
                                  {"empty"}},
                    BadStreamCase{"BeatsBackwards",
                                  [](const KeyMessage&) {
                                    v1::StreamDanceRequest beats, back;
                                    beats.mutable_music_beats()->add_times(1);
                                    back.mutable_music_beats()->add_times(3);
                                    back.mutable_music_beats()->add_times(2.5);
                                    return Requests{ConfigRequest(), beats, back};
                                  },
                                  kInvalidStatus,
                                  "music_beats[1].times[1]",
                                  {"2.5 s", "3 s"}},
                    BadStreamCase{"NoPassages",
                                  [](const KeyMessage&) {
                                    v1::StreamDanceRequest passages;
                                    passages.mutable_music_passages();
                                    return Requests{ConfigRequest(), passages};
                                  },
                                  kInvalidStatus,
                                  "music_passages[0].passages",
                                  {"empty"}},
                    BadStreamCase{"PassageLikeLater",
                                  [](const KeyMessage&) {
                                    v1::StreamDanceRequest passages;
                                    auto* passage =
                                        passages.mutable_music_passages()->add_passages();
                                    passage->set_from(3);
                                    passage->set_to(5);
                                    passage->set_like(4);
                                    return Requests{ConfigRequest(), passages};
                                  },
                                  kInvalidStatus,
                                  "music_passages[0].passages[0].like",
                                  {"4 s", "[0, 1]"}},
                    BadStreamCase{"GenerateUntilBackwards",
                                  [](const KeyMessage&) {
                                    v1::StreamDanceRequest until;
                                    until.mutable_generate_until()->set_frame(50);
                                    v1::StreamDanceRequest back;
                                    back.mutable_generate_until()->set_frame(40);
                                    return Requests{ConfigRequest(), until, back};
                                  },
                                  kInvalidStatus,
                                  "generate_until.frame",
                                  {"40", "50"}},
                    BadStreamCase{"RemovedIdThatNeverWas",
                                  [](const KeyMessage& key) {
                                    v1::StreamDanceRequest remove;
                                    remove.mutable_remove_keyframe()->set_id("ghost");
                                    return Requests{ConfigRequest(), key, remove};
                                  },
                                  grpc::StatusCode::NOT_FOUND,
                                  "remove_keyframes[0].id",
                                  {"ghost"}},
                    BadStreamCase{"RemovedTwice",
                                  [](const KeyMessage& key) {
                                    v1::StreamDanceRequest until, remove;
                                    until.mutable_generate_until()->set_frame(10);
                                    remove.mutable_remove_keyframe()->set_id("k");
                                    return Requests{ConfigRequest(), until, key, remove, remove};
                                  },
                                  grpc::StatusCode::NOT_FOUND,
                                  "remove_keyframes[1].id",
                                  {"\"k\""}}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    Config, BadStreamTest,
    testing::Values(
        BadStreamCase{"UnknownModel",
                      WithConfig([](auto& c) { c.set_model("paper"); }),
                      grpc::StatusCode::NOT_FOUND,
                      "config.model",
                      {"paper", "fake"}},
        // However long or odd a client's words are, the answer is one line that fits its trailers.
        BadStreamCase{"EndlessModel",
                      WithConfig([](auto& c) { c.set_model(std::string(100'000, 'x')); }),
                      grpc::StatusCode::NOT_FOUND,
                      "config.model",
                      {"xxx...xxx", "fake"}},
        BadStreamCase{"ModelOfControlCharacters",
                      WithConfig([](auto& c) { c.set_model(std::string("m\n\0\x7f\u00e9", 6)); }),
                      grpc::StatusCode::NOT_FOUND,
                      "config.model",
                      {"m\\x0a\\x00\\x7f\u00e9", "fake"}},
        BadStreamCase{"FrameRate",
                      WithConfig([](auto& c) { c.set_frame_rate(121); }),
                      kInvalidStatus,
                      "config.frame_rate",
                      {"121", "120"}},
        BadStreamCase{"FrameRateNaN",
                      WithConfig([](auto& c) { c.set_frame_rate(std::nan("")); }),
                      kInvalidStatus,
                      "config.frame_rate",
                      {"nan", "120"}},
        BadStreamCase{"Temperature",
                      WithConfig([](auto& c) { c.set_temperature(-0.5); }),
                      kInvalidStatus,
                      "config.temperature",
                      {"-0.5", "[0, 2]"}},
        BadStreamCase{"MusicDynamics",
                      WithConfig([](auto& c) { c.set_music_dynamics(1.5); }),
                      kInvalidStatus,
                      "config.music_dynamics",
                      {"1.5", "[0, 1]"}},
        BadStreamCase{"Style",
                      WithConfig([](auto& c) { c.set_style("foxtrot"); }),
                      kInvalidStatus,
                      "config.style",
                      {"foxtrot", "calm, wild"}},
        BadStreamCase{"EndlessStyle",
                      WithConfig([](auto& c) { c.set_style(std::string(257, 'x')); }),
                      kInvalidStatus,
                      "config.style",
                      {"257 bytes", "at most 256"}},
        BadStreamCase{"Frames",
                      WithConfig([](auto& c) { c.set_frames(0); }),
                      kInvalidStatus,
                      "config.frames",
                      {"0", "108000"}},
        BadStreamCase{
            "Encoding",
            WithConfig([](auto& c) { c.set_encoding(static_cast<v1::RotationEncoding>(17)); }),
            kInvalidStatus,
            "config.encoding",
            {"17"}},
        BadStreamCase{"AudioEncoding",
                      WithConfig([](auto& c) { c.mutable_audio_format(); }),
                      kInvalidStatus,
                      "config.audio_format.encoding",
                      {"PCM_F32LE"}},
        BadStreamCase{"SampleRate",
                      WithConfig([](auto& c) {
                        c.mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_PCM_S16LE);
                        c.mutable_audio_format()->set_sample_rate(7999);
                        c.mutable_audio_format()->set_channels(1);
                      }),
                      kInvalidStatus,
                      "config.audio_format.sample_rate",
                      {"7999", "8000"}},
        BadStreamCase{"Channels",
                      WithConfig([](auto& c) {
                        c.mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_PCM_S16LE);
                        c.mutable_audio_format()->set_sample_rate(44100);
                        c.mutable_audio_format()->set_channels(9);
                      }),
                      kInvalidStatus,
                      "config.audio_format.channels",
                      {"9", "8"}},
        BadStreamCase{"GenerateUntil",
                      WithConfig([](auto& c) { c.set_generate_until(-1); }),
                      kInvalidStatus,
                      "config.generate_until",
                      {"-1", "108000"}},
        BadStreamCase{"Beats",
                      WithConfig([](auto& c) {
                        c.add_music_beats(1);
                        c.add_music_beats(1);
                      }),
                      kInvalidStatus,
                      "config.music_beats[1]",
                      {"1 s"}},
        BadStreamCase{"Downbeats",
                      WithConfig([](auto& c) {
                        c.add_music_beats(1);
                        c.add_music_beats(1.5);
                        c.add_music_downbeats(1.5);
                        c.add_music_downbeats(2);
                      }),
                      kInvalidStatus,
                      "config.music_downbeats[1]",
                      {"2 s", "none of the beats"}},
        BadStreamCase{"BeatsConfidence",
                      [](const KeyMessage&) {
                        v1::StreamDanceRequest beats;
                        beats.mutable_music_beats()->add_times(1);
                        beats.mutable_music_beats()->set_confidence(1.5);
                        return Requests{ConfigRequest(), beats};
                      },
                      kInvalidStatus,
                      "music_beats[0].confidence",
                      {"1.5", "[0, 1]"}},
        BadStreamCase{"Passages",
                      WithConfig([](auto& c) {
                        c.add_music_passages()->set_from(3);
                        c.mutable_music_passages(0)->set_to(601);
                      }),
                      kInvalidStatus,
                      "config.music_passages[0].to",
                      {"601 s", "600"}},
        BadStreamCase{"Energies",
                      WithConfig([](auto& c) { c.add_music_energies(2.5F); }),
                      kInvalidStatus,
                      "config.music_energies[0]",
                      {"2.5", "[-2, 2]"}},
        BadStreamCase{"Variation",
                      WithConfig([](auto& c) { c.set_variation(1.5); }),
                      kInvalidStatus,
                      "config.variation",
                      {"1.5", "[0, 1]"}},
        BadStreamCase{"HistoryOfAnotherSkeleton",
                      WithConfig([](auto& c) {
                        v1::Pose* pose = c.mutable_history()->add_poses();
                        pose->mutable_root_position()->set_y(1);
                        pose->mutable_rotations()->Resize(3 * 23, 0.0F);
                      }),
                      kInvalidStatus,
                      "config.history.poses[0].rotations",
                      {"23 joints", "24"}},
        BadStreamCase{"ContinuationOfAnotherSkeleton",
                      WithConfig([](auto& c) {
                        v1::Continuation* from = c.mutable_continuation();
                        from->set_skeleton("tang23");
                        from->set_fingerprint("fake-1");
                        from->mutable_root_positions()->Resize(3 * 10, 0.0F);
                        from->mutable_rotations()->Resize(3 * 10 * 23, 0.0F);
                      }),
                      grpc::StatusCode::FAILED_PRECONDITION,
                      "config.continuation.skeleton",
                      {"tang23", "smpl24"}},
        BadStreamCase{"ContinuationOf23Joints",
                      WithConfig([](auto& c) {
                        v1::Continuation* from = c.mutable_continuation();
                        FillContinuation(from);
                        from->mutable_rotations()->Truncate(3 * 10 * 23);
                      }),
                      kInvalidStatus,
                      "config.continuation.rotations",
                      {"690", "720"}},
        BadStreamCase{"ShortContinuation",
                      WithConfig([](auto& c) {
                        c.mutable_continuation()->set_skeleton("smpl24");
                        c.mutable_continuation()->add_root_positions(1);
                      }),
                      kInvalidStatus,
                      "config.continuation.root_positions",
                      {"1 ", "30"}},
        BadStreamCase{"ContinuationWithHalfAStage",
                      WithConfig([](auto& c) {
                        v1::Continuation* from = c.mutable_continuation();
                        FillContinuation(from);
                        from->add_stage(1);
                      }),
                      kInvalidStatus,
                      "config.continuation.stage",
                      {"1 ", "2"}},
        BadStreamCase{"ContinuationOnNoStage",
                      WithConfig([](auto& c) {
                        v1::Continuation* from = c.mutable_continuation();
                        FillContinuation(from);
                        from->add_stage(1);
                        from->add_stage(NAN);
                      }),
                      kInvalidStatus,
                      "config.continuation.stage",
                      {"nan", "10000"}},
        BadStreamCase{"ContinuationFacingNowhere",
                      WithConfig([](auto& c) {
                        v1::Continuation* from = c.mutable_continuation();
                        FillContinuation(from);
                        from->set_front(7);
                      }),
                      kInvalidStatus,
                      "config.continuation.front",
                      {"7 radians", "a turn"}}),
    NameOf);

}  // namespace choreo::bad_stream_test
