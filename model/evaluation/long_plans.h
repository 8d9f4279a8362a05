#pragma once

#include <string>
#include <vector>

#include "model/evaluation/evaluation.h"

namespace choreo {

/// Which keys a long dance has: poses of its own clip.
enum class KeyTimes {
  kNone,
  kEachTwoSeconds,
  kEqual,    ///< each 100 frames, as in paper F's Table 4
  kOnBeats,  ///< as many, each on the beat nearest to the equal one
};
std::string NameOf(KeyTimes times);

/// `count` dances of EvalOptions::long_frames, spread evenly over the clips of a set and the places
/// within each. Beside music a dance ends with it; else a clip that is shorter than the dance
/// offers its keys forwards, backwards, forwards.
std::vector<LongPlan> PlanLongDances(const ModelInfo& model, const ClipSet& set, KeyTimes times,
                                     int count, const EvalOptions& options);

/// The real motion beside a long dance, of which its keys are frames: [chain.frames] poses.
std::vector<Pose> RealMotionBeside(const LongPlan& plan, const ClipSet& set);

}  // namespace choreo
