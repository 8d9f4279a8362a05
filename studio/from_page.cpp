#include "studio/from_page.h"

#include <algorithm>
#include <climits>
#include <cstring>

#include "client/authoring/music_beats.h"
#include "client/convert.h"
#include "model/audio/format.h"
#include "model/formats/own_arrays.h"
#include "model/motion/pose_limits.h"
#include "proto/wire/controls.h"

namespace choreo::studio {
namespace {

void RequireCount(const std::string& field, int count, int wanted) {
  if (count == wanted) return;
  throw InvalidArgument(field,
                        std::to_string(count) + " numbers, must be " + std::to_string(wanted));
}

Pose ToPose(const v1::Pose& pose, const Skeleton& skeleton, const std::string& field,
            double max_rotation) {
  if (pose.encoding() > v1::ROTATION_ENCODING_AXIS_ANGLE)
    throw InvalidArgument(field + ".encoding", "must be axis-angle");
  RequireCount(field + ".rotations", pose.rotations_size(), 3 * skeleton.joints());
  Pose out;
  const v1::Vector3& root = pose.root_position();
  out.root_position = {root.x(), root.y(), root.z()};
  out.rotations = Eigen::Map<const Eigen::Matrix3Xf>(pose.rotations().data(), 3, skeleton.joints())
                      .cast<double>();
  CheckPoseLimits(out, max_rotation, "the limit", field);
  return out;
}

PoseMask ToMask(const v1::JointMask* joints, bool root_position, const Skeleton& skeleton,
                const std::string& field) {
  PoseMask mask;
  mask.root_position = root_position;
  if (!joints) return mask;
  mask.joints.assign(static_cast<size_t>(skeleton.joints()), false);
  for (const int joint : joints->joints()) {
    if (joint < 0 || joint >= skeleton.joints()) {
      throw InvalidArgument(field, "joint " + std::to_string(joint) + ", must be 0 to " +
                                       std::to_string(skeleton.joints() - 1));
    }
    mask.joints[static_cast<size_t>(joint)] = true;
  }
  return mask;
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
  out.pose = ToPose(key.pose(), skeleton, "keyframe.pose", kMaxRotation);
  out.mask = ToMask(key.has_mask() ? &key.mask() : nullptr, key.pose().has_root_position(),
                    skeleton, "keyframe.mask.joints");
  if (key.has_hit()) out.hit = key.hit();
  return out;
}

client::DanceConfig FromProto(const v1::DanceConfig& config, const Skeleton& skeleton) {
  client::DanceConfig out;
  const auto refuse = [](const char* field) {
    throw InvalidArgument(field, "must be absent: the studio sees to it");
  };
  if (!config.model().empty()) refuse("config.model");
  if (config.music_id() != 0) refuse("config.music_id");
  if (config.music_passages_size() > 0) refuse("config.music_passages");
  if (config.frame_rate() != 0) refuse("config.frame_rate");
  if (config.has_audio_format()) {
    const v1::AudioFormat& format = config.audio_format();
    if (format.encoding() != v1::AUDIO_ENCODING_PCM_F32LE)
      throw InvalidArgument("config.audio_format.encoding", "must be 32-bit floats");
    CheckAudioFormat(format.sample_rate(),
                     static_cast<int>(std::min(format.channels(), uint32_t{INT_MAX})),
                     "config.audio_format");
    if (format.first_sample() != 0) refuse("config.audio_format.first_sample");
    out.audio = {client::AudioKind::kPcmFloat, static_cast<int>(format.sample_rate()),
                 static_cast<int>(format.channels())};
  }
  if (config.has_generate_until()) out.generate_until = config.generate_until();
  if (config.has_seed()) out.seed = config.seed();
  if (config.has_temperature()) out.temperature = config.temperature();
  if (config.has_music_dynamics()) out.music_dynamics = config.music_dynamics();
  if (config.has_variation()) out.variation = config.variation();
  out.music_beats.assign(config.music_beats().begin(), config.music_beats().end());
  authoring::CheckBeats(out.music_beats, "config.music_beats");
  out.style = config.style();
  if (config.has_frames()) out.frames = config.frames();
  for (int i = 0; i < config.history().poses_size(); ++i) {
    out.history.push_back(ToPose(config.history().poses(i), skeleton,
                                 "config.history.poses[" + std::to_string(i) + "]",
                                 kMaxWoundRotation));
  }
  out.first_frame = config.history().first_frame();
  if (config.has_continuation()) out.continuation = client::FromProto(config.continuation());
  // A file's rotations may have wound up; send the shortest way.
  const Pose unturned{{}, Eigen::Matrix3Xd::Zero(3, skeleton.joints())};
  for (Pose& pose : out.history) MakeContinuous(pose, unturned);
  return out;
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
  out.config = FromProto(request.config(), skeleton);
  out.config.controls = wire::FromProto(request.controls(), "controls");
  out.frames = request.frames();
  if (request.has_audio() || request.config().has_audio_format())
    throw InvalidArgument("audio", "must be absent: the studio sees to it");
  const Pose unturned{{}, Eigen::Matrix3Xd::Zero(3, skeleton.joints())};
  if (request.has_target()) {
    out.target = ToPose(request.target(), skeleton, "target", kMaxWoundRotation);
    MakeContinuous(*out.target, unturned);
    out.target_mask = ToMask(request.has_target_mask() ? &request.target_mask() : nullptr,
                             request.target().has_root_position(), skeleton, "target_mask.joints");
  }
  if (request.has_target_hit()) out.target_hit = request.target_hit();
  out.target_id = request.target_id();
  for (int i = 0; i < request.after_size(); ++i) {
    out.after.push_back(
        ToPose(request.after(i), skeleton, "after[" + std::to_string(i) + "]", kMaxWoundRotation));
    MakeContinuous(out.after.back(), unturned);
  }
  out.candidates = static_cast<int>(std::max(1U, request.candidates()));
  return out;
}

client::FinishedDance FromProto(const Clip& clip, const Skeleton& skeleton) {
  const v1::Frames& frames = clip.frames();
  const int count = frames.count();
  if (count < 1) throw InvalidArgument("clip.frames", "there are none");
  RequireCount("clip.frames.root_positions", frames.root_positions_size(), 3 * count);
  RequireCount("clip.frames.rotations", frames.rotations_size(), 3 * count * skeleton.joints());
  CheckRate("clip.frame_rate", clip.frame_rate());
  v1::Frames whole = frames;
  const bool touches = frames.contacts_size() > 0;
  if (!touches) whole.mutable_contacts()->Resize(4 * count, 0);
  client::FrameBlock block = client::FromProto(whole, skeleton.joints());
  client::FinishedDance out;
  out.motion = {.fps = clip.frame_rate(), .frames = std::move(block.poses)};
  if (touches) out.contacts = std::move(block.contacts);
  CheckMotionLimits(out.motion);
  return out;
}

}  // namespace choreo::studio
