#include "client/delivery_filter.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace choreo::client::delivery_filter_test {

/// Frames of two joints, full of their numbers.
v1::Frames Block(int64_t first, int count) {
  v1::Frames frames;
  frames.set_first_frame(first);
  frames.set_count(count);
  for (int i = 0; i < count; ++i) {
    const auto number = static_cast<float>(first + i);
    for (int j = 0; j < 3; ++j) frames.add_root_positions(number);
    for (int j = 0; j < 6; ++j) frames.add_rotations(number);
    for (int j = 0; j < 4; ++j) frames.add_contacts(number);
  }
  return frames;
}

v1::Event At(int64_t frame) {
  v1::Event event;
  event.set_frame(frame);
  return event;
}

v1::Event Reached(const std::string& id, int64_t frame) {
  v1::Event event = At(frame);
  event.mutable_keyframe_reached()->set_id(id);
  return event;
}

v1::Event Rejected(const std::string& id, int64_t frame) {
  v1::Event event = At(frame);
  event.mutable_keyframe_rejected()->set_id(id);
  event.mutable_keyframe_rejected()->set_code(v1::REJECTION_CODE_TOO_LATE);
  return event;
}

v1::Event AlreadyDanced(const std::string& id, int64_t frame) {
  v1::Event event = Rejected(id, frame);
  event.mutable_keyframe_rejected()->set_code(v1::REJECTION_CODE_ALREADY_DANCED);
  return event;
}

v1::Event Warned(const std::string& message, int64_t frame) {
  v1::Event event = At(frame);
  event.mutable_warning()->set_message(message);
  return event;
}

v1::Event BeatAt(double seconds, int64_t frame) {
  v1::Event event = At(frame);
  event.set_time(seconds);
  event.mutable_beat();
  return event;
}

TEST(DeliveryFilterTest, CutsAwayFramesThatWereDelivered) {
  DeliveryFilter filter(10, 10);
  v1::Frames first = Block(10, 5);
  EXPECT_TRUE(filter.Admit(&first));
  EXPECT_EQ(filter.next_frame(), 15);

  v1::Frames known = Block(10, 3);
  EXPECT_FALSE(filter.Admit(&known));
  v1::Frames overlapping = Block(12, 6);
  ASSERT_TRUE(filter.Admit(&overlapping));
  EXPECT_EQ(overlapping.SerializeAsString(), Block(15, 3).SerializeAsString());
  EXPECT_EQ(filter.next_frame(), 18);
}

TEST(DeliveryFilterTest, NoticesMissingFrames) {
  DeliveryFilter filter(0, 0);
  v1::Frames late = Block(1, 2);
  ExpectError(ErrorCode::kInternal, "1 came where 0 was due", [&] { filter.Admit(&late); });
}

TEST(DeliveryFilterTest, ReportsKeysBeatsAndWarningsOnce) {
  DeliveryFilter filter(0, 0);
  for (const bool is_new : {true, false}) {
    EXPECT_EQ(filter.Admit(Reached("a", 30)), is_new);
    EXPECT_EQ(filter.Admit(BeatAt(0.4, 12)), is_new);
    EXPECT_EQ(filter.Admit(Warned("short", 3)), is_new);
  }
  EXPECT_TRUE(filter.Admit(Reached("a", 60)));
  EXPECT_TRUE(filter.Admit(BeatAt(0.43, 13)));
  EXPECT_TRUE(filter.Admit(BeatAt(0.44, 13)));  // of who gives them so
}

TEST(DeliveryFilterTest, ReportsEachRejectionOnceAndNoneCausedByAResumption) {
  DeliveryFilter filter(0, 0);
  EXPECT_TRUE(filter.Admit(Rejected("late", 10)));
  EXPECT_TRUE(filter.Admit(Rejected("late", 10)));  // tried twice
  EXPECT_TRUE(filter.Admit(Rejected("timeless", -1)));
  filter.Restart();
  EXPECT_FALSE(filter.Admit(Rejected("late", 10)));
  EXPECT_FALSE(filter.Admit(AlreadyDanced("moved", 30)));
  EXPECT_FALSE(filter.Admit(Rejected("late", 10)));
  EXPECT_FALSE(filter.Admit(Rejected("timeless", -1)));
  EXPECT_TRUE(filter.Admit(Rejected("late", 10)));  // not answered before
  EXPECT_TRUE(filter.Admit(Rejected("timeless", -1)));
  EXPECT_FALSE(filter.Admit(AlreadyDanced("moved", 30)));  // removed
  filter.Restart();
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(filter.Admit(Rejected("again", 10)));
  EXPECT_TRUE(filter.Admit(Rejected("new", 10)));
}

TEST(DeliveryFilterTest, ReportsKeysBeforeTheContinuationFromWhichTheCallerGoesOn) {
  DeliveryFilter filter(60, 100);
  EXPECT_TRUE(filter.Admit(AlreadyDanced("danced", 59)));
  filter.Restart();
  EXPECT_FALSE(filter.Admit(AlreadyDanced("danced", 59)));
  EXPECT_FALSE(filter.Admit(AlreadyDanced("moved", 60)));
  EXPECT_TRUE(filter.Admit(AlreadyDanced("danced", 59)));
}

TEST(DeliveryFilterTest, ReportsRejectionsOfReachedKeysAfterAResumption) {
  const v1::Event reached = Reached("a", 30);
  DeliveryFilter filter(0, 0);
  EXPECT_TRUE(filter.Admit(reached));
  filter.Restart();
  EXPECT_FALSE(filter.Admit(reached));
  EXPECT_TRUE(filter.Admit(Rejected("a", 30)));  // sent anew
}

}  // namespace choreo::client::delivery_filter_test
