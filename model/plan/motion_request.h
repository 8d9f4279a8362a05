#pragma once

#include <optional>
#include <vector>

#include "model/motion/controls/controls.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/motion.h"

namespace choreo {

/// What is asked of some frames of a dance: a transition's, or a window's of it. All poses are in
/// one frame of reference. Empty fields are unknown.
struct MotionRequest {
  int frames = 0;                     ///< N >= 1
  std::vector<Pose> history = {};     ///< tau poses, oldest first; the last one directly precedes
                                      ///< frame 0
  std::optional<Target> target = {};  ///< the key to reach; none: dances to music alone
  Controls controls = {};             ///< beside the key (paper C, Section 3.3)
  /// The music's beats, in frames from frame 0, ascending. A dance without a path is timed to them
  /// (plan/plan_stages.h).
  std::vector<double> beats = {};
  /// Of the body parts without requested velocity factors, for models that sample the energy
  /// themselves.
  EnergyShift energy_shift = {};
  /// The middle of the floor area in which the dance stays if nothing fixes its position, and the
  /// audience, which the dancer faces if nothing fixes the facing.
  std::optional<GroundFrame> stage = {};
};

}  // namespace choreo
