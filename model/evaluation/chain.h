#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "model/evaluation/batch.h"

namespace choreo {

/// A long dance to be danced: a chain of transitions, as a stream has them.
struct ChainPlan {
  int frames = 0;
  std::vector<Pose> history;
  std::map<int, Pose> keys;  ///< by frame of the dance, each below `frames`
  /// [audio_features, history frames + frames], or no columns: dances without music.
  Eigen::MatrixXf audio;
  std::vector<double> beats;  ///< of the music, in frames of the dance
  uint64_t seed = 0;
  float temperature = 0;
};

struct Chain {
  std::vector<Pose> poses;     ///< [frames]
  std::map<int, double> keys;  ///< final error at each key, m
};

/// Dances all plans together, a transition of each at a time: to the next key, or, where none
/// follows, kFreeTransitionFrames without target. Chain i does not depend on the others.
/// Throws Error(kInternal) as soon as a model gives a value that is not finite.
std::vector<Chain> DanceChains(StepEngine& engine, std::span<const ChainPlan> plans,
                               const std::function<void(int)>& danced = {});

}  // namespace choreo
