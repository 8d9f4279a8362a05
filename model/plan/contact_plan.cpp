#include "model/plan/contact_plan.h"

#include <algorithm>
#include <cmath>

#include "model/motion/floor/support.h"
#include "model/motion/pose/body_limits.h"

namespace choreo {
namespace {

constexpr double kNever = 1e6;  // square metres: the cost of a forbidden state
// The cost of one frame of a flight that is too long. A whole such flight costs less than a
// forbidden state, because a fall from a height takes long.
constexpr double kTooLong = kNever / 1e3;
constexpr int kTurns = 2;        // rounds in which each foot adapts to the other
constexpr int kAttempts = 3;     // to shorten flights
constexpr int kMaxStance = 150;  // frames; after that a foot steps on the spot

using Standing = std::vector<bool>;  // per frame

// Prefix sums of four numbers per frame.
class Sums {
 public:
  explicit Sums(size_t frames) : sums_(frames + 1, Eigen::Vector4d::Zero()) {}
  /// Call frame by frame.
  void Set(size_t frame, const Eigen::Vector4d& value) { sums_[frame + 1] = sums_[frame] + value; }
  Eigen::Vector4d Of(int from, int to) const {
    return sums_[static_cast<size_t>(to) + 1] - sums_[static_cast<size_t>(from)];
  }

 private:
  std::vector<Eigen::Vector4d> sums_;
};

// The time in which a body that rises at `speed`, m/s, from a height, metres, falls to the floor.
int FallFrames(double height, double speed, double fps) {
  const double seconds =
      (speed + std::sqrt(speed * speed + 2 * kGravity * std::max(0.0, height))) / kGravity;
  return std::max(1, static_cast<int>(std::ceil(seconds * fps)));
}

// The time in which a leg lowers its foot from a height, metres, or raises it there. The toes move
// smoothly (toes_path.h): their highest speed is 15/8 of their mean speed.
int KickFrames(double height, double fps) {
  return std::max(1, static_cast<int>(std::ceil(height * 15 / 8 / kFastestJoint * fps)));
}

bool Carried(const FootTrack& foot, size_t frame) {
  return !foot.carried.empty() && foot.carried[frame];
}

// Finds the best stances of one foot when the other stands as in `other`.
class FootPlanner {
 public:
  /// `grounded`: frames of flights that are too long.
  FootPlanner(const FootTrack& foot, const FootTrack& beside, const Standing& other,
              const Standing& grounded, double fps, const FootworkOptions& options)
      : foot_(foot),
        frames_(static_cast<int>(foot.toes.size())),
        step_cost_(options.step_cost),
        shortest_step_(std::max(1, static_cast<int>(std::lround(options.shortest_step * fps)))),
        first_step_(std::max(FallFrames(foot.fall_before, foot.rise_before, fps),
                             KickFrames(foot.height_before, fps))),
        // A kick may be faster than a fall. It takes at most the whole plan.
        last_step_(foot.end == FootTrack::End::kInAir
                       ? std::min(frames_, std::max(FallFrames(foot.fall_after, 0, fps),
                                                    KickFrames(foot.heights.back(), fps)))
                       : 1),
        places_(foot.toes.size()),
        support_(foot.toes.size()) {
    for (size_t i = 0; i < foot.toes.size(); ++i) {
      const Eigen::Vector3d& toes = foot.toes[i];
      const double height = std::max(0.0, foot.heights[i]);
      const double lift = std::max(0.0, kSoleHeight - foot.heights[i]);
      places_.Set(i,
                  {toes.x(), toes.z(), toes.x() * toes.x() + toes.z() * toes.z(), height * height});
      const double here = foot.unbalanced[i], there = beside.unbalanced[i];
      const double flight = Carried(foot, i) ? 0 : grounded[i] ? kTooLong : options.flight_cost;
      support_.Set(
          i, {other[i] ? std::min(here, there) : here, other[i] ? there : flight, lift * lift, 0});
    }
  }

  std::vector<Stance> Plan() {
    // The least cost of the frames before, if the foot stands last or is in the air.
    const auto frames = static_cast<size_t>(frames_);
    down_.assign(frames + 1, {kNever * frames_, 0});
    up_ = down_;
    for (int end = 1; end <= frames_; ++end) {
      for (int from = std::max(0, end - kMaxStance); from < end; ++from) {
        Improve(&down_, end, from, StanceCost(from, end - 1) + CostBeforeStance(from));
        Improve(&up_, end, from, AirCost(from, end - 1) + CostBeforeAir(from));
      }
    }
    return Trace();
  }

 private:
  struct Best {
    double cost;
    int from;
  };

  static void Improve(std::vector<Best>* best, int end, int from, double cost) {
    Best& at = (*best)[static_cast<size_t>(end)];
    if (cost < at.cost) at = {cost, from};
  }
  double CostBeforeStance(int from) const {
    if (from > 0) return up_[static_cast<size_t>(from)].cost;
    return foot_.stood ? 0 : kNever;
  }
  double CostBeforeAir(int from) const {
    if (from > 0) return down_[static_cast<size_t>(from)].cost + step_cost_;
    return foot_.stood ? step_cost_ : 0;
  }

  bool IsLast(int frame) const { return frame == frames_ - 1; }
  Eigen::Vector3d PlaceOf(int from, int to) const {
    if (IsLast(to) && foot_.end == FootTrack::End::kStands) return foot_.toes.back();
    if (from == 0 && foot_.stood) return foot_.before;
    const Eigen::Vector4d mean = places_.Of(from, to) / (to - from + 1);
    return {mean[0], 0, mean[1]};
  }
  double StanceCost(int from, int to) const {
    if (IsLast(to) && foot_.end == FootTrack::End::kInAir) return kNever;
    const Eigen::Vector3d place = PlaceOf(from, to);
    const Eigen::Vector4d sum = places_.Of(from, to);
    const double count = to - from + 1, x = place.x(), z = place.z();
    double cost = sum[2] - 2 * (x * sum[0] + z * sum[1]) + count * (x * x + z * z) + sum[3] +
                  support_.Of(from, to)[0];
    // Moving to the key's place takes a step.
    if (from == 0 && foot_.stood) cost += count * (place - foot_.before).squaredNorm();
    return cost;
  }
  double AirCost(int from, int to) const {
    if (IsLast(to) && foot_.end == FootTrack::End::kStands) return kNever;
    int fewest = shortest_step_;
    if (from > 0 || foot_.stood) {
      if (IsLast(to)) fewest = last_step_;
    } else {
      fewest = IsLast(to) ? 1 : first_step_;  // a foot that stays in the air does not fall
    }
    const Eigen::Vector4d sum = support_.Of(from, to);
    return sum[1] + sum[2] + kNever * std::max(0, fewest - (to - from + 1));
  }

  std::vector<Stance> Trace() const {
    std::vector<Stance> stances;
    bool stands = down_.back().cost <= up_.back().cost;
    for (int end = frames_; end > 0; stands = !stands) {
      const int from = (stands ? down_ : up_)[static_cast<size_t>(end)].from;
      if (stands) stances.push_back({from, end - 1, PlaceOf(from, end - 1)});
      end = from;
    }
    std::ranges::reverse(stances);
    return stances;
  }

  const FootTrack& foot_;
  const int frames_;
  const double step_cost_;
  const int shortest_step_, first_step_, last_step_;
  Sums places_;  // x, z, their squares, the height's square
  // Cost of the body's support while this foot stands and while it does not, and of lifting the
  // foot where the plan does not.
  Sums support_;
  std::vector<Best> down_, up_;
};

Standing StandingIn(const std::vector<Stance>& stances, size_t frames) {
  Standing standing(frames);
  for (const Stance& stance : stances)
    std::fill(standing.begin() + stance.from, standing.begin() + stance.to + 1, true);
  return standing;
}

// Marks the frames of flights longer than the limit; returns whether there are any.
bool MarkLongFlights(const std::array<FootTrack, 2>& feet, const std::array<Standing, 2>& standing,
                     double longest, Standing* grounded) {
  const auto flies = [&](size_t i) {
    return !standing[0][i] && !standing[1][i] && !Carried(feet[0], i);
  };
  bool any = false;
  for (size_t from = 0, to = 0; from < grounded->size(); from = to + 1) {
    for (to = from; to < grounded->size() && flies(to);) ++to;
    if (static_cast<double>(to - from) <= longest) continue;
    any = true;
    for (size_t i = from; i < to; ++i) (*grounded)[i] = true;
  }
  return any;
}

double Lifted(const FootTrack& foot) {
  double sum = 0;
  for (const double height : foot.heights) sum += std::max(0.0, height);
  return sum;
}

}  // namespace

const Stance* StanceAt(const std::vector<Stance>& stances, int frame) {
  const auto at = std::ranges::find_if(
      stances, [frame](const Stance& one) { return one.from <= frame && frame <= one.to; });
  return at == stances.end() ? nullptr : &*at;
}

std::array<std::vector<Stance>, 2> PlanContacts(const std::array<FootTrack, 2>& feet, double fps,
                                                const FootworkOptions& options) {
  const size_t frames = feet[0].toes.size();
  std::array<std::vector<Stance>, 2> stances;
  std::array<Standing, 2> standing = {Standing(frames, true), Standing(frames, true)};
  Standing grounded(frames, false);
  // Starts with the foot that the plan lifts more; the other one supports it.
  const size_t first = Lifted(feet[0]) > Lifted(feet[1]) ? 0 : 1;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    for (int turn = 0; turn < 2 * kTurns; ++turn) {
      const size_t side = turn % 2 == 0 ? first : 1 - first, other = 1 - side;
      stances[side] =
          FootPlanner(feet[side], feet[other], standing[other], grounded, fps, options).Plan();
      standing[side] = StandingIn(stances[side], frames);
    }
    if (!MarkLongFlights(feet, standing, options.longest_flight * fps, &grounded)) break;
  }
  return stances;
}

}  // namespace choreo
