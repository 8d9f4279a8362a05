#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <numbers>

#include "bench/random_checkpoints.h"
#include "model/dance/transition_batch.h"
#include "model/engine/engines.h"
#include "model/motion/kinematics.h"
#include "tests/engine/engine_dances.h"
#include "tests/support/expect_error.h"

namespace choreo::controllers_engine_test {

class ControllersEngineTest : public testing::Test {
 protected:
  ControllersEngineTest() {
    SetTorchThreads(1);
    ControllersConfig config;
    config.residual = true;  // beside interpolation, an untrained network follows its path
    config.controller = 8;
    config.encoder_hidden = 16;
    config.encoding = 8;
    config.lstm = 16;
    config.decoder_hidden = 16;
    path_ = std::filesystem::path(testing::TempDir()) /
            ("controllers_" +
             std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
             std::to_string(getpid()) + ".safetensors");
    WriteRandomControllers(path_, config, Skeleton::Smpl24(), 3);
    engine_ = MakeEngine(path_, {}, 8);
  }
  ~ControllersEngineTest() override { std::filesystem::remove(path_); }

  TransitionSpec Spec(uint64_t seed, int frames = 12) const {
    TransitionSpec spec = RandomSpec(engine_->model(), seed, frames);
    if (seed % 2 == 0) {
      spec.controls.root_path.resize(3, frames);
      for (int t = 0; t < frames; ++t)
        spec.controls.root_path.col(t) << 0.01F * static_cast<float>(t), 0.9F,
            0.02F * static_cast<float>(t);
      spec.controls.velocity_factors.setConstant(kBodyParts, frames, 0.03F);
    }
    return spec;
  }

  std::filesystem::path path_;
  std::unique_ptr<StepEngine> engine_;
};

TEST_F(ControllersEngineTest, TellsWhatItTakes) {
  const ModelInfo& model = engine_->model();
  EXPECT_EQ(model.name, "controllers-paper");
  EXPECT_TRUE(model.root_path);
  EXPECT_TRUE(model.velocity_factors);
  ASSERT_EQ(model.velocity_references.size(), 1U);
  EXPECT_EQ(model.velocity_references[0].name, "median");
  EXPECT_FLOAT_EQ(model.velocity_references[0].factors[1], 0.02F);
  EXPECT_NE(model.fingerprint.find("controllers-paper/"), std::string::npos);
  EXPECT_EQ(model.default_temperature, 0);
  EXPECT_EQ(engine_->device(), "cpu");
}

TEST_F(ControllersEngineTest, GivesTheSameBitsAloneAndAmongOthers) {
  std::vector<Dancer> dancers;
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    const TransitionSpec spec = Spec(seed, 8 + static_cast<int>(seed));
    dancers.push_back({spec, engine_->Admit(spec), {}, {}});
  }
  ExpectError(ErrorCode::kResourceExhausted, "all 8 slots", [&] { engine_->Admit(Spec(9)); });
  DanceTogether(engine_.get(), &dancers);
  for (Dancer& dancer : dancers) engine_->Release(dancer.slot);
  EXPECT_EQ(engine_->free_slots(), 8);
  for (const Dancer& dancer : dancers)
    ExpectSameBits(dancer.outputs, DanceAlone(engine_.get(), dancer.spec));
}

TEST_F(ControllersEngineTest, NeitherSeedNorTemperatureNorMusicChangeIt) {
  TransitionSpec spec = Spec(1);
  const auto once = DanceAlone(engine_.get(), spec);
  spec.seed = 99;
  spec.candidate = 5;
  spec.temperature = 0;
  spec.has_audio = false;
  ExpectSameBits(once, DanceAlone(engine_.get(), spec));
}

TEST_F(ControllersEngineTest, FollowsItsPathAndReachesItsKey) {
  TransitionSpec spec = Spec(2, 60);
  spec.target->mask = {};
  // In a bow from the last pose to the key.
  const Eigen::Vector3d from = spec.history.back().root_position;
  const Eigen::Vector3d way = spec.target->pose.root_position - from;
  for (int t = 0; t < 60; ++t) {
    const double u = (t + 1) / 60.0;
    const Eigen::Vector3d bow(0.3 * std::sin(std::numbers::pi * u), 0, 0);
    spec.controls.root_path.col(t) = from + u * way + bow;
  }
  int slot = engine_->Admit(spec);
  Pose last = spec.history.back();
  for (int t = 0; t < 60; ++t) {
    const StepInput in{slot, t > 0 ? &last : nullptr, {}};
    StepOutput out;
    engine_->Step({&in, 1}, {&out, 1});
    last = out.pose;
    EXPECT_LT((last.root_position - spec.controls.root_path.col(t)).norm(), 0.2);
  }
  engine_->Release(slot);
  EXPECT_LT((last.root_position - spec.target->pose.root_position).norm(), 0.01);
}

TEST_F(ControllersEngineTest, DancesOnTheServedPipeline) {
  TransitionInput input;
  TransitionRequest& request = input.request;
  request.frames = 30;
  Pose there = RestPose(engine_->model().skeleton);
  there.root_position += Eigen::Vector3d(0.4, 0, 0.6);
  there.rotations(2, 16) = 0.8;
  request.target = Target{there, {}};
  const auto [frames, arrival, stage] = DanceTransitions(*engine_, {&input, 1}).front();
  ASSERT_EQ(frames.size(), 30U);
  ASSERT_TRUE(arrival);
  EXPECT_LT(arrival->final_error_m, 0.001);
}

TEST_F(ControllersEngineTest, StepsOutOfTurnAreRefused) {
  const int slot = engine_->Admit(Spec(1));
  const Pose pose = RestPose(engine_->model().skeleton);
  StepOutput out;
  const StepInput early{slot, &pose, {}}, wrong{slot + 1, nullptr, {}};
  ExpectError(ErrorCode::kInvalidArgument, "before the first frame", [&] {
    engine_->Step({&early, 1}, {&out, 1});
  });
  ExpectError(ErrorCode::kInvalidArgument, "holds no transition", [&] {
    engine_->Step({&wrong, 1}, {&out, 1});
  });
}

}  // namespace choreo::controllers_engine_test
