#include "model/plan/toes_path.h"

#include <algorithm>
#include <cmath>

#include "model/core/numbers/smooth_step.h"

namespace choreo {
namespace {

constexpr double kArc = 0.03, kArcPerMetre = 0.15, kMaxArc = 0.10;  // of steps, metres

// Rises from 0 to 1, with zero speed and acceleration at both ends.
double Smootherstep(double u) { return u * u * u * (10 + u * (6 * u - 15)); }

class PathMaker {
 public:
  PathMaker(const FootTrack& foot, const std::vector<Stance>& stances, double rest, bool keyed,
            double fps, double shortest_step)
      : foot_(foot),
        stances_(stances),
        rest_(rest),
        keyed_(keyed),
        settle_(kSettleSeconds * fps),
        shortest_step_(static_cast<int>(std::lround(shortest_step * fps))),
        last_(static_cast<int>(foot.toes.size()) - 1) {}

  std::vector<Eigen::Vector3d> Make() {
    for (int frame = 0; frame <= last_;) {
      if (const Stance* stance = StanceAt(stances_, frame)) {
        for (; frame <= stance->to; ++frame) path_.push_back(Standing(*stance, frame));
        continue;
      }
      int to = frame;
      while (to < last_ && StanceAt(stances_, to + 1) == nullptr) ++to;
      Fly(frame, to);
      frame = to + 1;
    }
    if (keyed_) path_.back() = foot_.toes.back();
    return std::move(path_);
  }

 private:
  Eigen::Vector3d Planned(int frame) const {
    return frame < 0 ? foot_.before : foot_.toes[static_cast<size_t>(std::min(frame, last_))];
  }

  Eigen::Vector3d Standing(const Stance& stance, int frame) const {
    Eigen::Vector3d at = stance.place;
    at.y() = rest_;
    const bool to_key = stance.to == last_ && foot_.end == FootTrack::End::kStands;
    // Time is too short to settle on the floor and leave it again: the foot moves straight.
    if (stance.from == 0 && to_key && last_ + 1 < 2 * settle_) {
      const double u = (frame + 1.0) / (last_ + 1);
      return foot_.before + SmoothStep(u) * (foot_.toes.back() - foot_.before);
    }
    if (stance.from == 0) {
      const double u = std::min(1.0, (frame + 1) / settle_);
      at += (1 - SmoothStep(u)) * (foot_.before - at);
    }
    if (to_key) {
      const double u = std::max(0.0, 1 - (last_ - frame) / settle_);
      at += SmoothStep(u) * (foot_.toes.back() - at);
    }
    return at;
  }

  void Fly(int from, int to) {
    const bool leaves = from > 0 || foot_.stood;
    const Stance* next = to < last_ ? StanceAt(stances_, to + 1) : nullptr;
    const int before = from - 1;
    int after = next != nullptr ? to + 1 : to;
    if (next == nullptr && !keyed_) after = std::max(after, before + shortest_step_);
    const Eigen::Vector3d start = from > 0 ? path_.back() : foot_.before;
    const Eigen::Vector3d goal = next != nullptr ? Standing(*next, after) : Planned(to);
    const Eigen::Vector3d far = goal - start;
    const double arc = std::min(kMaxArc, kArc + kArcPerMetre * std::hypot(far.x(), far.z()));
    // The path may leave the straight line as planned, except near a standing end.
    const auto free = [&](double u) {
      return SmoothStep(std::min({1.0, 3 * u, u * (after - before) / settle_}));
    };
    for (int frame = from; frame <= to; ++frame) {
      const double u = static_cast<double>(frame - before) / (after - before);
      const double eased = Smootherstep(u);
      const Eigen::Vector3d planned = Planned(before) + eased * (Planned(after) - Planned(before));
      const double loose = (leaves ? free(u) : 1) * (next != nullptr ? free(1 - u) : 1);
      Eigen::Vector3d at = start + eased * far + loose * (Planned(frame) - planned);
      const double lift = leaves && next != nullptr ? arc * 8 * std::pow(u * (1 - u), 1.5) : 0;
      at.y() = std::max(at.y(), rest_ + lift);
      path_.push_back(at);
    }
  }

  const FootTrack& foot_;
  const std::vector<Stance>& stances_;
  const double rest_;
  const bool keyed_;
  const double settle_;      // frames
  const int shortest_step_;  // frames
  const int last_;
  std::vector<Eigen::Vector3d> path_;
};

}  // namespace

std::vector<Eigen::Vector3d> ToesPath(const FootTrack& foot, const std::vector<Stance>& stances,
                                      double rest, bool keyed, double fps, double shortest_step) {
  return PathMaker(foot, stances, rest, keyed, fps, shortest_step).Make();
}

}  // namespace choreo
