#include "studio/from_page.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <climits>
#include <cstring>
#include <initializer_list>
#include <string_view>

#include "client/convert.h"
#include "model/audio/format.h"
#include "model/core/field.h"
#include "model/formats/own_arrays.h"
#include "model/motion/pose_limits.h"
#include "proto/wire/controls.h"
#include "proto/wire/poses.h"

namespace choreo::studio {
namespace {

void RequireCount(const std::string& field, int64_t count, int64_t wanted) {
  if (count == wanted) return;
  throw InvalidArgument(field,
                        std::to_string(count) + " numbers, must be " + std::to_string(wanted));
}

constexpr const char* kAbsent = "must be absent: the studio decides it";

/// Refuses all fields that are set, except those that the caller reads.
void RequireOnly(const google::protobuf::Message& message, const std::string& prefix,
                 std::initializer_list<std::string_view> read) {
  std::vector<const google::protobuf::FieldDescriptor*> set;
  message.GetReflection()->ListFields(message, &set);
  for (const auto* field : set) {
    if (std::ranges::find(read, field->name()) == read.end())
      throw InvalidArgument(prefix + field->name(), kAbsent);
  }
}

/// A pose of a file, whose rotations may be wound up, with the shortest ones.
Pose Unwound(Pose pose, const std::string& field) {
  CheckPoseLimits(pose, kMaxWoundRotation, Show(kMaxWoundRotation), field);
  MakeContinuous(pose, {{}, Eigen::Matrix3Xd::Zero(3, pose.rotations.cols())});
  return pose;
}

}  // namespace

client::KeyPose FromProto(const v1::Keyframe& key, const Skeleton& skeleton) {
  client::KeyPose out;
  out.id = key.id();
  switch (key.when_case()) {
    case v1::Keyframe::kFrame:
      out.frame = key.frame();
      break;
    case v1::Keyframe::kTime:
      out.time_s = key.time();
      break;
    default:
      throw InvalidArgument("keyframe.when", "must be a frame or a time");
  }
  Target target = wire::ToTarget(key.pose(), key.has_mask() ? &key.mask() : nullptr, skeleton,
                                 "keyframe.pose", "keyframe.mask");
  CheckPoseLimits(target.pose, kMaxRotation, "2π", "keyframe.pose");
  out.pose = std::move(target.pose);
  out.mask = std::move(target.mask);
  if (key.has_hit()) out.hit = key.hit();
  out.hands = wire::ToHands(key.hands(), "keyframe.hands");
  return out;
}

client::DanceConfig FromProto(const v1::DanceConfig& config, const Skeleton& skeleton) {
  client::DanceConfig out;
  RequireOnly(config, "config.",
              {"seed", "temperature", "history", "continuation", "audio_format", "frames",
               "music_beats", "music_downbeats", "generate_until", "style", "music_dynamics",
               "variation", "reject_invalid_keys"});
  if (config.has_audio_format()) {
    const v1::AudioFormat& format = config.audio_format();
    if (format.encoding() != v1::AUDIO_ENCODING_PCM_F32LE)
      throw InvalidArgument("config.audio_format.encoding", "must be 32-bit floats");
    CheckAudioFormat(format.sample_rate(),
                     static_cast<int>(std::min(format.channels(), uint32_t{INT_MAX})),
                     "config.audio_format");
    if (format.first_sample() != 0)
      throw InvalidArgument("config.audio_format.first_sample", kAbsent);
    out.audio = {client::AudioKind::kPcmFloat, static_cast<int>(format.sample_rate()),
                 static_cast<int>(format.channels())};
  }
  if (config.has_generate_until()) out.generate_until = config.generate_until();
  out.reject_invalid_keys = config.reject_invalid_keys();
  if (config.has_seed()) out.seed = config.seed();
  if (config.has_temperature()) out.temperature = config.temperature();
  if (config.has_music_dynamics()) out.music_dynamics = config.music_dynamics();
  if (config.has_variation()) out.variation = config.variation();
  out.music_beats.assign(config.music_beats().begin(), config.music_beats().end());
  CheckBeats(out.music_beats, "config.music_beats");
  out.music_downbeats.assign(config.music_downbeats().begin(), config.music_downbeats().end());
  out.style = config.style();
  if (config.has_frames()) out.frames = config.frames();
  for (int i = 0; i < config.history().poses_size(); ++i) {
    const std::string field = At("config.history.poses", i);
    out.history.push_back(Unwound(wire::ToPose(config.history().poses(i), skeleton, field), field));
  }
  out.first_frame = config.history().first_frame();
  if (config.has_continuation()) out.continuation = client::FromProto(config.continuation());
  return out;
}

live::LiveBeatHint FromProto(const LiveBeats& beats) {
  const auto require = [](const char* field, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw InvalidArgument(field, Show(value) + " is not within " + Show(low) + " to " + Show(high));
  };
  live::LiveBeatHint hint;
  if (beats.has_tempo()) {
    require("live_beats.tempo", beats.tempo(), kSlowestHint, kFastestHint);
    hint.beats.tempo_bpm = beats.tempo();
  }
  if (beats.half_time() && beats.double_time())
    throw InvalidArgument("live_beats.double_time", "excludes half_time");
  hint.beats.half_time = beats.half_time();
  hint.beats.double_time = beats.double_time();
  require("live_beats.later", beats.later(), -1, 1);
  hint.later_s = beats.later();
  if (beats.has_downbeat()) {
    require("live_beats.downbeat", beats.downbeat(), 0, kMaxAudioSeconds);
    hint.downbeat_s = beats.downbeat();
  }
  return hint;
}

std::vector<float> SamplesOf(const v1::Audio& audio) {
  const std::string& bytes = audio.data();
  if (bytes.size() % sizeof(float) != 0)
    throw InvalidArgument("audio.data",
                          std::to_string(bytes.size()) + " bytes are no whole floats");
  std::vector<float> samples(bytes.size() / sizeof(float));
  std::memcpy(samples.data(), bytes.data(), bytes.size());
  return samples;
}

client::TransitionRequest FromProto(const v1::GenerateTransitionRequest& request,
                                    const Skeleton& skeleton) {
  client::TransitionRequest out;
  RequireOnly(request, "",
              {"config", "frames", "target", "target_mask", "target_id", "target_hit", "after",
               "candidates", "controls"});
  if (request.config().has_audio_format()) throw InvalidArgument("config.audio_format", kAbsent);
  out.config = FromProto(request.config(), skeleton);
  out.config.controls = wire::FromProto(request.controls(), "controls");
  out.frames = request.frames();
  if (request.has_target()) {
    Target target = wire::ToTarget(request.target(),
                                   request.has_target_mask() ? &request.target_mask() : nullptr,
                                   skeleton, "target", "target_mask");
    out.target = Unwound(std::move(target.pose), "target");
    out.target_mask = std::move(target.mask);
  }
  if (request.has_target_hit()) out.target_hit = request.target_hit();
  out.target_id = request.target_id();
  for (int i = 0; i < request.after_size(); ++i) {
    out.after.push_back(
        Unwound(wire::ToPose(request.after(i), skeleton, At("after", i)), At("after", i)));
  }
  out.candidates = static_cast<int>(std::max(1U, request.candidates()));
  return out;
}

client::FinishedDance FromProto(const Clip& clip, const Skeleton& skeleton) {
  const v1::Frames& frames = clip.frames();
  const int64_t count = frames.count();
  if (count < 1) throw InvalidArgument("clip.frames", "there are none");
  RequireCount("clip.frames.root_positions", frames.root_positions_size(), 3 * count);
  RequireCount("clip.frames.rotations", frames.rotations_size(), 3 * count * skeleton.joints());
  CheckRate("clip.frame_rate", clip.frame_rate());
  v1::Frames whole = frames;
  const bool touches = frames.contacts_size() > 0;
  if (!touches) whole.mutable_contacts()->Resize(static_cast<int>(4 * count), 0);
  client::FrameBlock block = client::FromProto(whole, skeleton.joints());
  client::FinishedDance out;
  out.motion = {.fps = clip.frame_rate(), .frames = std::move(block.poses)};
  if (touches) out.contacts = std::move(block.contacts);
  CheckMotionLimits(out.motion);
  return out;
}

}  // namespace choreo::studio
