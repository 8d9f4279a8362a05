#include "model/metrics/balance.h"

#include <algorithm>
#include <cmath>

#include "model/core/numbers/quantile.h"

namespace choreo {
namespace {

constexpr double kFloorShare = 0.05;
constexpr double kMinHover = 0.15;           // m, of the lowest joint
constexpr double kCentreOutside = 0.10;      // m
constexpr double kZeroMomentOutside = 0.15;  // m

// The longest time, in frames, in which all joints hang above `least`.
size_t LongestHover(const JointTrack& track, const std::vector<Balance>& balance, double least) {
  std::vector<double> heights;
  for (const Eigen::Matrix3Xd& joints : track) heights.push_back(joints.row(1).minCoeff());
  size_t longest = 0;
  for (const auto& [first, end] : FindHovers(heights, balance, least))
    longest = std::max(longest, end - first);
  return longest;
}

// Lengths of all ground contacts of each foot, frames.
std::vector<double> ContactLengths(const std::vector<Balance>& balance) {
  std::vector<double> lengths;
  for (const size_t foot : {0, 2}) {
    int length = 0;
    for (const Balance& frame : balance) {
      if (frame.on_floor[foot] || frame.on_floor[foot + 1]) {
        ++length;
      } else if (length > 0) {
        lengths.push_back(length), length = 0;
      }
    }
    if (length > 0) lengths.push_back(length);
  }
  return lengths;
}

}  // namespace

double DancedFloor(const Skeleton& skeleton, const JointTrack& track) {
  std::vector<double> heights;
  for (const Eigen::Matrix3Xd& joints : track) {
    heights.push_back(
        std::min({joints(1, skeleton.feet[0]) - kAnkleAboveSole, joints(1, skeleton.feet[1]),
                  joints(1, skeleton.feet[2]) - kAnkleAboveSole, joints(1, skeleton.feet[3])}));
  }
  return Quantile(std::move(heights), kFloorShare);
}

WeightFigures MeasureWeight(const Skeleton& skeleton, double fps, const JointTrack& track,
                            double floor) {
  const std::vector<Balance> balance = BalanceOf(skeleton, fps, track, floor);
  const auto share = [&](auto is) {
    return static_cast<double>(std::ranges::count_if(balance, is)) /
           static_cast<double>(balance.size());
  };
  const auto hovers = [](const Balance& frame) { return frame.foot_height > kSoleHeight; };
  WeightFigures figures;
  figures.hover_share = share(hovers);
  std::vector<double> falls;
  for (const Balance& frame : balance)
    if (hovers(frame)) falls.push_back(frame.acceleration.y());
  figures.hover_acceleration = falls.empty() ? NAN : Median(std::move(falls));
  figures.longest_hover_s =
      static_cast<double>(LongestHover(track, balance, floor + kMinHover)) / fps;
  figures.zmp_outside = share(
      [](const Balance& frame) { return frame.zmp_outside.value_or(0) > kZeroMomentOutside; });
  figures.centre_outside =
      share([](const Balance& frame) { return frame.centre_outside.value_or(0) > kCentreOutside; });
  figures.supported = share(&Balance::Supported);
  std::vector<double> contacts = ContactLengths(balance);
  figures.contact_frames = contacts.empty() ? 0 : Median(std::move(contacts));
  return figures;
}

}  // namespace choreo
