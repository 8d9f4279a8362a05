#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "bench/random_checkpoints.h"
#include "model/dance/transition/transition.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/samplers/samplers.h"
#include "tests/samplers/sampled.h"
#include "tests/support/temporary_folder.h"

namespace choreo::controllers_sampler_test {

class ControllersSamplerTest : public testing::Test {
 protected:
  ControllersSamplerTest() {
    SetTorchThreads(1);
    ControllersConfig config;
    config.residual = true;  // beside interpolation, an untrained network follows its path
    config.controller = 8;
    config.encoder_hidden = 16;
    config.encoding = 8;
    config.lstm = 16;
    config.decoder_hidden = 16;
    WriteRandomControllers(path_, config, Skeleton::Smpl24(), 3);
    sampler_ = MakeSampler(path_, {});
  }

  TransitionSpec Spec(uint64_t seed, int frames = 12) const {
    TransitionSpec spec = RandomSpec(sampler_->model(), seed, frames);
    if (seed % 2 == 0) {
      spec.controls[kRootPath].values.resize(3, frames);
      for (int t = 0; t < frames; ++t)
        spec.controls[kRootPath].values.col(t) << 0.01F * static_cast<float>(t), 0.9F,
            0.02F * static_cast<float>(t);
      spec.controls[kVelocityFactors].values.setConstant(kBodyParts, frames, 0.03F);
    }
    return spec;
  }

  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "model.safetensors";
  std::unique_ptr<Sampler> sampler_;
};

TEST_F(ControllersSamplerTest, ListsItsControls) {
  const ModelInfo& model = sampler_->model();
  EXPECT_EQ(model.name, "controllers-paper");
  EXPECT_EQ(model.controls, ControlNames());
  ASSERT_EQ(model.velocity_references.size(), 1U);
  EXPECT_EQ(model.velocity_references[0].name, "median");
  EXPECT_FLOAT_EQ(model.velocity_references[0].speeds[1], 0.02F);
  EXPECT_NE(model.fingerprint.find("controllers-paper/"), std::string::npos);
  EXPECT_EQ(model.default_temperature, 0);
  EXPECT_EQ(sampler_->device(), "cpu");
}

TEST_F(ControllersSamplerTest, GivesTheSameBitsAloneAndInterleaved) {
  std::vector<TransitionSpec> specs;
  for (uint64_t seed = 1; seed <= 8; ++seed)
    specs.push_back(Spec(seed, 8 + static_cast<int>(seed)));
  const std::vector<Plan> plans = SampleInTurn(sampler_.get(), specs);
  for (size_t i = 0; i < specs.size(); ++i)
    ExpectSameBits(plans[i], SampleNow(*sampler_, specs[i]));
}

TEST_F(ControllersSamplerTest, NeitherSeedNorTemperatureNorMusicChangeIt) {
  TransitionSpec spec = Spec(1);
  const auto once = SampleNow(*sampler_, spec);
  spec.seed = 99;
  spec.candidate = 5;
  spec.temperature = 0;
  spec.music.reset();
  ExpectSameBits(once, SampleNow(*sampler_, spec));
}

TEST_F(ControllersSamplerTest, FollowsItsPathAndReachesItsKey) {
  TransitionSpec spec = Spec(2, 60);
  spec.target->mask = {};
  // In a bow from the last pose to the key.
  const Eigen::Vector3d from = spec.history.back().root_position;
  const Eigen::Vector3d way = spec.target->pose.root_position - from;
  for (int t = 0; t < 60; ++t) {
    const double u = (t + 1) / 60.0;
    const Eigen::Vector3d bow(0.3 * std::sin(std::numbers::pi * u), 0, 0);
    spec.controls[kRootPath].values.col(t) = from + u * way + bow;
  }
  const Plan plan = SampleNow(*sampler_, spec);
  for (int t = 0; t < 60; ++t) {
    const Pose& pose = plan.poses[static_cast<size_t>(t)];
    EXPECT_LT((pose.root_position - spec.controls[kRootPath].values.col(t)).norm(), 0.2);
  }
  EXPECT_LT((plan.poses.back().root_position - spec.target->pose.root_position).norm(), 0.01);
}

TEST_F(ControllersSamplerTest, RunsInTheServedPipeline) {
  TransitionSpec request;
  request.frames = 30;
  Pose there = RestPose(sampler_->model().skeleton);
  there.root_position += Eigen::Vector3d(0.4, 0, 0.6);
  there.rotations(2, 16) = 0.8;
  request.target = Target{there, {}};
  const TransitionRun run = DanceTransition(*sampler_, request);
  ASSERT_EQ(run.frames().size(), 30U);
  ASSERT_TRUE(run.arrival());
  EXPECT_LT(run.arrival()->final_error_m, 0.001);
}

}  // namespace choreo::controllers_sampler_test
