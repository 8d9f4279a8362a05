#include "proto/wire/continuation_message.h"

#include <utility>

#include "model/core/error.h"

namespace choreo::wire {
namespace {

void CheckSize(int64_t size, int64_t expected, const std::string& shape, const std::string& field) {
  if (size == expected) return;
  throw InvalidArgument(
      field, std::to_string(size) + " numbers, not " + std::to_string(expected) + ' ' + shape);
}

}  // namespace

v1::Continuation ToProto(const Continuation& continuation, const Skeleton& skeleton, uint64_t seed,
                         bool sends_file) {
  v1::Continuation out;
  out.set_frame(continuation.frame);
  if (continuation.audio_from_sample && !sends_file)
    out.set_audio_from_sample(*continuation.audio_from_sample);
  out.set_fingerprint(continuation.fingerprint);
  out.set_seed(seed);
  for (const Pose& pose : continuation.poses) {
    for (const double value : pose.root_position) out.add_root_positions(static_cast<float>(value));
    for (const double value : pose.rotations.reshaped())
      out.add_rotations(static_cast<float>(value));
  }
  out.set_skeleton(skeleton.name);
  if (continuation.last_beat) out.set_last_beat(*continuation.last_beat);
  if (continuation.stage) {
    out.add_stage(static_cast<float>(continuation.stage->origin.x()));
    out.add_stage(static_cast<float>(continuation.stage->origin.z()));
    out.set_front(static_cast<float>(continuation.stage->heading));
  }
  for (const KeyReached& key : continuation.reached) {
    v1::ReachedKey* added = out.add_reached();
    added->set_id(key.id);
    added->set_frame(key.frame);
    added->set_raw_error_m(key.raw_error_m);
    added->set_final_error_m(key.final_error_m);
    added->set_final_error_deg(key.final_error_deg);
    added->set_correction_m(key.correction_m);
  }
  return out;
}

Continuation FromProto(const v1::Continuation& message, const Skeleton& skeleton,
                       int history_frames, const std::string& field) {
  if (message.skeleton() != skeleton.name) {
    throw Error(ErrorCode::kFailedPrecondition, field + ".skeleton",
                '"' + message.skeleton() + "\" is not the model's, \"" + skeleton.name + '"');
  }
  CheckSize(message.root_positions_size(), int64_t{3} * history_frames, "[history, 3]",
            field + ".root_positions");
  CheckSize(message.rotations_size(), int64_t{3} * history_frames * skeleton.joints(),
            "[history, joints, 3]", field + ".rotations");
  if (message.stage_size() > 0) CheckSize(message.stage_size(), 2, "[x, z]", field + ".stage");
  Continuation continuation;
  continuation.frame = message.frame();
  continuation.fingerprint = message.fingerprint();
  continuation.audio_from_sample = message.audio_from_sample();
  if (message.has_last_beat()) continuation.last_beat = message.last_beat();
  for (const v1::ReachedKey& key : message.reached()) {
    continuation.reached.push_back({.id = key.id(),
                                    .frame = key.frame(),
                                    .raw_error_m = key.raw_error_m(),
                                    .final_error_m = key.final_error_m(),
                                    .final_error_deg = key.final_error_deg(),
                                    .correction_m = key.correction_m()});
  }
  for (int i = 0; i < history_frames; ++i) {
    Pose pose;
    for (int axis = 0; axis < 3; ++axis) {
      pose.root_position[axis] = message.root_positions(3 * i + axis);
    }
    pose.rotations.resize(3, skeleton.joints());
    for (Eigen::Index d = 0; d < pose.rotations.size(); ++d) {
      pose.rotations.data()[d] = message.rotations(static_cast<int>(i * pose.rotations.size() + d));
    }
    continuation.poses.push_back(std::move(pose));
  }
  continuation.stage = GroundFrame::Of(continuation.poses.back());
  if (message.stage_size() > 0)
    continuation.stage->origin = {message.stage(0), 0, message.stage(1)};
  if (message.has_front()) continuation.stage->heading = message.front();
  return continuation;
}

}  // namespace choreo::wire
