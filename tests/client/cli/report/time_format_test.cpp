#include "client/cli/report/time_format.h"

#include <gtest/gtest.h>

/// Messages give times in the unit that the user has used.
namespace choreo::cli::time_format_test {

TEST(TimeFormat, SaysSecondsOrCounts) {
  const TimeFormat seconds{30};
  EXPECT_EQ(seconds.Of(126), "4.2 s");
  const TimeFormat counts{30, authoring::CountsFrom({0.31, 0.81, 1.31}, {})};
  EXPECT_EQ(counts.Of(9), "1c, 0.3 s");
  EXPECT_EQ(counts.Of(54), "4c, 1.8 s");
  EXPECT_EQ(counts.Of(32), "2.5c, 1.07 s");
  EXPECT_EQ(counts.Of(38), "2.91c, 1.27 s");
}

TEST(TimeFormat, CountsFromCountZeroOn) {
  const TimeFormat counts{30, authoring::CountsFrom({0.31, 0.81, 1.31}, std::vector{0.81})};
  EXPECT_EQ(counts.Count(24), 1);
  EXPECT_EQ(counts.Count(9), 0);
  EXPECT_EQ(counts.Count(0), std::nullopt);
  EXPECT_EQ(TimeFormat{30}.Count(9), std::nullopt);
  // A key at 0.03 s stands on the first frame.
  EXPECT_EQ((TimeFormat{30, authoring::CountsFrom({0.03, 0.53}, {})}.Count(0)), 1);
}

}  // namespace choreo::cli::time_format_test
