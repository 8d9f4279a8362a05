#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/random_checkpoints.h"
#include "model/core/error.h"
#include "model/core/files/safetensors.h"
#include "model/dance/transition/transition.h"
#include "model/engine/packed/kernels.h"
#include "model/flow/flow_sampler.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/plan/takes.h"
#include "model/samplers/samplers.h"
#include "tests/samplers/sampled.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::continuous_flow_sampler_test {

class ContinuousFlowSamplerTest : public testing::Test {
 protected:
  ContinuousFlowSamplerTest() {
    SetTorchThreads(1);
    ContinuousFlowConfig config;
    config.width = 24;
    config.layers = 2;
    config.heads = 2;
    config.condition = 8;
    config.window_frames = 16;
    config.styles = {"waltz"};
    config.median_factors = {0.01, 0.02, 0.02, 0.015, 0.015};
    WriteRandomContinuousFlow(path_, config, Skeleton::Smpl24(), 3);
    sampler_ = MakeSampler(path_, {});
  }

  TransitionSpec Spec(uint64_t seed, int frames = 12) const {
    TransitionSpec spec = RandomSpec(sampler_->model(), seed, frames);
    spec.temperature = 0.7F;
    spec.spare_frames = SpareFrames::Of(frames).left();
    spec.beats = {-4, 8, 20, 32};
    return spec;
  }
  Plan Dance(const TransitionSpec& spec) { return SampleNow(*sampler_, spec); }

  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "model.safetensors";
  std::unique_ptr<Sampler> sampler_;
};

// Logs and metrics repeat the name, so a file in a folder must not fill them, nor the memory. Every
// error names its file.
TEST_F(ContinuousFlowSamplerTest, RefusesUnprintableNamesAndFilesOverAGigabyte) {
  const auto refused = [&](const std::string& why) {
    try {
      MakeSampler(path_, {});
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
  backwards.plan.accent = 1;
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
  refused("is not a covariance");
  std::filesystem::resize_file(path_, (uintmax_t{1} << 30) + 1);  // sparse
  refused("1073741825 bytes, the limit is 1073741824");
}

TEST_F(ContinuousFlowSamplerTest, ListsItsControls) {
  const ModelInfo& model = sampler_->model();
  EXPECT_EQ(model.controls, ControlNames());
  EXPECT_FALSE(model.deterministic);
  ASSERT_EQ(model.velocity_references.size(), 1U);
  EXPECT_FLOAT_EQ(model.velocity_references[0].speeds[1], 0.02F);
  EXPECT_EQ(model.default_temperature, 1);
  EXPECT_EQ(model.max_temperature, kMaxFlowTemperature);
}

// Windows of odd and even numbers of frames, several in a row, with and without keys: heads here
// are narrower than any panel.
TEST_F(ContinuousFlowSamplerTest, KernelsAgree) {
  const auto torch = MakeSampler(path_, {}, EngineKind::kTorch);
  std::vector<std::pair<std::unique_ptr<Sampler>, double>> others;
  const auto add = [&](const PackedKernels* kernels, double most) {
    const Device cpu;
    others.emplace_back(
        std::move(MakeSamplers(path_, {&cpu, 1}, EngineKind::kAuto, kernels->name).front()), most);
  };
  for (const PackedKernels* kernels : PackedKernelsHere()) add(kernels, 2e-4);
  for (const PackedKernels* kernels : Bf16KernelsHere()) add(kernels, 0.1);
  for (auto& [packed, most] : others) {
    EXPECT_NE(packed->model().fingerprint, torch->model().fingerprint);
    for (const int frames : {1, 2, 9, 16, 40}) {
      for (uint64_t seed = 1; seed <= 4; ++seed) {
        const TransitionSpec spec = Spec(seed, frames);
        const auto wanted = SampleNow(*torch, spec);
        EXPECT_LT(LargestDifference(wanted, SampleNow(*packed, spec)), most)
            << packed->model().fingerprint << ", " << frames << " frames, seed " << seed;
      }
    }
  }
}

TEST_F(ContinuousFlowSamplerTest, CudaDancesAsTheCpuDoes) {
  if (TorchDevices().cuda_devices == 0) GTEST_SKIP() << "no CUDA device answers";
  const auto cpu = MakeSampler(path_, {}, EngineKind::kTorch);
  const auto gpu = MakeSampler(path_, {Device::Kind::kCuda, 0}, EngineKind::kTorch);
  EXPECT_EQ(gpu->device(), "cuda:0");
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const TransitionSpec spec = Spec(seed, 40);
    const auto danced = SampleNow(*gpu, spec);
    EXPECT_LT(LargestDifference(SampleNow(*cpu, spec), danced), 2e-4) << "seed " << seed;
    ExpectSameBits(SampleNow(*gpu, spec), danced);
  }
}

// Windows are of 16 frames, each of four evaluations with beats (at this temperature the mean way,
// too) and three without, of all but the last; three rounds where energy is asked for. What
// follows the last evaluation is the last slice.
TEST_F(ContinuousFlowSamplerTest, InterleavedSlicesGiveTheSameBits) {
  TransitionSpec lively = Spec(2, 40);
  lively.controls[kVelocityFactors].values.setConstant(kBodyParts, lively.frames, 0.05F);
  const std::vector<std::pair<TransitionSpec, int>> wanted = {
      {Spec(1, 16), 7 + 1}, {Spec(3, 40), 3 * 7 + 1}, {lively, 3 * 3 * 7 + 1}};
  std::vector<TransitionSpec> specs;
  for (const auto& [spec, slices] : wanted) {
    specs.push_back(spec);
    const ValidSpec valid(spec, sampler_->model());
    auto sampling = sampler_->Sample(valid);
    int made = 1;
    while (sampling.Continue()) ++made;
    EXPECT_GE(made, slices);
    // This network knows nothing, so some windows before the key's are sampled again.
    EXPECT_EQ((made - slices) % 7, 0) << made;
  }
  const ValidSpec valid(lively, sampler_->model());
  auto abandoned = sampler_->Sample(valid);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(abandoned.Continue());
  const std::vector<Plan> plans = SampleInTurn(sampler_.get(), specs);
  for (size_t i = 0; i < specs.size(); ++i) ExpectSameBits(plans[i], Dance(specs[i]));
}

TEST_F(ContinuousFlowSamplerTest, SeedsAndCandidatesChangeItUnlessItIsTheMean) {
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

TEST_F(ContinuousFlowSamplerTest, RequestedBeatsAndLimbSpeedsChangeIt) {
  const TransitionSpec spec = Spec(2);
  const auto plain = Dance(spec);
  TransitionSpec other = spec;
  for (double& beat : other.beats) beat += 5;
  EXPECT_GT(LargestDifference(plain, Dance(other)), 1e-4);
  other = spec;
  other.controls[kVelocityFactors].values.setConstant(kBodyParts, spec.frames, 0.05F);
  const auto lively = Dance(other);
  EXPECT_GT(LargestDifference(plain, lively), 1e-4);
  // Parts without a request are unknown, whatever their value.
  other.controls[kVelocityFactors].requested.assign(kBodyParts, false);
  ExpectSameBits(plain, Dance(other));
}

TEST_F(ContinuousFlowSamplerTest, RequestedStyleChangesIt) {
  EXPECT_EQ(sampler_->model().styles, std::vector<std::string>{"waltz"});
  const TransitionSpec spec = Spec(2);
  TransitionSpec waltz = spec;
  waltz.style = "waltz";
  EXPECT_GT(LargestDifference(Dance(spec), Dance(waltz)), 1e-6);
}

TEST_F(ContinuousFlowSamplerTest, DancesWithoutAKeyWithAPathAndFromHeldHistory) {
  TransitionSpec spec = Spec(3, 40);
  spec.target.reset();
  spec.controls[kRootPath].values.resize(3, spec.frames);
  for (int i = 0; i < spec.frames; ++i)
    spec.controls[kRootPath].values.col(i) << 0.01F * static_cast<float>(i), 0.9F, 0.0F;
  spec.controls[kRootPath].requested[1] = false;
  const auto dance = Dance(spec);
  for (int i = 0; i < spec.frames; ++i) {
    EXPECT_NEAR(dance.poses[static_cast<size_t>(i)].root_position.x(), 0.01 * i, 1e-5);
  }
}

TEST_F(ContinuousFlowSamplerTest, AServedTransitionArrivesExactly) {
  TransitionSpec request;
  request.frames = 30;
  request.seed = 4;
  request.temperature = 0.7F;
  Target target{RestPose(Skeleton::Smpl24()), {}};
  target.pose.rotations(2, 16) = 1.0;
  request.target = target;
  const auto arrival = DanceTransition(*sampler_, request).arrival();
  ASSERT_TRUE(arrival);
  EXPECT_LT(arrival->final_error_m, 1e-3);
  EXPECT_LT(arrival->final_error_deg, 0.1);
}

}  // namespace choreo::continuous_flow_sampler_test
