#include "model/motion/floor/hovers.h"

#include "model/core/error.h"

namespace choreo {

std::vector<Balance> BalanceOf(const Skeleton& skeleton, double fps,
                               const std::vector<Eigen::Matrix3Xd>& track, double floor) {
  if (!BalanceGauge::Fits(skeleton))
    throw InvalidArgument("skeleton", skeleton.Describe() + " lacks joints that have mass");
  if (track.empty()) throw InvalidArgument("track", "0 frames, at least 1 is needed");
  const BalanceGauge gauge(skeleton, fps, floor);
  std::vector<BodyPoints> points;
  points.reserve(track.size());
  for (const Eigen::Matrix3Xd& joints : track) points.push_back(gauge.Of(joints));
  std::vector<Balance> balance;
  balance.reserve(track.size());
  for (size_t t = 0; t < track.size(); ++t) balance.push_back(gauge.At(points, t));
  return balance;
}

std::vector<Hover> FindHovers(std::span<const double> heights, std::span<const Balance> balance,
                              double least) {
  std::vector<Hover> hovers;
  for (size_t from = 0; from < heights.size();) {
    size_t to = from;
    double sum = 0;
    for (; to < heights.size() && heights[to] > least; ++to) sum += balance[to].acceleration.y();
    if (to > from && sum / static_cast<double>(to - from) > -kThrown) hovers.push_back({from, to});
    from = to + 1;
  }
  return hovers;
}

}  // namespace choreo
