#include "server/calls/player.h"

#include <gtest/gtest.h>

#include <chrono>

namespace choreo::player_test {

using std::chrono::seconds;

constexpr double kFps = 10;

class PlayerTest : public testing::Test {
 protected:
  // For frames that are made and sent this many seconds after the start.
  double Late(int64_t first_frame, int made, int sent) {
    return player_.Record(first_frame, begin_ + seconds(made), begin_ + seconds(sent));
  }

 private:
  const Player::Clock::time_point begin_ = Player::Clock::now();
  Player player_{kFps};
};

TEST_F(PlayerTest, FramesInTimeAreNotLate) {
  EXPECT_NEAR(Late(0, 0, 0), 0, 1e-9);
  EXPECT_NEAR(Late(10, 1, 1), 0, 1e-9);
  EXPECT_NEAR(Late(20, 2, 2), 0, 1e-9);
}

// The frames of a whole song are made at once, and read no faster than they are played.
TEST_F(PlayerTest, FramesMayWaitUntilTheyArePlayed) {
  EXPECT_NEAR(Late(0, 0, 0), 0, 1e-9);
  EXPECT_NEAR(Late(10, 0, 1), 0, 1e-9);
  EXPECT_NEAR(Late(100, 0, 10), 0, 1e-9);
  EXPECT_NEAR(Late(110, 0, 13), 2, 1e-9);
}

TEST_F(PlayerTest, LateFramesHaveThePlayerWait) {
  EXPECT_NEAR(Late(0, 0, 3), 3, 1e-9);
  EXPECT_NEAR(Late(10, 1, 4), 0, 1e-9);
  EXPECT_NEAR(Late(20, 2, 7), 2, 1e-9);
}

// The client sent its music late, or the engine was slow.
TEST_F(PlayerTest, FramesThatWereMadeLateAreNotLateAgain) {
  EXPECT_NEAR(Late(0, 0, 0), 0, 1e-9);
  EXPECT_NEAR(Late(10, 5, 5), 0, 1e-9);
  EXPECT_NEAR(Late(20, 6, 7), 1, 1e-9);
}

// A resumed dance does not begin with frame 0.
TEST_F(PlayerTest, BeginsWithAnyFrame) {
  EXPECT_NEAR(Late(1000, 2, 2), 0, 1e-9);
  EXPECT_NEAR(Late(1010, 3, 4), 1, 1e-9);
}

}  // namespace choreo::player_test
