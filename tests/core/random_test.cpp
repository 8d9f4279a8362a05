#include "model/core/numbers/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "model/core/error.h"

namespace choreo::random_test {

using ::testing::ElementsAre;

// The known-answer vectors published with Random123 (kat_vectors, philox4x32 10).
TEST(PhiloxTest, GivesThePublishedAnswers) {
  EXPECT_THAT(Philox4x32({0, 0, 0, 0}, {0, 0}),
              ElementsAre(0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8));
  EXPECT_THAT(
      Philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
      ElementsAre(0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd));
  EXPECT_THAT(
      Philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
      ElementsAre(0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1));
}

std::vector<float> Noise(uint64_t seed, uint32_t candidate, int64_t frame, size_t size) {
  std::vector<float> out(size);
  FillNormal(seed, candidate, frame, out);
  return out;
}

struct Moments {
  double mean = 0, variance = 0, skewness = 0, kurtosis = 0;
};
Moments MomentsOf(const std::vector<float>& values) {
  Moments m;
  for (float v : values) m.mean += v;
  m.mean /= static_cast<double>(values.size());
  for (float v : values) {
    const double d = v - m.mean;
    m.variance += d * d;
    m.skewness += d * d * d;
    m.kurtosis += d * d * d * d;
  }
  m.variance /= static_cast<double>(values.size());
  m.skewness /= static_cast<double>(values.size()) * std::pow(m.variance, 1.5);
  m.kurtosis /= static_cast<double>(values.size()) * m.variance * m.variance;
  return m;
}

void ExpectStandardNormal(const std::vector<float>& values) {
  // Five standard errors of each moment of a true normal sample.
  const double n = static_cast<double>(values.size());
  const Moments m = MomentsOf(values);
  EXPECT_NEAR(m.mean, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(m.variance, 1, 5 * std::sqrt(2 / n));
  EXPECT_NEAR(m.skewness, 0, 5 * std::sqrt(6 / n));
  EXPECT_NEAR(m.kurtosis, 3, 5 * std::sqrt(24 / n));
}

TEST(FillNormalTest, IsStandardNormalOverFramesAndDimensions) {
  std::vector<float> all;
  for (int64_t frame = 0; frame < 2000; ++frame) {
    const std::vector<float> row = Noise(7, 0, frame, 82);
    all.insert(all.end(), row.begin(), row.end());
  }
  ExpectStandardNormal(all);
}

TEST(FillNormalTest, NeighboursInEveryCoordinateAreUncorrelated) {
  const size_t size = 20000;
  const std::vector<float> base = Noise(7, 3, 100, size);
  const std::vector<std::vector<float>> others = {
      Noise(8, 3, 100, size),  Noise(7 + (uint64_t{1} << 32), 3, 100, size),
      Noise(7, 4, 100, size),  Noise(7, 3, 101, size),
      Noise(7, 3, -100, size), Noise(7, 3, 100 + (int64_t{1} << 32), size)};
  for (size_t i = 0; i < others.size(); ++i) {
    double correlation = 0;
    for (size_t d = 0; d < size; ++d) correlation += base[d] * others[i][d];
    EXPECT_NEAR(correlation / size, 0, 5 / std::sqrt(static_cast<double>(size))) << "case " << i;
  }
}

TEST(FillNormalTest, DependsOnItsCoordinatesAlone) {
  std::map<int64_t, std::vector<float>> forward;
  for (int64_t frame = 0; frame < 50; ++frame) forward[frame] = Noise(1, 2, frame, 82);
  for (int64_t frame = 49; frame >= 0; --frame) {
    EXPECT_EQ(Noise(1, 2, frame, 82), forward[frame]);
    for (size_t width : {1, 5, 81}) {
      const std::vector<float> part = Noise(1, 2, frame, width);
      EXPECT_TRUE(std::equal(part.begin(), part.end(), forward[frame].begin())) << width;
    }
  }
}

TEST(FillNormalTest, RepeatsCorrelateByTheirVariation) {
  const auto like = [](double variation) {
    std::vector<float> out(50'000);
    FillNormalLike(7, 3, 900, 100, variation, out);
    return out;
  };
  std::vector<float> first(50'000), own(50'000);
  FillNormal(7, 3, 100, first);
  FillNormal(7, 3, 900, own);
  EXPECT_EQ(like(0), first);
  EXPECT_EQ(like(1), own);
  const std::vector<float> between = like(0.6);
  double with_first = 0, squares = 0;
  for (size_t i = 0; i < between.size(); ++i) {
    with_first += static_cast<double>(between[i]) * first[i];
    squares += static_cast<double>(between[i]) * between[i];
  }
  EXPECT_NEAR(squares / 50'000, 1, 0.03);
  EXPECT_NEAR(with_first / 50'000, 0.8, 0.03);
  std::vector<float> itself(50'000);
  FillNormalLike(7, 3, 100, 100, 0.6, itself);
  EXPECT_EQ(itself, first);
}

// Bits must not change between runs; these also pin them between builds: the same seed must keep
// giving the same dance.
TEST(FillNormalTest, KeepsItsBits) {
  EXPECT_THAT(Noise(42, 3, 1000, 6), ElementsAre(-0x1.52d69ap-2F, -0x1.b90c62p-1F, 0x1.d54a2cp-2F,
                                                 0x1.77fa92p-1F, 0x1.ea526ap-6F, 0x1.5636b4p-4F));
}

TEST(RandomTest, IsStandardNormal) {
  std::vector<float> values(100000);
  Random random(11);
  random.FillNormal(values);
  ExpectStandardNormal(values);
}

TEST(RandomTest, UniformFillsItsInterval) {
  Random random(12);
  std::vector<int> histogram(20);
  const int draws = 100000;
  for (int i = 0; i < draws; ++i) {
    const double u = random.Uniform(-2, 3);
    ASSERT_GE(u, -2);
    ASSERT_LT(u, 3);
    ++histogram[static_cast<size_t>((u + 2) * 4)];
  }
  const double expected = draws / 20.0;
  for (int count : histogram) EXPECT_NEAR(count, expected, 5 * std::sqrt(expected));
}

TEST(RandomTest, IntegersAreUniformAndReachBothEnds) {
  Random random(13);
  std::map<int64_t, int> histogram;
  const int draws = 70000;
  for (int i = 0; i < draws; ++i) ++histogram[random.Integer(-3, 4)];
  ASSERT_EQ(histogram.size(), 7U);
  EXPECT_EQ(histogram.begin()->first, -3);
  EXPECT_EQ(histogram.rbegin()->first, 3);
  for (const auto& [value, count] : histogram) EXPECT_NEAR(count, 10000, 5 * 100) << value;
}

TEST(RandomTest, IntegersCoverTheWidestRange) {
  Random random(14);
  int negative = 0;
  for (int i = 0; i < 1000; ++i) {
    negative += random.Integer(std::numeric_limits<int64_t>::min(),
                               std::numeric_limits<int64_t>::max()) < 0;
  }
  EXPECT_NEAR(negative, 500, 80);
  EXPECT_EQ(random.Integer(5, 6), 5);
}

TEST(RandomTest, RefusesAnEmptyRange) {
  Random random(15);
  EXPECT_THROW(random.Integer(4, 4), Error);
  EXPECT_THROW(random.Integer(4, -4), Error);
}

TEST(RandomTest, StreamsAndSeedsDiffer) {
  std::set<uint32_t> words;
  for (uint64_t seed : {1, 2}) {
    for (uint32_t stream : {0, 1, 2}) {
      Random random(seed, stream);
      for (int i = 0; i < 100; ++i) words.insert(random.Next());
    }
  }
  EXPECT_EQ(words.size(), 600U);
}

}  // namespace choreo::random_test
