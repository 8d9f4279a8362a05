#include "model/engine/engines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "model/core/error.h"
#include "model/core/math_library.h"
#include "model/core/safetensors.h"
#include "model/core/threads.h"
#include "model/motion/kinematics.h"
#include "tests/engine/engine_dances.h"

// What every engine of the flow model promises, whatever steps it.
namespace choreo::engines_test {

using testing::ContainsRegex;
using testing::HasSubstr;

class EnginesTest : public testing::TestWithParam<std::tuple<EngineKind, Shape>> {
 protected:
  EnginesTest() : checkpoint_(std::get<1>(GetParam())) { SetTorchThreads(1); }
  std::unique_ptr<StepEngine> Engine(int slots = 16) {
    return MakeEngine(checkpoint_.path(), {}, slots, std::get<0>(GetParam()));
  }
  SmallCheckpoint checkpoint_;
};

INSTANTIATE_TEST_SUITE_P(Engines, EnginesTest,
                         testing::Combine(testing::Values(EngineKind::kTorch, EngineKind::kPacked),
                                          testing::Values(Shape::kRaw, Shape::kEncoded)),
                         [](const auto& instance) {
                           return std::string(std::get<0>(instance.param) == EngineKind::kTorch
                                                  ? "Torch"
                                                  : "Packed") +
                                  ShapeName(std::get<1>(instance.param));
                         });

TEST_P(EnginesTest, TellsWhatItIs) {
  const auto engine = Engine(3);
  const ModelInfo& info = engine->model();
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
  EXPECT_EQ(engine->device(), "cpu");
  EXPECT_EQ(engine->slots(), 3);
  EXPECT_EQ(engine->free_slots(), 3);
}

TEST_P(EnginesTest, GivesTheSameBitsAloneAndAmongFifteenOthers) {
  const auto engine = Engine();
  const auto spec = [&](uint64_t seed, int frames) {
    return RandomSpec(engine->model(), seed, frames);
  };
  const auto alone = DanceAlone(engine.get(), spec(7, 12));
  for (int place : {0, 6, 15}) {
    std::vector<Dancer> crowd;
    for (int i = 0; i < 16; ++i) {
      // They end one by one, so the batch takes every size.
      const TransitionSpec one =
          i == place ? spec(7, 12) : spec(100 + static_cast<uint64_t>(i), 5 + i);
      crowd.push_back({one, engine->Admit(one), {}, {}});
    }
    EXPECT_EQ(engine->free_slots(), 0);
    DanceTogether(engine.get(), &crowd);
    ExpectSameBits(crowd[static_cast<size_t>(place)].outputs, alone);
    EXPECT_NE(crowd[static_cast<size_t>(place + 1) % 16].outputs[0].pose.root_position,
              alone[0].pose.root_position);
    for (const Dancer& dancer : crowd) engine->Release(dancer.slot);
  }
}

TEST_P(EnginesTest, GivesTheSameBitsInAnySlotOrderAndInstance) {
  const auto engine = Engine(70);
  const auto first = DanceAlone(engine.get(), RandomSpec(engine->model(), 7));
  std::vector<Dancer> crowd;
  for (uint64_t i = 0; i < 70; ++i) {
    const TransitionSpec spec = RandomSpec(engine->model(), i);
    crowd.push_back({spec, engine->Admit(spec), {}, {}});
  }
  std::ranges::reverse(crowd);  // and more than a tile of either engine
  DanceTogether(engine.get(), &crowd);
  ExpectSameBits(crowd[62].outputs, first);
  const auto other = Engine(1);
  ExpectSameBits(DanceAlone(other.get(), RandomSpec(other->model(), 7)), first);
}

TEST_P(EnginesTest, AReleasedSlotForgets) {
  const auto engine = Engine(1);
  const auto spec = [&](uint64_t seed, int frames) {
    return RandomSpec(engine->model(), seed, frames);
  };
  const auto first = DanceAlone(engine.get(), spec(7, 12));
  DanceAlone(engine.get(), spec(8, 80));
  ExpectSameBits(DanceAlone(engine.get(), spec(7, 12)), first);
}

TEST_P(EnginesTest, EveryInputMatters) {
  const auto engine = Engine(1);
  const TransitionSpec spec = RandomSpec(engine->model(), 7);
  const auto base = DanceAlone(engine.get(), spec);
  const auto differs = [&](auto change) {
    TransitionSpec changed = spec;
    change(changed);
    return DanceAlone(engine.get(), changed)[0].pose.rotations != base[0].pose.rotations;
  };
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.history[0].root_position.x() += 0.1; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.target->pose.rotations(0, 9) += 0.2; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.target->mask.root_position = false; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.target.reset(); }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.audio_history(3, 9) += 1; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.has_audio = false; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.candidate += 1; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.first_frame += 1; }));
  EXPECT_TRUE(differs([](TransitionSpec& it) { it.temperature = 0; }));
  EXPECT_FALSE(differs([](TransitionSpec&) {}));
}

TEST_P(EnginesTest, RefusesWhatDoesNotFitAndStaysUsable) {
  const auto engine = Engine(1);
  const auto refused = [&](auto change) -> std::string {
    TransitionSpec spec = RandomSpec(engine->model(), 7);
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
              HasSubstr("frames: 0 is not in [1, 200]"));
  EXPECT_THAT(refused([](auto& spec) { spec.frames = 201; }), HasSubstr("frames: 201"));
  EXPECT_THAT(refused([](auto& spec) { spec.history.pop_back(); }), HasSubstr("history: 9 poses"));
  EXPECT_THAT(refused([](auto& spec) { spec.history[4].rotations.resize(3, 22); }),
              HasSubstr("history[4].rotations: 22 joints"));
  EXPECT_THAT(refused([](auto& spec) { spec.target->mask.joints.resize(3); }),
              HasSubstr("target.mask: 3 joints"));
  EXPECT_THAT(refused([](auto& spec) { spec.audio_history.resize(40, 3); }),
              HasSubstr("audio_history: 40 x 3, must be 40 x 10"));

  const int slot = engine->Admit(RandomSpec(engine->model(), 8));
  try {
    engine->Admit(RandomSpec(engine->model(), 8));
    FAIL() << "there was no free slot";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kResourceExhausted);
  }
  std::vector<StepOutput> out(1);
  const Pose pose = RestPose(engine->model().skeleton);
  const std::vector<StepInput> wrong_slot = {{1, nullptr, {}}}, early = {{slot, &pose, {}}},
                               right = {{slot, nullptr, {}}};
  EXPECT_THROW(engine->Step(wrong_slot, out), Error);
  EXPECT_THROW(engine->Step(early, out), Error);
  engine->Step(right, out);
  EXPECT_THROW(engine->Step(right, out), Error);  // where is the pose before?
}

TEST_P(EnginesTest, EnginesOfOneDeviceShareTheirWeights) {
  const std::vector<Device> twice(2);
  const EngineKind kind = std::get<0>(GetParam());
  const auto engines = MakeEngines(checkpoint_.path(), twice, 2, kind);
  ASSERT_EQ(engines.size(), 2U);
  EXPECT_EQ(engines[0]->model().fingerprint, engines[1]->model().fingerprint);
  const TransitionSpec spec = RandomSpec(engines[0]->model(), 7);
  ExpectSameBits(DanceAlone(engines[0].get(), spec), DanceAlone(engines[1].get(), spec));
  EXPECT_THROW(MakeEngines(checkpoint_.path(), twice, 0, kind), Error);
}

// On the devices that are there engines are made, and on no others.
TEST_P(EnginesTest, ThisBuildHasItsDevices) {
  const AvailableDevices available = TorchDevices();
  const EngineKind kind = std::get<0>(GetParam());
  std::vector<Device> devices = {Device{}};
  if (kind == EngineKind::kTorch) {
    for (int i = 0; i < available.cuda_devices; ++i) devices.push_back({Device::Kind::kCuda, i});
  }
  for (const Device& device : devices) {
    const auto engine = MakeEngine(checkpoint_.path(), device, 1, kind);
    EXPECT_EQ(engine->device(), device.name());
    EXPECT_FALSE(DanceAlone(engine.get(), RandomSpec(engine->model(), 7)).empty());
  }
  const Device beyond{Device::Kind::kCuda, available.cuda_devices};
  EXPECT_THROW(MakeEngine(checkpoint_.path(), beyond, 1, kind), std::exception);
}

TEST(EngineSetUpTest, TheMathLibraryIsNamed) {
  EXPECT_THAT(MathLibrary(), ContainsRegex("^glibc [0-9]+\\.[0-9]+( fma| fma4| avx)?$"));
}

TEST(EngineSetUpTest, TheBuildIsNamed) {
  EXPECT_THAT(BuildIdentity(), ContainsRegex("^[A-Za-z]+ [0-9.]+ [A-Za-z]* [0-9a-f]{16}$"));
}

TEST(EngineSetUpTest, AFastBlasStandsBehindTorch) {
  if (TorchDevices().cuda_build) GTEST_SKIP() << "LibTorch with CUDA has its BLAS linked in";
  const BlasInfo blas = DetectBlas();
  EXPECT_EQ(blas.kind, BlasInfo::Kind::kFast) << blas.name << " at " << blas.path;
  EXPECT_NE(blas.name, "");
}

TEST(EngineSetUpTest, KindsHaveNames) {
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

}  // namespace choreo::engines_test
