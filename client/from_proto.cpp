#include <algorithm>

#include "client/convert.h"

namespace choreo::client {

void CheckFrames(const v1::Frames& frames, int joints) {
  const int64_t count = frames.count();
  if (count < 1 || frames.root_positions_size() != 3 * count ||
      frames.rotations_size() != 3 * count * joints || frames.contacts_size() != 4 * count) {
    throw wire::Broken("frames whose arrays do not have the length that their count asks for");
  }
}

FrameBlock FromProto(const v1::Frames& frames, int joints) {
  CheckFrames(frames, joints);
  FrameBlock out;
  out.first_frame = frames.first_frame();
  out.candidate = frames.candidate();
  out.poses.resize(static_cast<size_t>(frames.count()));
  out.contacts.resize(out.poses.size());
  const float* rotations = frames.rotations().data();
  const float* roots = frames.root_positions().data();
  const float* contacts = frames.contacts().data();
  for (size_t i = 0; i < out.poses.size(); ++i) {
    out.poses[i].root_position = Eigen::Map<const Eigen::Vector3f>(roots + 3 * i).cast<double>();
    out.poses[i].rotations = Eigen::Map<const Eigen::Matrix3Xf>(
                                 rotations + 3 * i * static_cast<size_t>(joints), 3, joints)
                                 .cast<double>();
    std::copy_n(contacts + 4 * i, 4, out.contacts[i].begin());
  }
  return out;
}

Continuation FromProto(const v1::Continuation& continuation) {
  return {continuation.frame(), continuation.audio_from_sample(), continuation.fingerprint(),
          continuation.SerializeAsString()};
}

Report FromProto(const v1::QualityReport& report, const v1::Timing& timing) {
  return {FromProto(report), FromProto(timing)};
}

ServerDescription FromProto(const v1::GetServerInfoResponse& response) {
  ServerDescription out;
  out.version = response.version();
  for (const v1::ModelInfo& model : response.models()) {
    ModelDescription& added = out.models.emplace_back(FromProto(model));
    // Servers before 0.2 do not send their models' limits.
    if (added.max_transition_frames == 0)
      added.max_transition_frames = response.limits().max_transition_frames();
  }
  if (out.models.empty()) throw wire::Broken("a server without models");
  out.devices.assign(response.devices().begin(), response.devices().end());
  out.workers = response.slots();
  out.active_streams = response.active_streams();
  out.draining = response.draining();
  const v1::Limits& limits = response.limits();
  out.limits = {limits.max_message_bytes(),     limits.max_audio_s(),
                limits.max_audio_file_bytes(),  limits.max_keyframes(),
                limits.max_transition_frames(), limits.max_candidates(),
                limits.max_frame_rate(),        limits.max_streams()};
  return out;
}

}  // namespace choreo::client
