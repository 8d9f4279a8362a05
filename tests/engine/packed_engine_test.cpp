#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include "model/engine/engines.h"
#include "model/engine/packed/kernels.h"
#include "tests/engine/engine_dances.h"

// Counts what this program asks the C library for, thread by thread: operator new and Eigen come
// here.
namespace {
thread_local uint64_t allocations = 0;
}
extern "C" void* __libc_malloc(std::size_t size);
extern "C" [[gnu::noinline]] void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}

// The packed engine against the torch engine.
namespace choreo::packed_engine_test {

double LargestDifference(const std::filesystem::path& checkpoint, uint64_t seed, int frames,
                         EngineKind kind = EngineKind::kPacked) {
  const auto torch = MakeEngine(checkpoint, {}, 1, EngineKind::kTorch);
  const auto packed = MakeEngine(checkpoint, {}, 1, kind);
  return LargestStepDifference(torch.get(), packed.get(), seed, frames);
}

class PackedEngineTest : public testing::TestWithParam<std::tuple<Shape, EngineKind>> {
 protected:
  PackedEngineTest() : checkpoint_(std::get<0>(GetParam())) { SetTorchThreads(1); }
  void SetUp() override {
    if (bf16() && Bf16KernelsHere().empty()) GTEST_SKIP() << "this CPU has no AVX512-BF16";
  }
  EngineKind kind() const { return std::get<1>(GetParam()); }
  bool bf16() const { return kind() == EngineKind::kPackedBf16; }
  SmallCheckpoint checkpoint_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, PackedEngineTest,
                         testing::Combine(testing::Values(Shape::kRaw, Shape::kEncoded),
                                          testing::Values(EngineKind::kPacked,
                                                          EngineKind::kPackedBf16)),
                         [](const auto& instance) {
                           return ShapeName(std::get<0>(instance.param)) +
                                  (std::get<1>(instance.param) == EngineKind::kPackedBf16 ? "Bf16"
                                                                                          : "");
                         });

TEST_P(PackedEngineTest, StepsAsTheTorchEngineDoes) {
  const double most = bf16() ? 0.05 : 1e-4;
  for (const uint64_t seed : {7, 8, 9, 10}) {
    EXPECT_LT(LargestDifference(checkpoint_.path(), seed, 12, kind()), most) << "seed " << seed;
  }
  // The condition is hoisted again and again.
  EXPECT_LT(LargestDifference(checkpoint_.path(), 7, 150, kind()), most);
}

// The probe's frame f is made in a batch of f + 1, each time in another place. The others fall
// behind, so batches hold frames of different numbers, too.
TEST_P(PackedEngineTest, ARowHasTheSameBitsInBatchesOfEverySize) {
  constexpr int kMost = 66;  // more than a tile
  const auto engine = MakeEngine(checkpoint_.path(), {}, kMost, kind());
  const TransitionSpec probe = RandomSpec(engine->model(), 7, kMost);
  const auto alone = DanceAlone(engine.get(), probe);
  std::vector<Dancer> crowd;
  for (uint64_t i = 0; i < kMost; ++i) {
    const TransitionSpec spec = i == 0 ? probe : RandomSpec(engine->model(), 100 + i, kMost);
    crowd.push_back({spec, engine->Admit(spec), {}, {}});
  }
  for (int size = 1; size <= kMost; ++size) {
    std::vector<Dancer*> batch;
    for (int i = 1; i < size; ++i) batch.push_back(&crowd[static_cast<size_t>(i)]);
    batch.insert(batch.begin() + (5 * size + 3) % size, &crowd[0]);
    std::vector<std::vector<float>> rows;
    std::vector<StepInput> in;
    std::vector<StepOutput> out(batch.size());
    for (Dancer* dancer : batch) {
      const auto frame = static_cast<int>(dancer->outputs.size());
      rows.push_back(dancer->spec.has_audio
                         ? RandomAudioRow(engine->model(), dancer->spec.seed, frame)
                         : std::vector<float>());
      in.push_back({dancer->slot, frame > 0 ? &dancer->emitted.back() : nullptr, rows.back()});
    }
    engine->Step(in, out);
    for (size_t i = 0; i < batch.size(); ++i) {
      batch[i]->emitted.push_back(Emit(out[i].pose, static_cast<int>(batch[i]->outputs.size())));
      batch[i]->outputs.push_back(out[i]);
    }
  }
  ExpectSameBits(crowd[0].outputs, alone);
}

TEST_P(PackedEngineTest, AFrameAllocatesNothing) {
  constexpr int kStreams = 9, kFrames = 100;
  const auto engine = MakeEngine(checkpoint_.path(), {}, kStreams, kind());
  std::vector<StepInput> in(kStreams);
  std::vector<StepOutput> out(kStreams);
  std::vector<Pose> previous(kStreams);
  const std::vector<float> row = RandomAudioRow(engine->model(), 7, 0);
  const uint64_t before = allocations;
  for (size_t i = 0; i < in.size(); ++i) {
    const TransitionSpec spec = RandomSpec(engine->model(), i, kFrames);
    in[i] = {engine->Admit(spec), nullptr, {}};
    if (spec.has_audio) in[i].audio_row = row;
  }
  EXPECT_GT(allocations, before) << "the counter counts";
  const auto step = [&] {
    engine->Step(in, out);
    for (size_t i = 0; i < in.size(); ++i) {
      previous[i] = out[i].pose;
      in[i].previous = &previous[i];
    }
  };
  step();  // `out` and `previous` get their sizes
  step();
  const uint64_t settled = allocations;
  for (int frame = 2; frame < kFrames; ++frame) step();
  EXPECT_EQ(allocations, settled);
}

}  // namespace choreo::packed_engine_test
