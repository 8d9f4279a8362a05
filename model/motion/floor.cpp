// The floor under a recording: fit, level, and take out drift.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "model/core/error.h"
#include "model/motion/position_clip.h"

namespace choreo {
namespace {

constexpr double kFloorQuantile = 0.05;
constexpr double kMaximalSlope = 0.15;
constexpr double kLeastExtent = 1.0;

// The lowest foot of every frame: [3, frames].
Eigen::Matrix3Xd LowestFeet(const PositionClip& clip, const std::vector<int>& foot_joints) {
  if (foot_joints.empty()) throw InvalidArgument("foot_joints", "0 joints, at least 1 is needed");
  Eigen::Matrix3Xd lowest(3, clip.frames.size());
  for (size_t frame = 0; frame < clip.frames.size(); ++frame) {
    const Eigen::Matrix3Xd& positions = clip.frames[frame];
    for (size_t i = 0; i < foot_joints.size(); ++i) {
      if (foot_joints[i] < 0 || foot_joints[i] >= positions.cols()) {
        throw InvalidArgument("foot_joints", "joint " + std::to_string(foot_joints[i]) +
                                                 ", must be 0 to " +
                                                 std::to_string(positions.cols() - 1));
      }
      const Eigen::Vector3d foot = positions.col(foot_joints[i]);
      if (i == 0 || foot.y() < lowest(1, frame)) lowest.col(frame) = foot;
    }
  }
  return lowest;
}

double Quantile(std::vector<double> values, double q) {
  const auto index = static_cast<size_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(index),
                   values.end());
  return values[index];
}

double Extent(const Eigen::RowVectorXd& row) {
  const std::vector<double> values(row.begin(), row.end());
  return Quantile(values, 0.95) - Quantile(values, 0.05);
}

}  // namespace

FloorPlane FitFloorPlane(const PositionClip& clip, const std::vector<int>& foot_joints) {
  ValidateClip(clip);
  const Eigen::Matrix3Xd feet = LowestFeet(clip, foot_joints);
  const bool tilts = Extent(feet.row(0)) >= kLeastExtent && Extent(feet.row(2)) >= kLeastExtent;
  const std::vector<double> heights(feet.row(1).begin(), feet.row(1).end());
  FloorPlane plane;
  plane.height = Quantile(heights, kFloorQuantile);
  if (!tilts) return plane;
  // Quantile regression by iteratively reweighted least squares, around the feet's centre for the
  // sake of conditioning.
  const Eigen::Vector3d centre = feet.rowwise().mean();
  Eigen::Vector3d solution(plane.height, 0, 0);  // height at the centre, slopes
  for (int iteration = 0; iteration < 50; ++iteration) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < feet.cols(); ++i) {
      const Eigen::Vector3d row(1, feet(0, i) - centre.x(), feet(2, i) - centre.z());
      const double residual = feet(1, i) - row.dot(solution);
      const double weight = (residual > 0 ? kFloorQuantile : 1 - kFloorQuantile) /
                            std::max(std::abs(residual), 0.005);
      normal += weight * row * row.transpose();
      right += weight * feet(1, i) * row;
    }
    solution = normal.ldlt().solve(right);
  }
  const double slope = solution.tail<2>().norm();
  if (slope > kMaximalSlope) solution.tail<2>() *= kMaximalSlope / slope;
  plane.slope_x = solution[1];
  plane.slope_z = solution[2];
  plane.height = solution[0] - plane.slope_x * centre.x() - plane.slope_z * centre.z();
  return plane;
}

PositionClip LevelFloor(const PositionClip& clip, const FloorPlane& plane) {
  ValidateClip(clip);
  const Eigen::Vector3d normal = Eigen::Vector3d(-plane.slope_x, 1, -plane.slope_z).normalized();
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond::FromTwoVectors(normal, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Vector3d floor_point(0, plane.height, 0);
  PositionClip result = clip;
  for (Eigen::Matrix3Xd& frame : result.frames) frame = turn * (frame.colwise() - floor_point);
  return result;
}

PositionClip RemoveHeightDrift(const PositionClip& clip, const std::vector<int>& foot_joints,
                               double window_s) {
  ValidateClip(clip);
  const Eigen::Matrix3Xd feet = LowestFeet(clip, foot_joints);
  const auto count = static_cast<int>(clip.frames.size());
  const int half = std::max(1, static_cast<int>(std::lround(0.5 * window_s * clip.fps)));
  std::vector<double> floor(count);
  for (int frame = 0; frame < count; ++frame) {
    const int first = std::max(0, frame - half);
    const int last = std::min(count - 1, frame + half);
    floor[frame] = Quantile({feet.row(1).begin() + first, feet.row(1).begin() + last + 1}, 0.1);
  }
  PositionClip result = clip;
  for (int frame = 0; frame < count; ++frame) {
    const int first = std::max(0, frame - half);
    const int last = std::min(count - 1, frame + half);
    double sum = 0;
    for (int i = first; i <= last; ++i) sum += floor[i];
    result.frames[frame].row(1).array() -= sum / (last - first + 1);
  }
  return result;
}

}  // namespace choreo
