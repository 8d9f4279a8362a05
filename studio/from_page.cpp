#include "studio/from_page.h"

#include <algorithm>
#include <climits>

#include "client/convert.h"
#include "model/audio/signal/format.h"
#include "model/core/text/field.h"
#include "model/formats/arrays/own_arrays.h"
#include "model/motion/pose/pose_limits.h"
#include "proto/wire/poses.h"

namespace choreo::studio {
namespace {

void RequireCount(const std::string& field, int64_t count, int64_t wanted) {
  if (count == wanted) return;
  throw InvalidArgument(field,
                        std::to_string(count) + " numbers, must be " + std::to_string(wanted));
}

/// A pose with the shortest form of its rotations, which in files may exceed a half turn.
Pose Unwound(Pose pose, const std::string& field) {
  CheckPoseLimits(pose, kMaxWoundRotation, Show(kMaxWoundRotation), field);
  MakeContinuous(pose, {{}, Eigen::Matrix3Xd::Zero(3, pose.rotations.cols())});
  return pose;
}

}  // namespace

client::KeyPose FromProto(const v1::Keyframe& key, const Skeleton& skeleton,
                          const std::string& field, const std::string& pose) {
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
      throw InvalidArgument(field + ".when", "must be a frame or a time");
  }
  const v1::JointMask* mask = key.mask().joints().empty() ? nullptr : &key.mask();
  Target target = wire::ToTarget(key.pose(), mask, skeleton, pose, field + ".mask");
  CheckPoseLimits(target.pose, kMaxRotation, "2π", pose);
  out.pose = std::move(target.pose);
  out.mask = std::move(target.mask);
  if (key.has_hit()) out.hit = key.hit();
  out.hands = wire::ToHands(key.hands(), field + ".hands");
  return out;
}

client::AudioFormat FromProto(const v1::AudioFormat& format) {
  if (format.encoding() != v1::AUDIO_ENCODING_PCM_F32LE)
    throw InvalidArgument("dance.live_music.encoding", "must be 32-bit floats");
  CheckAudioFormat(format.sample_rate(),
                   static_cast<int>(std::min(format.channels(), uint32_t{INT_MAX})),
                   "dance.live_music");
  if (format.first_sample() != 0)
    throw InvalidArgument("dance.live_music.first_sample", "must be 0");
  return {client::AudioKind::kPcmFloat, static_cast<int>(format.sample_rate()),
          static_cast<int>(format.channels())};
}

std::vector<Pose> PosesOf(const v1::History& history, const Skeleton& skeleton) {
  std::vector<Pose> poses;
  for (int i = 0; i < history.poses_size(); ++i) {
    const std::string field = At("dance.history.poses", i);
    poses.push_back(Unwound(wire::ToPose(history.poses(i), skeleton, field), field));
  }
  return poses;
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
