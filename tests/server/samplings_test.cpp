#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "client/authoring/pose_library.h"
#include "model/core/threads.h"
#include "model/dance/transition.h"
#include "model/plan/takes.h"
#include "model/samplers/samplers.h"

/// How often transitions of the shipped model are sampled: the mean that admission charges, and the
/// bound for which it leaves time.
namespace choreo::samplings_test {

/// Passes on a sampler's plans, and counts the frames that they cost.
class CountingSampler : public Sampler {
 public:
  explicit CountingSampler(std::unique_ptr<Sampler> sampler)
      : Sampler(sampler->model(), sampler->device()), sampler_(std::move(sampler)) {}

  Slices<Plan> Begin(const ValidSpec& spec) override {
    Plan plan = co_await sampler_->Begin(spec);
    sampled += spec->frames + plan.resampled;
    co_return plan;
  }

  int64_t sampled = 0;

 private:
  const std::unique_ptr<Sampler> sampler_;
};

// 200 transitions of 0.5 to 2 s between poses of the library, as often with requested energy.
TEST(Samplings, AreFewOnTheMeanAndBoundedInEachTransition) {
  SetTorchThreads(1);
  CountingSampler sampler(MakeSampler(SHIPPED_CHECKPOINT, Device{}));
  const std::vector<authoring::LibraryPose>& poses = authoring::PoseLibrary();
  for (const bool lively : {false, true}) {
    double most = 0, sum = 0;
    int more = 0;
    constexpr int kTransitions = 200;
    for (uint64_t seed = 1; seed <= kTransitions; ++seed) {
      TransitionSpec spec;
      spec.frames = 15 + static_cast<int>(seed % 4) * 15;
      spec.history = {poses[seed % poses.size()].pose};
      spec.target = Target{poses[(7 * seed + 3) % poses.size()].pose, {}};
      spec.temperature = 1;
      spec.seed = seed;
      if (lively) spec.controls[kVelocityFactors].values.setConstant(kBodyParts, spec.frames, 0.05);
      sampler.sampled = 0;
      DanceTransition(sampler, spec);
      const double samplings = static_cast<double>(sampler.sampled) / spec.frames;
      most = std::max(most, samplings);
      sum += samplings;
      more += samplings > (lively ? 3 : 1) ? 1 : 0;
    }
    std::cout << (lively ? "with requested energy: " : "without: ") << sum / kTransitions
              << " samplings of a frame on the mean, at most " << most << "; of " << kTransitions
              << " transitions " << more << " were sampled again\n";
    EXPECT_LE(most, kMaxTakes);
    EXPECT_LT(sum / kTransitions, lively ? 3.5 : 1.5);
  }
}

}  // namespace choreo::samplings_test
