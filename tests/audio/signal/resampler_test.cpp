#include "model/audio/signal/resampler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "tests/audio/signals.h"

namespace choreo::resample_test {

// Two rates with few phases, the usual rates, both ends of the range, one with many phases that are
// cached, one whose are not.
constexpr int kRates[] = {8000, 11025, 16000, 44100, 48000, 96000, 192000, 22255, 44101};

std::vector<float> Resample(std::span<const float> interleaved, double rate, int channels = 1,
                            int64_t first_sample = 0) {
  Resampler resampler(rate, channels, first_sample);
  std::vector<float> mono;
  resampler.Push(interleaved);
  resampler.Finish();
  resampler.Pull(mono);
  return mono;
}

/// RMS of mono minus expected, away from the ends, where the filter reaches the silence outside.
double RmsError(std::span<const float> mono, std::span<const float> expected) {
  double squares = 0;
  size_t count = 0;
  for (size_t i = 400; i + 400 < mono.size(); ++i, ++count) {
    squares += std::pow(static_cast<double>(mono[i]) - static_cast<double>(expected[i]), 2);
  }
  EXPECT_GT(count, 1000u);
  return std::sqrt(squares / static_cast<double>(count));
}

double Decibels(double amplitude) { return 20 * std::log10(amplitude); }

class ResamplerRateTest : public ::testing::TestWithParam<int> {
 protected:
  int rate() const { return GetParam(); }
  double LowerNyquist() const { return std::min(rate(), kModelSampleRate) / 2.0; }
};
INSTANTIATE_TEST_SUITE_P(Rates, ResamplerRateTest, ::testing::ValuesIn(kRates));

TEST_P(ResamplerRateTest, PassBandSinesAreUnchanged) {
  for (const double hz : {100.0, 1000.0, 0.5 * LowerNyquist(), 0.9 * LowerNyquist()}) {
    const std::vector<float> mono = Resample(Sine(hz, rate(), rate() / 2), rate());
    const std::vector<float> ideal = Sine(hz, kModelSampleRate, static_cast<int64_t>(mono.size()));
    // Against an RMS of 0.7. At the band's edge 0.01 dB, which is an error of 0.0012, are allowed.
    const double limit = hz < 0.9 * LowerNyquist() ? -95 : -58;
    EXPECT_LT(Decibels(RmsError(mono, ideal)), limit) << hz << " Hz at " << rate();
  }
}

TEST(ResamplerTest, FrequenciesAboveNyquistVanish) {
  for (const int rate : {44100, 44101, 48000, 96000, 192000}) {
    for (const double factor : {1.0, 1.1, 1.5, 1.9}) {
      const double hz = factor * kModelSampleRate / 2;
      const std::vector<float> mono = Resample(Sine(hz, rate, rate / 2), rate);
      const std::vector<float> nothing(mono.size(), 0.0f);
      EXPECT_LT(Decibels(RmsError(mono, nothing)), -95) << hz << " Hz at " << rate;
    }
  }
}

TEST_P(ResamplerRateTest, AConstantStaysThatConstant) {
  const std::vector<float> mono = Resample(std::vector<float>(20000, 0.3f), rate());
  ASSERT_GT(mono.size(), 1000u);
  for (size_t i = 400; i + 400 < mono.size(); ++i) EXPECT_NEAR(mono[i], 0.3f, 1e-7) << i;
}

TEST_P(ResamplerRateTest, LastsAsLongAsTheInput) {
  for (const int64_t samples : {1, 2, 1000, 4321}) {
    const std::vector<float> mono = Resample(Noise(samples, 1), rate());
    const double exact = static_cast<double>(samples) * kModelSampleRate / rate();
    EXPECT_EQ(static_cast<double>(mono.size()), std::ceil(exact)) << samples;
  }
  EXPECT_TRUE(Resample({}, rate()).empty());
}

TEST_P(ResamplerRateTest, ChunksDoNotChangeABit) {
  const int channels = 2;
  const std::vector<float> wave = Noise(20000 * channels, 3);
  const std::vector<float> whole = Resample(wave, rate(), channels);
  std::mt19937 random(7);
  for (const int longest : {3, 100, 9000}) {
    Resampler resampler(rate(), channels);
    std::vector<float> mono;
    for (size_t at = 0; at < wave.size();) {
      const size_t frames = random() % static_cast<unsigned>(longest + 1);
      const size_t size = std::min(frames * channels, wave.size() - at);
      resampler.Push(std::span(wave).subspan(at, size));
      if (random() % 2) resampler.Pull(mono);
      at += size;
    }
    resampler.Finish();
    resampler.Pull(mono);
    EXPECT_EQ(mono, whole) << longest;
  }
}

TEST_P(ResamplerRateTest, WhereTheStreamStartsDoesNotChangeABit) {
  const std::vector<float> wave = Noise(20000, 4);
  const std::vector<float> whole = Resample(wave, rate());
  for (const int64_t start : {1, 17, 4410, 12345}) {
    const Resampler probe(rate(), 1, start);
    const std::vector<float> tail =
        Resample(std::span(wave).subspan(static_cast<size_t>(start)), rate(), 1, start);
    const int64_t first = probe.first_output();
    // No available output is missing, and none has support before the stream's start.
    const auto support = [&](int64_t n) {
      return n * rate() / kModelSampleRate - probe.half_length() + 1;
    };
    EXPECT_GE(support(first), start);
    EXPECT_LT(support(first - 1), start);
    ASSERT_EQ(tail.size(), whole.size() - static_cast<size_t>(first));
    EXPECT_TRUE(std::equal(tail.begin(), tail.end(), whole.begin() + first)) << start;
  }
}

TEST_P(ResamplerRateTest, OutputIsReadyOnceItsSupportArrived) {
  Resampler resampler(rate(), 1);
  const std::vector<float> wave = Noise(3000, 5);
  std::vector<float> mono;
  for (int64_t pushed = 1; pushed <= 3000; ++pushed) {
    resampler.Push(std::span(wave).subspan(static_cast<size_t>(pushed - 1), 1));
    resampler.Pull(mono);
    const int64_t next = static_cast<int64_t>(mono.size());
    const auto last_needed = [&](int64_t n) {
      return n * rate() / kModelSampleRate + resampler.half_length();
    };
    ASSERT_GE(last_needed(next), pushed);
    if (next > 0) {
      ASSERT_LT(last_needed(next - 1), pushed);
    }
  }
  EXPECT_GT(mono.size(), 200u);
}

TEST_P(ResamplerRateTest, OutputDependsOnSamplesNearByOnly) {
  std::vector<float> wave = Noise(20000, 6);
  const std::vector<float> before = Resample(wave, rate());
  wave[10000] += 0.5f;
  const std::vector<float> after = Resample(wave, rate());
  const double centre = 10000.0 * kModelSampleRate / rate();
  const double reach = static_cast<double>(Resampler(rate(), 1).latency()) + 1;
  int64_t changed = 0;
  for (size_t n = 0; n < before.size(); ++n) {
    if (before[n] == after[n]) continue;
    ++changed;
    EXPECT_LE(std::abs(static_cast<double>(n) - centre), reach);
  }
  EXPECT_GT(changed, 5);
}

TEST(ResamplerTest, TheModelRatePassesUnchanged) {
  const std::vector<float> wave = Noise(5000, 8);
  EXPECT_EQ(Resample(wave, kModelSampleRate), wave);
  const Resampler resampler(kModelSampleRate, 1, 123);
  EXPECT_EQ(resampler.first_output(), 123);
  EXPECT_EQ(resampler.latency(), 0);
}

TEST(ResamplerTest, ChannelsAreAveraged) {
  const std::vector<float> three = {0.5f, 0.25f, 0.0f, -1.0f, -0.5f, 0.75f};
  EXPECT_THAT(Resample(three, kModelSampleRate, 3), ::testing::ElementsAre(0.25f, -0.25f));
}

TEST(ResamplerTest, RefusesFormatsBeyondTheLimits) {
  const auto refusal = [](double rate, int channels, int64_t first) -> std::string {
    try {
      Resampler resampler(rate, channels, first);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
      return error.what();
    }
    return "accepted";
  };
  using ::testing::HasSubstr;
  using ::testing::StartsWith;
  EXPECT_EQ(refusal(8000, 1, 0), "accepted");
  EXPECT_EQ(refusal(192000, 8, 0), "accepted");
  for (const double rate : {7999.0, 192001.0, 0.0, -44100.0, 44100.5, std::nan("")}) {
    EXPECT_THAT(refusal(rate, 1, 0), AllOf(HasSubstr("audio.sample_rate"), HasSubstr("192000")));
  }
  EXPECT_THAT(refusal(44100, 0, 0), AllOf(HasSubstr("audio.channels: 0"), HasSubstr("1 to 8")));
  EXPECT_THAT(refusal(44100, 9, 0), HasSubstr("audio.channels: 9"));
  EXPECT_THAT(refusal(44100, 1, -1), StartsWith("first_sample: -1"));
  EXPECT_EQ(refusal(44100, 1, 44100 * 600), "accepted");
  EXPECT_THAT(refusal(44100, 1, 44100 * 600 + 1), HasSubstr("0 to 26460000"));
}

}  // namespace choreo::resample_test
