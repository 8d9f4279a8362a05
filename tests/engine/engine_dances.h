#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "model/engine/step_engine.h"
#include "model/flow/flow_config.h"

/// Small models with random weights, transitions for them, and dances of those: what tests of real
/// engines share.
namespace choreo {

/// What couplings see of a frame's condition.
enum class Shape {
  kRaw,      ///< as preset `paper`
  kEncoded,  ///< as preset `paper-f`, whose flow draws innovations
};
std::string ShapeName(Shape shape);
FlowConfig SmallConfig(Shape shape);

/// A checkpoint of random weights that exists while this does.
class SmallCheckpoint {
 public:
  explicit SmallCheckpoint(Shape shape);
  ~SmallCheckpoint();
  SmallCheckpoint(const SmallCheckpoint&) = delete;
  SmallCheckpoint& operator=(const SmallCheckpoint&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A transition of its own for each seed: with and without key, masks and music.
TransitionSpec RandomSpec(const ModelInfo& model, uint64_t seed, int frames = 12);
/// Of the music that goes with such a transition.
std::vector<float> RandomAudioRow(const ModelInfo& model, uint64_t seed, int frame);
/// What a dance makes of the model's pose: near it, but not the same.
Pose Emit(const Pose& raw, int frame);

struct Dancer {
  TransitionSpec spec;
  int slot = -1;
  std::vector<StepOutput> outputs;
  std::vector<Pose> emitted;
};
/// Steps slots that were admitted for these specs, all together, to the end of the longest.
void DanceTogether(StepEngine* engine, std::vector<Dancer>* dancers);
std::vector<StepOutput> DanceAlone(StepEngine* engine, const TransitionSpec& spec);
/// Both engines make each frame of a transition in slot 0 from the same poses before it: the
/// largest difference of any output, in metres, radians, and nats relative to their size.
double LargestStepDifference(StepEngine* reference, StepEngine* other, uint64_t seed, int frames);
void ExpectSameBits(const std::vector<StepOutput>& a, const std::vector<StepOutput>& b);

}  // namespace choreo
