#include <gtest/gtest.h>
#include <torch/torch.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "model/engine/device_noise.h"
#include "model/engine/engines.h"
#include "tests/engine/engine_dances.h"

// The torch engine on GPUs, against itself on the CPU. Skipped where none answers.
namespace choreo {
namespace {

constexpr Device kGpu{Device::Kind::kCuda, 0};

class CudaEngineTest : public testing::TestWithParam<std::tuple<Shape, EngineKind>> {
 protected:
  CudaEngineTest() : checkpoint_(std::get<0>(GetParam())) { SetTorchThreads(1); }
  void SetUp() override {
    if (TorchDevices().cuda_devices == 0) GTEST_SKIP() << "no CUDA device answers";
  }
  std::unique_ptr<StepEngine> Engine(int slots, const Device& device = kGpu) {
    return MakeEngine(checkpoint_.path(), device, slots, std::get<1>(GetParam()));
  }
  SmallCheckpoint checkpoint_;
};

INSTANTIATE_TEST_SUITE_P(
    Shapes, CudaEngineTest,
    testing::Combine(testing::Values(Shape::kPlannerAndPerceptron, Shape::kRecurrent),
                     testing::Values(EngineKind::kTorch, EngineKind::kTorchBf16)),
    [](const auto& instance) {
      return ShapeName(std::get<0>(instance.param)) +
             (std::get<1>(instance.param) == EngineKind::kTorchBf16 ? "Bf16" : "");
    });

TEST_P(CudaEngineTest, StepsAsTheCpuDoes) {
  const double most = std::get<1>(GetParam()) == EngineKind::kTorchBf16 ? 0.05 : 1e-4;
  for (const uint64_t seed : {7, 8, 9, 10}) {
    const auto cpu = MakeEngine(checkpoint_.path(), {}, 1, EngineKind::kTorch);
    const auto gpu = Engine(1);
    EXPECT_EQ(gpu->device(), "cuda:0");
    EXPECT_LT(LargestStepDifference(cpu.get(), gpu.get(), seed, 30), most) << "seed " << seed;
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

// On the CPU, which draws it otherwise, and on a GPU.
TEST(DeviceNoiseTest, IsFillNormalsTimesItsSpread) {
  std::vector<torch::Device> devices = {torch::kCPU};
  if (TorchDevices().cuda_devices > 0) devices.emplace_back(torch::kCUDA, 0);
  for (const torch::Device& device : devices) {
    constexpr int kRows = 5, kWidth = 79;
    DeviceNoise noise(device, kRows, kWidth);
    for (int row = 0; row < kRows; ++row) {
      noise.rows()[static_cast<size_t>(row)] = {.seed = uint64_t{1} << (12 * row),
                                                .frame = 1000 * row - 1,
                                                .candidate = static_cast<uint32_t>(row % 2),
                                                .spread = 0.5F * static_cast<float>(row)};
    }
    noise.Draw();
    const torch::Tensor drawn = noise.values().cpu();
    for (int row = 0; row < kRows; ++row) {
      std::vector<float> expected(kWidth);
      noise.rows()[static_cast<size_t>(row)].Fill(expected);
      EXPECT_EQ(std::ranges::count(expected, 0.0F), row == 0 ? kWidth : 0);
      const float* actual = drawn[row].data_ptr<float>();
      for (int i = 0; i < kWidth; ++i)
        EXPECT_NEAR(actual[i], expected[static_cast<size_t>(i)], device.is_cuda() ? 1e-6 : 0);
    }
  }
}

}  // namespace
}  // namespace choreo
