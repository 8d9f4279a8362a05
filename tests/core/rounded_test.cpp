#include "model/core/rounded.h"

#include <gtest/gtest.h>

#include <limits>

namespace choreo::rounded_test {

TEST(RoundedTest, ShowsFewDigits) {
  EXPECT_EQ(Rounded(0.123457), "0.12");
  EXPECT_EQ(Rounded(1.0 / 30), "0.033");
  EXPECT_EQ(Rounded(-0.00098765), "-0.00099");
  EXPECT_EQ(Rounded(59.966667), "59.97");
  EXPECT_EQ(Rounded(0.3), "0.3");
  EXPECT_EQ(Rounded(5), "5");
  EXPECT_EQ(Rounded(0.99999), "1");
  EXPECT_EQ(RoundedBeyond(5.004, 5), "5.004");
  EXPECT_EQ(RoundedBeyond(5.123456, 5), "5.12");
  EXPECT_EQ(Rounded(1200), "1200");
  EXPECT_EQ(Rounded(12345.678), "12345.68");
  EXPECT_EQ(Rounded(0), "0");
  EXPECT_EQ(Rounded(-1e-12), "0");
  EXPECT_EQ(Rounded(0.0000098), "0");
  EXPECT_EQ(Rounded(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(Rounded(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(Rounded(std::numeric_limits<double>::infinity()), "inf");
}

TEST(InFullTest, ShowsEveryDigitAndNoMore) {
  EXPECT_EQ(InFull(3.0025), "3.0025");
  EXPECT_EQ(InFull(7), "7");
  EXPECT_EQ(InFull(0.1), "0.1");
}

}  // namespace choreo::rounded_test
