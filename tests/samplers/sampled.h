#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "model/papers/networks/flow_config.h"
#include "model/plan/sampler.h"

/// Small models with random weights, transitions for them, and plans of those: what tests of real
/// samplers share.
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

/// A transition of its own for each seed: with and without key, masks, arrival and music.
TransitionSpec RandomSpec(const ModelInfo& model, uint64_t seed, int frames = 12);

/// Samples one at once.
inline Plan SampleNow(Sampler& sampler, const TransitionSpec& spec) {
  return sampler.Sample(ValidSpec(spec, sampler.model())).Finish();
}
/// Samples all of these with a slice of each in turn, until the last is done.
std::vector<Plan> SampleInTurn(Sampler* sampler, std::span<const TransitionSpec> specs);
/// Of any output of two plans, in metres, radians, and nats relative to their size.
double LargestDifference(const Plan& a, const Plan& b);
void ExpectSameBits(const Plan& a, const Plan& b);

}  // namespace choreo
