#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/core/error.h"
#include "model/engine/loading.h"
#include "model/engine/packed/kernels.h"
#include "model/samplers/samplers.h"
#include "tests/samplers/sampled.h"

/// The choice of the packed engine's instructions.
namespace choreo::kernels_test {

using testing::HasSubstr;

std::string Fingerprint(const SmallCheckpoint& checkpoint, const std::string& kernels,
                        EngineKind kind = EngineKind::kAuto) {
  const Device cpu;
  return MakeSamplers(checkpoint.path(), {&cpu, 1}, kind, kernels).front()->model().fingerprint;
}

TEST(KernelsTest, AreChosenByName) {
  const SmallCheckpoint checkpoint(Shape::kEncoded);
  for (const PackedKernels* kernels : PackedKernelsHere()) {
    EXPECT_THAT(Fingerprint(checkpoint, kernels->name),
                HasSubstr("/packed " + std::string(kernels->name)));
  }
  for (const PackedKernels* bf16 : Bf16KernelsHere()) {
    EXPECT_THAT(Fingerprint(checkpoint, bf16->name),
                HasSubstr("/packed " + std::string(bf16->name)));
  }
  if (!Bf16KernelsHere().empty()) {
    EXPECT_EQ(Fingerprint(checkpoint, Bf16KernelsHere().front()->name),
              Fingerprint(checkpoint, "", EngineKind::kPackedBf16));
  }
}

TEST(KernelsTest, ThoseThatMixRowsAreNotedAndReplaced) {
  const PackedKernels& right = *PackedKernelsHere().back();
  PackedKernels mixes = right;
  mixes.name = "mixes";
  mixes.multiply = [](const PackedProduct& product) {
    PackedKernelsHere().back()->multiply(product);
    product.c[0] += static_cast<float>(product.rows);
  };
  std::vector<std::string> notes;
  EXPECT_EQ(FirstIndependent({{&mixes, &mixes}, {&right, &right}}, &notes).products, &right);
  EXPECT_THAT(notes,
              testing::ElementsAre(HasSubstr("with mixes a row's bits depend on its batch")));
}

TEST(KernelsTest, UnavailableOnesAreNamed) {
  const SmallCheckpoint checkpoint(Shape::kEncoded);
  const auto refusal = [&](const std::string& kernels, EngineKind kind) -> std::string {
    try {
      return Fingerprint(checkpoint, kernels, kind);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
      return error.what();
    }
  };
  EXPECT_THAT(refusal("sse9", EngineKind::kAuto), HasSubstr("kernels: \"sse9\" is none of "));
  EXPECT_THAT(refusal("sse9", EngineKind::kAuto), HasSubstr("portable"));
  EXPECT_THAT(refusal("avx512_bf16", EngineKind::kPacked),
              HasSubstr("kernels: \"avx512_bf16\" is none of "));
}

}  // namespace choreo::kernels_test
