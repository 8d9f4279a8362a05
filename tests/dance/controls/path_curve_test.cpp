#include "model/dance/controls/path_validation.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "model/dance/controls/path_lead.h"
#include "model/dance/timeline/timeline.h"
#include "model/motion/rotation.h"
#include "tests/support/expect_error.h"

namespace choreo::path_curve_test {

RootPath Path(std::vector<int64_t> frames, const std::vector<Eigen::Vector3d>& points,
              bool has_heights = false) {
  RootPath path{.frames = std::move(frames)};
  for (const Eigen::Vector3d& point : points) {
    path.points.emplace_back(point.x(), point.z());
    if (has_heights) path.heights.push_back(point.y());
  }
  return path;
}

const std::vector<Eigen::Vector3d> kCorners = {{0, 0.9, 0},  {1, 0.5, 0},  {1, 1.2, 2},
                                               {-1, 0.9, 2}, {-1, 0.9, 2}, {0, 0.8, 1}};
const std::vector<int64_t> kFrames = {0, 30, 45, 100, 130, 190};

TEST(PathCurve, LeadsThroughItsPointsWithoutAKink) {
  const PathCurve curve(Path(kFrames, kCorners, true));
  for (size_t i = 0; i < kFrames.size(); ++i) {
    EXPECT_LT((curve.At(kFrames[i]).position - kCorners[i]).norm(), 1e-12);
  }
  // The velocity matches the positions on both sides of every point.
  for (int64_t frame = 1; frame < 190; ++frame) {
    const Eigen::Vector3d back = curve.At(frame).position - curve.At(frame - 1).position;
    const Eigen::Vector3d ahead = curve.At(frame + 1).position - curve.At(frame).position;
    EXPECT_LT((back - ahead).norm(), 0.03) << frame;
    EXPECT_LT((0.5 * (back + ahead) - curve.At(frame).velocity).norm(), 0.015) << frame;
  }
}

TEST(PathCurve, WalksAStraightLineEvenly) {
  const PathCurve two(Path({10, 110}, {{0, 0, 0}, {2, 0, 1}}));
  const PathCurve three(Path({10, 30, 110}, {{0, 0, 0}, {0.4, 0, 0.2}, {2, 0, 1}}));
  for (int64_t frame = 10; frame <= 110; ++frame) {
    const Eigen::Vector3d there = static_cast<double>(frame - 10) / 100 * Eigen::Vector3d(2, 0, 1);
    EXPECT_LT((two.At(frame).position - there).norm(), 1e-12);
    EXPECT_LT((three.At(frame).position - there).norm(), 1e-12);
  }
}

TEST(PathCurve, TracesACircle) {
  // A walk of ten seconds has a point each half second.
  std::vector<int64_t> frames;
  std::vector<Eigen::Vector3d> points;
  const auto on_circle = [](double frame) {
    const double angle = 2 * std::numbers::pi * frame / 300;
    return Eigen::Vector3d(2 * std::sin(angle), 0, 2 - 2 * std::cos(angle));
  };
  for (int64_t frame = 0; frame <= 300; frame += 15) {
    frames.push_back(frame);
    points.push_back(on_circle(static_cast<double>(frame)));
  }
  const PathCurve curve(Path(frames, points));
  for (int64_t frame = 0; frame <= 300; ++frame) {
    EXPECT_LT((curve.At(frame).position - on_circle(static_cast<double>(frame))).norm(), 0.015);
  }
}

TEST(PathCurve, StandsStillBetweenEqualPoints) {
  const PathCurve curve(Path(kFrames, kCorners));
  for (int64_t frame = 100; frame <= 130; ++frame) {
    EXPECT_LT((curve.At(frame).position - Eigen::Vector3d(-1, 0, 2)).norm(), 1e-12);
  }
}

TEST(PathCurve, TurnsWithItsPoints) {
  const Eigen::Matrix3d turn = HeadingRotation(0.7);
  const Eigen::Vector3d shift(3, 0, -1);
  std::vector<Eigen::Vector3d> moved;
  for (const Eigen::Vector3d& point : kCorners) moved.push_back(turn * point + shift);
  const PathCurve here(Path(kFrames, kCorners, true)), there(Path(kFrames, moved, true));
  for (int64_t frame = -1; frame <= 191; ++frame) {
    EXPECT_LT((turn * here.At(frame).position + shift - there.At(frame).position).norm(), 1e-12);
  }
}

TEST(RootPath, RefusesInvalidPaths) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const RootPath& path, const std::string& message) {
    ExpectError(ErrorCode::kInvalidArgument, message, [&] { CheckPath(path, "root_path"); });
  };
  refused(Path({}, {}), "root_path.points: 0 points, a path needs at least 2");
  refused(Path({4}, {{0, 0, 0}}), "root_path.points: 1 points, a path needs at least 2");
  refused(Path({0, 9, 20}, {{0, 0, 0}, {1, 0, 0}}), "root_path.points: 2 points for 3 frames");
  refused(Path({0, 9}, {{0, 0, 0}, {0, 0, nan}}), "root_path.points[3]: nan m is not within 10000");
  refused(Path({0, 9}, {{1e5, 0, 0}, {0, 0, 0}}), "root_path.points[0]: 100000 m is not within");
  refused(Path({0, 9}, {{0, 0, 0}, {0, nan, 0}}, true), "root_path.heights[1]: nan m");
  refused(Path({0, 9}, {{0, -0.1, 0}, {0, 1, 0}}, true),
          "root_path.heights[0]: -0.1 m above the floor is not in [0, 2]");
  refused(Path({0, 9}, {{0, 0, 0}, {0, 2.1, 0}}, true),
          "root_path.heights[1]: 2.1 m above the floor is not in [0, 2]");
  refused(Path({0, 9, 9}, {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}),
          "root_path.frames[2]: 9 is not after the frame before it, 9");
  refused(Path({-1, 9}, {{0, 0, 0}, {0, 0, 1}}), "root_path.frames[0]: -1 is not in [0, 108000]");
  // Ten hours.
  refused(Path({0, 1'080'000}, {{0, 0, 0}, {0, 0, 1}}),
          "root_path.frames[1]: 1080000 is not in [0, 108000]");
  EXPECT_NO_THROW(CheckPath(Path({0, kMaxDanceFrames}, {{0, nan, 0}, {0, 0, 1}}), "root_path"));
}

class LeadTest : public testing::Test {
 protected:
  LeadTest() {
    request_.first_frame = 100;
    request_.curves.assign(90, &curve_);
    request_.start = {curve_.At(99).position, curve_.At(99).position - curve_.At(98).position};
  }

  /// No step between frames changes by more than this, metres a frame.
  void ExpectSmooth(const Lead& lead, double limit) const {
    Eigen::Vector3d before = request_.start.position, step = request_.start.velocity;
    for (const auto& place : lead.path.colwise()) {
      const Eigen::Vector3d next = place - before;
      EXPECT_LT((next - step).norm(), limit);
      step = next;
      before = place;
    }
  }

  const PathCurve curve_{Path({0, 100, 150, 200}, {{0, 0, 0}, {2, 0, 1}, {3, 0, 1}, {4, 0, 2}})};
  LeadRequest request_;
};

TEST_F(LeadTest, FollowsTheCurveOfADancerWhoIsOnIt) {
  const Lead lead = LeadPath(request_);
  for (int frame = 0; frame < 90; ++frame) {
    EXPECT_LT((lead.path.col(frame) - curve_.At(100 + frame).position).norm(), 1e-12);
  }
  EXPECT_TRUE(lead.missed.isZero());
}

TEST_F(LeadTest, ReturnsSmoothlyToTheCurve) {
  request_.start.position += Eigen::Vector3d(0, 0, -0.6);
  const Lead lead = LeadPath(request_);
  ExpectSmooth(lead, 0.01);
  // 0.6 m at up to 1 m/s: 27 frames.
  EXPECT_GT((lead.path.col(20) - curve_.At(120).position).norm(), 0.05);
  EXPECT_LT((lead.path.col(27) - curve_.At(127).position).norm(), 1e-12);
}

// A dancer who waited before the path, or held a pose on it, starts without a jerk.
TEST_F(LeadTest, SetsOutFromRest) {
  request_.start.velocity.setZero();
  const Lead lead = LeadPath(request_);
  ExpectSmooth(lead, 0.01);
  EXPECT_GT((lead.path.col(5) - curve_.At(105).position).norm(), 0.02);
  EXPECT_LT((lead.path.col(15) - curve_.At(115).position).norm(), 1e-12);
}

TEST_F(LeadTest, ComesToRestOnTheCurve) {
  request_.rests = true;
  const Lead lead = LeadPath(request_);
  ExpectSmooth(lead, 0.01);
  EXPECT_LT((lead.path.col(89) - curve_.At(189).position).norm(), 1e-12);
  EXPECT_LT((lead.path.col(89) - lead.path.col(88)).norm(), 0.1 * curve_.At(189).velocity.norm());
  EXPECT_LT((lead.path.col(60) - curve_.At(160).position).norm(), 1e-12);
  // The dancer does so on the path, not beside it.
  for (int frame = 65; frame < 90; ++frame) {
    double nearest = 1;
    for (double at = 160; at < 190; at += 0.01)
      nearest = std::min(nearest, (lead.path.col(frame) - curve_.At(at).position).norm());
    EXPECT_LT(nearest, 1e-3) << frame;
  }
}

TEST_F(LeadTest, EndsAtItsTarget) {
  request_.end = PathPoint{curve_.At(189).position + Eigen::Vector3d(0.3, 0, 0.4), {0, 0, 0}};
  const Lead lead = LeadPath(request_);
  EXPECT_LT((lead.path.col(89) - request_.end->position).norm(), 1e-12);
  EXPECT_LT((lead.missed - Eigen::Vector3d(0.3, 0, 0.4)).norm(), 1e-12);
  EXPECT_LT((lead.path.col(60) - curve_.At(160).position).norm(), 1e-12);
  ExpectSmooth(lead, 0.01);
}

TEST_F(LeadTest, BridgesFramesWithoutACurve) {
  std::fill_n(request_.curves.begin(), 50, nullptr);
  std::fill_n(request_.curves.begin() + 70, 20, nullptr);
  request_.start.position += Eigen::Vector3d(0, 0, -1);
  request_.end = PathPoint{{3.6, 0, 1.6}, {0, 0, 0}};
  const Lead lead = LeadPath(request_);
  ExpectSmooth(lead, 0.01);
  for (int frame = 50; frame < 70; ++frame) {
    EXPECT_LT((lead.path.col(frame) - curve_.At(100 + frame).position).norm(), 1e-12);
  }
  EXPECT_LT((lead.path.col(89) - request_.end->position).norm(), 1e-12);
  EXPECT_TRUE(lead.missed.isZero());  // nobody said where to be there
}

// A key right after the curve's end is no reason to jump, and asks what one on its end would.
TEST_F(LeadTest, BendsTheCurveToAnEndTooSoonAfterIt) {
  const Eigen::Vector3d beside(0.3, 0, -0.4);
  for (const int gap : {1, 2, 9}) {
    std::fill(request_.curves.end() - gap, request_.curves.end(), nullptr);
    request_.end = PathPoint{curve_.At(189).position + beside, {0, 0, 0}};
    const Lead lead = LeadPath(request_);
    EXPECT_LT((lead.path.col(89) - request_.end->position).norm(), 1e-12);
    EXPECT_LT((lead.path.col(60) - curve_.At(160).position).norm(), 1e-12);
    EXPECT_NEAR(lead.missed.norm(), 0.5, 0.05) << gap;
    ExpectSmooth(lead, 0.01);
  }
}

TEST_F(LeadTest, TargetFurtherAlongTheCurveIsNotMissed) {
  std::fill(request_.curves.end() - 3, request_.curves.end(), nullptr);
  for (const int further : {0, 1, 3}) {
    request_.end =
        PathPoint{curve_.At(186).position + further * curve_.At(186).velocity, {0, 0, 0}};
    const Lead lead = LeadPath(request_);
    EXPECT_LT(lead.missed.norm(), 1e-12) << further;
    EXPECT_LT((lead.path.col(86) - curve_.At(186).position).norm(), 1e-12);
    EXPECT_LT((lead.path.col(89) - request_.end->position).norm(), 1e-12);
  }
}

TEST_F(LeadTest, HoldsThePlaceWithoutACurve) {
  std::fill(request_.curves.begin() + 30, request_.curves.end(), nullptr);
  const Lead lead = LeadPath(request_);
  for (int frame = 30; frame < 90; ++frame) {
    EXPECT_LT((lead.path.col(frame) - curve_.At(129).position).norm(), 1e-12);
  }
}

TEST_F(LeadTest, GoesOverToAnotherCurve) {
  const PathCurve other(Path({0, 200}, {{0, 0, 1}, {4, 0, 1}}));
  std::fill(request_.curves.begin() + 40, request_.curves.end(), &other);
  const Lead lead = LeadPath(request_);
  EXPECT_LT((lead.path.col(39) - curve_.At(139).position).norm(), 1e-12);
  EXPECT_LT((lead.path.col(89) - other.At(189).position).norm(), 1e-12);
  ExpectSmooth(lead, 0.02);
}

TEST_F(LeadTest, ChangesOnlyItsAxes) {
  request_.axes = {0, 1, 0};
  request_.curves.assign(90, nullptr);
  request_.start.position.y() = 0.6;
  request_.end = PathPoint{{5, 0.9, 5}, {0, 0, 0}};
  const Lead lead = LeadPath(request_);
  EXPECT_TRUE(lead.path.row(0).isZero() && lead.path.row(2).isZero());
  EXPECT_NEAR(lead.path(1, 89), 0.9, 1e-12);
  for (int frame = 1; frame < 90; ++frame) EXPECT_GE(lead.path(1, frame), lead.path(1, frame - 1));
}

}  // namespace choreo::path_curve_test
