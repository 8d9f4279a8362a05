#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/core/progress.h"
#include "model/dance/transition_batch.h"

namespace choreo {

/// A long dance to be danced beside a clip, a chain of transitions as a stream has them: its frame
/// f goes with the clip's frame start + f.
struct LongPlan {
  size_t clip = 0;  ///< within its set
  int start = 0;
  int frames = 0;
  std::vector<Pose> history;
  std::map<int, Pose> keys;  ///< by frame of the dance, each below `frames`
  /// [audio_features, history frames + frames], or no columns: dances without music.
  Eigen::MatrixXf audio;
  std::vector<double> beats;  ///< of the music, in frames of the dance
  uint64_t seed = 0;
  float temperature = 0;
  std::string style = {};  ///< as TransitionRequest has it
};

struct LongDance {
  std::vector<Pose> poses;                    ///< [frames]
  std::map<int, double> keys;                 ///< final error at each key, m
  std::optional<Eigen::Vector3d> stage = {};  ///< TransitionRequest::stage, once a key said it
};

/// Dances what tables ask for, all of a call together, and says how far it is. Not
/// thread-safe.
class Runner {
 public:
  /// `progress` may be null, and else outlives the runner; it is told frames and `what`.
  explicit Runner(ProgressBar* progress = nullptr, std::string what = "")
      : progress_(progress), what_(std::move(what)) {}

  /// DanceTransitions: the poses of each.
  std::vector<std::vector<Pose>> Dance(StepEngine& engine,
                                       std::span<const TransitionInput> inputs) const;

  /// Of each plan a transition at a time (TransitionEnd). No dance depends on
  /// the others. Throws Error(kInternal) as soon as a model gives a value that is not finite.
  std::vector<LongDance> DanceLong(StepEngine& engine, std::span<const LongPlan> plans) const;

 private:
  std::vector<TransitionResult> Results(StepEngine& engine,
                                        std::span<const TransitionInput> inputs) const;

  ProgressBar* progress_;
  std::string what_;
};

}  // namespace choreo
