#include "model/papers/samplers/inbetweener_stepper.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/random_checkpoints.h"
#include "model/dance/transition/transition.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/samplers/samplers.h"
#include "tests/samplers/sampled.h"
#include "tests/support/temporary_folder.h"

namespace choreo::inbetweener_stepper_test {

// The baseline as a sampler.
class InbetweenerStepperTest : public testing::Test {
 protected:
  InbetweenerStepperTest() {
    SetTorchThreads(1);
    FlowConfig config = FlowConfig::Preset(kInbetweenerPreset);
    config.hidden = 16;
    WriteRandomInbetweener(path_, config, Skeleton::Smpl24(), 3);
    sampler_ = MakeSampler(path_, {});
  }

  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "model.safetensors";
  std::unique_ptr<Sampler> sampler_;
};

TEST_F(InbetweenerStepperTest, IsDeterministicWithoutMusicInput) {
  const ModelInfo& model = sampler_->model();
  EXPECT_EQ(model.name, "harvey");
  EXPECT_TRUE(model.deterministic);
  EXPECT_FALSE(model.music_features);
  EXPECT_FALSE(model.Supports(kRootPath));
  EXPECT_FALSE(SettingsUsedBy(*sampler_).kind);
}

TEST_F(InbetweenerStepperTest, GivesTheSameBitsAloneAndInterleaved) {
  std::vector<TransitionSpec> specs;
  for (uint64_t seed = 1; seed <= 6; ++seed)
    specs.push_back(RandomSpec(sampler_->model(), seed, 8 + static_cast<int>(seed)));
  const std::vector<Plan> plans = SampleInTurn(sampler_.get(), specs);
  for (size_t i = 0; i < specs.size(); ++i)
    ExpectSameBits(plans[i], SampleNow(*sampler_, specs[i]));
}

TEST_F(InbetweenerStepperTest, NeitherSeedNorTemperatureChangeItAndItHasNoLikelihood) {
  TransitionSpec spec = RandomSpec(sampler_->model(), 1);
  const Plan once = SampleNow(*sampler_, spec);
  EXPECT_TRUE(once.log_likelihoods.empty());
  spec.seed = 99;
  spec.candidate = 5;
  spec.temperature = 0.5F;
  ExpectSameBits(once, SampleNow(*sampler_, spec));
}

TEST_F(InbetweenerStepperTest, RunsInTheServedPipeline) {
  TransitionSpec request;
  request.frames = 30;
  Pose there = RestPose(sampler_->model().skeleton);
  there.root_position += Eigen::Vector3d(0.4, 0, 0.6);
  request.target = Target{there, {}};
  const TransitionRun run = DanceTransition(*sampler_, request);
  ASSERT_EQ(run.frames().size(), 30U);
  ASSERT_TRUE(run.arrival());
  EXPECT_LT(run.arrival()->final_error_m, 0.001);
}

}  // namespace choreo::inbetweener_stepper_test
