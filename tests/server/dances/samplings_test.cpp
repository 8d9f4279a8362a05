#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "client/authoring/keys/pose_library.h"
#include "model/core/running/threads.h"
#include "model/dance/transition/transition.h"
#include "model/plan/takes.h"
#include "model/samplers/samplers.h"

/// How often transitions of the shipped model are sampled: the mean that admission charges, and the
/// bound for which it leaves time.
namespace choreo::samplings_test {

/// Passes on a sampler's plans, and counts the frames that they cost. Without `bounded`, the
/// sampler spends what it likes.
class CountingSampler : public Sampler {
 public:
  explicit CountingSampler(std::unique_ptr<Sampler> sampler)
      : Sampler(sampler->model(), sampler->device()), sampler_(std::move(sampler)) {}

  Slices<Plan> Sample(const ValidSpec& spec) override {
    ValidSpec own = spec;
    if (!bounded) own.SetTake(spec->candidate, 1'000'000);
    Plan plan = co_await sampler_->Sample(own);
    sampled += spec->frames + plan.resampled;
    if (!bounded) plan.resampled = 0;
    co_return plan;
  }

  bool bounded = true;
  int64_t sampled = 0;

 private:
  const std::unique_ptr<Sampler> sampler_;
};

class SamplingsTest : public testing::Test {
 protected:
  /// Of 0.5 to 2 s, between poses of the library, to beats.
  TransitionSpec Spec(uint64_t seed, double energy) const {
    const std::vector<authoring::LibraryPose>& poses = authoring::PoseLibrary();
    TransitionSpec spec;
    spec.frames = 15 + static_cast<int>(seed % 4) * 15;
    spec.history = {poses[seed % poses.size()].pose};
    spec.target = Target{poses[(7 * seed + 3) % poses.size()].pose, {}};
    for (double beat = 0; beat <= spec.frames; beat += 15) spec.beats.push_back(beat);
    spec.temperature = 1;
    spec.seed = seed;
    if (energy == 0) return spec;
    Eigen::MatrixXd& speeds = spec.controls[kVelocityFactors].values;
    speeds.resize(kBodyParts, spec.frames);
    for (int part = 0; part < kBodyParts; ++part)
      speeds.row(part).setConstant(
          energy * sampler_.model().velocity_references[0].speeds[static_cast<size_t>(part)]);
    return spec;
  }
  std::vector<DanceFrame> Dance(const TransitionSpec& spec, bool bounded) {
    sampler_.sampled = 0;
    sampler_.bounded = bounded;
    return DanceTransition(sampler_, spec).frames();
  }

  CountingSampler sampler_{MakeSampler(SHIPPED_CHECKPOINT, Device{})};
};

TEST_F(SamplingsTest, AreFewOnTheMeanAndBounded) {
  SetTorchThreads(1);
  constexpr int kTransitions = 200;
  for (const double energy : {0.0, 1.5, 3.0}) {
    double most = 0, sum = 0, most_unbounded = 0;
    int changed = 0;
    for (uint64_t seed = 1; seed <= kTransitions; ++seed) {
      const TransitionSpec spec = Spec(seed, energy);
      Dance(spec, false);
      const double samplings = static_cast<double>(sampler_.sampled) / spec.frames;
      most_unbounded = std::max(most_unbounded, samplings);
      if (samplings > kMaxTakes) {
        const Pose unbounded = Dance(spec, false)[spec.frames / 2].pose;
        changed += Dance(spec, true)[spec.frames / 2].pose.rotations != unbounded.rotations;
      }
      const double bounded = static_cast<double>(sampler_.sampled) / spec.frames;
      most = std::max(most, bounded);
      sum += bounded;
    }
    std::cout << "energy " << energy << ": " << sum / kTransitions
              << " samplings of a frame on the mean, at most " << most << " (unbounded "
              << most_unbounded << "); the bound changes " << changed << " of " << kTransitions
              << " transitions\n";
    EXPECT_LE(most, kMaxTakes);
  }
}

}  // namespace choreo::samplings_test
