#include "model/formats/bvh/euler_angles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "model/motion/rotation.h"

namespace choreo {
namespace {

// The two triples of a frame, each within half a turn of zero.
using Branches = std::array<Eigen::Vector3d, 2>;

constexpr double kNearZero = 0.01;  // the weight of nearness to zero, against that to the neighbour
constexpr size_t kWays = 8;         // that are followed at once
// Radians. Away from a quarter turn the other triple is half a turn off: no step leads there.
constexpr double kLongestStep = 2.6;

Eigen::Vector3d Wrapped(Eigen::Vector3d angles) {
  return angles.unaryExpr([](double angle) { return WrapAngle(angle); });
}

// Angles z and y are one at a quarter turn about x; y keeps its value `last_y`.
Branches BranchesOf(const Eigen::Matrix3d& r, double last_y) {
  const bool locked = std::hypot(r(2, 0), r(2, 2)) < 1e-9;
  const double y = locked ? last_y : std::atan2(-r(2, 0), r(2, 2));
  const Eigen::Matrix3d zx = r * Eigen::AngleAxisd(-y, Eigen::Vector3d::UnitY()).matrix();
  const Eigen::Vector3d one(std::atan2(zx(1, 0), zx(0, 0)), std::atan2(zx(2, 1), zx(2, 2)), y);
  return {Wrapped(one), Wrapped({one.x() + M_PI, M_PI - one.y(), one.z() + M_PI})};
}

// A branch, and the whole turns of its angles away from zero.
using State = std::array<int, 4>;

// The best curve that ends in a state.
struct Way {
  double cost = 0;
  Eigen::Vector3d angles;
  State before;
};
using Ways = std::map<State, Way>;

void Keep(const State& state, Way way, Ways* ways) {
  const auto [known, is_new] = ways->try_emplace(state, way);
  if (!is_new && way.cost < known->second.cost) known->second = way;
}

// All states within a nearest step of those before.
Ways GoOn(const Ways& ways, const Branches& branches) {
  Ways next;
  for (const auto& [state, way] : ways) {
    for (int branch = 0; branch < 2; ++branch) {
      const Eigen::Vector3d& base = branches[static_cast<size_t>(branch)];
      const Eigen::Vector3d step = Wrapped(base - way.angles);
      if (branch != state[0] && step.cwiseAbs().maxCoeff() > kLongestStep) continue;
      const Eigen::Vector3d angles = way.angles + step;
      const auto turns = [&](int i) {
        return static_cast<int>(std::lround((angles[i] - base[i]) / (2 * M_PI)));
      };
      Keep({branch, turns(0), turns(1), turns(2)},
           {way.cost + step.squaredNorm() + kNearZero * angles.squaredNorm(), angles, state},
           &next);
    }
  }
  while (next.size() > kWays)
    next.erase(std::ranges::max_element(next, {}, [](const auto& one) { return one.second.cost; }));
  return next;
}

}  // namespace

Eigen::Matrix3Xd EulerAnglesZxy(std::span<const Eigen::Matrix3d> rotations) {
  std::vector<Ways> ways;
  double last_y = 0;
  for (const Eigen::Matrix3d& rotation : rotations) {
    const Branches branches = BranchesOf(rotation, last_y);
    last_y = branches[0].z();
    const Ways first = {{{0, 0, 0, 0}, {0, branches[0], {}}}, {{1, 0, 0, 0}, {0, branches[1], {}}}};
    ways.push_back(GoOn(ways.empty() ? first : ways.back(), branches));
  }
  Eigen::Matrix3Xd angles(3, std::ssize(ways));
  if (ways.empty()) return angles;
  auto way =
      std::ranges::min_element(ways.back(), {}, [](const auto& one) { return one.second.cost; });
  for (size_t frame = ways.size(); frame-- > 0;) {
    angles.col(static_cast<Eigen::Index>(frame)) = way->second.angles;
    if (frame > 0) way = ways[frame - 1].find(way->second.before);
  }
  return angles;
}

}  // namespace choreo
