#include "model/metrics/contrast.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "model/core/error.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kStandstill = 1e-3;  // m/s: lower bound of the logarithm's argument

std::ptrdiff_t WindowFrames(double fps) { return std::lround(kContrastSeconds * fps); }

}  // namespace

std::vector<double> WindowTurns(std::span<const Pose> poses, double fps) {
  std::vector<double> turns;
  const auto length = static_cast<size_t>(WindowFrames(fps));
  for (size_t end = length; end < poses.size(); end += length)
    turns.push_back(TurnOver(poses[end - length], poses.subspan(end - length + 1, length)));
  return turns;
}

double FacesAway(std::span<const Pose> poses, double front) {
  const auto away = std::ranges::count_if(poses, [front](const Pose& pose) {
    return std::abs(WrapAngle(GroundFrame::Of(pose).heading - front)) > std::numbers::pi / 2;
  });
  return poses.empty() ? 0 : static_cast<double>(away) / static_cast<double>(poses.size());
}

double HandsAtRest(const Skeleton& skeleton, double fps, const JointTrack& track) {
  int64_t still = 0, all = 0;
  for (const int elbow : {skeleton.left_elbow, skeleton.right_elbow}) {
    const auto wrist = std::ranges::find(skeleton.parents, elbow);
    if (elbow < 0 || wrist == skeleton.parents.end())
      throw InvalidArgument("skeleton", skeleton.Describe() + " lacks elbows or wrists");
    const auto joint = wrist - skeleton.parents.begin();
    const auto reach = [&](size_t t) -> Eigen::Vector3d {
      return track[t].col(joint) - track[t].col(0);
    };
    for (size_t t = 1; t < track.size(); ++t, ++all)
      if ((reach(t) - reach(t - 1)).norm() * fps < kRestSpeed) ++still;
  }
  return all > 0 ? static_cast<double>(still) / static_cast<double>(all) : 0;
}

std::vector<double> TrunkLean(const Skeleton& skeleton, const JointTrack& track) {
  if (skeleton.left_shoulder < 0 || skeleton.right_shoulder < 0)
    throw InvalidArgument("skeleton", skeleton.Describe() + " has no shoulders");
  std::vector<double> lean;
  for (const Eigen::Matrix3Xd& at : track) {
    const Eigen::Vector3d trunk =
        0.5 * (at.col(skeleton.left_shoulder) + at.col(skeleton.right_shoulder)) - at.col(0);
    lean.push_back(std::atan2(std::hypot(trunk.x(), trunk.z()), trunk.y()) * kDegrees);
  }
  return lean;
}

double PaceSpread(double fps, const JointTrack& track) {
  const std::vector<float> speeds = MeanSpeeds(track, fps);
  const auto length = WindowFrames(fps);
  std::vector<double> paces;
  for (auto from = speeds.begin(); speeds.end() - from >= length; from += length) {
    const double mean = std::accumulate(from, from + length, 0.0) / static_cast<double>(length);
    paces.push_back(std::log(std::max(mean, kStandstill)));
  }
  if (paces.size() < 2) return NAN;
  const Eigen::Map<const Eigen::ArrayXd> all(paces.data(), std::ssize(paces));
  return std::sqrt((all - all.mean()).square().sum() / static_cast<double>(paces.size() - 1));
}

}  // namespace choreo
