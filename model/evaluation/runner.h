#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/dance/transition/transition.h"

namespace choreo {

/// The plan of a long dance beside a clip, a chain of transitions like a stream's. The dance's
/// frame f goes with the clip's frame start + f.
struct LongPlan {
  size_t clip = 0;  ///< index in its set
  int start = 0;
  int frames = 0;
  std::vector<Pose> history;
  std::map<int, Pose> keys;  ///< by frame of the dance, each below `frames`
  /// [MusicFeatures::count, history frames + frames], or no columns for dances without music.
  Eigen::MatrixXf audio;
  std::vector<double> beats;  ///< of the music, in frames of the dance
  uint64_t seed = 0;
  float temperature = 0;
  std::string style = {};  ///< as in TransitionSpec
  bool finished = true;    ///< as served; false: without arrival and footwork
};

struct LongDance {
  std::vector<Pose> poses;                ///< [frames]
  std::map<int, double> keys;             ///< final error at each key, m
  std::optional<GroundFrame> stage = {};  ///< TransitionSpec::stage, once a key has set it
};

using Dances = std::vector<std::vector<Pose>>;  ///< [dances] of [frames]

/// Makes the dances of tables, as the server does. Not thread-safe.
class Runner {
 public:
  /// Calls `danced` with the number of frames of each transition.
  explicit Runner(std::function<void(int)> danced = {}) : danced_(std::move(danced)) {}

  /// Returns the poses of each request. Throws what TransitionRun throws.
  Dances Dance(Sampler& sampler, std::span<const TransitionSpec> requests) const;

  /// Makes each plan's dance transition by transition (TransitionEnd). No dance depends on the
  /// others. Throws Error(kInternal) at the first value that is not finite.
  std::vector<LongDance> DanceLong(Sampler& sampler, std::span<const LongPlan> plans) const;

 private:
  std::function<void(int)> danced_;
};

}  // namespace choreo
