#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/core/valid.h"
#include "model/motion/motion.h"
#include "model/plan/arrival.h"
#include "model/plan/model_info.h"
#include "model/plan/motion_request.h"
#include "model/plan/transition_noise.h"

namespace choreo {

/// A key after the end of a transition.
struct LaterTarget {
  Target target;
  int frames = 0;  ///< >= 1, from the transition's last frame to the key's
};

/// MusicFeatures of a transition.
struct MusicRows {
  Eigen::MatrixXf history;  ///< [features, tau], of the history's frames, oldest first
  Eigen::MatrixXf rows;     ///< [features, frames], of the transition's own frames
};

/// All inputs of a transition, whose target is the pose of its last frame. Its poses are in the
/// world for a TransitionRun, in the canonical frame (motion/kinematics/canonical.h) for a Sampler.
/// Without a stage it takes the position and facing of the history's last pose.
struct TransitionSpec : MotionRequest, TransitionNoise {
  std::optional<LaterTarget> later = {};  ///< only without a target; for models with sight_frames
  /// The pose one frame after the target, if the following motion already exists.
  std::optional<Pose> after = {};
  /// How hard the target is hit, 0 to kMaxHit (plan/plan_stages.h). The dancer then comes to rest
  /// in it unless `after` follows. None: passes the target at the dance's own speed.
  std::optional<double> hit = {};
  /// The most frames to sample again (plan/takes.h).
  int spare_frames = 0;
  std::string style = {};               ///< one of the model's, or empty for any
  std::optional<MusicRows> music = {};  ///< for models that hear; none: no music
  // Set the next two to 0 and false to measure the model alone.
  int arrival_frames = 12;  ///< Arrival's window; TransitionRun's to a key on the floor is longer
  bool footwork = true;
};

/// A spec checked against its model.
class ValidSpec : public Valid<TransitionSpec> {
 public:
  /// Throws Error(kInvalidArgument), naming the field, unless frames, history, joints, mask, music
  /// rows and controls have the model's shape, for a control or a style that the model lacks, and
  /// for a temperature above kMaxTemperature.
  ValidSpec(TransitionSpec spec, const ModelInfo& model);

  /// Sets the numbers of another take (plan/takes.h).
  void SetTake(uint32_t candidate, int spare_frames) {
    request_.candidate = candidate;
    request_.spare_frames = spare_frames;
  }
  /// Describes the same transition in another frame of reference: `change` alters nothing else.
  void ChangeFrame(const auto& change) { change(&request_); }
};

/// Whether the spec's target fixes the root's position or a joint.
bool Keyed(const TransitionSpec& spec);

/// The Arrival that steers the spec's frames to its target; none without a target or with
/// arrival_frames 0. An autoregressive model steers each frame before it samples the next, so that
/// it continues from the dance's actual pose.
std::optional<Arrival> ArrivalOf(const TransitionSpec& spec,
                                 Arrival::Lead lead = Arrival::Lead::kWithModel);

}  // namespace choreo
