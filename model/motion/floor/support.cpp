#include "model/motion/floor/support.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "model/motion/kinematics/body_mass.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

constexpr double kSmoothFrames = 1.5;

// Positive if a, b, c turn left.
double Turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d ab = b - a, ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

// Counter-clockwise, by Andrew's monotone chain.
std::vector<Eigen::Vector2d> ConvexHull(std::vector<Eigen::Vector2d> points) {
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::ranges::sort(points, before);
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> hull;
  const auto walk = [&](auto from, auto to) {
    const size_t start = hull.size();
    for (auto point = from; point != to; ++point) {
      while (hull.size() >= start + 2 && Turn(hull[hull.size() - 2], hull.back(), *point) <= 0)
        hull.pop_back();
      hull.push_back(*point);
    }
    hull.pop_back();  // the other half begins with it
  };
  walk(points.begin(), points.end());
  walk(points.rbegin(), points.rend());
  return hull;
}

Eigen::Vector2d NearestOnSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                                 const Eigen::Vector2d& b) {
  const Eigen::Vector2d ab = b - a;
  const double square = ab.squaredNorm();
  return a + (square > 0 ? std::clamp((p - a).dot(ab) / square, 0.0, 1.0) : 0) * ab;
}

// The floor's height in the rest pose: the lower toes'.
double RestFloor(const Skeleton& skeleton) {
  const Eigen::Matrix3Xd rest = JointPositions(skeleton, RestPose(skeleton));
  return std::min(rest(1, skeleton.feet[1]), rest(1, skeleton.feet[3]));
}

}  // namespace

Eigen::Vector2d NearestInHull(const Eigen::Vector2d& point, std::vector<Eigen::Vector2d> others) {
  const std::vector<Eigen::Vector2d> hull = ConvexHull(std::move(others));
  Eigen::Vector2d nearest = hull.front();
  bool within = hull.size() > 2;
  for (size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d &a = hull[i], &b = hull[(i + 1) % hull.size()];
    const Eigen::Vector2d here = NearestOnSegment(point, a, b);
    if ((here - point).squaredNorm() < (nearest - point).squaredNorm()) nearest = here;
    within = within && Turn(a, b, point) >= 0;
  }
  return within ? point : nearest;
}

Eigen::Vector2d WayToHull(const Eigen::Vector2d& point, std::vector<Eigen::Vector2d> others,
                          double slack) {
  const Eigen::Vector2d way = NearestInHull(point, std::move(others)) - point;
  const double far = way.norm();
  if (far <= slack) return Eigen::Vector2d::Zero();
  return way * (1 - slack / far);
}

double DistanceToHull(const Eigen::Vector2d& point, std::vector<Eigen::Vector2d> others) {
  if (others.empty()) return INFINITY;
  return (NearestInHull(point, std::move(others)) - point).norm();
}

bool BalanceGauge::Fits(const Skeleton& skeleton) { return MassWeights(skeleton).size() > 0; }

BalanceGauge::BalanceGauge(const Skeleton& skeleton, double fps, double floor)
    : feet_(skeleton.feet), weights_(MassWeights(skeleton)), floor_(floor) {
  double sum = 0;
  for (int i = 1 - kReach; i < kReach; ++i) {
    const double away = i / kSmoothFrames;
    sum += smooth_[i + kReach] = std::exp(-0.5 * away * away);
  }
  for (double& weight : smooth_) weight /= sum;
  const int last = 2 * kReach;
  for (int i = 0; i <= last; ++i) {
    const double before = i > 0 ? smooth_[i - 1] : 0, after = i < last ? smooth_[i + 1] : 0;
    bend_[i] = (before - 2 * smooth_[i] + after) * fps * fps;
  }
}

BodyPoints BalanceGauge::Of(const Eigen::Matrix3Xd& joints) const {
  BodyPoints points;
  points.centre = joints * weights_;
  for (int foot = 0; foot < 4; ++foot) {
    points.feet.col(foot) = joints.col(feet_[static_cast<size_t>(foot)]);
    if (foot % 2 == 0) points.feet(1, foot) -= kAnkleAboveSole;
  }
  return points;
}

Balance BalanceGauge::At(std::span<const BodyPoints> frames, size_t at) const {
  const auto last = static_cast<int64_t>(frames.size()) - 1;
  const auto centre = [&](int64_t i) -> Eigen::Vector3d {
    if (i < 0) return 2 * frames[0].centre - frames[std::min(-i, last)].centre;
    if (i > last)
      return 2 * frames[last].centre - frames[std::max<int64_t>(2 * last - i, 0)].centre;
    return frames[i].centre;
  };
  Balance balance;
  for (int i = -kReach; i <= kReach; ++i) {
    const Eigen::Vector3d near = centre(static_cast<int64_t>(at) + i);
    balance.centre += smooth_[i + kReach] * near;
    balance.acceleration += bend_[i + kReach] * near;
  }
  const Eigen::Matrix<double, 3, 4>& feet = balance.feet = frames[at].feet;
  balance.foot_height = feet.row(1).minCoeff() - floor_;
  std::vector<Eigen::Vector2d> support;
  for (int foot = 0; foot < 4; ++foot) {
    balance.on_floor[static_cast<size_t>(foot)] = feet(1, foot) - floor_ < kSoleHeight;
    if (balance.on_floor[static_cast<size_t>(foot)])
      support.emplace_back(feet(0, foot), feet(2, foot));
  }
  if (support.empty()) return balance;
  const Eigen::Vector2d below(balance.centre.x(), balance.centre.z());
  balance.centre_outside = DistanceToHull(below, support);
  if (balance.Thrown()) return balance;
  const double height = balance.centre.y() - floor_;
  const Eigen::Vector2d push(balance.acceleration.x(), balance.acceleration.z());
  balance.zmp_outside =
      DistanceToHull(below - MomentLever(height, balance.acceleration.y()) * push, support);
  return balance;
}

SupportMeter::SupportMeter(const Skeleton& skeleton, double fps)
    : gauge_(skeleton, fps, RestFloor(skeleton)) {}

void SupportMeter::Add(const Eigen::Matrix3Xd& joints) {
  constexpr size_t kAll = 2 * BalanceGauge::kReach + 1;
  if (last_.size() == kAll) last_.erase(last_.begin());
  last_.push_back(gauge_.Of(joints));
  if (last_.size() <= BalanceGauge::kReach) return;
  ++judged_;
  if (gauge_.At(last_, last_.size() - 1 - BalanceGauge::kReach).Supported()) ++supported_;
}

double SupportMeter::Share() const {
  int64_t judged = judged_, supported = supported_;
  const size_t open = std::min<size_t>(last_.size(), BalanceGauge::kReach);
  for (size_t at = last_.size() - open; at < last_.size(); ++at, ++judged)
    if (gauge_.At(last_, at).Supported()) ++supported;
  return judged > 0 ? static_cast<double>(supported) / static_cast<double>(judged) : 1;
}

}  // namespace choreo
