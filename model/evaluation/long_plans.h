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

/// `count` dances of EvalOptions::long_frames, spread evenly over the clips of a set and the places
/// within each. Beside music a dance ends with it; else a clip that is shorter than the dance
/// offers its keys forwards, backwards, forwards.
std::vector<LongPlan> PlanLongDances(const ModelInfo& model, const ClipSet& set, KeyTimes times,
                                     int count, const EvalOptions& options);

/// The real motion beside a long dance, of which its keys are frames: [plan.frames] poses.
std::vector<Pose> RealMotionBeside(const LongPlan& plan, const ClipSet& set);

/// One dance a clip through the clip's own poses each 2 s, for as long as the clip has them, a
/// minute at most, from its middle where there is more; no music, no beats, seed 0. Clips below
/// 20 s offer none. Dances end on a key.
std::vector<LongPlan> PlanKeyedDances(const ModelInfo& model, const ClipSet& set,
                                      float temperature);

/// Beats of one tempo, in frames, from before a dance of `frames` to behind it; `phase`: where the
/// first stands after frame 0, as a part of their distance.
std::vector<double> RegularBeats(double bpm, double phase, double fps, int frames);
/// As many on average, at distances of a half to one and a half of that, others for each `seed`:
/// what is danced to them meets the regular ones by chance alone.
std::vector<double> ShuffledBeats(double bpm, uint64_t seed, double fps, int frames);

/// Real motion as if a model had danced it between the keys of a plan: put on its feet, rounded as
/// sent. [plan.frames] poses.
std::vector<Pose> RealThroughFootwork(const ModelInfo& model, const LongPlan& plan,
                                      const ClipSet& set);

}  // namespace choreo
