#include "model/plan/takes.h"

#include <gtest/gtest.h>

#include <vector>

namespace choreo::takes_test {

// Samples takes with these excesses, as TransitionRun does. Returns the kept one.
int Sample(const std::vector<double>& excesses, SpareFrames* spare, BestTake<int>* best) {
  while (best->WantsAnother() && spare->SpendUnlessFirst(best->takes(), 10))
    best->Add(best->takes(), excesses.at(static_cast<size_t>(best->takes())));
  return best->motion();
}

TEST(BestTake, IsTheFirstWithinTheLimits) {
  SpareFrames spare(100);
  BestTake<int> best;
  EXPECT_EQ(Sample({3, 2, 1, 0}, &spare, &best), 2);
  EXPECT_EQ(best.takes(), 3);
  EXPECT_EQ(spare.left(), 80) << "the first take costs nothing";
}

TEST(BestTake, IsTheLeastOfAllIfNoneIsWithinThem) {
  SpareFrames spare(100);
  BestTake<int> best;
  EXPECT_EQ(Sample({3, 2, 4, 2, 5}, &spare, &best), 1);
  EXPECT_EQ(best.takes(), kMaxTakes);
}

TEST(BestTake, IsTheFirstIfNothingIsLeft) {
  SpareFrames spare(9);
  BestTake<int> best;
  EXPECT_EQ(Sample({3, 0}, &spare, &best), 0);
  EXPECT_TRUE(best.WantsAnother()) << "which costs nothing to ask";
  EXPECT_EQ(spare.left(), 9);
}

TEST(SpareFrames, AreGoneWhenMoreThanTheyHaveBeenSampled) {
  SpareFrames spare = SpareFrames::Of(10);
  spare.Charge(15);
  EXPECT_EQ(spare.left(), 10 * (kMaxTakes - 1) - 15);
  spare.Charge(1000);
  EXPECT_EQ(spare.left(), 0);
  EXPECT_FALSE(spare.SpendUnlessFirst(1, 1));
  EXPECT_TRUE(spare.SpendUnlessFirst(0, 1));
}

}  // namespace choreo::takes_test
