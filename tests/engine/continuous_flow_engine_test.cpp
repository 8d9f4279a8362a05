#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "bench/random_checkpoints.h"
#include "model/core/error.h"
#include "model/core/safetensors.h"
#include "model/dance/transition_batch.h"
#include "model/engine/engines.h"
#include "model/engine/packed/kernels.h"
#include "model/flow/flow_sampler.h"
#include "model/motion/kinematics.h"
#include "tests/engine/engine_dances.h"
#include "tests/support/expect_error.h"

namespace choreo::continuous_flow_engine_test {

class ContinuousFlowEngineTest : public testing::Test {
 protected:
  ContinuousFlowEngineTest() {
    SetTorchThreads(1);
    ContinuousFlowConfig config;
    config.width = 24;
    config.layers = 2;
    config.heads = 2;
    config.condition = 8;
    config.window_frames = 16;
    config.styles = {"waltz"};
    config.median_factors = {0.01, 0.02, 0.02, 0.015, 0.015};
    path_ = std::filesystem::path(testing::TempDir()) /
            ("continuous_" +
             std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
             std::to_string(getpid()) + ".safetensors");
    WriteRandomContinuousFlow(path_, config, Skeleton::Smpl24(), 3);
    engine_ = MakeEngine(path_, {}, 8);
  }
  ~ContinuousFlowEngineTest() override { std::filesystem::remove(path_); }

  TransitionSpec Spec(uint64_t seed, int frames = 12) const {
    TransitionSpec spec = RandomSpec(engine_->model(), seed, frames);
    spec.temperature = 0.7F;
    spec.beats = {-4, 8, 20, 32};
    return spec;
  }
  std::vector<StepOutput> Dance(const TransitionSpec& spec) {
    return DanceAlone(engine_.get(), spec);
  }

  std::filesystem::path path_;
  std::unique_ptr<StepEngine> engine_;
};

double LargestDifference(const std::vector<StepOutput>& a, const std::vector<StepOutput>& b) {
  double most = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, (a[i].pose.rotations - b[i].pose.rotations).cwiseAbs().maxCoeff());
    most =
        std::max(most, (a[i].pose.root_position - b[i].pose.root_position).cwiseAbs().maxCoeff());
  }
  return most;
}

// Logs and metrics repeat the name; whoever may put a file in a folder must not fill them, nor the
// memory. Every error says which file it is about.
TEST_F(ContinuousFlowEngineTest, IsRefusedUnderANameThatNobodyCanPrintAndBeyondAGigabyte) {
  const auto refused = [&](const std::string& why) {
    try {
      MakeEngine(path_, {}, 1);
      ADD_FAILURE() << "loaded";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(path_.string()));
      EXPECT_THAT(error.what(), testing::HasSubstr(why));
    }
  };
  for (const std::string& name : {std::string(), std::string("a\nb"), std::string(65, 'x')}) {
    WriteRandomContinuousFlow(path_, {.name = name, .width = 24, .layers = 1, .heads = 2},
                              Skeleton::Smpl24(), 3);
    refused("is not 1 to 64 printable bytes");
  }
  ContinuousFlowConfig backwards{.width = 24, .layers = 1, .heads = 2};
  backwards.plan.accent = 0.5;
  WriteRandomContinuousFlow(path_, backwards, Skeleton::Smpl24(), 3);
  refused("config.plan.accent");
  for (const int steps : {0, 65}) {
    WriteRandomContinuousFlow(path_, {.width = 24, .layers = 1, .heads = 2, .steps = steps},
                              Skeleton::Smpl24(), 3);
    refused("config.steps: " + std::to_string(steps) + " is not in [1, 64]");
  }
  WriteRandomContinuousFlow(path_, {.width = 24, .layers = 1, .heads = 2}, Skeleton::Smpl24(), 3);
  Safetensors content = ReadSafetensors(path_);
  content.tensors.at("velocity_covariance").data.front() = NAN;
  content.metadata["hash"] = ContentHash(content, "hash");
  WriteSafetensors(path_, content);
  refused("is no covariance");
  std::filesystem::resize_file(path_, (uintmax_t{1} << 30) + 1);  // sparse
  refused("1073741825 bytes, the limit is 1073741824");
}

TEST_F(ContinuousFlowEngineTest, TellsWhatItTakes) {
  const ModelInfo& model = engine_->model();
  EXPECT_TRUE(model.root_path && model.velocity_factors);
  EXPECT_FALSE(model.deterministic);
  ASSERT_EQ(model.velocity_references.size(), 1U);
  EXPECT_FLOAT_EQ(model.velocity_references[0].factors[1], 0.02F);
  EXPECT_EQ(model.default_temperature, 1);
  EXPECT_EQ(model.max_temperature, kMaxFlowTemperature);
}

// Windows of odd and even numbers of frames, several in a row, with and without keys: heads here
// are narrower than any panel.
TEST_F(ContinuousFlowEngineTest, EnginesAgree) {
  const auto torch = MakeEngine(path_, {}, 1, EngineKind::kTorch);
  std::vector<std::pair<std::unique_ptr<StepEngine>, double>> others;
  const auto add = [&](const PackedKernels* kernels, double most) {
    const Device cpu;
    others.emplace_back(
        std::move(MakeEngines(path_, {&cpu, 1}, 1, EngineKind::kAuto, kernels->name).front()),
        most);
  };
  for (const PackedKernels* kernels : PackedKernelsHere()) add(kernels, 2e-4);
  for (const PackedKernels* kernels : Bf16KernelsHere()) add(kernels, 0.1);
  for (auto& [packed, most] : others) {
    EXPECT_NE(packed->model().fingerprint, torch->model().fingerprint);
    for (const int frames : {1, 2, 9, 16, 40}) {
      for (uint64_t seed = 1; seed <= 4; ++seed) {
        const TransitionSpec spec = Spec(seed, frames);
        const auto wanted = DanceAlone(torch.get(), spec);
        EXPECT_LT(LargestDifference(wanted, DanceAlone(packed.get(), spec)), most)
            << packed->model().fingerprint << ", " << frames << " frames, seed " << seed;
      }
    }
  }
}

TEST_F(ContinuousFlowEngineTest, CudaDancesAsTheCpuDoes) {
  if (TorchDevices().cuda_devices == 0) GTEST_SKIP() << "no CUDA device answers";
  const auto cpu = MakeEngine(path_, {}, 1, EngineKind::kTorch);
  const auto gpu = MakeEngine(path_, {Device::Kind::kCuda, 0}, 2, EngineKind::kTorch);
  EXPECT_EQ(gpu->device(), "cuda:0");
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const TransitionSpec spec = Spec(seed, 40);
    const auto danced = DanceAlone(gpu.get(), spec);
    EXPECT_LT(LargestDifference(DanceAlone(cpu.get(), spec), danced), 2e-4) << "seed " << seed;
    ExpectSameBits(DanceAlone(gpu.get(), spec), danced);
  }
}

TEST_F(ContinuousFlowEngineTest, GivesTheSameBitsAloneAndAmongOthers) {
  std::vector<Dancer> dancers;
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    const TransitionSpec spec = Spec(seed, 8 + 4 * static_cast<int>(seed));
    dancers.push_back({spec, engine_->Admit(spec), {}, {}});
  }
  ExpectError(ErrorCode::kResourceExhausted, "all 8 slots", [&] { engine_->Admit(Spec(9)); });
  DanceTogether(engine_.get(), &dancers);
  for (Dancer& dancer : dancers) engine_->Release(dancer.slot);
  EXPECT_EQ(engine_->free_slots(), 8);
  for (const Dancer& dancer : dancers) ExpectSameBits(dancer.outputs, Dance(dancer.spec));
}

// Windows are of 16 frames, each of four evaluations with beats and four without (at this
// temperature the mean way, too); three rounds where energy is asked for; the plan's stages are the
// last slice.
TEST_F(ContinuousFlowEngineTest, AdmissionsInSlicesGiveTheSameBitsWhateverComesBetween) {
  TransitionSpec lively = Spec(2, 40);
  lively.controls.velocity_factors.setConstant(kBodyParts, lively.frames, 0.05F);
  const std::vector<std::pair<TransitionSpec, int>> wanted = {
      {Spec(1, 16), 8 + 1}, {Spec(3, 40), 3 * 8 + 1}, {lively, 3 * 3 * 8 + 1}};
  std::vector<Dancer> dancers;
  std::vector<int> slices(wanted.size());
  for (const auto& one : wanted)
    dancers.push_back({one.first, engine_->BeginAdmission(one.first), {}, {}});
  const StepInput early{.slot = dancers[0].slot, .previous = nullptr, .audio_row = {}};
  StepOutput none;
  ExpectError(ErrorCode::kInvalidArgument, "is still being admitted", [&] {
    engine_->Step({&early, 1}, {&none, 1});
  });
  const int abandoned = engine_->BeginAdmission(lively);
  std::vector<bool> more(wanted.size(), true);
  for (int round = 0; round < 3 * 3 * 8 + 1; ++round) {
    for (size_t i = 0; i < wanted.size(); ++i) {
      if (!more[i]) continue;
      more[i] = engine_->ContinueAdmission(dancers[i].slot);
      ++slices[i];
    }
    if (round < 4) {
      EXPECT_TRUE(engine_->ContinueAdmission(abandoned));
    } else if (round == 4) {
      engine_->Release(abandoned);
    }
  }
  EXPECT_EQ(engine_->free_slots(), 5);
  DanceTogether(engine_.get(), &dancers);
  for (size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_EQ(slices[i], wanted[i].second);
    engine_->Release(dancers[i].slot);
    ExpectSameBits(dancers[i].outputs, Dance(dancers[i].spec));
  }
}

TEST_F(ContinuousFlowEngineTest, SeedsAndCandidatesChangeItUnlessItIsTheMean) {
  TransitionSpec spec = Spec(1);
  TransitionSpec other = spec;
  other.seed = 99;
  EXPECT_GT(LargestDifference(Dance(spec), Dance(other)), 0.01);
  other = spec;
  ++other.candidate;
  EXPECT_GT(LargestDifference(Dance(spec), Dance(other)), 0.01);
  spec.temperature = other.temperature = 0;
  ExpectSameBits(Dance(spec), Dance(other));
}

TEST_F(ContinuousFlowEngineTest, BeatsAndLimbsThatAreAskedForChangeIt) {
  const TransitionSpec spec = Spec(2);
  const auto plain = Dance(spec);
  TransitionSpec other = spec;
  for (double& beat : other.beats) beat += 5;
  EXPECT_GT(LargestDifference(plain, Dance(other)), 1e-4);
  other = spec;
  other.controls.velocity_factors.setConstant(kBodyParts, spec.frames, 0.05F);
  const auto lively = Dance(other);
  EXPECT_GT(LargestDifference(plain, lively), 1e-4);
  // What nobody asks for is unknown, whatever value stands there.
  other.controls.parts_asked.fill(false);
  ExpectSameBits(plain, Dance(other));
}

TEST_F(ContinuousFlowEngineTest, AStyleThatIsAskedForChangesIt) {
  EXPECT_EQ(engine_->model().styles, std::vector<std::string>{"waltz"});
  const TransitionSpec spec = Spec(2);
  TransitionSpec waltz = spec;
  waltz.style = "waltz";
  EXPECT_GT(LargestDifference(Dance(spec), Dance(waltz)), 1e-6);
}

TEST_F(ContinuousFlowEngineTest, DancesWithoutAKeyWithAPathAndFromHeldHistory) {
  TransitionSpec spec = Spec(3, 40);
  spec.target.reset();
  spec.controls.root_path.resize(3, spec.frames);
  for (int i = 0; i < spec.frames; ++i)
    spec.controls.root_path.col(i) << 0.01F * static_cast<float>(i), 0.9F, 0.0F;
  spec.controls.path_heights = false;
  const auto dance = Dance(spec);
  for (int i = 0; i < spec.frames; ++i) {
    EXPECT_NEAR(dance[static_cast<size_t>(i)].pose.root_position.x(), 0.01 * i, 1e-5);
  }
}

TEST_F(ContinuousFlowEngineTest, AServedTransitionArrivesExactly) {
  TransitionInput input;
  TransitionRequest& request = input.request;
  request.frames = 30;
  request.seed = 4;
  request.temperature = 0.7F;
  Target target{RestPose(Skeleton::Smpl24()), {}};
  target.pose.rotations(2, 16) = 1.0;
  request.target = target;
  const auto arrival = DanceTransitions(*engine_, {&input, 1}).front().arrival;
  ASSERT_TRUE(arrival);
  EXPECT_LT(arrival->final_error_m, 1e-3);
  EXPECT_LT(arrival->final_error_deg, 0.1);
}

}  // namespace choreo::continuous_flow_engine_test
