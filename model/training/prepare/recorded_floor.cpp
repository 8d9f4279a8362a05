#include "model/training/prepare/recorded_floor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/core/numbers/quantile.h"

namespace choreo {
namespace {

constexpr double kFloorQuantile = 0.05;
constexpr double kMaxSlope = 0.15;
constexpr double kMinExtent = 1.0;
constexpr double kDriftKnotSeconds = 15.0;
constexpr double kDriftWindowSeconds = 8;

// The lowest foot of every frame: [3, frames].
Eigen::Matrix3Xd LowestFeet(const PositionClip& clip, const std::vector<int>& foot_joints) {
  Eigen::Matrix3Xd lowest(3, clip.frames.size());
  for (size_t frame = 0; frame < clip.frames.size(); ++frame) {
    const Eigen::Matrix3Xd& positions = clip.frames[frame];
    lowest.col(frame) = positions.col(
        *std::ranges::min_element(foot_joints, {}, [&](int joint) { return positions(1, joint); }));
  }
  return lowest;
}

double Extent(const Eigen::RowVectorXd& row) {
  const std::vector<double> values(row.begin(), row.end());
  return Quantile(values, 0.95) - Quantile(values, 0.05);
}

}  // namespace

FloorPlane FitFloorPlane(const PositionClip& clip, const std::vector<int>& foot_joints) {
  CheckClip(clip);
  const Eigen::Matrix3Xd feet = LowestFeet(clip, foot_joints);
  const std::vector<double> heights(feet.row(1).begin(), feet.row(1).end());
  FloorPlane plane;
  plane.height = Quantile(heights, kFloorQuantile);
  if (Extent(feet.row(0)) < kMinExtent || Extent(feet.row(2)) < kMinExtent) return plane;
  // Quantile regression by iteratively reweighted least squares. The height drifts in time,
  // piecewise linearly between knots. Otherwise a dancer who crosses a drifting floor once would
  // seem to climb a slope.
  const auto count = static_cast<int>(feet.cols());
  const int knots =
      1 + std::max(1, static_cast<int>(std::lround(count / clip.fps / kDriftKnotSeconds)));
  const Eigen::Vector3d centre = feet.rowwise().mean();
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(knots + 2);  // heights at the knots, slopes
  solution.head(knots).setConstant(plane.height);
  Eigen::VectorXd row(knots + 2);
  for (int iteration = 0; iteration < 50; ++iteration) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(knots + 2, knots + 2);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(knots + 2);
    for (int i = 0; i < count; ++i) {
      const double place = static_cast<double>(i) / std::max(1, count - 1) * (knots - 1);
      const int knot = std::min(static_cast<int>(place), knots - 2);
      row.setZero();
      row[knot] = knot + 1 - place;
      row[knot + 1] = place - knot;
      row[knots] = feet(0, i) - centre.x();
      row[knots + 1] = feet(2, i) - centre.z();
      const double residual = feet(1, i) - row.dot(solution);
      const double weight = (residual > 0 ? kFloorQuantile : 1 - kFloorQuantile) /
                            std::max(std::abs(residual), 0.005);
      normal += weight * row * row.transpose();
      right += weight * feet(1, i) * row;
    }
    // Knots at which no foot comes down follow the overall height.
    for (int knot = 0; knot < knots; ++knot) {
      normal(knot, knot) += 1e-3 * count;
      right[knot] += 1e-3 * count * plane.height;
    }
    solution = normal.ldlt().solve(right);
  }
  Eigen::Vector2d slope = solution.tail<2>();
  if (slope.norm() > kMaxSlope) slope *= kMaxSlope / slope.norm();
  plane.slope_x = slope.x();
  plane.slope_z = slope.y();
  plane.height = solution.head(knots).mean() - slope.x() * centre.x() - slope.y() * centre.z();
  return plane;
}

PositionClip LevelFloor(const PositionClip& clip, const FloorPlane& plane) {
  const Eigen::Vector3d normal = Eigen::Vector3d(-plane.slope_x, 1, -plane.slope_z).normalized();
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond::FromTwoVectors(normal, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Vector3d floor_point(0, plane.height, 0);
  PositionClip result = clip;
  for (Eigen::Matrix3Xd& frame : result.frames) frame = turn * (frame.colwise() - floor_point);
  return result;
}

PositionClip RemoveHeightDrift(const PositionClip& clip, const std::vector<int>& foot_joints) {
  CheckClip(clip);
  const Eigen::Matrix3Xd feet = LowestFeet(clip, foot_joints);
  const std::vector<double> floor =
      SlowQuantile({feet.row(1).begin(), feet.row(1).end()}, 0.1, kDriftWindowSeconds * clip.fps);
  PositionClip result = clip;
  for (size_t frame = 0; frame < floor.size(); ++frame)
    result.frames[frame].row(1).array() -= floor[frame];
  return result;
}

}  // namespace choreo
