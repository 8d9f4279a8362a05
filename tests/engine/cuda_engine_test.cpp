#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "model/engine/engines.h"
#include "tests/engine/engine_dances.h"

// The torch engine on GPUs, against itself on the CPU. Skipped where none answers.
namespace choreo::cuda_engine_test {

constexpr Device kGpu{Device::Kind::kCuda, 0};

class CudaEngineTest : public testing::TestWithParam<Shape> {
 protected:
  CudaEngineTest() : checkpoint_(GetParam()) { SetTorchThreads(1); }
  void SetUp() override {
    if (TorchDevices().cuda_devices == 0) GTEST_SKIP() << "no CUDA device answers";
  }
  std::unique_ptr<StepEngine> Engine(int slots, const Device& device = kGpu) {
    return MakeEngine(checkpoint_.path(), device, slots, EngineKind::kTorch);
  }
  SmallCheckpoint checkpoint_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, CudaEngineTest, testing::Values(Shape::kEncoded, Shape::kRaw),
                         [](const auto& instance) { return ShapeName(instance.param); });

TEST_P(CudaEngineTest, StepsAsTheCpuDoes) {
  for (const uint64_t seed : {7, 8, 9, 10}) {
    const auto cpu = MakeEngine(checkpoint_.path(), {}, 1, EngineKind::kTorch);
    const auto gpu = Engine(1);
    EXPECT_EQ(gpu->device(), "cuda:0");
    EXPECT_EQ(gpu->model().fingerprint.find('\n'), std::string::npos) << "a log has it in a line";
    EXPECT_LT(LargestStepDifference(cpu.get(), gpu.get(), seed, 30), 1e-4) << "seed " << seed;
  }
}

TEST_P(CudaEngineTest, GivesTheSameBitsAloneAndInACrowdThatShrinks) {
  const auto engine = Engine(200);
  const auto alone = DanceAlone(engine.get(), RandomSpec(engine->model(), 7));
  std::vector<Dancer> crowd;
  for (uint64_t i = 0; i < 200; ++i) {
    const TransitionSpec spec =
        RandomSpec(engine->model(), i, i == 7 ? 12 : 5 + static_cast<int>(i % 20));
    crowd.push_back({spec, engine->Admit(spec), {}, {}});
  }
  DanceTogether(engine.get(), &crowd);
  ExpectSameBits(crowd[7].outputs, alone);
}

TEST_P(CudaEngineTest, EveryDeviceGivesTheSameBits) {
  const auto first = Engine(1);
  const auto expected = DanceAlone(first.get(), RandomSpec(first->model(), 7));
  for (int i = 0; i < TorchDevices().cuda_devices; ++i) {
    const auto engine = Engine(3, {Device::Kind::kCuda, i});
    ExpectSameBits(DanceAlone(engine.get(), RandomSpec(engine->model(), 7)), expected);
  }
}

}  // namespace choreo::cuda_engine_test
