#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "model/core/numbers/random.h"
#include "model/engine/packed/kernels.h"
#include "model/engine/packed/matrix.h"

// The packed engine's kernels against the same in double.
namespace choreo::packed_kernels_test {

std::vector<const PackedKernels*> AllKernels() {
  std::vector<const PackedKernels*> all(PackedKernelsHere().begin(), PackedKernelsHere().end());
  std::ranges::copy(Bf16KernelsHere(), std::back_inserter(all));
  return all;
}

float ToBf16(float x) {
  const auto bits = std::bit_cast<uint32_t>(x);
  return std::bit_cast<float>((bits + 0x7FFF + (bits >> 16 & 1)) & 0xFFFF0000);
}

class PackedKernelsTest : public testing::TestWithParam<const PackedKernels*> {};

INSTANTIATE_TEST_SUITE_P(Cpus, PackedKernelsTest, testing::ValuesIn(AllKernels()),
                         [](const auto& instance) { return instance.param->name; });

TEST_P(PackedKernelsTest, RowsAreIndependent) { EXPECT_TRUE(RowsAreIndependent(*GetParam())); }

TEST_P(PackedKernelsTest, MultipliesAnyShape) {
  Random random(5);
  for (const long rows : {1, 2, 3, 4, 5, 7, 12, 13, 30, 35, 53}) {
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
        if (GetParam()->pair != nullptr) {
          x = x.unaryExpr(&ToBf16).eval();
          weight = weight.unaryExpr(&ToBf16).eval();
        }
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

TEST_P(PackedKernelsTest, CurvesMatchTheLibrary) {
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

TEST_P(PackedKernelsTest, GeluMatchesTheLibrary) {
  std::vector<float> x;
  for (double at = -30; at <= 30; at += 0.0137) x.push_back(static_cast<float>(at));
  std::vector<float> gelu = x;
  const auto count = static_cast<long>(x.size());
  GetParam()->gelu(gelu.data(), count);
  for (size_t i = 0; i < x.size(); ++i) {
    const double at = x[i], size = std::max(1.0, std::abs(at));
    ASSERT_NEAR(gelu[i], 0.5 * at * (1 + std::erf(at / std::sqrt(2.0))), 4e-7 * size) << at;
  }
}

TEST_P(PackedKernelsTest, NormalisesRowsOfAnyLength) {
  for (const size_t width : {1, 5, 16, 33, 70, 160}) {
    std::vector<float> x(width), gain(width), bias(width), out(width);
    uint64_t seed = width;
    for (auto* values : {&x, &gain, &bias}) Random(seed++).FillNormal(*values);
    const auto count = static_cast<long>(width);
    GetParam()->layer_norm(x.data(), gain.data(), bias.data(), count, out.data());
    const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(width);
    double variance = 0, sum = 0;
    for (const float value : x) {
      variance += (value - mean) * (value - mean) / static_cast<double>(width);
      sum += std::exp(5.0 * value);
    }
    std::vector<float> logits = x;
    for (float& value : logits) value *= 5;
    GetParam()->softmax(logits.data(), count);
    for (size_t i = 0; i < width; ++i) {
      ASSERT_NEAR(out[i], (x[i] - mean) / std::sqrt(variance + 1e-5) * gain[i] + bias[i], 2e-5);
      ASSERT_NEAR(logits[i], std::exp(5.0 * x[i]) / sum, 1e-6);
    }
  }
}

}  // namespace choreo::packed_kernels_test
