#include "client/seen.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace choreo::client::seen_test {

FrameBlock Block(int64_t first, int64_t count) {
  FrameBlock block;
  block.first_frame = first;
  for (int64_t i = 0; i < count; ++i) {
    block.poses.emplace_back().root_position.x() = static_cast<double>(first + i);
    block.contacts.push_back({static_cast<float>(first + i)});
  }
  return block;
}

TEST(SeenTest, CutsAwayFramesThatWereDelivered) {
  Seen seen(10);
  FrameBlock first = Block(10, 5);
  EXPECT_TRUE(seen.Admit(&first));
  EXPECT_EQ(seen.next_frame(), 15);

  FrameBlock known = Block(10, 3);
  EXPECT_FALSE(seen.Admit(&known));
  FrameBlock overlapping = Block(12, 6);
  ASSERT_TRUE(seen.Admit(&overlapping));
  EXPECT_EQ(overlapping.first_frame, 15);
  ASSERT_EQ(overlapping.poses.size(), 3U);
  EXPECT_EQ(overlapping.poses[0].root_position.x(), 15);
  EXPECT_EQ(overlapping.contacts[2][0], 17);
  EXPECT_EQ(seen.next_frame(), 18);
}

TEST(SeenTest, NoticesMissingFrames) {
  Seen seen(0);
  FrameBlock late = Block(1, 2);
  ExpectError(ErrorCode::kInternal, "1 came where 0 was due", [&] { seen.Admit(&late); });
}

TEST(SeenTest, ReportsKeysBeatsAndWarningsOnce) {
  Seen seen(0);
  for (const bool is_new : {true, false}) {
    EXPECT_EQ(seen.Admit(DanceEvent(KeyReached{.id = "a", .frame = 30})), is_new);
    EXPECT_EQ(seen.Admit(DanceEvent(Beat{.frame = 12, .time_s = 0.4})), is_new);
    EXPECT_EQ(seen.Admit(DanceEvent(Warning{.frame = 3, .message = "short"})), is_new);
  }
  EXPECT_TRUE(seen.Admit(DanceEvent(KeyReached{.id = "a", .frame = 60})));
  EXPECT_TRUE(seen.Admit(DanceEvent(Beat{.frame = 13, .time_s = 0.43})));
  EXPECT_TRUE(seen.Admit(DanceEvent(Beat{.frame = 13, .time_s = 0.44})));  // of who gives them so
}

TEST(SeenTest, HidesOnlyRejectionsCausedByAResumption) {
  const auto rejected = [](const std::string& id, int64_t frame) {
    return DanceEvent(KeyRejected{.id = id, .frame = frame, .earliest_frame = 90, .reason = ""});
  };
  Seen seen(0);
  EXPECT_TRUE(seen.Admit(rejected("late", 80)));
  EXPECT_TRUE(seen.Admit(rejected("late", 80)));  // tried twice
  seen.Restart(60, {{"danced", 30}});
  EXPECT_FALSE(seen.Admit(rejected("danced", 30)));
  EXPECT_FALSE(seen.Admit(rejected("late", 80)));
  EXPECT_FALSE(seen.Admit(rejected("late", 80)));
  EXPECT_TRUE(seen.Admit(rejected("danced", 30)));  // asked for again, in vain
  EXPECT_TRUE(seen.Admit(rejected("late", 80)));
}

TEST(SeenTest, ShowsRejectionsOfReachedKeysAfterAResumption) {
  const DanceEvent reached(KeyReached{.id = "a", .frame = 30});
  Seen seen(0);
  EXPECT_TRUE(seen.Admit(reached));
  seen.Restart(60, {{"a", 30}});
  EXPECT_FALSE(seen.Admit(reached));
  EXPECT_TRUE(seen.Admit(DanceEvent(KeyRejected{.id = "a", .frame = 30})));  // sent anew
}

}  // namespace choreo::client::seen_test
