#include "model/engine/torch_engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/torch.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "model/core/error.h"
#include "model/core/random.h"
#include "model/core/threads.h"
#include "model/engine/build_identity.h"
#include "model/engine/torch_tile.h"
#include "model/flow/checkpoint.h"
#include "model/motion/contacts.h"
#include "model/motion/kinematics.h"
#include "model/motion/pose_codec.h"
#include "model/motion/rotation.h"
#include "model/motion/velocity.h"

namespace choreo {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

// Both shapes of the model, with weights drawn at random: it dances nothing, but every path
// computes.
enum class Shape { kPlannerAndPerceptron, kRecurrent };

FlowModel RandomModel(Shape shape) {
  torch::manual_seed(3);
  FlowConfig config;
  config.preset = "random-weights-of-a-test";
  config.flow_steps = 2;
  config.hidden = 24;
  config.max_transition_frames = 60;
  config.temperature = 0.4;
  if (shape == Shape::kPlannerAndPerceptron) {
    config.recurrent = false;
    config.condition_width = 20;
    config.planner = {.width = 16, .layers = 1, .heads = 2};
  }
  FlowModel model(config, Skeleton::Smpl24());
  torch::NoGradGuard no_grad;
  for (auto& item : model->named_parameters()) {
    // Also what starts as zero, and would hide everything before it.
    item.value().add_(0.05 * torch::randn_like(item.value()));
  }
  model->SetFeatureNormalisation(0.05 * torch::randn({model->feature_width()}),
                                 0.02 + 0.1 * torch::rand({model->feature_width()}));
  model->SetAudioNormalisation(torch::randn({config.audio_features}),
                               1 + torch::rand({config.audio_features}));
  model->eval();
  return model;
}

Pose RandomPose(Random* random, const Pose& base, double size) {
  Pose pose = base;
  for (double& value : pose.root_position) value += size * random->Normal();
  for (double& value : pose.rotations.reshaped()) value += size * random->Normal();
  return pose;
}

class TorchEngineTest : public testing::TestWithParam<Shape> {
 protected:
  void SetUp() override {
    SetTorchThreads(1);
    model_ = RandomModel(GetParam());
    // Tests may run side by side, and so may whole builds.
    std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::ranges::replace(name, '/', '_');
    path_ = std::filesystem::path(testing::TempDir()) /
            ("torch_engine_" + name + "_" + std::to_string(getpid()) + ".safetensors");
    SaveCheckpoint(path_, model_, {{"licence", "none: random weights"}});
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::unique_ptr<StepEngine> Engine(int slots = 16) { return MakeTorchEngine(path_, {}, slots); }

  TransitionSpec Spec(uint64_t seed, int frames = 12) const {
    const Skeleton& skeleton = model_->skeleton();
    Random random(seed);
    TransitionSpec spec;
    spec.frames = frames;
    Pose pose = RandomPose(&random, RestPose(skeleton), 0.2);
    for (int t = 0; t < model_->config().history_frames; ++t) {
      pose = RandomPose(&random, pose, 0.02);
      spec.history.push_back(pose);
    }
    spec.target = Target{RandomPose(&random, pose, 0.3), {}};
    if (seed % 3 == 0) {
      spec.target->mask.root_position = false;
      spec.target->mask.joints.assign(static_cast<size_t>(skeleton.joints()), true);
      spec.target->mask.joints[5] = false;
    }
    if (seed % 5 == 0) spec.target.reset();
    spec.has_audio = seed % 2 == 1;
    if (spec.has_audio) {
      spec.audio_history.resize(model_->config().audio_features, model_->config().history_frames);
      for (float& value : spec.audio_history.reshaped())
        value = static_cast<float>(random.Normal());
    }
    spec.seed = seed;
    spec.candidate = static_cast<uint32_t>(seed % 4);
    spec.first_frame = 1000 + static_cast<int64_t>(seed);
    spec.temperature = 0.7F;
    return spec;
  }
  std::vector<float> AudioRow(uint64_t seed, int frame) const {
    std::vector<float> row(static_cast<size_t>(model_->config().audio_features));
    FillNormal(seed, 77, frame, row);
    return row;
  }
  // What a dance makes of the model's pose: near it, but not the same.
  static Pose Emit(const Pose& raw, int frame) {
    Pose pose = raw;
    pose.root_position.x() += 0.001 * frame;
    pose.rotations(1, 3) += 0.002;
    return pose;
  }

  // Steps slots that were admitted for these seeds, all together, to the end of the longest.
  struct Dancer {
    TransitionSpec spec;
    int slot = -1;
    std::vector<StepOutput> outputs;
    std::vector<Pose> emitted;
  };
  void Dance(StepEngine* engine, std::vector<Dancer>* dancers) const {
    for (int frame = 0;; ++frame) {
      std::vector<StepInput> inputs;
      std::vector<std::vector<float>> rows;
      std::vector<Dancer*> stepping;
      for (Dancer& dancer : *dancers) {
        if (frame < dancer.spec.frames) stepping.push_back(&dancer);
      }
      if (stepping.empty()) return;
      for (Dancer* dancer : stepping) {
        rows.push_back(dancer->spec.has_audio ? AudioRow(dancer->spec.seed, frame)
                                              : std::vector<float>());
        inputs.push_back(
            {dancer->slot, frame > 0 ? &dancer->emitted.back() : nullptr, rows.back()});
      }
      std::vector<StepOutput> outputs(stepping.size());
      engine->Step(inputs, outputs);
      for (size_t i = 0; i < stepping.size(); ++i) {
        stepping[i]->outputs.push_back(outputs[i]);
        stepping[i]->emitted.push_back(Emit(outputs[i].pose, frame));
      }
    }
  }
  std::vector<StepOutput> DanceAlone(StepEngine* engine, const TransitionSpec& spec) const {
    std::vector<Dancer> one(1);
    one[0] = {spec, engine->Admit(spec), {}, {}};
    Dance(engine, &one);
    engine->Release(one[0].slot);
    return one[0].outputs;
  }
  static void ExpectSameBits(const std::vector<StepOutput>& a, const std::vector<StepOutput>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (size_t t = 0; t < a.size(); ++t) {
      ASSERT_EQ(a[t].pose.root_position, b[t].pose.root_position) << "frame " << t;
      ASSERT_EQ(a[t].pose.rotations, b[t].pose.rotations) << "frame " << t;
      ASSERT_EQ(a[t].contacts, b[t].contacts) << "frame " << t;
      ASSERT_EQ(a[t].log_likelihood, b[t].log_likelihood) << "frame " << t;
    }
  }

  std::filesystem::path path_;
  FlowModel model_{nullptr};
};

INSTANTIATE_TEST_SUITE_P(Shapes, TorchEngineTest,
                         testing::Values(Shape::kPlannerAndPerceptron, Shape::kRecurrent),
                         [](const auto& instance) {
                           return instance.param == Shape::kRecurrent ? "Recurrent" : "Planner";
                         });

TEST_P(TorchEngineTest, TellsWhatItIs) {
  const auto engine = Engine(3);
  const ModelInfo& info = engine->model();
  EXPECT_EQ(info.name, "random-weights-of-a-test");
  EXPECT_EQ(info.licence, "none: random weights");
  EXPECT_THAT(info.fingerprint, HasSubstr(LoadCheckpoint(path_).hash));
  EXPECT_THAT(info.fingerprint, HasSubstr(BuildIdentity()));
  EXPECT_EQ(info.skeleton.joint_names, Skeleton::Smpl24().joint_names);
  EXPECT_EQ(info.max_transition_frames, 60);
  EXPECT_EQ(info.default_temperature, 0.4);
  EXPECT_EQ(engine->device(), "cpu");
  EXPECT_EQ(engine->slots(), 3);
  EXPECT_EQ(engine->free_slots(), 3);
}

TEST_P(TorchEngineTest, RowsOfATileAreIndependentHere) {
  const c10::InferenceMode inference;
  auto weights = std::make_shared<TorchWeights>();
  weights->model = model_;
  weights->inverse_weights = model_->InverseWeights();
  EXPECT_GT(TorchTile::VerifiedRows(weights), 1) << "the slow fallback is in use";
}

TEST_P(TorchEngineTest, GivesTheSameBitsAloneAndAmongFifteenOthers) {
  const auto engine = Engine();
  const auto alone = DanceAlone(engine.get(), Spec(7));
  for (int place : {0, 6, 15}) {
    std::vector<Dancer> crowd;
    for (int i = 0; i < 16; ++i) {
      const TransitionSpec spec =
          i == place ? Spec(7) : Spec(100 + static_cast<uint64_t>(i), 5 + i);
      crowd.push_back({spec, engine->Admit(spec), {}, {}});
    }
    EXPECT_EQ(engine->free_slots(), 0);
    Dance(engine.get(), &crowd);
    ExpectSameBits(crowd[static_cast<size_t>(place)].outputs, alone);
    EXPECT_NE(crowd[static_cast<size_t>(place + 1) % 16].outputs[0].pose.root_position,
              alone[0].pose.root_position);
    for (const Dancer& dancer : crowd) engine->Release(dancer.slot);
  }
}

TEST_P(TorchEngineTest, GivesTheSameBitsInAnySlotOrderAndInstance) {
  const auto engine = Engine(40);
  const auto first = DanceAlone(engine.get(), Spec(7));
  std::vector<Dancer> crowd;
  for (uint64_t i = 0; i < 40; ++i) crowd.push_back({Spec(i), engine->Admit(Spec(i)), {}, {}});
  std::ranges::reverse(crowd);  // and more than two tiles
  Dance(engine.get(), &crowd);
  ExpectSameBits(crowd[32].outputs, first);
  ExpectSameBits(DanceAlone(Engine(1).get(), Spec(7)), first);
}

TEST_P(TorchEngineTest, AReleasedSlotForgets) {
  const auto engine = Engine(1);
  const auto first = DanceAlone(engine.get(), Spec(7));
  DanceAlone(engine.get(), Spec(8));
  ExpectSameBits(DanceAlone(engine.get(), Spec(7)), first);
}

// The module itself, fed by the test with features of the whole emitted motion.
TEST_P(TorchEngineTest, StepsAsTheModuleDoes) {
  for (uint64_t seed : {7, 8, 9, 10}) {
    const auto engine = Engine(1);
    std::vector<Dancer> one(1);
    one[0].spec = Spec(seed);
    one[0].slot = engine->Admit(one[0].spec);
    Dance(engine.get(), &one);
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
        transition.target_mask[0][j] =
            mask.joints.empty() || mask.joints[static_cast<size_t>(j)] ? 1 : 0;
      }
      transition.target_mask[0][joints] = mask.root_position ? 1 : 0;
    }
    const TransitionContext context = model_->Begin(transition);

    // Reference poses of the N frames, as the module planned them.
    std::vector<Pose> plan;
    if (model_->has_planner()) {
      Pose before = spec.history.back();
      for (int t = 0; t < spec.frames; ++t) {
        Pose pose = before;
        for (int i = 0; i < 3; ++i) {
          pose.root_position[i] = context.reference.position[0][t][i].item<float>();
        }
        for (int j = 0; j < joints; ++j) {
          Eigen::Matrix3d matrix;
          for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) {
              matrix(r, c) = context.reference.rotation[0][t][j][r][c].item<float>();
            }
          }
          pose.rotations.col(j) = NearestBranch(LogMap(matrix), before.rotations.col(j));
        }
        plan.push_back(pose);
        before = pose;
      }
    }
    const int width = codec.width();
    torch::Tensor features = torch::empty({tau + spec.frames, width});
    for (int i = 0; i < tau + spec.frames; ++i) {
      const auto at = static_cast<size_t>(i);
      const Pose& pose = motion.frames[at];
      const Pose* reference = nullptr;
      if (!plan.empty()) reference = i < tau ? &pose : &plan[at - static_cast<size_t>(tau)];
      const Pose& previous = motion.frames[i == 0 ? 0 : at - 1];
      Eigen::VectorXf x = codec.Encode(pose, previous, reference, contacts[at], 30);
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
        std::vector<float> row = i < tau ? std::vector<float>() : AudioRow(seed, i - tau);
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
          has_audio, context.static_condition.select(1, t),
          spec.temperature * torch::tensor(noise).unsqueeze(0), inverse_weights, &state);
      if (state.numel() > 0) {
        largest_effect_of_state =
            std::max<double>(largest_effect_of_state, state.abs().max().item<float>());
      }
      const Eigen::VectorXf x =
          Eigen::Map<Eigen::VectorXf>(result.features.contiguous().data_ptr<float>(), width);
      const auto expected = codec.Decode(x, plan.empty() ? nullptr : &plan[static_cast<size_t>(t)]);
      const StepOutput& output = one[0].outputs[static_cast<size_t>(t)];
      ASSERT_LT((output.pose.root_position - expected.pose.root_position).norm(), 1e-5) << t;
      ASSERT_LT((output.pose.rotations - expected.pose.rotations).norm(), 1e-5) << t;
      for (size_t foot = 0; foot < 4; ++foot) {
        ASSERT_NEAR(output.contacts[foot], std::clamp(expected.contacts[foot], 0.0F, 1.0F), 1e-5);
      }
      ASSERT_NEAR(output.log_likelihood, result.log_likelihood.item<float>(), 2e-3) << t;
    }
    EXPECT_EQ(largest_effect_of_state > 0, GetParam() == Shape::kRecurrent);
  }
}

TEST_P(TorchEngineTest, EveryInputMatters) {
  const auto engine = Engine(1);
  const auto base = DanceAlone(engine.get(), Spec(7));
  const auto differs = [&](auto change) {
    TransitionSpec spec = Spec(7);
    change(spec);
    return DanceAlone(engine.get(), spec)[0].pose.rotations != base[0].pose.rotations;
  };
  EXPECT_TRUE(differs([](TransitionSpec& spec) { spec.history[0].root_position.x() += 0.1; }));
  EXPECT_TRUE(differs([](TransitionSpec& spec) { spec.target->pose.rotations(0, 9) += 0.2; }));
  EXPECT_TRUE(differs([](TransitionSpec& spec) { spec.target->mask.root_position = false; }));
  EXPECT_TRUE(differs([](TransitionSpec& spec) { spec.target.reset(); }));
  EXPECT_TRUE(differs([](TransitionSpec& spec) { spec.audio_history(3, 9) += 1; }));
  EXPECT_TRUE(differs([](TransitionSpec& spec) { spec.has_audio = false; }));
  EXPECT_TRUE(differs([](TransitionSpec& spec) { spec.candidate += 1; }));
  EXPECT_TRUE(differs([](TransitionSpec& spec) { spec.first_frame += 1; }));
  EXPECT_TRUE(differs([](TransitionSpec& spec) { spec.temperature = 0; }));
  EXPECT_FALSE(differs([](TransitionSpec&) {}));
}

TEST_P(TorchEngineTest, RefusesWhatDoesNotFitAndStaysUsable) {
  const auto engine = Engine(1);
  const auto refused = [&](auto change) -> std::string {
    TransitionSpec spec = Spec(7);
    change(spec);
    try {
      engine->Admit(spec);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refused([](auto& spec) { spec.frames = 0; }),
              HasSubstr("frames: 0 is not in [1, 60]"));
  EXPECT_THAT(refused([](auto& spec) { spec.frames = 61; }), HasSubstr("frames: 61"));
  EXPECT_THAT(refused([](auto& spec) { spec.history.pop_back(); }), HasSubstr("history: 9 poses"));
  EXPECT_THAT(refused([](auto& spec) { spec.history[4].rotations.resize(3, 22); }),
              HasSubstr("history[4]: 22 joints"));
  EXPECT_THAT(refused([](auto& spec) { spec.target->mask.joints.resize(3); }),
              HasSubstr("target.mask: 3 joints"));
  EXPECT_THAT(refused([](auto& spec) { spec.audio_history.resize(40, 3); }),
              HasSubstr("audio_history: 40 x 3, must be 40 x 10"));

  const int slot = engine->Admit(Spec(8));
  try {
    engine->Admit(Spec(8));
    FAIL() << "there was no free slot";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kResourceExhausted);
  }
  std::vector<StepOutput> out(1);
  const Pose pose = RestPose(model_->skeleton());
  const std::vector<StepInput> wrong_slot = {{1, nullptr, {}}}, early = {{slot, &pose, {}}},
                               right = {{slot, nullptr, {}}};
  EXPECT_THROW(engine->Step(wrong_slot, out), Error);
  EXPECT_THROW(engine->Step(early, out), Error);
  engine->Step(right, out);
  EXPECT_THROW(engine->Step(right, out), Error);  // where is the pose before?
}

TEST_P(TorchEngineTest, EnginesOfOneDeviceShareTheirWeights) {
  const std::vector<Device> twice(2);
  const auto engines = MakeTorchEngines(path_, twice, 2);
  ASSERT_EQ(engines.size(), 2U);
  EXPECT_EQ(engines[0]->model().fingerprint, engines[1]->model().fingerprint);
  ExpectSameBits(DanceAlone(engines[0].get(), Spec(7)), DanceAlone(engines[1].get(), Spec(7)));
  EXPECT_THROW(MakeTorchEngines(path_, twice, 0), Error);
}

TEST(TorchSetUpTest, TheBuildIsNamed) {
  EXPECT_THAT(BuildIdentity(), ContainsRegex("^[A-Za-z]+ [0-9.]+ [A-Za-z]* [0-9a-f]{16}$"));
}

TEST(TorchSetUpTest, AFastBlasStandsBehindTorch) {
  if (TorchDevices().cuda_build) GTEST_SKIP() << "LibTorch with CUDA has its BLAS linked in";
  const BlasInfo blas = DetectBlas();
  EXPECT_EQ(blas.kind, BlasInfo::Kind::kFast) << blas.name << " at " << blas.path;
  EXPECT_NE(blas.name, "");
}

// On the devices that are there engines are made, and on no others.
TEST_P(TorchEngineTest, ThisBuildHasItsDevices) {
  const AvailableDevices available = TorchDevices();
  std::vector<Device> devices = {Device{}};
  for (int i = 0; i < available.cuda_devices; ++i) devices.push_back({Device::Kind::kCuda, i});
  for (const Device& device : devices) {
    const auto engine = MakeTorchEngine(path_, device, 1);
    EXPECT_EQ(engine->device(), device.name());
    EXPECT_FALSE(DanceAlone(engine.get(), Spec(7)).empty());
  }
  const Device beyond{Device::Kind::kCuda, available.cuda_devices};
  EXPECT_THROW(MakeTorchEngine(path_, beyond, 1), std::exception);
}

}  // namespace
}  // namespace choreo
