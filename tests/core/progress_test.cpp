#include "model/core/running/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace choreo::progress_test {

using ::testing::HasSubstr;
using ::testing::Not;

std::chrono::steady_clock::time_point fake_time;

class ProgressBarTest : public ::testing::Test {
 protected:
  void SetUp() override { fake_time = {}; }
  ProgressBar::Output Output(bool terminal) {
    return {&stream_, terminal, [] { return fake_time; }};
  }
  static void Pass(double seconds) {
    fake_time += std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(seconds));
  }
  int64_t Lines() const {
    const std::string text = stream_.str();
    return std::count(text.begin(), text.end(), '\n');
  }

  std::ostringstream stream_;
};

TEST_F(ProgressBarTest, OnATerminalRedrawsOneLineWithAnEstimate) {
  ProgressBar bar("prepare", 4, Output(true));
  Pass(30);
  bar.Advance(1, "clip a");
  EXPECT_THAT(stream_.str(), HasSubstr("prepare [=======                       ]  25 % 1/4"));
  EXPECT_THAT(stream_.str(), HasSubstr("1 min 30 s left  clip a"));
  EXPECT_EQ(Lines(), 0);
  Pass(30);
  bar.Advance(3);
  bar.Finish();
  EXPECT_THAT(stream_.str(), HasSubstr("100 % 4/4, took 1 min 00 s\n"));
  EXPECT_EQ(Lines(), 1);
}

TEST_F(ProgressBarTest, ElsewhereWritesALineEveryTenSeconds) {
  {
    ProgressBar bar("train", 100, Output(false));
    for (int step = 0; step < 100; ++step) {
      Pass(0.5);
      bar.Advance();
    }
    EXPECT_EQ(Lines(), 5);
    bar.Finish();
    bar.Finish();
  }
  EXPECT_EQ(Lines(), 6);
  EXPECT_THAT(stream_.str(), Not(HasSubstr("\r")));
}

TEST_F(ProgressBarTest, EndsItsLineWhenAJobFails) {
  {
    ProgressBar bar("train", 3, Output(true));
    Pass(1);
    bar.Advance();
  }
  EXPECT_EQ(Lines(), 1);
}

TEST(FormatDurationTest, NamesTheTwoLargestUnits) {
  EXPECT_EQ(FormatDuration(0.4), "0 s");
  EXPECT_EQ(FormatDuration(59.6), "1 min 00 s");
  EXPECT_EQ(FormatDuration(187), "3 min 07 s");
  EXPECT_EQ(FormatDuration(3725), "1 h 02 min");
}

}  // namespace choreo::progress_test
