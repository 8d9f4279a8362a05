#include <bit>
#include <cstring>

#include "client/convert.h"

namespace choreo::client {

static_assert(std::endian::native == std::endian::little, "PCM is sent as it lies in memory");

v1::Keyframe ToProto(const KeyPose& key) {
  v1::Keyframe out;
  out.set_id(key.id);
  if (key.frame) {
    out.set_frame(*key.frame);
  } else {
    out.set_time(key.time_s);
  }
  *out.mutable_pose() = ToProto(key.pose, key.mask);
  if (!key.mask.joints.empty()) *out.mutable_mask() = ToProto(key.mask);
  if (key.hit) out.set_hit(*key.hit);
  if (key.hands) out.set_hands(ToProto(*key.hands));
  return out;
}

v1::DanceConfig ToProto(const DanceConfig& config) {
  v1::DanceConfig out;
  out.set_model(config.model);
  out.set_frame_rate(config.fps);
  out.set_encoding(v1::ROTATION_ENCODING_AXIS_ANGLE);
  if (config.seed) out.set_seed(*config.seed);
  wire::Write(config.manner, &out);
  wire::Write(config.known, &out);
  if (config.continuation) {
    if (!out.mutable_continuation()->ParseFromString(config.continuation->bytes)) {
      throw InvalidArgument("continuation", "the bytes are not those of a continuation");
    }
  } else if (!config.history.empty()) {
    for (const Pose& pose : config.history) *out.mutable_history()->add_poses() = ToProto(pose);
    out.mutable_history()->set_first_frame(config.first_frame);
  }
  switch (config.audio.kind) {
    case AudioKind::kNone:
      break;
    case AudioKind::kPcmFloat:
      out.mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_PCM_F32LE);
      out.mutable_audio_format()->set_sample_rate(static_cast<uint32_t>(config.audio.sample_rate));
      out.mutable_audio_format()->set_channels(static_cast<uint32_t>(config.audio.channels));
      break;
    case AudioKind::kFile:
      out.mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_FILE);
      break;
  }
  if (config.frames) out.set_frames(*config.frames);
  if (config.generate_until) out.set_generate_until(*config.generate_until);
  out.set_reject_invalid_keys(config.reject_invalid_keys);
  return out;
}

std::string ToPcmBytes(std::span<const float> samples) {
  std::string bytes(samples.size_bytes(), '\0');
  std::memcpy(bytes.data(), samples.data(), bytes.size());
  return bytes;
}

}  // namespace choreo::client
