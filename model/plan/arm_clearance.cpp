#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "model/core/numbers/smooth_step.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/floor/support.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/trunk_line.h"
#include "model/motion/rotation.h"
#include "model/plan/plan_stages.h"
#include "model/plan/toes_path.h"

namespace choreo {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kDetourRounds = 3;         // a turned arm brings other points of it next to the trunk
constexpr double kFastestShoulder = 20;  // rad/s: recorded dancers are slower in 99.5 % of frames

struct ClearedArm : Arm {
  Vector3d outside;  // of the body, in the trunk's frame
};

// How an arm goes round the trunk.
struct Detour {
  Vector3d towards;           // in the trunk's frame
  std::vector<double> turns;  // per frame, about Lever
  int left_cm = 0;            // how far the arm is still inside
  double shaking = 0;         // what it adds to the accelerations of the forearm, squared
  bool whirls = false;        // faster than kFastestShoulder, and than the plan
  bool operator<(const Detour& other) const {
    return std::tie(whirls, left_cm, shaking) <
           std::tie(other.whirls, other.left_cm, other.shaking);
  }
};

class ArmClearer {
 public:
  ArmClearer(const PlanContext& context, std::vector<Pose>* plan)
      : context_(context),
        skeleton_(context.skeleton),
        plan_(*plan),
        frames_(static_cast<int>(plan->size())),
        settle_(kSettleSeconds * context.fps),
        trunk_(context.skeleton),
        before_(ForwardKinematics(skeleton_, context.history.back())) {
    for (const Pose& pose : plan_) placed_.push_back(ForwardKinematics(skeleton_, pose));
  }

  void Clear(const ClearedArm& arm) {
    const std::vector<double> least = Least(arm);
    for (int from = 0, to = 0; from < frames_; from = to + 1) {
      for (to = from; to < frames_ && Way(arm, At(to)).norm() < least[Index(to)];) ++to;
      if (to == from) continue;
      // Not to turn at all is the best of those that do not whirl, if all others do.
      Detour best{
          .towards = arm.outside, .turns = std::vector<double>(plan_.size()), .left_cm = 100};
      for (const Vector3d& towards :
           {Vector3d(Vector3d::UnitZ()), Vector3d(-Vector3d::UnitZ()), arm.outside})
        best = std::min(best, Around(arm, least, from, to, towards));
      Apply(arm, best);
    }
  }

 private:
  static size_t Index(int frame) { return static_cast<size_t>(frame); }
  int ParentOf(int joint) const { return skeleton_.parents[Index(joint)]; }
  const JointPlacement& At(int frame) const { return placed_[Index(frame)]; }

  Vector3d Way(const Arm& arm, const JointPlacement& at,
               const Matrix3d& turn = Matrix3d::Identity()) const {
    return trunk_.WayTo(arm, at.positions, turn);
  }

  // The vector about which the arm turns to move the middle of its forearm `towards`. It is
  // shorter, the less a turn moves it there, so that it is continuous.
  Vector3d Lever(const Arm& arm, const JointPlacement& at, const Vector3d& towards) const {
    return Middle(arm, at).normalized().cross(at.rotations[Index(trunk_.joints().front())] *
                                              towards);
  }
  // The middle of the forearm, from the shoulder.
  static Vector3d Middle(const Arm& arm, const JointPlacement& at) {
    return (at.positions.col(arm.elbow) + at.positions.col(arm.wrist)) / 2 -
           at.positions.col(arm.shoulder);
  }

  // The least distance from the trunk's line per frame, metres. Near the poses at the ends it is
  // theirs, if they are inside.
  std::vector<double> Least(const Arm& arm) const {
    const auto inside = [&](const JointPlacement& at) {
      return std::max(0.0, kTrunkDepth - Way(arm, at).norm());
    };
    const double first = inside(before_), last = context_.keyed ? inside(placed_.back()) : 0;
    const auto left = [&](int away) { return 1 - SmoothStep(std::min(1.0, away / (2 * settle_))); };
    std::vector<double> least;
    for (int frame = 0; frame < frames_; ++frame)
      least.push_back(kTrunkDepth -
                      std::max(first * left(frame + 1), last * left(frames_ - 1 - frame)));
    return least;
  }

  // Spreads turns that frames need over their neighbours: a hand moves aside no faster than it
  // falls. The poses at the ends stay.
  std::vector<double> Spread(const Arm& arm, const std::vector<double>& needed) const {
    const double length =
        skeleton_.offsets.col(arm.elbow).norm() + skeleton_.offsets.col(arm.wrist).norm() / 2;
    std::vector<double> turns(needed.size());
    for (int at = 0; at < frames_; ++at) {
      const double need = needed[Index(at)];
      if (need == 0) continue;
      const double reach = std::max(settle_, StepSeconds(need * length, kGravity) * context_.fps);
      const int to = std::min(frames_, at + static_cast<int>(std::ceil(reach)));
      for (int frame = std::max(0, at - static_cast<int>(reach)); frame < to; ++frame) {
        const int from_end = context_.keyed ? frames_ - 1 - frame : frames_;
        const double share = SmoothStep(std::min(1.0, std::min(frame + 1, from_end) / settle_)) *
                             (1 - SmoothStep(std::min(1.0, std::abs(frame - at) / reach)));
        turns[Index(frame)] = std::max(turns[Index(frame)], share * need);
      }
    }
    return turns;
  }

  // The turn from which an arm that `turn` has turned is `least` away from the trunk's line.
  double TurnFor(const Arm& arm, const JointPlacement& at, const Vector3d& lever, double turn,
                 const Vector3d& way, double least) const {
    // The nearest point moves about as the middle of the forearm does.
    const Vector3d gain = ExpMap(turn * lever) * lever.cross(Middle(arm, at));
    const double gg = gain.squaredNorm(), wg = way.dot(gain);
    if (gg < 1e-9) return turn;
    return turn + (std::sqrt(wg * wg + gg * (least * least - way.squaredNorm())) - wg) / gg;
  }

  // How far a detour of frames [from, to) leaves the arm inside, metres. Adds the turns from which
  // frames would be outside to `needed`.
  double Inside(const Arm& arm, const std::vector<double>& least, int from, int to,
                const Detour& detour, std::vector<double>* needed) const {
    double inside = 0;
    for (int frame = 0; frame < frames_ - (context_.keyed ? 1 : 0); ++frame) {
      const double turn = detour.turns[Index(frame)];
      if (turn == 0 && (frame < from || frame >= to)) continue;
      const Vector3d lever = Lever(arm, At(frame), detour.towards);
      const Vector3d way = Way(arm, At(frame), ExpMap(turn * lever));
      const double more = least[Index(frame)] - way.norm();
      if (more <= 0) continue;
      inside = std::max(inside, more);
      (*needed)[Index(frame)] =
          std::min(M_PI / 2, TurnFor(arm, At(frame), lever, turn, way, least[Index(frame)]));
    }
    return inside;
  }

  // The detour of frames [from, to). One that would whirl goes a half, a quarter or an eighth of
  // it.
  Detour Around(const Arm& arm, const std::vector<double>& least, int from, int to,
                const Vector3d& towards) const {
    Detour detour{.towards = towards, .turns = std::vector<double>(plan_.size())};
    std::vector<double> needed(plan_.size());
    double inside = Inside(arm, least, from, to, detour, &needed);
    for (int round = 0; inside > 0 && round < kDetourRounds; ++round) {
      detour.turns = Spread(arm, needed);
      inside = Inside(arm, least, from, to, detour, &needed);
    }
    detour.whirls = Whirls(arm, detour);
    for (int round = 0; detour.whirls && round < kDetourRounds; ++round) {
      for (double& turn : detour.turns) turn /= 2;
      inside = Inside(arm, least, from, to, detour, &needed);
      detour.whirls = Whirls(arm, detour);
    }
    detour.left_cm = static_cast<int>(std::lround(100 * inside));
    const auto moved = [&](int frame) -> Vector3d {
      const double turn = frame < 0 || frame >= frames_ ? 0 : detour.turns[Index(frame)];
      if (turn == 0) return Vector3d::Zero();
      const Vector3d middle = Middle(arm, At(frame));
      return ExpMap(turn * Lever(arm, At(frame), towards)) * middle - middle;
    };
    for (int frame = 0; frame < frames_; ++frame)
      detour.shaking += (moved(frame + 1) - 2 * moved(frame) + moved(frame - 1)).squaredNorm();
    return detour;
  }

  // The shoulder's rotation in its parent's frame, turned.
  Matrix3d Shoulder(const Arm& arm, const JointPlacement& at, const Detour& detour,
                    double turn) const {
    return at.rotations[Index(ParentOf(arm.shoulder))].transpose() *
           ExpMap(turn * Lever(arm, at, detour.towards)) * at.rotations[Index(arm.shoulder)];
  }

  bool Whirls(const Arm& arm, const Detour& detour) const {
    const auto step = [&](int frame, double before, double now) {
      const JointPlacement& last = frame == 0 ? before_ : At(frame - 1);
      return Eigen::AngleAxisd(Shoulder(arm, last, detour, before).transpose() *
                               Shoulder(arm, At(frame), detour, now))
          .angle();
    };
    for (int frame = 0; frame < frames_; ++frame) {
      const double before = frame == 0 ? 0 : detour.turns[Index(frame - 1)];
      const double now = detour.turns[Index(frame)];
      if (before == 0 && now == 0) continue;
      const double most = std::max(kFastestShoulder / context_.fps, step(frame, 0, 0));
      if (step(frame, before, now) > most) return true;
    }
    return false;
  }

  void Apply(const Arm& arm, const Detour& detour) {
    for (int frame = 0; frame < frames_; ++frame) {
      const double turn = detour.turns[Index(frame)];
      if (turn == 0) continue;
      JointPlacement& at = placed_[Index(frame)];
      auto rotation = plan_[Index(frame)].rotations.col(arm.shoulder);
      rotation = NearestBranch(LogMap(Shoulder(arm, at, detour, turn)), Vector3d(rotation));
      ForwardKinematics(skeleton_, plan_[Index(frame)], at);
    }
  }

  const PlanContext& context_;
  const Skeleton& skeleton_;
  std::vector<Pose>& plan_;
  const int frames_;
  const double settle_;  // kSettleSeconds, in frames
  const TrunkLine trunk_;
  const JointPlacement before_;
  std::vector<JointPlacement> placed_;  // the plan
};

}  // namespace

void KeepArmsOutside(const PlanContext& context, std::vector<Pose>* plan) {
  const std::vector<Arm> arms = ArmsOf(context.skeleton);
  if (arms.empty() || plan->empty()) return;
  ArmClearer clearer(context, plan);
  clearer.Clear({arms[0], Vector3d::UnitX()});
  clearer.Clear({arms[1], -Vector3d::UnitX()});
}

}  // namespace choreo
