#include <gtest/gtest.h>

#include <vector>

#include "model/samplers/samplers.h"
#include "tests/samplers/sampled.h"

// LibTorch on GPUs, against itself on the CPU. Skipped where none answers.
namespace choreo::cuda_sampler_test {

constexpr Device kGpu{Device::Kind::kCuda, 0};

class CudaSamplerTest : public testing::TestWithParam<Shape> {
 protected:
  CudaSamplerTest() : checkpoint_(GetParam()) { SetTorchThreads(1); }
  void SetUp() override {
    if (TorchDevices().cuda_devices == 0) GTEST_SKIP() << "no CUDA device answers";
  }
  std::unique_ptr<Sampler> Make(const Device& device = kGpu) {
    return MakeSampler(checkpoint_.path(), device, EngineKind::kTorch);
  }
  SmallCheckpoint checkpoint_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, CudaSamplerTest, testing::Values(Shape::kEncoded, Shape::kRaw),
                         [](const auto& instance) { return ShapeName(instance.param); });

TEST_P(CudaSamplerTest, SamplesAsTheCpuDoes) {
  for (const uint64_t seed : {7, 8, 9, 10}) {
    const auto cpu = Make(Device{});
    const auto gpu = Make();
    EXPECT_EQ(gpu->device(), "cuda:0");
    EXPECT_EQ(gpu->model().fingerprint.find('\n'), std::string::npos) << "a log has it in a line";
    const TransitionSpec spec = RandomSpec(cpu->model(), seed, 30);
    EXPECT_LT(LargestDifference(SampleNow(*cpu, spec), SampleNow(*gpu, spec)), 2e-4)
        << "seed " << seed;
  }
}

TEST_P(CudaSamplerTest, GivesTheSameBitsAloneAndInterleaved) {
  const auto sampler = Make();
  std::vector<TransitionSpec> specs;
  for (int i = 0; i < 20; ++i)
    specs.push_back(RandomSpec(sampler->model(), static_cast<uint64_t>(i), 5 + i));
  const std::vector<Plan> plans = SampleInTurn(sampler.get(), specs);
  for (size_t i = 0; i < specs.size(); ++i) ExpectSameBits(plans[i], SampleNow(*sampler, specs[i]));
}

TEST_P(CudaSamplerTest, EveryDeviceGivesTheSameBits) {
  const auto first = Make();
  const TransitionSpec spec = RandomSpec(first->model(), 7);
  const Plan expected = SampleNow(*first, spec);
  for (int i = 0; i < TorchDevices().cuda_devices; ++i)
    ExpectSameBits(SampleNow(*Make({Device::Kind::kCuda, i}), spec), expected);
}

}  // namespace choreo::cuda_sampler_test
