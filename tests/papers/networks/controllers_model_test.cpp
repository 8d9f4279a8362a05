#include "model/papers/networks/controllers_model.h"

#include <gtest/gtest.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "model/motion/kinematics/kinematics.h"
#include "model/papers/networks/controllers_checkpoint.h"
#include "model/papers/training/control_clips.h"
#include "model/papers/training/control_losses.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_clips.h"
#include "tests/support/temporary_folder.h"

namespace choreo::controllers_model_test {

using torch::Tensor;

ControllersConfig Small() {
  ControllersConfig config;
  config.feed_forward = 16;
  config.controller = 8;
  config.encoder_hidden = 16;
  config.encoding = 8;
  config.lstm = 16;
  config.decoder_hidden = 16;
  return config;
}

ControllersConfig SmallResidual() {
  ControllersConfig config = Small();
  config.residual = true;
  return config;
}

class ControllersModelTest : public testing::Test {
 protected:
  ControllersModelTest()
      : clips_({testing_support::SyntheticClip("a", 90, 0.2, false),
                testing_support::SyntheticClip("b", 90, 1.2, false)}) {}

  ControlBatch Draw(int frames, const ControlClips::Variation& variation = {}) const {
    Random random(3, 1);
    return clips_.Draw(4, 10, frames, variation, &random);
  }
  // Weights at random, so that nothing stays at the zeros that training starts from.
  static ControllersModel Random4(const ControllersConfig& config) {
    torch::manual_seed(5);
    ControllersModel model(config, Skeleton::Smpl24());
    torch::NoGradGuard no_grad;
    for (auto& parameter : model->parameters()) {
      if (!parameter.any().item<bool>()) parameter.copy_(0.1 * torch::randn_like(parameter));
    }
    model->SetNormalisation(torch::zeros({23, 3}), torch::full({23, 3}, 0.1),
                            torch::full({kBodyParts}, 0.01));
    model->eval();
    return model;
  }

  ControlClips clips_;
};

double Difference(const Tensor& a, const Tensor& b) { return (a - b).abs().max().item<double>(); }

TEST_F(ControllersModelTest, HeadingsAddAndVectorsTurnAboutTheVertical) {
  const double right = std::numbers::pi / 2;
  const Tensor quarter = HeadingOf(torch::tensor(right));
  const Tensor forward = torch::tensor({0.0, 1.0, 2.0}, torch::kFloat64);
  EXPECT_LT(Difference(Turn(forward, quarter.to(torch::kFloat64)),
                       torch::tensor({2.0, 1.0, 0.0}, torch::kFloat64)),
            1e-6);
  EXPECT_LT(Difference(TurnBack(Turn(forward, quarter), quarter), forward), 1e-6);
  EXPECT_LT(Difference(AddHeadings(quarter, quarter), HeadingOf(torch::tensor(2 * right))), 1e-6);
  EXPECT_LT(Difference(SubtractHeadings(quarter, quarter), torch::tensor({0.0, 1.0})), 1e-6);
}

TEST_F(ControllersModelTest, FactorsAgreeWithTheLibrarys) {
  const PreparedClip clip = testing_support::SyntheticClip("a", 90, 0.2, false);
  const BodyPartWeights weights = WeighBodyParts(clip.skeleton);
  ControllersModel model(Small(), clip.skeleton);
  const ControlBatch batch = Draw(8);
  const Tensor mine = FactorsOf(Steps(batch.truth), model->shares());
  EXPECT_LT(Difference(mine, batch.factors.narrow(1, 1, 7)), 2e-5);
}

// Windows of 7 frames around each, ahead of the first the history's, after the last the last: what
// shipped checkpoints were trained on.
TEST_F(ControllersModelTest, ReceivesControlsAroundEachFrame) {
  const ControlledTransition asked = Draw(20).transition;
  torch::NoGradGuard no_grad;
  ControllersModel model = Random4(Small());
  const ControlledGiven given = model->Prepare(asked);
  const Tensor middle = torch::tensor({0.0, Skeleton::Smpl24().pelvis_height, 0.0});
  const Tensor speeds = FactorsOf(Steps(asked.history), model->shares());
  for (int64_t frame = 0; frame < 20; ++frame) {
    for (int64_t at = 0; at < 7; ++at) {
      const int64_t of = std::min<int64_t>(frame + at - 3, 19);
      const Tensor place =
          of < 0 ? asked.history.root.select(1, 10 + of) : asked.path.select(1, of);
      const Tensor factors = of < 0 ? speeds.select(1, 9 + of) : asked.factors.select(1, of);
      EXPECT_LT(Difference(given.path_window.select(1, frame).select(1, at), place - middle), 1e-5);
      EXPECT_LT(Difference(given.factor_window.select(1, frame).select(1, at), factors / 0.01),
                1e-3);
    }
  }
}

TEST_F(ControllersModelTest, StartsAsTheMeanPostureAtTheOrigin) {
  ControllersModel model(Small(), Skeleton::Smpl24());
  model->SetNormalisation(torch::full({23, 3}, 0.3), torch::full({23, 3}, 0.1),
                          torch::full({kBodyParts}, 0.01));
  model->eval();
  torch::NoGradGuard no_grad;
  const FrameTensors out = model->RollOut(Draw(20).transition);
  const double pelvis = Skeleton::Smpl24().pelvis_height;
  EXPECT_LT(Difference(out.root, torch::tensor({0.0, pelvis, 0.0}).expand_as(out.root)), 1e-6);
  EXPECT_LT(Difference(out.joints, torch::full_like(out.joints, 0.3)), 1e-6);
  EXPECT_LT(Difference(out.facing, torch::tensor({0.0, 1.0}).expand_as(out.facing)), 1e-6);
}

TEST_F(ControllersModelTest, AResidualNetworkStartsAsInterpolationOnThePath) {
  ControllersModel model(SmallResidual(), Skeleton::Smpl24());
  model->eval();
  const ControlBatch batch = Draw(20);
  torch::NoGradGuard no_grad;
  const FrameTensors out = model->RollOut(batch.transition);
  EXPECT_LT(Difference(out.root, batch.transition.path), 1e-6);
  const Tensor last = batch.transition.history.joints.select(1, 9);
  EXPECT_LT(Difference(out.joints.select(1, 9), 0.5 * (last + batch.transition.target_joints)),
            1e-5);
}

TEST_F(ControllersModelTest, OnlyAResidualNetworkReachesTheTargetWithAnyWeights) {
  const ControlBatch batch = Draw(12);
  torch::NoGradGuard no_grad;
  const FrameTensors free = Random4(Small())->RollOut(batch.transition);
  EXPECT_GT(Difference(free.joints.select(1, 11), batch.transition.target_joints), 0.05);
  EXPECT_GT(Difference(free.root.select(1, 11), batch.truth.root.select(1, 11)), 0.05);
  const FrameTensors out = Random4(SmallResidual())->RollOut(batch.transition);
  EXPECT_GT(Difference(out.joints.select(1, 6), batch.truth.joints.select(1, 6)), 1e-3);
  EXPECT_LT(Difference(out.joints.select(1, 11), batch.transition.target_joints), 1e-5);
  EXPECT_LT(Difference(out.root.select(1, 11), batch.truth.root.select(1, 11)), 1e-5);
  EXPECT_LT(Difference(out.facing.select(1, 11), HeadingOf(batch.transition.target_turn)), 1e-3);
}

// Training computes at once what the engine computes frame by frame.
TEST_F(ControllersModelTest, WalksAllFramesAtOnceAsOneByOne) {
  for (const bool whole : {true, false}) {
    ControllersConfig config = Small();
    config.two_lstms = config.transformers = config.root_decoder = config.velocity_factors = whole;
    config.residual = !whole;
    ControllersModel model = Random4(config);
    const ControlBatch batch = Draw(15);
    torch::NoGradGuard no_grad;
    const FrameTensors alone = model->RollOut(batch.transition);
    const FrameTensors lead = batch.transition.history.Narrow(10 - model->lead(), model->lead());
    ControllersState state;
    const ControlledOutput together =
        model->Walk(model->Prepare(batch.transition), Join(lead, alone.Narrow(0, 14)), &state);
    EXPECT_LT(Difference(together.frames.joints, alone.joints), 1e-4);
    EXPECT_LT(Difference(together.frames.root, alone.root), 1e-4);
    EXPECT_EQ(together.velocities.sizes(), (std::vector<int64_t>{4, 15, 24, 3}));
  }
}

TEST_F(ControllersModelTest, DependsOnItsControls) {
  ControllersModel model = Random4(Small());
  ControlBatch batch = Draw(15);
  torch::NoGradGuard no_grad;
  const FrameTensors as_asked = model->RollOut(batch.transition);
  batch.transition.factors = 1.5 * batch.transition.factors;
  EXPECT_GT(Difference(model->RollOut(batch.transition).joints, as_asked.joints), 1e-5);
}

TEST_F(ControllersModelTest, ReceivesItsTargetAndDistance) {
  ControlBatch batch = Draw(15);
  torch::NoGradGuard no_grad;
  for (const bool absolute : {true, false}) {
    for (const bool relative : {true, false}) {
      ControllersConfig config = Small();
      config.absolute_position = absolute;
      config.relative_position = relative;
      if (!absolute && !relative) {
        ExpectError(ErrorCode::kInvalidArgument, "relative_position", [&] { Random4(config); });
        continue;
      }
      ControllersModel model = Random4(config);
      const FrameTensors before = model->RollOut(batch.transition);
      ControlledTransition other = batch.transition;
      other.target_joints = other.target_joints + 0.2;
      EXPECT_GT(Difference(model->RollOut(other).joints, before.joints), 1e-5);
      other.has_target = torch::zeros_like(other.has_target);
      const FrameTensors without = model->RollOut(other);
      other.target_joints = other.target_joints + 0.2;
      EXPECT_EQ(Difference(model->RollOut(other).joints, without.joints), 0);
    }
  }
}

TEST_F(ControllersModelTest, UnvariedWindowsMatchTheirControls) {
  const ControlBatch batch = Draw(20);
  EXPECT_LT(Difference(batch.transition.path, batch.truth.root), 1e-7);
  EXPECT_LT(Difference(batch.transition.factors, batch.factors), 1e-7);
  EXPECT_LT(Difference(batch.truth.joints.select(1, 19), batch.transition.target_joints), 1e-7);
  EXPECT_LT(Difference(batch.transition.history.facing.select(1, 9), torch::tensor({0.0, 1.0})),
            1e-6);
  EXPECT_LT(batch.transition.history.root.select(1, 9).select(1, 0).abs().max().item<float>(),
            1e-6);
  const ControlBatch varied = Draw(20, {.smooth_path = 1, .scale_factors = 1});
  EXPECT_GT(Difference(varied.transition.path, varied.truth.root), 1e-5);
  EXPECT_LT(Difference(varied.transition.path.select(1, 19), varied.truth.root.select(1, 19)),
            1e-5);
  EXPECT_LT(varied.weight.max().item<float>(), 1);
}

TEST_F(ControllersModelTest, TheKeyframeLossPullsEachEndToItsOwnPose) {
  const Tensor first = torch::zeros({1, 1}), last = torch::ones({1, 1});
  // Long: 5 frames at 0.1 from the first pose, 5 at 0.2 from the last; what lies between is free.
  const Tensor far = torch::full({1, 12, 1}, 7.0);
  far.narrow(1, 0, 5).fill_(0.1);
  far.narrow(1, 7, 5).fill_(0.8);
  EXPECT_NEAR(KeyframeLoss(far, first, last).item<double>(), (5 * 0.01 + 5 * 0.04) / 10, 1e-6);
  // Short: on the straight way a frame at u costs (1-u) u^2 + u (1-u)^2 = u (1-u).
  const Tensor straight = torch::arange(1, 5).view({1, 4, 1}) / 4.0;
  EXPECT_NEAR(KeyframeLoss(straight, first, last).item<double>(),
              (0.25 * 0.75 + 0.5 * 0.5 + 0.75 * 0.25) / 4, 1e-6);
  // As printed, the way back would cost less than the way there.
  const Tensor back = torch::flip(straight - 0.25, {1});
  EXPECT_GT(KeyframeLoss(back, first, last).item<double>(),
            KeyframeLoss(straight, first, last).item<double>());
}

TEST_F(ControllersModelTest, LossesVanishForRealMotion) {
  ControllersModel model(Small(), Skeleton::Smpl24());
  const ControlBatch batch = Draw(20);
  const FrameTensors& history = batch.transition.history;
  const Tensor steps = Steps(Join(history.Narrow(history.size() - 1, 1), batch.truth));
  const auto stated = [&](const FrameTensors& frames) { return ControlledOutput{frames, steps}; };
  const auto loss = [&](const FrameTensors& frames, const std::string& name) {
    for (const LossTerm& term : ControlLoss(*model, batch, stated(frames)))
      if (term.name == name) return term.value.item<double>();
    return -1.0;
  };
  EXPECT_LT(loss(batch.truth, "reconstruction"), 1e-6);
  EXPECT_LT(loss(batch.truth, "factors"), 1e-3);
  // A decimetre beside the path on each frame is one (Eq. 4).
  FrameTensors moved = batch.truth;
  moved.root = moved.root + torch::tensor({0.0F, 0.0F, 0.1F});
  EXPECT_NEAR(loss(moved, "reconstruction"), 1, 1e-4);
  // A decimetre per frame, as published: of the dance's own path, not relative to the real one (Eq.
  // 9).
  FrameTensors glide = batch.truth;
  glide.facing = torch::tensor({0.0F, 1.0F}).expand_as(glide.facing);
  const Tensor start = history.root.narrow(1, history.size() - 1, 1);
  glide.root = start + torch::tensor({0.0F, 0.0F, 0.1F}) * torch::arange(1, 21).view({1, 20, 1});
  EXPECT_NEAR(loss(glide, "root"), 1, 1e-4);
}

TEST_F(ControllersModelTest, SlidingContactsAndStretchingLimbsAddLoss) {
  ControllersModel model(Small(), Skeleton::Smpl24());
  const ControlBatch batch = Draw(20);
  const FrameTensors& history = batch.transition.history;
  const FrameTensors last = history.Narrow(history.size() - 1, 1);
  const auto consistency = [&](const FrameTensors& frames, const Tensor& velocities) {
    return ControlLoss(*model, batch, {frames, velocities})[1].value.item<double>();
  };
  FrameTensors standing = batch.truth;
  standing.contacts = torch::ones_like(standing.contacts);
  const Tensor steps = Steps(Join(last, standing));
  FrameTensors flying = standing;
  flying.contacts = torch::zeros_like(flying.contacts);
  // Eq. 7 is of the velocities that the network states: four feet, a centimetre a frame each.
  Tensor stated = torch::zeros_like(steps);
  stated.select(2, 0).select(-1, 0).fill_(0.01);
  EXPECT_NEAR(consistency(standing, stated) - consistency(flying, stated), 4, 1e-3);
  // Eq. 6 is of squares: a bone of twice the length costs its length in decimetres, squared.
  FrameTensors longer = flying;
  longer.joints = 2 * flying.joints;
  double squares = 0;
  for (int joint = 1; joint < Skeleton::Smpl24().joints(); ++joint)
    squares += Skeleton::Smpl24().offsets.col(joint).squaredNorm();
  EXPECT_NEAR(consistency(longer, Steps(Join(last, longer))), 100 * squares, 2 * squares);
}

TEST_F(ControllersModelTest, CheckpointRoundTrips) {
  const TemporaryFolder folder;
  ControllersModel model = Random4(Small());
  const auto path = folder.path() / "c.safetensors";
  const std::string hash = SaveControllers(path, model, {0.1, 0.2, 0.3, 0.4, 0.5}, {{"a", 1}});
  const Safetensors content = ReadSafetensors(path);
  ASSERT_TRUE(HoldsControllers(content));
  ControllersCheckpoint loaded = ParseControllers(content, "c");
  EXPECT_EQ(loaded.hash, hash);
  EXPECT_EQ(loaded.median_factors[4], 0.5);
  const ControlBatch batch = Draw(6);
  torch::NoGradGuard no_grad;
  EXPECT_TRUE(torch::equal(loaded.model->RollOut(batch.transition).joints,
                           model->RollOut(batch.transition).joints));
  Safetensors edited = content;
  edited.tensors.begin()->second.data[0] += 1;
  ExpectError(ErrorCode::kInvalidArgument, "damaged or was edited",
              [&] { ParseControllers(edited, "c"); });
}

}  // namespace choreo::controllers_model_test
