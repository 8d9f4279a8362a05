#include "client/delivery_filter.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace choreo::client::delivery_filter_test {

FrameBlock Block(int64_t first, int64_t count) {
  FrameBlock block;
  block.first_frame = first;
  for (int64_t i = 0; i < count; ++i) {
    block.poses.emplace_back().root_position.x() = static_cast<double>(first + i);
    block.contacts.push_back({static_cast<float>(first + i)});
  }
  return block;
}

TEST(DeliveryFilterTest, CutsAwayFramesThatWereDelivered) {
  DeliveryFilter filter(10);
  FrameBlock first = Block(10, 5);
  EXPECT_TRUE(filter.Admit(&first));
  EXPECT_EQ(filter.next_frame(), 15);

  FrameBlock known = Block(10, 3);
  EXPECT_FALSE(filter.Admit(&known));
  FrameBlock overlapping = Block(12, 6);
  ASSERT_TRUE(filter.Admit(&overlapping));
  EXPECT_EQ(overlapping.first_frame, 15);
  ASSERT_EQ(overlapping.poses.size(), 3U);
  EXPECT_EQ(overlapping.poses[0].root_position.x(), 15);
  EXPECT_EQ(overlapping.contacts[2][0], 17);
  EXPECT_EQ(filter.next_frame(), 18);
}

TEST(DeliveryFilterTest, NoticesMissingFrames) {
  DeliveryFilter filter(0);
  FrameBlock late = Block(1, 2);
  ExpectError(ErrorCode::kInternal, "1 came where 0 was due", [&] { filter.Admit(&late); });
}

TEST(DeliveryFilterTest, ReportsKeysBeatsAndWarningsOnce) {
  DeliveryFilter filter(0);
  for (const bool is_new : {true, false}) {
    EXPECT_EQ(filter.Admit(DanceEvent(KeyReached{.id = "a", .frame = 30})), is_new);
    EXPECT_EQ(filter.Admit(DanceEvent(Beat{.frame = 12, .time_s = 0.4})), is_new);
    EXPECT_EQ(filter.Admit(DanceEvent(Warning{.frame = 3, .message = "short"})), is_new);
  }
  EXPECT_TRUE(filter.Admit(DanceEvent(KeyReached{.id = "a", .frame = 60})));
  EXPECT_TRUE(filter.Admit(DanceEvent(Beat{.frame = 13, .time_s = 0.43})));
  EXPECT_TRUE(filter.Admit(DanceEvent(Beat{.frame = 13, .time_s = 0.44})));  // of who gives them so
}

TEST(DeliveryFilterTest, HidesOnlyRejectionsCausedByAResumption) {
  const auto rejected = [](const std::string& id, int64_t frame) {
    return DanceEvent(KeyRejected{.id = id, .frame = frame, .earliest_frame = 90, .reason = ""});
  };
  DeliveryFilter filter(0);
  EXPECT_TRUE(filter.Admit(rejected("late", 80)));
  EXPECT_TRUE(filter.Admit(rejected("late", 80)));  // tried twice
  filter.Restart(60, {{"danced", 30}});
  EXPECT_FALSE(filter.Admit(rejected("danced", 30)));
  EXPECT_FALSE(filter.Admit(rejected("late", 80)));
  EXPECT_FALSE(filter.Admit(rejected("late", 80)));
  EXPECT_TRUE(filter.Admit(rejected("danced", 30)));  // asked for again, in vain
  EXPECT_TRUE(filter.Admit(rejected("late", 80)));
}

TEST(DeliveryFilterTest, HidesRepeatedRejectionsOfKeysWithoutAFrame) {
  const DanceEvent rejected(KeyRejected{.id = "timeless", .frame = -1});
  DeliveryFilter filter(0);
  EXPECT_TRUE(filter.Admit(rejected));
  filter.Restart(60, {});
  EXPECT_FALSE(filter.Admit(rejected));
  EXPECT_TRUE(filter.Admit(rejected));  // sent anew
}

TEST(DeliveryFilterTest, ShowsRejectionsOfReachedKeysAfterAResumption) {
  const DanceEvent reached(KeyReached{.id = "a", .frame = 30});
  DeliveryFilter filter(0);
  EXPECT_TRUE(filter.Admit(reached));
  filter.Restart(60, {{"a", 30}});
  EXPECT_FALSE(filter.Admit(reached));
  EXPECT_TRUE(filter.Admit(DanceEvent(KeyRejected{.id = "a", .frame = 30})));  // sent anew
}

}  // namespace choreo::client::delivery_filter_test
