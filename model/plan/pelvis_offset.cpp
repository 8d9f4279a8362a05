#include "model/plan/pelvis_offset.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "model/motion/floor/support.h"

namespace choreo {
namespace {

constexpr int kMostRounds = 12;
constexpr double kPushSeconds =
    0.27;  // s before and after a flight in which legs may push as hard as gravity
constexpr double kGive = 0.2;  // metres that a leap across a plan's end may leave it
// Weight of standing at the end, relative to per-frame terms, and of falling relative to that.
constexpr double kFirm = 30;

double Square(double value) { return value * value; }

// Normal equations of residuals that are linear in a few unknowns each.
class LeastSquares {
 public:
  explicit LeastSquares(int unknowns)
      : normal_(unknowns, unknowns), right_(Eigen::VectorXd::Zero(unknowns)) {}

  /// A factor of an unknown; a negative index marks a known value.
  struct Term {
    int unknown;
    double factor, value = 0;
  };

  /// Adds weight times (sum of factor x - wanted)².
  void Add(std::initializer_list<Term> terms, double wanted, double weight) {
    for (const Term& term : terms) {
      if (term.unknown < 0) wanted -= term.factor * term.value;
    }
    for (const Term& row : terms) {
      if (row.unknown < 0) continue;
      right_[row.unknown] += weight * row.factor * wanted;
      for (const Term& column : terms) {
        if (column.unknown >= 0)
          entries_.emplace_back(row.unknown, column.unknown, weight * row.factor * column.factor);
      }
    }
  }
  Eigen::VectorXd Solve() {
    normal_.setFromTriplets(entries_.begin(), entries_.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower,
                                 Eigen::NaturalOrdering<int>>(normal_)
        .solve(right_);
  }

 private:
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::SparseMatrix<double> normal_;
  Eigen::VectorXd right_;
};

class PelvisSolver {
 public:
  PelvisSolver(const std::vector<SupportFrame>& frames, const std::array<BodyCentre, 2>& before,
               const PelvisRules& rules)
      : frames_(frames),
        before_(before),
        rules_(rules),
        count_(static_cast<int>(frames.size())),
        moved_(rules.returns ? count_ - 1 : count_),
        step_(1 / Square(rules.fps)),
        push_(static_cast<int>(std::lround(kPushSeconds * rules.fps))),
        offset_(Eigen::Matrix3Xd::Zero(3, count_)),
        leaps_(frames.size()),
        pushes_(frames.size()) {
    const auto bears = [](const SupportFrame& frame) { return !frame.support.empty(); };
    const auto first = std::ranges::find_if(frames, bears);
    const auto last = std::find_if(frames.rbegin(), frames.rend(), bears).base();
    first_borne_ = static_cast<int>(first - frames.begin());
    last_borne_ = static_cast<int>(last - frames.begin()) - 1;
    if (!rules.heights_alone) {  // on a path they stay as planned, because it may set the height
      lands_ = Lands();
      takes_off_ = TakesOff();
    }
    FindLeaps();
    for (int frame = 0; frame < count_; ++frame) {
      if (!Leaps(frame)) continue;
      for (int i = std::max(0, frame - push_); i < std::min(count_, frame + push_ + 1); ++i)
        pushes_[static_cast<size_t>(i)] = true;
    }
  }

  Eigen::Matrix3Xd Solve() {
    if (moved_ <= 0) return offset_;
    for (int round = 0; round < kMostRounds; ++round) {
      LeastSquares problem(3 * moved_);
      for (int frame = -1; frame < count_; ++frame) AddSmoothness(frame, &problem);
      if (Leaps(0)) AddFall(-1, &problem);  // it flew there as it flies on
      for (int frame = 0; frame < moved_; ++frame) {
        for (int axis = 0; axis < 3; ++axis)
          problem.Add({{3 * frame + axis, 1}}, 0, 1 / Square(rules_.options.offset));
        AddReach(frame, &problem);
        if (Leaps(frame)) AddFall(frame, &problem);
        if (Flies(frame)) continue;
        AddBalance(frame, 0, &problem);
        frame + 1 < count_ ? AddBalance(frame, Lever(frame), &problem) : AddCapture(&problem);
      }
      const Eigen::Matrix3Xd before = offset_;
      offset_.leftCols(moved_) = problem.Solve().reshaped(3, moved_);
      if ((offset_ - before).colwise().norm().maxCoeff() < rules_.options.reach / 10) break;
    }
    return offset_;
  }

 private:
  const SupportFrame& At(int frame) const { return frames_[static_cast<size_t>(frame)]; }
  bool Flies(int frame) const { return At(frame).support.empty(); }
  // Whether the frame is in a flight whose length suits its height.
  bool Leaps(int frame) const { return leaps_[static_cast<size_t>(frame)]; }
  // Whether anything but feet carries the body in one of these frames.
  bool Carried(int from, int to) const {
    return -rules_.since_carried >= from ||
           std::any_of(frames_.begin() + std::max(0, from), frames_.begin() + std::min(count_, to),
                       [](const SupportFrame& frame) { return frame.carried; });
  }
  // Flights from feet to feet, and at the ends those that land and take off. While other joints
  // are on the floor, legs can't push.
  void FindLeaps() {
    for (int from = 0, to = 0; from < count_; from = to + 1) {
      for (to = from; to < count_ && Flies(to);) ++to;
      const bool leaves = from > 0 ? !Carried(from - push_, from) : lands_;
      const bool arrives = to < count_ ? !Carried(to, to + push_) : takes_off_;
      std::fill(leaps_.begin() + from, leaps_.begin() + to, leaves && arrives);
    }
  }
  // The distance that a body falls from rest in `frames` frames, metres.
  double Fall(int frames) const { return kGravity / 2 * step_ * Square(frames); }
  // Whether a body that flies before the first frame and falls freely lands near its plan. Feet
  // slightly above the floor in a recording are not a leap.
  bool Lands() const {
    if (first_borne_ == 0 || first_borne_ == count_ || Carried(-push_, 0)) return false;
    const int frames = first_borne_ + 1;
    const double planned = Planned(-1).y() - Planned(first_borne_).y();
    const double speed = Centre(-1).exact.y() - Centre(-2).exact.y();
    const double fall = Fall(frames) - speed * frames;
    return std::abs(fall - planned) < std::min(kGive, Fall(frames) / 2);
  }
  // Whether a flight to a key at the end rises as a leap would, and its arc stays near the plan.
  bool TakesOff() const {
    if (!rules_.returns || last_borne_ < 0) return false;
    const double fall = Fall(count_ - 1 - last_borne_);
    double lowest = Planned(last_borne_).y();  // while legs may push
    for (int frame = std::max(0, last_borne_ - push_); frame < last_borne_; ++frame)
      lowest = std::min(lowest, Planned(frame).y());
    return fall / 4 < kGive && Planned(count_ - 1).y() - lowest > fall / 2;
  }
  LeastSquares::Term Term(int frame, int axis, double factor) const {
    const bool fixed = frame < 0 || frame >= moved_ || (axis != 1 && rules_.heights_alone);
    return {fixed ? -1 : 3 * frame + axis, factor, Offset(frame, axis)};
  }
  double Offset(int frame, int axis) const {
    if (frame < 0) return rules_.before(axis, 2 + frame);
    return frame >= count_ ? 0 : offset_(axis, frame);
  }
  // The plan's centre of mass, from two frames before the first on.
  const BodyCentre& Centre(int frame) const {
    return frame < 0 ? before_[static_cast<size_t>(2 + frame)] : At(frame).centre;
  }
  const Eigen::Vector3d& Planned(int frame) const { return Centre(frame).smooth; }
  Eigen::Vector3d PlannedStep(int frame) const {
    return Planned(frame + 1) - 2 * Planned(frame) + Planned(frame - 1);
  }

  void AddSmoothness(int frame, LeastSquares* problem) const {
    // The body is free after a last frame that is no key.
    if (!rules_.returns && frame + 1 >= count_) return;
    for (int axis = 0; axis < 3; ++axis) {
      const bool pushes = axis == 1 && frame >= 0 && pushes_[static_cast<size_t>(frame)];
      const double acceleration = pushes ? kGravity : rules_.options.acceleration;
      problem->Add({Term(frame - 1, axis, 1), Term(frame, axis, -2), Term(frame + 1, axis, 1)}, 0,
                   1 / Square(acceleration * step_));
    }
  }

  // How far a leg's ankle is out of reach of its hip, moved by `offset`.
  static double Beyond(const SupportFrame::Leg& leg, const Eigen::Vector3d& offset) {
    return (leg.to_ankle - offset).norm() - kStraightestLeg * leg.length;
  }
  // Moving the pelvis along the way to an ankle shortens it.
  void AddReach(int frame, LeastSquares* problem) const {
    for (const SupportFrame::Leg& leg : At(frame).legs) {
      const Eigen::Vector3d now = offset_.col(frame), way = leg.to_ankle - now;
      const double beyond = Beyond(leg, now);
      if (beyond <= 0) continue;
      const Eigen::Vector3d along = way.normalized();
      problem->Add(
          {Term(frame, 0, along.x()), Term(frame, 1, along.y()), Term(frame, 2, along.z())},
          beyond + along.dot(now), 1 / Square(rules_.options.reach));
    }
  }

  void AddFall(int frame, LeastSquares* problem) const {
    const Eigen::Vector3d planned =
        Centre(frame + 1).exact - 2 * Centre(frame).exact + Centre(frame - 1).exact;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != 1 && rules_.heights_alone) continue;
      const double wanted = axis == 1 ? -kGravity * step_ : 0;
      problem->Add({Term(frame - 1, axis, 1), Term(frame, axis, -2), Term(frame + 1, axis, 1)},
                   wanted - planned[axis], Square(kFirm / (rules_.options.acceleration * step_)));
    }
  }

  // The acceleration of the offset, per frame squared.
  double OffsetStep(int frame, int axis) const {
    return Offset(frame + 1, axis) - 2 * Offset(frame, axis) + Offset(frame - 1, axis);
  }
  // MomentLever in frames squared.
  double Lever(int frame) const {
    const double height = Planned(frame).y() + Offset(frame, 1);
    const double rise = (PlannedStep(frame).y() + OffsetStep(frame, 1)) / step_;
    return MomentLever(height, rise) / step_;
  }

  // The centre of mass (lever 0) and the zero moment point move with the body, the latter against
  // its acceleration; their target is the nearest point at the feet.
  void AddBalance(int frame, double lever, LeastSquares* problem) const {
    if (rules_.heights_alone) return;
    Eigen::Vector2d point;
    for (const int axis : {0, 2}) {
      const double step = lever == 0 ? 0 : PlannedStep(frame)[axis] + OffsetStep(frame, axis);
      point[axis / 2] = Planned(frame)[axis] + Offset(frame, axis) - lever * step;
    }
    const Eigen::Vector2d way = WayToHull(point, At(frame).support, rules_.options.sole);
    for (const int axis : {0, 2}) {
      const double now = Offset(frame, axis) - lever * OffsetStep(frame, axis);
      problem->Add({Term(frame - 1, axis, -lever), Term(frame, axis, 1 + 2 * lever),
                    Term(frame + 1, axis, -lever)},
                   now + way[axis / 2], 1 / Square(rules_.options.balance));
    }
  }

  // The capture point c + c' sqrt(h / g) must be at the feet (Pratt 2006), so that the body also
  // stands after an open end; otherwise toppling would be cheapest.
  void AddCapture(LeastSquares* problem) const {
    if (rules_.heights_alone) return;
    const int frame = count_ - 1;
    const double height = std::max(0.0, Planned(frame).y() + Offset(frame, 1));
    const double lead = std::sqrt(height / kGravity) * rules_.fps;
    Eigen::Vector2d point;
    for (const int axis : {0, 2}) {
      const double planned = Planned(frame)[axis] - Planned(frame - 1)[axis];
      point[axis / 2] = Planned(frame)[axis] + lead * planned + Captured(axis, lead);
    }
    const Eigen::Vector2d way = WayToHull(point, At(frame).support, rules_.options.sole);
    for (const int axis : {0, 2}) {
      problem->Add({Term(frame, axis, 1 + lead), Term(frame - 1, axis, -lead)},
                   Captured(axis, lead) + way[axis / 2], kFirm / Square(rules_.options.balance));
    }
  }
  double Captured(int axis, double lead) const {
    return Offset(count_ - 1, axis) + lead * (Offset(count_ - 1, axis) - Offset(count_ - 2, axis));
  }

  const std::vector<SupportFrame>& frames_;
  const std::array<BodyCentre, 2>& before_;
  const PelvisRules& rules_;
  const int count_, moved_;
  const double step_;  // squared seconds between frames
  const int push_;     // frames in which legs may push
  Eigen::Matrix3Xd offset_;
  int first_borne_, last_borne_;  // frames with a joint on the floor
  // Whether the flight before first_borne_, and the one after last_borne_, are leaps.
  bool lands_ = false, takes_off_ = false;
  std::vector<bool> leaps_;   // per frame
  std::vector<bool> pushes_;  // per frame: whether a leap is near
};

}  // namespace

Eigen::Matrix3Xd PelvisOffset(const std::vector<SupportFrame>& frames,
                              const std::array<BodyCentre, 2>& before, const PelvisRules& rules) {
  return PelvisSolver(frames, before, rules).Solve();
}

}  // namespace choreo
