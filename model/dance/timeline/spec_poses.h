#pragma once

#include <optional>
#include <span>
#include <vector>

#include "model/motion/kinematics/canonical.h"
#include "model/plan/model_info.h"
#include "model/plan/transition_spec.h"

/// The start and target poses of a transition, and the speeds needed between them. Pure functions.
namespace choreo {

/// The average speeds needed to reach a key. A transition fails if its interval is too short for
/// the change (paper F, Section 5.2).
struct RequiredSpeed {
  double root_m_per_s = 0;
  double joint_rad_per_s = 0;  ///< of the fastest joint
  int joint = 0;
  /// Limits beyond which a dance warns: a sprint, and the fastest limbs of real dances.
  static constexpr double kRootLimit = 5.0;
  static constexpr double kJointLimit = 15.0;
  bool TooFast() const { return root_m_per_s > kRootLimit || joint_rad_per_s > kJointLimit; }
};

/// The speeds needed to reach the spec's target; none without a target. `spec` must have a history.
std::optional<RequiredSpeed> RequiredSpeedOf(const TransitionSpec& spec, double fps);

/// Whether the dancer only holds the present pose: the target is that pose, at the same position or
/// without one, and too soon to dance away and back. A hold does not run the model; a path waits.
/// `world`: must have at least one pose of history.
bool IsHold(const TransitionSpec& world, double fps);

/// Gives a target without a position the position of the path's end, if there is a path. A dancer
/// who already has the target's pose stays in place.
std::optional<Target> Placed(std::optional<Target> target, const Controls& controls,
                             const Pose& now);

/// The history of a transition after `poses`: exactly tau poses, rounded to floats. Fewer poses are
/// padded with the earliest; no poses mean the neutral stance.
std::vector<Pose> FillHistory(const ModelInfo& model, std::span<const Pose> poses);

/// Rounds every number to a float, as clients receive it.
Pose RoundToFloat(const Pose& pose);

/// The history in its canonical frame. Rotation vectors grow with each whole turn of a dance. This
/// shortens the last pose's vectors, and keeps earlier poses continuous with it, as in training
/// data.
std::vector<Pose> CanonicalHistory(const GroundFrame& ground, const std::vector<Pose>& world);

/// The nearest float. Compilers drop the rounding of plain conversions.
double ToFloat(double value);

}  // namespace choreo
