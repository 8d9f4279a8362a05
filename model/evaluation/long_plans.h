#pragma once

#include <string>
#include <vector>

#include "model/core/grid.h"
#include "model/evaluation/evaluation.h"

namespace choreo {

/// When a long dance has keys (poses of its own clip).
enum class KeyTimes {
  kNone,
  kEachTwoSeconds,
  kEqual,    ///< every 100 frames, as in paper F's Table 4
  kOnBeats,  ///< as many, each on the beat nearest to the equal interval
};

/// `count` dances of EvalOptions::long_frames, spread evenly over the clips of a set and the
/// positions within each. A dance with music ends with it; without music, a clip shorter than the
/// dance gives its keys forwards, backwards, forwards.
std::vector<LongPlan> PlanLongDances(const ModelInfo& model, const ClipSet& set, KeyTimes times,
                                     int count, const EvalOptions& options);

/// The real motion that a long dance takes its keys from: [plan.frames] poses.
std::vector<Pose> RealMotionBeside(const LongPlan& plan, const ClipSet& set);

/// One dance per clip through the clip's own poses, one each `interval` frames, as long as the clip
/// but at most a minute from its middle; no music, no beats, seed 0. Skips clips below 20 s. Dances
/// end on a pose that is a key at the usual interval.
std::vector<LongPlan> PlanKeyedDances(const ModelInfo& model, const ClipSet& set, float temperature,
                                      int interval = kTypicalFrames);

/// Beats of one tempo, in frames, from before a dance of `frames` to after it; `phase`: position of
/// the first after frame 0, as a part of their distance.
std::vector<double> RegularBeats(double bpm, double phase, double fps, int frames);
/// Makes as many beats on average, at half to one and a half of the regular distances, different
/// for each `seed`: a dance to them meets the regular ones only by chance.
std::vector<double> ShuffledBeats(double bpm, uint64_t seed, double fps, int frames);

/// Real motion as if a model had danced it between a plan's keys: with footwork, rounded as sent.
/// [plan.frames] poses.
std::vector<Pose> RealThroughFootwork(const ModelInfo& model, const LongPlan& plan,
                                      const ClipSet& set);

}  // namespace choreo
