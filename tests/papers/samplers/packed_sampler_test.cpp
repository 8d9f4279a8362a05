#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "model/engine/packed/kernels.h"
#include "model/samplers/samplers.h"
#include "tests/samplers/sampled.h"

// Our own kernels against LibTorch.
namespace choreo::packed_sampler_test {

class PackedSamplerTest : public testing::TestWithParam<std::tuple<Shape, EngineKind>> {
 protected:
  PackedSamplerTest() : checkpoint_(std::get<0>(GetParam())) { SetTorchThreads(1); }
  void SetUp() override {
    if (bf16() && Bf16KernelsHere().empty()) GTEST_SKIP() << "this CPU has no AVX512-BF16";
  }
  EngineKind kind() const { return std::get<1>(GetParam()); }
  bool bf16() const { return kind() == EngineKind::kPackedBf16; }
  SmallCheckpoint checkpoint_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, PackedSamplerTest,
                         testing::Combine(testing::Values(Shape::kRaw, Shape::kEncoded),
                                          testing::Values(EngineKind::kPacked,
                                                          EngineKind::kPackedBf16)),
                         [](const auto& instance) {
                           return ShapeName(std::get<0>(instance.param)) +
                                  (std::get<1>(instance.param) == EngineKind::kPackedBf16 ? "Bf16"
                                                                                          : "");
                         });

TEST_P(PackedSamplerTest, SamplesAsTorchDoes) {
  const auto torch = MakeSampler(checkpoint_.path(), {}, EngineKind::kTorch);
  const auto packed = MakeSampler(checkpoint_.path(), {}, kind());
  const auto difference = [&](uint64_t seed, int frames) {
    const TransitionSpec spec = RandomSpec(torch->model(), seed, frames);
    return LargestDifference(SampleNow(*torch, spec), SampleNow(*packed, spec));
  };
  const double most = bf16() ? 0.1 : 2e-4;
  for (const uint64_t seed : {7, 8, 9, 10})
    EXPECT_LT(difference(seed, 12), most) << "seed " << seed;
  // The condition is hoisted again and again.
  EXPECT_LT(difference(7, 150), most);
}

}  // namespace choreo::packed_sampler_test
