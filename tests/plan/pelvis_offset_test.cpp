#include "model/plan/pelvis_offset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/core/numbers/smooth_step.h"
#include "model/motion/floor/support.h"

namespace choreo::pelvis_offset_test {

constexpr double kFps = 30, kHeight = 1;
constexpr int kFrames = 60;

BodyCentre At(double x, double y) { return {.exact = {x, y, 0}, .smooth = {x, y, 0}}; }

void Move(const Eigen::Vector3d& by, SupportFrame* frame) {
  frame->centre.exact += by;
  frame->centre.smooth += by;
}

// The centre of mass before a plan, at rest or moving by `step` a frame.
std::array<BodyCentre, 2> Before(double x = 0, double y = kHeight, double step = 0) {
  return {At(x - step, y), At(x, y)};
}

// A body standing still, feet `beside` the centre of mass.
std::vector<SupportFrame> Still(double beside) {
  SupportFrame frame;
  frame.support = {
      {beside - 0.05, -0.1}, {beside + 0.05, -0.1}, {beside - 0.05, 0.1}, {beside + 0.05, 0.1}};
  frame.centre = At(0, kHeight);
  frame.legs = {{.to_ankle = {0, -0.7, 0}, .length = 0.8}};
  return std::vector<SupportFrame>(kFrames, frame);
}

TEST(PelvisOffset, LeavesABalancedPelvis) {
  EXPECT_NEAR(PelvisOffset(Still(0), Before(), {.fps = kFps}).norm(), 0, 1e-9);
}

TEST(PelvisOffset, MovesOverTheFeet) {
  const Eigen::Matrix3Xd offset = PelvisOffset(Still(0.3), Before(), {.fps = kFps});
  EXPECT_GT(offset(0, kFrames - 1), 0.1);
  EXPECT_NEAR(offset.row(2).norm(), 0, 1e-9);
  // The first frame continues the one before, in which nothing was moved.
  EXPECT_LT(offset.col(0).norm(), 0.02);
}

// An inverted pendulum that topples has its zero moment point at its feet all the way.
TEST(PelvisOffset, HoldsATopplingBody) {
  std::vector<SupportFrame> frames = Still(0);
  const auto beside = [](int frame) {
    return 0.01 * std::cosh(std::sqrt(kGravity / kHeight) * frame / kFps);
  };
  for (int i = 0; i < kFrames; ++i) Move({beside(i), 0, 0}, &frames[static_cast<size_t>(i)]);
  ASSERT_GT(beside(45), 0.4);
  const Eigen::Matrix3Xd offset =
      PelvisOffset(frames, Before(beside(-1)), {.returns = true, .fps = kFps});
  EXPECT_LT(offset(0, 45), -0.1);
}

TEST(PelvisOffset, LowersForShortLegs) {
  std::vector<SupportFrame> frames = Still(0);
  for (int i = 20; i < 40; ++i) frames[static_cast<size_t>(i)].legs[0].to_ankle.y() = -0.85;
  const Eigen::Matrix3Xd offset = PelvisOffset(frames, Before(), {.fps = kFps});
  EXPECT_NEAR(offset(1, 30), 0.985 * 0.8 - 0.85, 0.01);
}

double Acceleration(const std::vector<SupportFrame>& frames, const Eigen::Matrix3Xd& offset,
                    int frame) {
  const auto height = [&](int i) {
    return frames[static_cast<size_t>(i)].centre.exact.y() + offset(1, i);
  };
  return (height(frame + 1) - 2 * height(frame) + height(frame - 1)) * kFps * kFps;
}

void Fly(std::vector<SupportFrame>* frames, int from, int to) {
  for (int i = from; i < to; ++i) {
    (*frames)[static_cast<size_t>(i)].support.clear();
    (*frames)[static_cast<size_t>(i)].legs.clear();
  }
}

TEST(PelvisOffset, FallsInFlight) {
  std::vector<SupportFrame> frames = Still(0);
  Fly(&frames, 25, 35);
  const Eigen::Matrix3Xd offset = PelvisOffset(frames, Before(), {.fps = kFps});
  for (int i = 27; i < 33; ++i) EXPECT_NEAR(Acceleration(frames, offset, i), -kGravity, 1.5) << i;
  EXPECT_GT(offset(1, 30), offset(1, 20) + 0.05);  // so it leaps
}

// Nothing brakes a body in the air: plans that did were danced so.
TEST(PelvisOffset, KeepsItsVelocityInFlight) {
  std::vector<SupportFrame> frames = Still(0);
  Fly(&frames, 25, 35);
  for (int i = 20; i < kFrames; ++i)
    Move({0.3 * SmoothStep(std::min(1.0, (i - 20) / 10.0)), 0, 0}, &frames[static_cast<size_t>(i)]);
  const Eigen::Matrix3Xd offset = PelvisOffset(frames, Before(), {.fps = kFps});
  const auto speed = [&](int i) {
    const auto x = [&](int at) {
      return frames[static_cast<size_t>(at)].centre.exact.x() + offset(0, at);
    };
    return (x(i + 1) - x(i)) * kFps;
  };
  for (int i = 25; i < 34; ++i) EXPECT_NEAR(speed(i), speed(24), 0.1) << i;
}

// Whoever rises from her hands or seat has no legs to jump with, also shortly afterwards.
TEST(PelvisOffset, RisesFromTheFloorWithoutALeap) {
  for (const int feet_from : {30, 21}) {
    std::vector<SupportFrame> frames = Still(0);
    Fly(&frames, 0, 20);
    for (size_t i = 0; i < 20; ++i) {
      frames[i].support = {{0, 0}};
      frames[i].carried = true;
    }
    Fly(&frames, 20, feet_from);
    if (feet_from < 25) Fly(&frames, 25, 35);
    const Eigen::Matrix3Xd offset = PelvisOffset(frames, Before(), {.fps = kFps});
    EXPECT_LT(offset.row(1).cwiseAbs().maxCoeff(), 0.01) << feet_from;
    std::ranges::reverse(frames);
    const Eigen::Matrix3Xd down = PelvisOffset(frames, Before(), {.fps = kFps});
    EXPECT_LT(down.row(1).cwiseAbs().maxCoeff(), 0.01) << feet_from;
  }
  std::vector<SupportFrame> frames = Still(0);
  Fly(&frames, 0, 6);
  for (int i = 0; i < 6; ++i)
    Move({0, 0.125 * (1 + std::cos(i * M_PI / 6)), 0}, &frames[static_cast<size_t>(i)]);
  const auto moved = [&](int since_carried) {
    const PelvisRules rules{.since_carried = since_carried, .fps = kFps};
    const Eigen::Matrix3Xd offset = PelvisOffset(frames, Before(0, kHeight + 0.25), rules);
    return offset.row(1).cwiseAbs().maxCoeff();
  };
  EXPECT_GT(moved(20), 0.02);
  for (const int since : {1, 5}) EXPECT_LT(moved(since), 0.005) << since;
  // She has stood for three frames only.
  frames = Still(0);
  Fly(&frames, 2, 12);
  EXPECT_GT(moved(20), 0.02);
  EXPECT_LT(moved(1), 0.005);
}

// Legs that are long enough once the body moves over its feet must not lift it as well.
TEST(PelvisOffset, FindsTheLeastOfBalanceAndReach) {
  std::vector<SupportFrame> frames = Still(0);
  for (int i = 10; i < 40; ++i) {
    SupportFrame& frame = frames[static_cast<size_t>(i)];
    frame.legs = {{.to_ankle = {0, -0.3, -0.8}, .length = 0.85}};
    frame.support = {{0, -0.8}};
  }
  const Eigen::Matrix3Xd offset = PelvisOffset(frames, Before(), {.returns = true, .fps = kFps});
  EXPECT_LT(offset.row(2).minCoeff(), -0.1);
  EXPECT_LT(offset.row(1).cwiseAbs().maxCoeff(), 0.03);
}

// Plans end at keys, and a key in the air cuts a flight in two.
TEST(PelvisOffset, LeapsToAKeyInTheAirFromACrouch) {
  std::vector<SupportFrame> frames = Still(0);
  Fly(&frames, 53, kFrames);
  for (int i = 48; i < kFrames; ++i)
    Move({0, 0.25 * (i - 47) / (kFrames - 48), 0}, &frames[static_cast<size_t>(i)]);
  const Eigen::Matrix3Xd offset = PelvisOffset(frames, Before(), {.returns = true, .fps = kFps});
  for (int i = 54; i < 58; ++i) EXPECT_NEAR(Acceleration(frames, offset, i), -kGravity, 2.5) << i;
  EXPECT_EQ(offset(1, kFrames - 1), 0);
  EXPECT_LT(offset.row(1).minCoeff(), -0.04);  // before
}

TEST(PelvisOffset, FallsFromAKeyInTheAir) {
  std::vector<SupportFrame> frames = Still(0);
  Fly(&frames, 0, 6);
  for (int i = 0; i < 7; ++i)
    Move({0, 0.25 * (1 - (i + 1) * (i + 1) / 49.0), 0}, &frames[static_cast<size_t>(i)]);
  const Eigen::Matrix3Xd offset = PelvisOffset(frames, Before(0, kHeight + 0.25), {.fps = kFps});
  for (int i = 1; i < 5; ++i) EXPECT_NEAR(Acceleration(frames, offset, i), -kGravity, 2.5) << i;
  // A body that would fall through the floor does not fall freely.
  Fly(&frames, 0, 15);
  const Eigen::Matrix3Xd glide = PelvisOffset(frames, Before(0, kHeight + 0.25), {.fps = kFps});
  EXPECT_GT(glide.row(1).minCoeff(), -0.1);
}

// A key in the air stops nothing, either: she flies on as she reached it.
TEST(PelvisOffset, FliesOnThroughAKeyInTheAir) {
  std::vector<SupportFrame> frames = Still(0);
  Fly(&frames, 0, 6);
  for (int i = 0; i < 6; ++i)
    Move({0, 0.25 * (1 - (i + 1) * (i + 1) / 49.0), 0}, &frames[static_cast<size_t>(i)]);
  const Eigen::Matrix3Xd offset =
      PelvisOffset(frames, Before(0, kHeight + 0.25, 0.03), {.fps = kFps});
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(offset(0, i), 0.03 * (i + 1), 0.015) << i;
}

TEST(PelvisOffset, KeepsKeysAndPaths) {
  const Eigen::Matrix3Xd keyed = PelvisOffset(Still(0.3), Before(), {.returns = true, .fps = kFps});
  EXPECT_EQ(keyed.col(kFrames - 1).norm(), 0);
  EXPECT_GT(keyed(0, kFrames / 2), 0.03);
  std::vector<SupportFrame> frames = Still(0.3);
  for (SupportFrame& frame : frames) frame.legs[0].to_ankle.y() = -0.85;
  const Eigen::Matrix3Xd on_path =
      PelvisOffset(frames, Before(), {.heights_alone = true, .fps = kFps});
  EXPECT_EQ(on_path.row(0).norm() + on_path.row(2).norm(), 0);
  EXPECT_LT(on_path(1, 30), -0.03);
}

TEST(PelvisOffset, ContinuesFromThePreviousPiece) {
  Eigen::Matrix<double, 3, 2> before;
  before << 0.10, 0.11, 0, 0, 0, 0;
  const Eigen::Matrix3Xd offset = PelvisOffset(Still(0), Before(), {.before = before, .fps = kFps});
  EXPECT_NEAR(offset(0, 0), 0.11, 0.01);
  EXPECT_LT(offset(0, kFrames - 1), 0.08);
}

}  // namespace choreo::pelvis_offset_test
