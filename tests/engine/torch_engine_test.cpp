#include <gtest/gtest.h>
#include <torch/torch.h>

#include <algorithm>
#include <utility>

#include "model/core/random.h"
#include "model/engine/engines.h"
#include "model/engine/torch/tile.h"
#include "model/flow/checkpoint.h"
#include "model/motion/contacts.h"
#include "model/motion/pose_codec.h"
#include "model/motion/rotation.h"
#include "model/motion/velocity.h"
#include "tests/engine/engine_dances.h"
#include "tests/support/load_checkpoint.h"

namespace choreo::torch_engine_test {

// The torch engine against the module that is trained.
class TorchEngineTest : public testing::TestWithParam<Shape> {
 protected:
  TorchEngineTest() : checkpoint_(GetParam()), model_(LoadCheckpoint(checkpoint_.path()).model) {
    SetTorchThreads(1);
  }
  SmallCheckpoint checkpoint_;
  FlowModel model_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, TorchEngineTest, testing::Values(Shape::kEncoded, Shape::kRaw),
                         [](const auto& instance) { return ShapeName(instance.param); });

TEST_P(TorchEngineTest, RowsOfATileAreIndependentHere) {
  const c10::InferenceMode inference;
  auto weights = std::make_shared<TorchWeights>();
  weights->model = model_;
  weights->inverse_weights = model_->InverseWeights();
  EXPECT_GT(TorchTile::VerifiedRows(weights), 1) << "the slow fallback is in use";
}

// The module itself, fed by the test with features of the whole emitted motion.
TEST_P(TorchEngineTest, StepsAsTheModuleDoes) {
  for (uint64_t seed : {7, 8, 9, 10}) {
    const auto engine = MakeEngine(checkpoint_.path(), {}, 1, EngineKind::kTorch);
    std::vector<Dancer> one(1);
    one[0].spec = RandomSpec(engine->model(), seed);
    one[0].slot = engine->Admit(one[0].spec);
    DanceTogether(engine.get(), &one);
    const TransitionSpec& spec = one[0].spec;

    torch::NoGradGuard no_grad;
    const Skeleton& skeleton = model_->skeleton();
    const PoseCodec codec(skeleton);
    const int tau = model_->config().history_frames, joints = skeleton.joints();
    Motion motion;
    motion.frames = spec.history;
    motion.frames.insert(motion.frames.end(), one[0].emitted.begin(), one[0].emitted.end());
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
        transition.target_mask[0][j] = mask.Asks(j) ? 1 : 0;
      }
      transition.target_mask[0][joints] = mask.root_position ? 1 : 0;
    }
    const torch::Tensor condition = model_->Begin(transition);
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
    if (spec.has_audio) {
      for (int i = 0; i < tau + spec.frames; ++i) {
        std::vector<float> row =
            i < tau ? std::vector<float>() : RandomAudioRow(engine->model(), seed, i - tau);
        if (i < tau) {
          const Eigen::VectorXf column = spec.audio_history.col(i);
          row.assign(column.begin(), column.end());
        }
        audio[i] = torch::tensor(row);
      }
    }
    const torch::Tensor has_audio = torch::full({1, 1}, spec.has_audio ? 1.0F : 0.0F);
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
      const StepOutput& output = one[0].outputs[static_cast<size_t>(t)];
      ASSERT_LT((output.pose.root_position - expected.pose.root_position).norm(), 1e-5) << t;
      ASSERT_LT((output.pose.rotations - expected.pose.rotations).norm(), 1e-5) << t;
      for (size_t foot = 0; foot < 4; ++foot) {
        ASSERT_NEAR(output.contacts[foot], std::clamp(expected.contacts[foot], 0.0F, 1.0F), 1e-5);
      }
      ASSERT_NEAR(output.log_likelihood.value(), result.log_likelihood.item<float>(), 2e-3) << t;
    }
    EXPECT_GT(largest_effect_of_state, 0);
  }
}

}  // namespace choreo::torch_engine_test
