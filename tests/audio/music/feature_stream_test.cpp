#include "model/audio/music/feature_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "tests/audio/signals.h"

namespace choreo::feature_stream_test {

using ::testing::Each;
using ::testing::HasSubstr;

std::vector<MelBandsDb> RowsOf(const FeatureStream& stream, int64_t from, int64_t to) {
  std::vector<MelBandsDb> rows;
  for (int64_t r = from; r < to; ++r) rows.push_back(stream.Bands(r));
  return rows;
}

FeatureStream Whole(std::span<const float> wave, int rate, int channels) {
  FeatureStream stream(rate, channels);
  stream.Push(wave);
  stream.Finish();
  return stream;
}

struct Format {
  int rate;
  int channels;
};

class FeatureStreamFormatTest : public ::testing::TestWithParam<Format> {
 protected:
  int rate() const { return GetParam().rate; }
  int channels() const { return GetParam().channels; }
  std::vector<float> Wave(int64_t samples) const { return Noise(samples * channels(), 21, 0.5); }
};
INSTANTIATE_TEST_SUITE_P(Formats, FeatureStreamFormatTest,
                         ::testing::Values(Format{22050, 1}, Format{44100, 2}, Format{48000, 1},
                                           Format{8000, 1}, Format{192000, 8}, Format{44101, 2}));

TEST_P(FeatureStreamFormatTest, ChunksDoNotChangeABit) {
  const std::vector<float> wave = Wave(rate() / 2);
  const FeatureStream whole = Whole(wave, rate(), channels());
  const int64_t count = whole.audio_rows() + 5;
  ASSERT_GE(count, 20);
  const std::vector<MelBandsDb> expected = RowsOf(whole, 0, count);
  std::mt19937 random(11);
  for (const int longest : {40, 700, 20000}) {
    FeatureStream stream(rate(), channels());
    int64_t final_rows = 0;
    for (size_t at = 0; at < wave.size();) {
      const size_t frames = random() % static_cast<unsigned>(longest + 1);
      const size_t size = std::min(frames * static_cast<size_t>(channels()), wave.size() - at);
      stream.Push(std::span(wave).subspan(at, size));
      at += size;
      EXPECT_GE(stream.final_rows(), final_rows);
      final_rows = stream.final_rows();
    }
    // Rows that were final before the end do not change.
    const std::vector<MelBandsDb> early = RowsOf(stream, 0, final_rows);
    EXPECT_TRUE(std::equal(early.begin(), early.end(), expected.begin()));
    stream.Finish();
    EXPECT_EQ(RowsOf(stream, 0, count), expected) << longest;
    EXPECT_EQ(stream.next_sample(), rate() / 2);
  }
}

TEST_P(FeatureStreamFormatTest, RowsAreTheSpectraOfTheResampledWhole) {
  const std::vector<float> wave = Wave(rate() / 2);
  Resampler resampler(rate(), channels());
  std::vector<float> mono;
  resampler.Push(wave);
  resampler.Finish();
  resampler.Pull(mono);
  const FeatureStream stream = Whole(wave, rate(), channels());
  EXPECT_EQ(RowsOf(stream, 0, stream.audio_rows()), MelSpectrogram(mono, kFeatureHop));
}

TEST_P(FeatureStreamFormatTest, WhereTheStreamStartsDoesNotChangeABit) {
  const std::vector<float> wave = Wave(rate());
  const FeatureStream whole = Whole(wave, rate(), channels());
  for (const int64_t row : {0, 1, 2, 3, 10, 19}) {
    const int64_t first = FeatureStream::FirstSampleFor(row, rate());
    FeatureStream stream(rate(), channels(), first);
    EXPECT_LE(stream.first_row(), row);
    // One sample later would have been too late.
    EXPECT_TRUE(first == 0 || FeatureStream(rate(), channels(), first + 1).first_row() > row);
    EXPECT_EQ(stream.final_rows(), stream.first_row());
    stream.Push(std::span(wave).subspan(static_cast<size_t>(first * channels())));
    stream.Finish();
    EXPECT_EQ(stream.audio_rows(), whole.audio_rows());
    EXPECT_EQ(RowsOf(stream, row, 35), RowsOf(whole, row, 35)) << row;
    if (stream.first_row() > 0) {
      EXPECT_THROW(stream.Bands(stream.first_row() - 1), Error);
    }
  }
}

TEST_P(FeatureStreamFormatTest, ForgottenRowsAreGoneAndTheOthersStay) {
  const std::vector<float> wave = Wave(rate());
  const FeatureStream whole = Whole(wave, rate(), channels());
  FeatureStream stream(rate(), channels());
  for (size_t at = 0; at < wave.size(); at += 1000 * static_cast<size_t>(channels())) {
    const size_t count = std::min(1000 * static_cast<size_t>(channels()), wave.size() - at);
    stream.Push(std::span(wave).subspan(at, count));
    stream.Forget(7);
    stream.Forget(3);  // never goes back
  }
  stream.Finish();
  EXPECT_EQ(stream.first_row(), 7);
  EXPECT_THROW(stream.Bands(6), Error);
  EXPECT_EQ(stream.audio_rows(), whole.audio_rows());
  EXPECT_EQ(RowsOf(stream, 7, 35), RowsOf(whole, 7, 35));
  stream.Forget(1000);
  EXPECT_LE(stream.first_row(), 40);  // later rows are all silence
  EXPECT_EQ(RowsOf(stream, 50, 60), RowsOf(whole, 50, 60));
}

TEST_P(FeatureStreamFormatTest, RowsAreFinalAtTheDeclaredLatency) {
  FeatureStream stream(rate(), channels());
  const std::vector<float> wave = Wave(rate() / 3);
  const size_t step = static_cast<size_t>(channels());
  int64_t final_rows = 0;
  for (size_t at = 0; at < wave.size(); at += step) {
    stream.Push(std::span(wave).subspan(at, step));
    if (stream.final_rows() == final_rows) continue;
    ASSERT_EQ(stream.final_rows(), final_rows + 1);
    const double centre = static_cast<double>(kFeatureHop * final_rows);
    const double heard = static_cast<double>(stream.next_sample()) * kModelSampleRate / rate();
    EXPECT_LE(heard - centre, stream.latency_samples() + 2.0 * kModelSampleRate / rate());
    EXPECT_GE(heard - centre, kFftSize / 2);  // not before its window is heard
    ++final_rows;
  }
  EXPECT_GE(final_rows, 8);
}

TEST(FeatureStreamTest, NoRateHasMoreThanTheLargestLatency) {
  int largest = 0;
  for (int rate = kMinSampleRate; rate <= kMaxSampleRate; rate += 1000) {
    largest = std::max(largest, FeatureStream(rate, 1).latency_samples());
  }
  // Half a window plus, at the lowest rate, half the resampling filter.
  EXPECT_EQ(largest, kFftSize / 2 + 188);
}

TEST(FeatureStreamTest, RowsAfterTheEndAreSilent) {
  FeatureStream silence(22050, 1);
  silence.Finish();
  silence.Finish();
  EXPECT_EQ(silence.audio_rows(), 0);
  const std::vector<MelBandsDb> silent = RowsOf(silence, 0, 1);
  EXPECT_THAT(silent[0], Each(-100));
  EXPECT_EQ(RowsOf(silence, 1000000, 1000001), silent);

  const std::vector<float> wave = Noise(22050, 3);
  const FeatureStream stream = Whole(wave, 22050, 1);
  EXPECT_EQ(stream.final_rows(), std::numeric_limits<int64_t>::max());
  EXPECT_EQ(stream.audio_rows(), 31);
  // Row 31 still includes the end: its window begins at sample 21 761. Row 32's begins at 22 496.
  EXPECT_NE(RowsOf(stream, 31, 32), silent);
  for (const int64_t row : {32, 33, 34, 50, 1 << 30}) {
    EXPECT_EQ(RowsOf(stream, row, row + 1), silent) << row;
  }
}

TEST(FeatureStreamTest, RowsThatAreNotFinalAreRefused) {
  FeatureStream stream(22050, 1);
  stream.Push(Noise(5000, 3));
  EXPECT_EQ(stream.final_rows(), 6);
  EXPECT_EQ(stream.audio_rows(), 7);
  EXPECT_NO_THROW(stream.Bands(5));
  for (const int64_t row : {int64_t{-1}, int64_t{6}}) {
    try {
      stream.Bands(row);
      FAIL() << row;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kOutOfRange);
      EXPECT_THAT(error.what(), AllOf(HasSubstr(std::to_string(row)), HasSubstr("0 to 5")));
    }
  }
}

TEST(FeatureStreamTest, ARowStaysWhereItIs) {
  FeatureStream stream(22050, 1);
  stream.Push(Noise(2000, 3));
  const MelBandsDb& row = stream.Bands(0);
  const MelBandsDb before = row;
  stream.Push(Noise(500000, 4));
  EXPECT_EQ(&stream.Bands(0), &row);
  EXPECT_EQ(row, before);
}

TEST(FeatureStreamTest, RefusesFormatsBeyondTheLimits) {
  EXPECT_THROW(FeatureStream(4000, 1), Error);
  EXPECT_THROW(FeatureStream(44100, 9), Error);
}

}  // namespace choreo::feature_stream_test
