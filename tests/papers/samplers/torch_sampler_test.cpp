#include <gtest/gtest.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <utility>

#include "model/core/numbers/random.h"
#include "model/motion/floor/contacts.h"
#include "model/motion/kinematics/velocity.h"
#include "model/motion/pose/pose_codec.h"
#include "model/motion/rotation.h"
#include "model/papers/networks/flow_checkpoint.h"
#include "model/samplers/samplers.h"
#include "tests/samplers/sampled.h"
#include "tests/support/load_checkpoint.h"

namespace choreo::torch_sampler_test {

// What LibTorch samples, against the module that is trained.
class TorchSamplerTest : public testing::TestWithParam<Shape> {
 protected:
  TorchSamplerTest() : checkpoint_(GetParam()), model_(LoadCheckpoint(checkpoint_.path()).model) {
    SetTorchThreads(1);
  }
  SmallCheckpoint checkpoint_;
  FlowModel model_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, TorchSamplerTest, testing::Values(Shape::kEncoded, Shape::kRaw),
                         [](const auto& instance) { return ShapeName(instance.param); });

// The module itself, fed by the test with features of the whole motion as arrival steers it.
TEST_P(TorchSamplerTest, SamplesAsTheModuleDoes) {
  for (uint64_t seed : {7, 8, 9, 10}) {
    const auto sampler = MakeSampler(checkpoint_.path(), {}, EngineKind::kTorch);
    const TransitionSpec spec = RandomSpec(sampler->model(), seed);
    const Plan plan = SampleNow(*sampler, spec);

    torch::NoGradGuard no_grad;
    const Skeleton& skeleton = model_->skeleton();
    const PoseCodec codec(skeleton);
    const int tau = model_->config().history_frames, joints = skeleton.joints();
    Motion motion;
    motion.frames = spec.history;
    std::optional<Arrival> arrival = ArrivalOf(spec);
    for (const Pose& pose : plan.poses)
      motion.frames.push_back(arrival ? arrival->Apply(pose) : pose);
    const std::vector<Contacts> contacts = DetectContacts(skeleton, motion);

    const auto position = [](const Pose& pose) {
      return torch::tensor({pose.root_position.x(), pose.root_position.y(), pose.root_position.z()},
                           torch::kFloat32);
    };
    const auto rotation = [&](const Pose& pose) {
      torch::Tensor matrices = torch::empty({joints, 3, 3});
      for (int j = 0; j < joints; ++j) {
        const Eigen::Matrix3d matrix = ExpMap(pose.rotations.col(j));
        for (int r = 0; r < 3; ++r) {
          for (int c = 0; c < 3; ++c) matrices[j][r][c] = matrix(r, c);
        }
      }
      return matrices;
    };
    TransitionTensors transition;
    transition.frames = spec.frames;
    std::vector<torch::Tensor> positions, rotations;
    for (const Pose& pose : spec.history) {
      positions.push_back(position(pose));
      rotations.push_back(rotation(pose));
    }
    transition.history_position = torch::stack(positions).unsqueeze(0);
    transition.history_rotation = torch::stack(rotations).unsqueeze(0);
    const Pose& goal = spec.target ? spec.target->pose : spec.history.back();
    transition.target_position = position(goal).unsqueeze(0);
    transition.target_rotation = rotation(goal).unsqueeze(0);
    transition.target_mask = torch::zeros({1, joints + 1});
    if (spec.target) {
      const PoseMask& mask = spec.target->mask;
      for (int j = 0; j < joints; ++j) {
        transition.target_mask[0][j] = mask.Constrains(j) ? 1 : 0;
      }
      transition.target_mask[0][joints] = mask.root_position ? 1 : 0;
    }
    const torch::Tensor condition = model_->StaticCondition(transition);
    const int width = codec.width();
    torch::Tensor features = torch::empty({tau + spec.frames, width});
    for (int i = 0; i < tau + spec.frames; ++i) {
      const auto at = static_cast<size_t>(i);
      const Pose& pose = motion.frames[at];
      const Pose& previous = motion.frames[i == 0 ? 0 : at - 1];
      Eigen::VectorXf x = codec.Encode(pose, previous, contacts[at], 30);
      if (i == 0) {  // the first frame moves as the second
        const RootVelocity velocity = RootVelocityBetween(motion.frames[0], motion.frames[1], 30);
        x[codec.velocity_at()] = static_cast<float>(velocity.forward);
        x[codec.velocity_at() + 1] = static_cast<float>(velocity.sideways);
        x[codec.velocity_at() + 2] = static_cast<float>(velocity.yaw);
      }
      std::copy(x.data(), x.data() + width, features[i].data_ptr<float>());
    }
    torch::Tensor audio = torch::zeros({tau + spec.frames, model_->config().audio_features});
    if (const auto& music = spec.music) {
      for (int i = 0; i < tau + spec.frames; ++i) {
        const Eigen::VectorXf row = i < tau ? music->history.col(i) : music->rows.col(i - tau);
        audio[i] = torch::tensor(std::vector<float>(row.begin(), row.end()));
      }
    }
    const torch::Tensor has_audio = torch::full({1, 1}, spec.music ? 1.0F : 0.0F);
    const auto inverse_weights = model_->InverseWeights();
    FlowState state = torch::zeros({1, model_->StateWidth()});
    double largest_effect_of_state = 0;
    for (int t = 0; t < spec.frames; ++t) {
      std::vector<float> noise(static_cast<size_t>(width));
      FillNormal(spec.seed, spec.candidate, spec.first_frame + t, noise);
      const auto result = model_->Step(
          features.narrow(0, t, tau).unsqueeze(0), audio.narrow(0, t, tau + 1).unsqueeze(0),
          has_audio, condition.select(1, t), spec.temperature * torch::tensor(noise).unsqueeze(0),
          inverse_weights, &state);
      largest_effect_of_state =
          std::max<double>(largest_effect_of_state, state.abs().max().item<float>());
      const Eigen::VectorXf x =
          Eigen::Map<Eigen::VectorXf>(result.features.contiguous().data_ptr<float>(), width);
      const auto expected = codec.Decode(x);
      const auto at = static_cast<size_t>(t);
      const Pose& pose = plan.poses[at];
      ASSERT_LT((pose.root_position - expected.pose.root_position).norm(), 1e-5) << t;
      ASSERT_LT((pose.rotations - expected.pose.rotations).norm(), 1e-5) << t;
      for (size_t foot = 0; foot < 4; ++foot) {
        ASSERT_NEAR(plan.contacts[at][foot], std::clamp(expected.contacts[foot], 0.0F, 1.0F), 1e-5);
      }
      ASSERT_NEAR(plan.log_likelihoods[at], result.log_likelihood.item<float>(), 2e-3) << t;
    }
    EXPECT_GT(largest_effect_of_state, 0);
  }
}

}  // namespace choreo::torch_sampler_test
