#include "model/samplers/samplers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "model/core/error.h"
#include "model/core/files/safetensors.h"
#include "model/core/numbers/math_library.h"
#include "model/core/running/threads.h"
#include "model/engine/loading.h"
#include "tests/samplers/sampled.h"

// The promises of every sampler of the flow model, on any engine.
namespace choreo::samplers_test {

using testing::ContainsRegex;
using testing::HasSubstr;

class SamplersTest : public testing::TestWithParam<std::tuple<EngineKind, Shape>> {
 protected:
  SamplersTest() : checkpoint_(std::get<1>(GetParam())) { SetTorchThreads(1); }
  std::unique_ptr<Sampler> Make() {
    return MakeSampler(checkpoint_.path(), {}, std::get<0>(GetParam()));
  }
  SmallCheckpoint checkpoint_;
};

INSTANTIATE_TEST_SUITE_P(Samplers, SamplersTest,
                         testing::Combine(testing::Values(EngineKind::kTorch, EngineKind::kPacked),
                                          testing::Values(Shape::kRaw, Shape::kEncoded)),
                         [](const auto& instance) {
                           return std::string(std::get<0>(instance.param) == EngineKind::kTorch
                                                  ? "Torch"
                                                  : "Packed") +
                                  ShapeName(std::get<1>(instance.param));
                         });

TEST_P(SamplersTest, DescribesItself) {
  const auto sampler = Make();
  const ModelInfo& info = sampler->model();
  EXPECT_EQ(info.name, "random-weights-of-a-test");
  EXPECT_EQ(info.licence, "none: random weights");
  EXPECT_THAT(info.fingerprint, HasSubstr(ReadSafetensors(checkpoint_.path()).metadata["hash"]));
  EXPECT_THAT(info.fingerprint, HasSubstr(std::string(BuildIdentity()) + ", " + MathLibrary()));
  EXPECT_EQ(info.fingerprint.find("/packed ") != std::string::npos,
            std::get<0>(GetParam()) == EngineKind::kPacked)
      << info.fingerprint;
  EXPECT_EQ(info.skeleton.joint_names, Skeleton::Smpl24().joint_names);
  EXPECT_EQ(info.max_transition_frames, 200);
  EXPECT_EQ(info.default_temperature, 0.4);
  EXPECT_FALSE(info.deterministic);
  EXPECT_EQ(sampler->device(), "cpu");
}

TEST_P(SamplersTest, GivesTheSameBitsAloneInTurnWithOthersAndElsewhere) {
  const auto sampler = Make();
  std::vector<TransitionSpec> specs;
  for (int i = 0; i < 16; ++i) {
    // They end one by one.
    specs.push_back(RandomSpec(sampler->model(), static_cast<uint64_t>(i), 5 + i));
  }
  const std::vector<Plan> plans = SampleInTurn(sampler.get(), specs);
  const auto other = Make();
  for (size_t i = 0; i < specs.size(); ++i) {
    ExpectSameBits(plans[i], SampleNow(*sampler, specs[i]));
    ExpectSameBits(plans[i], SampleNow(*other, specs[i]));
    if (i > 0) {
      EXPECT_NE(plans[i].poses[0].root_position, plans[i - 1].poses[0].root_position);
    }
  }
}

TEST_P(SamplersTest, EveryInputMatters) {
  const auto sampler = Make();
  const TransitionSpec spec = RandomSpec(sampler->model(), 7);
  const Plan base = SampleNow(*sampler, spec);
  const auto differs = [&](auto change) {
    TransitionSpec changed = spec;
    change(changed);
    return SampleNow(*sampler, changed).poses[0].rotations != base.poses[0].rotations;
  };
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.history[0].root_position.x() += 0.1; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.target->pose.rotations(0, 9) += 0.2; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.target->mask.root_position = false; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.target.reset(); }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.music->history(3, 9) += 1; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.music->rows(5, 0) += 1; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.music.reset(); }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.candidate += 1; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.first_frame += 1; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.temperature = 0; }));
  EXPECT_FALSE(differs([](TransitionSpec&) {}));
}

TEST_P(SamplersTest, RefusesUnfitSpecsAndStaysUsable) {
  const auto sampler = Make();
  const auto refused = [&](auto change) -> std::string {
    TransitionSpec spec = RandomSpec(sampler->model(), 7);
    change(spec);
    try {
      SampleNow(*sampler, spec);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refused([](auto& spec) { spec.frames = 0; }),
              HasSubstr("frames: 0 is not in [1, 200]"));
  EXPECT_THAT(refused([](auto& spec) { spec.frames = 201; }), HasSubstr("frames: 201"));
  EXPECT_THAT(refused([](auto& spec) { spec.history.pop_back(); }), HasSubstr("history: 9 poses"));
  EXPECT_THAT(refused([](auto& spec) { spec.history[4].rotations.resize(3, 22); }),
              HasSubstr("history[4].rotations: 22 joints"));
  EXPECT_THAT(refused([](auto& spec) { spec.target->mask.joints.resize(3); }),
              HasSubstr("target.mask: 3 joints"));
  EXPECT_THAT(refused([](auto& spec) { spec.music->history.resize(40, 3); }),
              HasSubstr("audio_history: 40 x 3, must be 40 x 10"));
  EXPECT_THAT(refused([](auto& spec) { spec.music->rows.resize(40, 11); }),
              HasSubstr("audio_rows: 40 x 11, must be 40 x 12"));
  EXPECT_EQ(SampleNow(*sampler, RandomSpec(sampler->model(), 8)).poses.size(), 12U);
}

TEST_P(SamplersTest, ThoseOfOneDeviceShareTheirWeights) {
  const std::vector<Device> twice(2);
  const EngineKind kind = std::get<0>(GetParam());
  const auto samplers = MakeSamplers(checkpoint_.path(), twice, kind);
  ASSERT_EQ(samplers.size(), 2U);
  EXPECT_EQ(samplers[0]->model().fingerprint, samplers[1]->model().fingerprint);
  const TransitionSpec spec = RandomSpec(samplers[0]->model(), 7);
  ExpectSameBits(SampleNow(*samplers[0], spec), SampleNow(*samplers[1], spec));
}

// On the devices that are there samplers are made, and on no others.
TEST_P(SamplersTest, ThisBuildHasItsDevices) {
  const AvailableDevices available = TorchDevices();
  const EngineKind kind = std::get<0>(GetParam());
  std::vector<Device> devices = {Device{}};
  if (kind == EngineKind::kTorch) {
    for (int i = 0; i < available.cuda_devices; ++i) devices.push_back({Device::Kind::kCuda, i});
  }
  for (const Device& device : devices) {
    const auto sampler = MakeSampler(checkpoint_.path(), device, kind);
    EXPECT_EQ(sampler->device(), device.name());
    EXPECT_FALSE(SampleNow(*sampler, RandomSpec(sampler->model(), 7)).poses.empty());
  }
  const Device beyond{Device::Kind::kCuda, available.cuda_devices};
  EXPECT_THROW(MakeSampler(checkpoint_.path(), beyond, kind), std::exception);
}

TEST(SamplerSetUpTest, TheMathLibraryIsNamed) {
  EXPECT_THAT(MathLibrary(), ContainsRegex("^glibc [0-9]+\\.[0-9]+( fma| fma4| avx)?$"));
}

TEST(SamplerSetUpTest, TheBuildIsNamed) {
  EXPECT_THAT(BuildIdentity(), ContainsRegex("^[A-Za-z]+ [0-9.]+ [A-Za-z]* [0-9a-f]{16}$"));
}

TEST(SamplerSetUpTest, TorchUsesAFastBlas) {
  if (TorchDevices().cuda_build) GTEST_SKIP() << "LibTorch with CUDA has its BLAS linked in";
  const BlasInfo blas = DetectBlas();
  EXPECT_EQ(blas.kind, BlasInfo::Kind::kFast) << blas.name << " at " << blas.path;
  EXPECT_NE(blas.name, "");
}

TEST(SamplerSetUpTest, KindsHaveNames) {
  EXPECT_EQ(ParseEngineKind("auto"), EngineKind::kAuto);
  EXPECT_EQ(ParseEngineKind("torch"), EngineKind::kTorch);
  EXPECT_EQ(ParseEngineKind("packed"), EngineKind::kPacked);
  EXPECT_EQ(ParseEngineKind("packed-bf16"), EngineKind::kPackedBf16);
  try {
    ParseEngineKind("fast", "--engine");
    FAIL() << "no such engine";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "--engine: \"fast\" is none of auto, torch, packed, packed-bf16");
  }
}

}  // namespace choreo::samplers_test
