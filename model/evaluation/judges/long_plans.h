#pragma once

#include <string>
#include <vector>

#include "model/core/grid.h"
#include "model/evaluation/evaluation.h"

namespace choreo {

/// The times of a long dance's keys, which are poses of its own clip.
enum class KeyTimes {
  kNone,
  kEachTwoSeconds,
  kEqual,    ///< every 100 frames, as in paper F's Table 4
  kOnBeats,  ///< as many, each on the beat nearest to the equal times
};

/// Plans `count` dances of EvalOptions::long_frames, spread evenly over the clips of a set and the
/// positions within each. A dance with music ends with it. Without music, a clip shorter than the
/// dance provides keys forwards, backwards, forwards.
std::vector<LongPlan> PlanLongDances(const ModelInfo& model, const ClipSet& set, KeyTimes times,
                                     int count, const EvalOptions& options);

/// The real motion from which a long dance takes its keys: [plan.frames] poses.
std::vector<Pose> RealMotionBeside(const LongPlan& plan, const ClipSet& set);

/// Plans one dance per clip through the clip's own poses, one every `interval` frames, as long as
/// the clip but at most a minute from its middle; no music, no beats, seed 0. Skips clips below 20
/// s. Dances end on a pose that is a key at the usual interval.
std::vector<LongPlan> PlanKeyedDances(const ModelInfo& model, const ClipSet& set, float temperature,
                                      int interval = kTypicalFrames);

/// Beats of one tempo, in frames, from before a dance of `frames` to after it. `phase`: the
/// position of the first beat after frame 0, as a fraction of the beats' distance.
std::vector<double> RegularBeats(double bpm, double phase, double fps, int frames);
/// As many beats as RegularBeats on average, at 0.5 to 1.5 times their distance, different for each
/// `seed`. A dance to them meets the regular beats only by chance.
std::vector<double> ShuffledBeats(double bpm, uint64_t seed, double fps, int frames);

/// Real motion, treated like a model's between a plan's keys: with footwork, rounded as sent.
/// [plan.frames] poses.
std::vector<Pose> RealThroughFootwork(const ModelInfo& model, const LongPlan& plan,
                                      const ClipSet& set);

}  // namespace choreo
