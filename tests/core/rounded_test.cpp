#include "model/core/rounded.h"

#include <gtest/gtest.h>

#include <limits>

namespace choreo {
namespace {

TEST(RoundedTest, ShowsWhatPeopleReadAndNoMore) {
  EXPECT_EQ(Rounded(0.123457), "0.12");
  EXPECT_EQ(Rounded(1.0 / 30), "0.033");
  EXPECT_EQ(Rounded(-0.00098765), "-0.00099");
  EXPECT_EQ(Rounded(59.966667), "59.97");
  EXPECT_EQ(Rounded(0.3), "0.3");
  EXPECT_EQ(Rounded(5), "5");
  EXPECT_EQ(Rounded(0.99999), "1");
  EXPECT_EQ(Rounded(1200), "1200");
  EXPECT_EQ(Rounded(12345.678), "12345.68");
  EXPECT_EQ(Rounded(0), "0");
  EXPECT_EQ(Rounded(-1e-12), "0");
  EXPECT_EQ(Rounded(std::numeric_limits<double>::infinity()), "inf");
}

}  // namespace
}  // namespace choreo
