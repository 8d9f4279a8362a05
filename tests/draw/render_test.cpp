#include "model/draw/render.h"

#include <gtest/gtest.h>

#include <limits>

#include "model/body/doll.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/support/expect_error.h"

namespace choreo::render_test {

const Skeleton& kSmpl = Skeleton::Smpl24();

Picture Draw(const Pose& pose, const View& view, const FrameStyle& style = {}) {
  Picture picture{.width = 120, .height = 150, .rgb = {}};
  DrawFrame(kSmpl, pose, view, style, picture);
  return picture;
}

// The dancer stays in the middle.
View FollowView(const Pose& pose, double azimuth) {
  return {.target = {pose.root_position.x(), 0.95, pose.root_position.z()}, .azimuth = azimuth};
}

// Mean column and row of the pixels that are coloured like one side of the body, and their number.
struct Blob {
  double x = 0, y = 0;
  int pixels = 0;
};
Blob Find(const Picture& picture, bool left) {
  Blob blob;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const uint8_t* rgb = &picture.rgb[3 * (y * picture.width + x)];
      const bool match = left ? rgb[0] > rgb[2] + 90 : rgb[2] > rgb[0] + 60;
      if (!match) continue;
      blob.x += x, blob.y += y, ++blob.pixels;
    }
  }
  if (blob.pixels > 0) blob.x /= blob.pixels, blob.y /= blob.pixels;
  return blob;
}

TEST(Render, LeftIsOnTheRightOfADancerWhoFacesUs) {
  const Pose pose = RestPose(kSmpl);
  const Picture front = Draw(pose, FollowView(pose, 0));
  const Blob left = Find(front, true), right = Find(front, false);
  EXPECT_GT(left.pixels, 200);
  EXPECT_GT(right.pixels, 200);
  EXPECT_GT(left.x, right.x + 10);
  const Picture back = Draw(pose, FollowView(pose, M_PI));
  EXPECT_LT(Find(back, true).x, Find(back, false).x - 10);
}

TEST(Render, TheCameraFollowsAndTheFloorStays) {
  Pose pose = RestPose(kSmpl);
  const Picture here = Draw(pose, FollowView(pose, 0.6));
  pose.root_position += Eigen::Vector3d(3, 0, -2);  // whole squares of the grid
  const Picture there = Draw(pose, FollowView(pose, 0.6));
  int different = 0;
  for (size_t i = 0; i < here.rgb.size(); ++i) {
    different += std::abs(int{here.rgb[i]} - int{there.rgb[i]}) > 3;
  }
  EXPECT_LT(different, 200);       // of 54 000: rounding at edges
  pose.root_position.x() += 0.25;  // half a square: the lines have moved
  const Picture between = Draw(pose, FollowView(pose, 0.6));
  different = 0;
  for (size_t i = 0; i < here.rgb.size(); ++i) {
    different += std::abs(int{here.rgb[i]} - int{between.rgb[i]}) > 3;
  }
  EXPECT_GT(different, 400);
}

TEST(Render, AJumpRaisesTheDancerByItsHeight) {
  Pose pose = RestPose(kSmpl);
  const View view = FollowView(pose, 0);
  const Blob standing = Find(Draw(pose, view), true);
  pose.root_position.y() += 0.3;
  const Blob jumping = Find(Draw(pose, view), true);
  EXPECT_NEAR(standing.y - jumping.y, 0.3 / view.extent * 150, 3);
}

TEST(Render, TheSameInputGivesTheSameBytes) {
  const Pose pose = RestPose(kSmpl);
  EXPECT_EQ(Draw(pose, FollowView(pose, 0.6)).rgb, Draw(pose, FollowView(pose, 0.6)).rgb);
}

// Most pixels of a body are the mean of their neighbours: a picture twice as large shows the same.
TEST(Render, PixelsBetweenOthersAreAsIfDrawn) {
  const Pose pose = RestPose(kSmpl);
  const auto draw = [&](int scale) {
    Picture picture{.width = 200 * scale, .height = 250 * scale, .rgb = {}};
    DrawFrame(kSmpl, pose, FollowView(pose, 0.6), {}, picture);
    return picture;
  };
  const Picture one = draw(1), two = draw(2);
  double squares = 0;
  for (int y = 0; y < one.height; ++y) {
    for (int x = 0; x < 3 * one.width; ++x) {
      const int column = 6 * (x / 3) + x % 3;
      const auto at = [&](int i, int j) {
        return int{two.rgb[static_cast<size_t>((2 * y + j) * 3 * two.width + column + 3 * i)]};
      };
      const double mean = (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / 4.0;
      const double off = one.rgb[static_cast<size_t>(y * 3 * one.width + x)] - mean;
      squares += off * off;
    }
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(one.rgb.size())), 3);  // of 255
}

TEST(Render, OtherSkeletonsAreSticks) {
  Skeleton chain;
  chain.name = "chain";
  chain.joint_names = {"root", "left_tip", "right_tip"};
  chain.parents = {-1, 0, 0};
  chain.offsets.setZero(3, 3);
  chain.offsets.col(1) << 0.5, 0, 0;
  chain.offsets.col(2) << -0.5, 0, 0;
  Pose pose;
  pose.root_position.y() = 1;
  pose.rotations.setZero(3, 3);
  EXPECT_EQ(BuildDoll(chain, pose).size(), 2u);
  Picture picture{.width = 120, .height = 150, .rgb = {}};
  DrawFrame(chain, pose, FollowView(pose, 0), {}, picture);
  EXPECT_GT(Find(picture, true).x, Find(picture, false).x + 10);
}

TEST(Render, RefusesWhatItCannotDraw) {
  const Pose pose = RestPose(kSmpl);
  const auto refuse = [&](const std::string& part, const View& view, const FrameStyle& style,
                          int width) {
    Picture picture{.width = width, .height = 10, .rgb = {}};
    ExpectError(ErrorCode::kInvalidArgument, part,
                [&] { DrawFrame(kSmpl, pose, view, style, picture); });
  };
  refuse("picture.width: 0", {}, {}, 0);
  refuse("view.extent", {.extent = 0}, {}, 10);
  refuse("style.samples: 9", {}, {.samples = 9}, 10);
  Pose infinite = pose;
  infinite.root_position.x() = std::numeric_limits<double>::infinity();
  Picture wanted{.width = 10, .height = 10, .rgb = {}};
  ExpectError(ErrorCode::kInvalidArgument, "pose: holds values that are not finite",
              [&] { DrawFrame(kSmpl, infinite, {}, {}, wanted); });
  Pose other;
  other.rotations.setZero(3, 5);
  Picture picture{.width = 10, .height = 10, .rgb = {}};
  EXPECT_THROW(DrawFrame(kSmpl, other, {}, {}, picture), Error);
}

}  // namespace choreo::render_test
