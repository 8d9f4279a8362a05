#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "model/core/random.h"
#include "model/engine/engines.h"
#include "model/engine/packed_kernels.h"
#include "model/engine/packed_matrix.h"
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

// The packed engine against the torch engine, and its kernels against sums in double.
namespace choreo {
namespace {

// Both engines make each frame from the same poses before it; the largest difference of any output,
// metres, radians, nats relative to their size.
double LargestDifference(const std::filesystem::path& checkpoint, uint64_t seed, int frames) {
  const auto torch = MakeEngine(checkpoint, {}, 1, EngineKind::kTorch);
  const auto packed = MakeEngine(checkpoint, {}, 1, EngineKind::kPacked);
  const TransitionSpec spec =
      RandomSpec(torch->model(), seed, std::min(frames, torch->model().max_transition_frames));
  EXPECT_EQ(torch->Admit(spec), packed->Admit(spec));
  std::vector<StepInput> in(1);
  std::vector<StepOutput> expected(1), actual(1);
  Pose previous;
  double largest = 0;
  for (int frame = 0; frame < spec.frames; ++frame) {
    const std::vector<float> row = RandomAudioRow(torch->model(), seed, frame);
    in[0] = {0, frame > 0 ? &previous : nullptr, {}};
    if (spec.has_audio) in[0].audio_row = row;
    torch->Step(in, expected);
    packed->Step(in, actual);
    const Pose &a = expected[0].pose, &b = actual[0].pose;
    largest = std::max(largest, (a.root_position - b.root_position).cwiseAbs().maxCoeff());
    largest = std::max(largest, (a.rotations - b.rotations).cwiseAbs().maxCoeff());
    for (size_t foot = 0; foot < 4; ++foot) {
      largest = std::max<double>(largest,
                                 std::abs(expected[0].contacts[foot] - actual[0].contacts[foot]));
    }
    largest =
        std::max<double>(largest, std::abs(expected[0].log_likelihood - actual[0].log_likelihood) /
                                      std::max(1.0F, std::abs(expected[0].log_likelihood)));
    EXPECT_TRUE(std::isfinite(actual[0].log_likelihood));
    previous = Emit(a, frame);
  }
  return largest;
}

class PackedEngineTest : public testing::TestWithParam<Shape> {
 protected:
  PackedEngineTest() : checkpoint_(GetParam()) { SetTorchThreads(1); }
  SmallCheckpoint checkpoint_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, PackedEngineTest,
                         testing::Values(Shape::kPlannerAndPerceptron,
                                         Shape::kPerceptronOnCondition, Shape::kRecurrent,
                                         Shape::kEncodedRecurrent),
                         [](const auto& instance) { return ShapeName(instance.param); });

TEST_P(PackedEngineTest, StepsAsTheTorchEngineDoes) {
  for (const uint64_t seed : {7, 8, 9, 10}) {
    EXPECT_LT(LargestDifference(checkpoint_.path(), seed, 12), 1e-4) << "seed " << seed;
  }
  // The condition is hoisted again and again.
  EXPECT_LT(LargestDifference(checkpoint_.path(), 7, 150), 1e-4);
}

TEST(PackedEngine, DancesTheShippedModelAsTheTorchEngineDoes) {
  const auto path =
      std::filesystem::path(CHOREO_SOURCE_DIR) / "model/checkpoints/default.safetensors";
  EXPECT_LT(LargestDifference(path, 7, 90), 1e-4);
  EXPECT_LT(LargestDifference(path, 8, 40), 1e-4);
}

// The probe's frame f is made in a batch of f + 1, each time in another place. The others fall
// behind, so batches hold frames of different numbers, too.
TEST_P(PackedEngineTest, ARowHasTheSameBitsInBatchesOfEverySize) {
  constexpr int kMost = 66;  // more than a tile
  const auto engine = MakeEngine(checkpoint_.path(), {}, kMost, EngineKind::kPacked);
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
  const auto engine = MakeEngine(checkpoint_.path(), {}, kStreams, EngineKind::kPacked);
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

class PackedKernelsTest : public testing::TestWithParam<const PackedKernels*> {};

INSTANTIATE_TEST_SUITE_P(Cpus, PackedKernelsTest,
                         testing::ValuesIn(PackedKernelsHere().begin(), PackedKernelsHere().end()),
                         [](const auto& instance) { return instance.param->name; });

TEST_P(PackedKernelsTest, RowsAreIndependent) { EXPECT_TRUE(RowsAreIndependent(*GetParam())); }

TEST_P(PackedKernelsTest, MultipliesWhateverTheShape) {
  Random random(5);
  for (const long rows : {1, 2, 3, 4, 5, 7, 12, 13, 30}) {
    for (const long depth : {1, 41, 130}) {
      for (const long columns : {1, 41, 82, 224}) {
        RowMajorMatrix x(rows, depth), weight(depth, columns);
        Eigen::VectorXf bias(columns);
        for (float& value : x.reshaped()) value = static_cast<float>(random.Normal());
        for (float& value : weight.reshaped()) value = static_cast<float>(random.Normal());
        for (float& value : bias) value = static_cast<float>(random.Normal());
        const PackedLinear linear(*GetParam(), weight, bias);
        ASSERT_EQ(linear.columns(), columns);
        ASSERT_EQ(linear.padded() % GetParam()->panel, 0);
        RowMajorMatrix y = RowMajorMatrix::Constant(rows, linear.padded() + 3, 7);
        linear.Run(x.data(), depth, y.data(), y.cols(), rows);
        const Eigen::MatrixXd expected =
            (x.cast<double>() * weight.cast<double>()).rowwise() + bias.cast<double>().transpose();
        ASSERT_LT((y.leftCols(columns).cast<double>() - expected).cwiseAbs().maxCoeff(), 5e-5);
        ASSERT_TRUE((y.rightCols(3).array() == 7).all()) << "wrote beyond its panels";
        linear.Add(x.data(), depth, y.data(), y.cols(), rows);
        const Eigen::MatrixXd twice = (2 * expected).rowwise() - bias.cast<double>().transpose();
        ASSERT_LT((y.leftCols(columns).cast<double>() - twice).cwiseAbs().maxCoeff(), 1e-4);
      }
    }
  }
}

TEST_P(PackedKernelsTest, CurvesAreThoseOfTheLibrary) {
  std::vector<float> x, expected;
  for (double at = -120; at <= 120; at += 0.0137) {
    x.push_back(static_cast<float>(at));
    expected.push_back(static_cast<float>(x.back() / (1 + std::exp(-double{x.back()}))));
  }
  GetParam()->silu(x.data(), static_cast<long>(x.size()));
  for (size_t i = 0; i < x.size(); ++i) {
    ASSERT_NEAR(x[i], expected[i], 4e-7 * std::max(1.0F, std::abs(expected[i]))) << i;
  }
  // An LSTM cell, an input apart from the others in each gate.
  const auto sigmoid = [](double at) { return 1 / (1 + std::exp(-at)); };
  constexpr size_t kWidth = 37;
  std::vector<float> gates(4 * kWidth), hidden(kWidth), cell(kWidth);
  Random(2).FillNormal(gates);
  Random(3).FillNormal(cell);
  const std::vector<float> before = cell;
  GetParam()->lstm(gates.data(), hidden.data(), cell.data(), kWidth);
  for (size_t i = 0; i < kWidth; ++i) {
    const double next = sigmoid(gates[kWidth + i]) * before[i] +
                        sigmoid(gates[i]) * std::tanh(gates[2 * kWidth + i]);
    ASSERT_NEAR(cell[i], next, 1e-6);
    ASSERT_NEAR(hidden[i], sigmoid(gates[3 * kWidth + i]) * std::tanh(next), 1e-6);
  }
}

}  // namespace
}  // namespace choreo
