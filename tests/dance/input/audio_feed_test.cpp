#include "model/dance/input/audio_feed.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "model/audio/signal/mel.h"
#include "model/core/error.h"
#include "tests/audio/signals.h"

namespace choreo::audio_feed_test {

// The features of a model that takes the mel bands themselves.
const MusicFeatures kBands = {kMelBands,
                              [](std::span<const double> bands, std::span<float> features) {
                                std::ranges::copy(bands, features.begin());
                              }};

Eigen::VectorXf RowOf(const AudioFeed& feed, int64_t row) { return feed.History(row + 1, 1); }

TEST(AudioFeedTest, ForgottenRowsAreGoneAndTheOthersStay) {
  const std::vector<float> wave = TonesAndBursts();
  AudioFeed whole(22050, 1, 0, kBands), feed(22050, 1, 0, kBands);
  whole.Push(wave, 0, [] {});
  int64_t at = 0;
  for (; at < static_cast<int64_t>(wave.size()); at += 735) {
    const auto rest = std::span(wave).subspan(static_cast<size_t>(at));
    feed.Push(rest.first(std::min<size_t>(735, rest.size())), at, [] {});
    feed.Forget(at / 735 - 10);
  }
  whole.Finish();
  feed.Finish();
  EXPECT_EQ(feed.ready(), whole.ready());
  const int64_t kept = at / 735 - 1 - 10;
  for (int64_t row = kept; row < kept + 30; ++row) EXPECT_EQ(RowOf(feed, row), RowOf(whole, row));
  EXPECT_EQ(feed.History(kept + 10, 10), whole.History(kept + 10, 10));
  EXPECT_NE(RowOf(whole, kept), RowOf(whole, kept + 1));
  EXPECT_THROW(RowOf(feed, kept - 1), Error);
  EXPECT_EQ(RowOf(feed, -1), RowOf(whole, -1));  // silence's, before all music
}

TEST(AudioFeedTest, HearsNothingForAModelThatDoesNot) {
  AudioFeed feed(22050, 1, 0);
  feed.Push(TonesAndBursts(), 0, [] {});
  EXPECT_EQ(feed.History(10, 10).rows(), 0);
  EXPECT_EQ(feed.Sounds(20, 5).size(), 5U);
}

TEST(AudioFeedTest, KnowsSilenceAndChannelsThatCancelEachOther) {
  const auto stereo = [](float left, float right, int64_t first_sample, float offset = 0) {
    AudioFeed feed(22050, 2, first_sample);
    std::vector<float> wave;
    for (const float level : Noise(22050, 5))
      wave.insert(wave.end(), {left * level + offset, right * level - 0.5F * offset});
    feed.Push(wave, first_sample, [] {});
    return std::pair(feed.silent(), feed.cancels());
  };
  EXPECT_EQ(stereo(1, 1, 0), std::pair(false, false));
  EXPECT_EQ(stereo(1, 0, 0), std::pair(false, false));
  EXPECT_EQ(stereo(0, 0, 0), std::pair(true, false));
  EXPECT_EQ(stereo(1, -1, 0), std::pair(false, true));
  EXPECT_EQ(stereo(1, -0.999F, 0), std::pair(false, true));
  EXPECT_EQ(stereo(1, -1, 735), std::pair(false, false)) << "what came before is unknown";
  EXPECT_EQ(stereo(0, 0, 0, 0.5F), std::pair(true, false)) << "a DC offset is no sound";
  EXPECT_EQ(stereo(1, -1, 0, 0.5F), std::pair(false, true));
  EXPECT_EQ(stereo(1, 1, 0, 0.5F), std::pair(false, false));
}

TEST(AudioFeedTest, RefusesPartialFramesAndNonFiniteSamples) {
  const std::vector<float> wave = Noise(2 * 30000, 5);
  AudioFeed whole(44100, 2, 0, kBands), feed(44100, 2, 0, kBands);
  whole.Push(wave, 0, [] {});
  feed.Push(std::span(wave).first(20000), 0, [] {});
  EXPECT_THROW(feed.Push(std::span(wave).first(3), 10000, [] {}), Error);
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
        -std::numeric_limits<float>::infinity()}) {
    std::vector<float> broken(wave.begin() + 20000, wave.begin() + 40000);
    broken[2 * 4321 + 1] = bad;
    try {
      feed.Push(broken, 10000, [] {});
      FAIL() << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
      EXPECT_EQ(error.field(), "samples");
      EXPECT_NE(std::string(error.what()).find("sample 14321 of channel 1"), std::string::npos);
    }
  }
  feed.Push(std::span(wave).subspan(20000), 10000, [] {});
  ASSERT_EQ(feed.ready(), whole.ready());
  for (int64_t row = 0; row < feed.ready(); ++row) EXPECT_EQ(RowOf(feed, row), RowOf(whole, row));
}

}  // namespace choreo::audio_feed_test
