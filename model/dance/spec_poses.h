#pragma once

#include <optional>
#include <span>
#include <vector>

#include "model/motion/canonical.h"
#include "model/plan/transition_spec.h"

/// The poses that a transition is asked to start from and to reach, and what the way between them
/// takes. Pure functions.
namespace choreo {

/// The average speeds needed to reach a key. Paper F, Section 5.2: an interval too short for the
/// change fails.
struct RequiredSpeed {
  double root_m_per_s = 0;
  double joint_rad_per_s = 0;  ///< of the fastest joint
  int joint = 0;
  /// A dance warns beyond these limits: a sprint, and the fastest limbs of real dances.
  static constexpr double kRootLimit = 5.0;
  static constexpr double kJointLimit = 15.0;
  bool TooFast() const { return root_m_per_s > kRootLimit || joint_rad_per_s > kJointLimit; }
};

/// None without a target. `spec`: with a history.
std::optional<RequiredSpeed> RequiredSpeedOf(const TransitionSpec& spec, double fps);

/// Whether the dancer only keeps the pose that she has: its target is that pose where she is, or
/// anywhere, and so soon that nobody dances away from it and back. No model is asked, and a path
/// waits. `world`: with at least one pose of history.
bool IsHold(const TransitionSpec& world, double fps);

/// Gives a key without a position that of the path's end, if there is a path. A dancer who holds
/// the key's pose stays in place.
std::optional<Target> Placed(std::optional<Target> target, const Controls& controls,
                             const Pose& now);

/// The history of a transition after these poses: exactly tau of them, rounded to floats. Fewer are
/// padded with the earliest; none mean a dancer who stands.
std::vector<Pose> FillHistory(const ModelInfo& model, std::span<const Pose> poses);

/// Rounds every number to a float, as clients receive it.
Pose RoundToFloat(const Pose& pose);

/// The history in its canonical frame. Rotation vectors grow with each whole turn of a dance: this
/// shortens those of the last pose, and keeps the earlier ones continuous with it, as training data
/// are.
std::vector<Pose> CanonicalHistory(const GroundFrame& ground, const std::vector<Pose>& world);

/// The nearest float. Compilers drop the rounding of plain conversions.
double ToFloat(double value);

}  // namespace choreo
