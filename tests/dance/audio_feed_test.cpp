#include "model/dance/audio_feed.h"

#include <gtest/gtest.h>

#include "model/audio/mfcc.h"
#include "model/core/error.h"
#include "tests/audio/signals.h"

namespace choreo {
namespace {

using Row = std::array<float, kMfccCount>;

Row RowOf(const AudioFeed& feed, int64_t row) {
  Row values{};
  EXPECT_TRUE(feed.CopyRow(row, values)) << row;
  return values;
}

TEST(AudioFeedTest, ForgottenRowsAreGoneAndTheOthersStay) {
  const std::vector<float> wave = TonesAndBursts();
  AudioFeed whole(22050, 1, 0), feed(22050, 1, 0);
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
  Row values{};
  EXPECT_THROW(feed.CopyRow(kept - 1, values), Error);
  EXPECT_EQ(RowOf(feed, -1), RowOf(whole, -1));  // silence's, before all music
}

}  // namespace
}  // namespace choreo
