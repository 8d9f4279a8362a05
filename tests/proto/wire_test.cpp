#include "proto/wire/convert.h"

#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "model/core/error.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/motion/kinematics/kinematics.h"
#include "proto/wire/continuation_message.h"
#include "proto/wire/field_path.h"
#include "proto/wire/poses.h"
#include "tests/support/expect_error.h"

namespace choreo::wire_test {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// Whether each field that the API has is written, also in the messages inside. Of a oneof, the
/// member that is set counts.
void ExpectFull(const Message& message) {
  const auto& type = *message.GetDescriptor();
  const auto& reflection = *message.GetReflection();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor* field = type.field(i);
    if (const auto* oneof = field->real_containing_oneof()) {
      EXPECT_TRUE(reflection.HasOneof(message, oneof)) << oneof->full_name();
      if (!reflection.HasField(message, field)) continue;
    }
    EXPECT_TRUE(field->is_repeated() ? reflection.FieldSize(message, field) > 0
                                     : reflection.HasField(message, field))
        << field->full_name();
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) continue;
    if (!field->is_repeated()) {
      ExpectFull(reflection.GetMessage(message, field));
    } else if (reflection.FieldSize(message, field) > 0) {
      ExpectFull(reflection.GetRepeatedMessage(message, field, 0));
    }
  }
}

template <class Proto>
void ExpectBackAgain(const Proto& message) {
  ExpectFull(message);
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(
      wire::ToProto(wire::FromProto(message)), message))
      << message.DebugString();
}

KeyReached SomeKey() { return {"a", 30, 0.25, 0.5, 0.75, 1, 1.25}; }

KeyReached KeyWithHands() {
  KeyReached key = SomeKey();
  key.hands = HandPose::kFist;
  return key;
}

TEST(Wire, ReportsRoundTrip) {
  QualityReport report{.frames = 90,
                       .keys = {SomeKey()},
                       .measured_from = 30,
                       .log_likelihood = -2,
                       .skate_ratio = 0.25,
                       .support = 0.5,
                       .beat_hit_rate = 0.75,
                       .beat_coverage = 1.5,
                       .max_key_acceleration = 9,
                       .p95_acceleration = 8};
  for (int part = 1; part <= kBodyParts; ++part) report.part_speeds.push_back({0.5 * part, 0.25});
  ExpectBackAgain(wire::ToProto(report));
}

TEST(Wire, TimingsRoundTrip) { ExpectBackAgain(wire::ToProto(CallTiming{0.25, 2, 3})); }

TEST(Wire, ModelsRoundTrip) {
  const ModelDescription model{.name = "default",
                               .fingerprint = "f",
                               .licence = "l",
                               .card = "{}",
                               .skeleton = Skeleton::Smpl24(),
                               .fps = 30,
                               .history_frames = 10,
                               .default_temperature = 0.5,
                               .controls = {"root_path", "velocity_factors"},
                               .velocity_references = {{"median", {0.5, 1, 1.5, 2, 2.5}}},
                               .styles = {"calm"},
                               .style_figures = StyleFigures{60, 25, 50},
                               .takes_music = false,
                               .likelihood = true,
                               .deterministic = true,
                               .audio_lead_s = 0.5,
                               .latency_frames = 4,
                               .max_transition_frames = 600};
  ExpectBackAgain(wire::ToProto(model));
}

TEST(Wire, HeadersRoundTrip) {
  ExpectBackAgain(wire::ToProto(DanceHeader{.model = "default",
                                            .fingerprint = "f",
                                            .skeleton = Skeleton::Smpl24(),
                                            .seed = 7,
                                            .temperature = 0.5,
                                            .fps = 60,
                                            .model_fps = 30,
                                            .first_frame = 90,
                                            .latency_frames = 4,
                                            .exact_resume = true,
                                            .free_transition_frames = 60,
                                            .server_version = "0.2.0"}));
  EXPECT_THROW(wire::FromProto(v1::Header()), Error) << "no frame rate";
}

TEST(Wire, ContinuationsRoundTrip) {
  const Skeleton skeleton = Skeleton::Smpl24();
  Pose pose = StandingPose(skeleton);
  pose.rotations.setConstant(0.25);
  const v1::Continuation message =
      wire::ToProto(Continuation{.frame = 30,
                                 .poses = {pose, pose},
                                 .fingerprint = "f",
                                 .audio_from_sample = 22050,
                                 .last_beat = 0.75,
                                 .stage = GroundFrame{{1, 0, 2}, 0.5},
                                 .reached = {{"a", 20, 0.25, 0.5, 0.75, 1}}},
                    skeleton, /*seed=*/7, /*sends_file=*/false);
  ExpectFull(message);
  const Continuation back = wire::FromProto(message, skeleton, 2, "config.continuation");
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(
      wire::ToProto(back, skeleton, 7, false), message))
      << message.DebugString();
  EXPECT_EQ(wire::ToProto(back, skeleton, 7, /*sends_file=*/true).audio_from_sample(), 0);
  EXPECT_THROW(wire::FromProto(message, skeleton, 3, "config.continuation"), Error);
}

TEST(Wire, EventsRoundTrip) {
  for (const DanceEvent& event : std::vector<DanceEvent>{
           KeyWithHands(),
           KeyRejected{"a", 30, 33, "wrong", KeyRejected::Code::kInvalid, "keyframe.pose"},
           Beat{30, 1.25, Beat::Source::kHeard, 0.5, true},
           Warning{30, "fast", Warning::Code::kJointTooFast, "a", 12, 11}}) {
    const v1::Event message = wire::ToProto(event, 30);
    EXPECT_EQ(message.time(), event.index() == 3 ? 1.25 : 1);
    ExpectFull(message);
    const std::optional<DanceEvent> back = wire::FromProto(message);
    ASSERT_TRUE(back);
    EXPECT_EQ(wire::ToProto(*back, 30).SerializeAsString(), message.SerializeAsString());
  }
  EXPECT_FALSE(wire::FromProto(v1::Event())) << "of a later version";
}

TEST(Wire, HandsRoundTrip) {
  for (size_t i = 0; i < kHandPoseNames.size(); ++i) {
    const auto hands = static_cast<HandPose>(i);
    EXPECT_EQ(wire::FromProto(wire::ToProto(hands)), hands) << kHandPoseNames[i];
    EXPECT_TRUE(v1::HandPose_IsValid(wire::ToProto(hands))) << kHandPoseNames[i];
  }
  EXPECT_EQ(wire::FromProto(v1::HAND_POSE_UNSPECIFIED), std::nullopt);
  EXPECT_EQ(wire::FromProto(static_cast<v1::HandPose>(v1::HandPose_MAX + 1)), std::nullopt);
}

TEST(Wire, HandsOfAClientAreChecked) {
  EXPECT_EQ(wire::ToHands(v1::HAND_POSE_UNSPECIFIED, "hands"), std::nullopt);
  EXPECT_EQ(wire::ToHands(v1::HAND_POSE_FIST, "hands"), HandPose::kFist);
  ExpectError(ErrorCode::kInvalidArgument,
              "keyframe.hands: 99, must be 0 to " + std::to_string(v1::HandPose_MAX),
              [] { wire::ToHands(static_cast<v1::HandPose>(99), "keyframe.hands"); });
}

TEST(Wire, CodesOfLaterVersionsAreUnknown) {
  v1::Event event;
  event.mutable_warning()->set_code(static_cast<v1::WarningCode>(v1::WarningCode_MAX + 1));
  EXPECT_EQ(std::get<Warning>(*wire::FromProto(event)).code, Warning::Code::kUnknown);
  event.mutable_warning()->set_code(v1::WarningCode_MAX);
  EXPECT_EQ(std::get<Warning>(*wire::FromProto(event)).code, Warning::Code::kBeatsBehindMusic);
  event.mutable_keyframe_rejected()->set_code(v1::RejectionCode_MAX);
  EXPECT_EQ(std::get<KeyRejected>(*wire::FromProto(event)).code, KeyRejected::Code::kInvalid);
  event.mutable_beat()->set_source(v1::BeatSource_MAX);
  EXPECT_EQ(std::get<Beat>(*wire::FromProto(event)).source, Beat::Source::kHeard);
}

/// Whether a message of this type has a field with this path.
bool HasPath(const google::protobuf::Descriptor* type, const std::string& path) {
  const size_t dot = path.find('.');
  const FieldDescriptor* field = type->FindFieldByName(path.substr(0, dot));
  if (field == nullptr || dot == std::string::npos) return field != nullptr;
  return field->message_type() != nullptr && HasPath(field->message_type(), path.substr(dot + 1));
}

TEST(Wire, FieldsOfTheModelHavePathsInTheApi) {
  for (const char* field : {"after",
                            "audio",
                            "audio.channels",
                            "audio.first_sample",
                            "audio.sample_rate",
                            "beats",
                            "before",
                            "candidates",
                            "confidence",
                            "continuation.frame",
                            "controls",
                            "downbeats",
                            "end_frame",
                            "end_of_audio",
                            "first_frame",
                            "first_sample",
                            "frames",
                            "generate_until",
                            "history",
                            "hit",
                            "key.after_previous",
                            "key.at_frame",
                            "key.at_time",
                            "key.hit",
                            "key.id",
                            "key.mask.joints",
                            "key.pose.rotations",
                            "keys_complete",
                            "music_beats",
                            "music_downbeats",
                            "music_dynamics",
                            "music_energies",
                            "music_passages",
                            "output_fps",
                            "passages",
                            "push_audio",
                            "rank_by",
                            "removed_key.id",
                            "samples",
                            "style",
                            "target",
                            "target.mask.joints",
                            "target_id",
                            "temperature",
                            "until",
                            "variation"}) {
    const std::string path = wire::PathOf(field);
    EXPECT_TRUE(HasPath(v1::StreamDanceRequest::descriptor(), path) ||
                HasPath(v1::GenerateTransitionRequest::descriptor(), path))
        << field << " -> " << path;
  }
}

TEST(Wire, ErrorsNameTheFieldAsSent) {
  EXPECT_EQ(wire::PathOf("history[1].rotations"), "config.history.poses[1].rotations");
  EXPECT_EQ(wire::PathOf("audio.first_sample"), "config.audio_format.first_sample");
  EXPECT_EQ(wire::PathOf("key.at_time"), "keyframe.time");
  EXPECT_EQ(wire::PathOf("keyframe.pose"), "keyframe.pose") << "begins like key";
  EXPECT_EQ(wire::PathOf(""), "");
  ExpectError(ErrorCode::kOutOfRange, "config.frames: 7 is too long", [] {
    wire::WithPaths([] { throw Error(ErrorCode::kOutOfRange, "end_frame", "7 is too long"); });
  });
}

TEST(Wire, RemediesNameFields) {
  for (const Remedy remedy : {Remedy::kGrantFrames, Remedy::kSetEnd, Remedy::kAllowInexact}) {
    const std::string text = wire::WithRemedy("", remedy);
    ASSERT_GT(text.size(), 3U);
    EXPECT_TRUE(HasPath(v1::StreamDanceRequest::descriptor(), text.substr(2, text.size() - 3)))
        << text;
  }
  ExpectError(ErrorCode::kInvalidArgument, "keyframes_complete: it has no end (config.frames)", [] {
    wire::WithPaths([] {
      throw Error(ErrorCode::kInvalidArgument, "keys_complete", "it has no end", Remedy::kSetEnd);
    });
  });
  EXPECT_EQ(wire::WithRemedy("it is too long", Remedy::kTakePart), "it is too long");
  EXPECT_EQ(wire::ToProto(KeyRejected{.reason = "it is frozen", .remedy = Remedy::kGrantFrames}, 30)
                .keyframe_rejected()
                .reason(),
            "it is frozen (config.generate_until)");
}

}  // namespace choreo::wire_test
