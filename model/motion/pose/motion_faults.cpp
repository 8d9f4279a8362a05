#include "model/motion/pose/motion_faults.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/core/rounded.h"
#include "model/core/text/counted.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/floor/hovers.h"
#include "model/motion/floor/support.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/limb.h"
#include "model/motion/kinematics/trunk_line.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

// Seconds. Stretches less apart are one to people, and shorter hovers may be steps.
constexpr double kMoment = 0.2;

class FaultFinder {
 public:
  FaultFinder(const Skeleton& skeleton, const Motion& motion)
      : skeleton_(skeleton), fps_(motion.fps), clearance_(FloorClearance(skeleton)) {
    track_.reserve(motion.frames.size());
    for (const Pose& pose : motion.frames) track_.push_back(JointPositions(skeleton, pose));
  }

  std::vector<MotionFault> Find() {
    FindArms();
    FindDepths();
    FindSnaps();
    if (BalanceGauge::Fits(skeleton_)) {
      const std::vector<Balance> balance = BalanceOf(skeleton_, fps_, track_, 0);
      FindFloating(balance);
      FindSliding(balance);
    }
    std::ranges::stable_sort(found_, {}, &MotionFault::first);
    return std::move(found_);
  }

 private:
  /// Adds the stretches in which the values of a joint are beyond the limit. `sign`: -1 if smaller
  /// is worse.
  template <class JointAt>
  void AddStretches(MotionFaultKind kind, const std::vector<double>& values, const JointAt& joint,
                    double sign = 1) {
    const auto apart = static_cast<int64_t>(kMoment * fps_);
    MotionFault* open = nullptr;
    for (int64_t frame = 0; frame < std::ssize(values); ++frame) {
      const double value = values[static_cast<size_t>(frame)];
      if (sign * value <= sign * LimitOf(kind)) continue;
      if (open == nullptr || frame - open->last > apart)
        open = &found_.emplace_back(MotionFault{kind, frame, frame, joint(frame), value});
      open->last = frame;
      if (sign * value <= sign * open->worst) continue;
      open->worst = value;
      open->joint = joint(frame);
    }
  }

  void FindArms() {
    const std::vector<Arm> arms = ArmsOf(skeleton_);
    if (arms.empty()) return;
    const TrunkLine trunk(skeleton_);
    for (const Arm& arm : arms) {
      std::vector<double> distances;
      for (const Eigen::Matrix3Xd& joints : track_)
        distances.push_back(trunk.WayTo(arm, joints).norm());
      AddStretches(
          MotionFaultKind::kArmInside, distances, [&](int64_t) { return arm.wrist; }, -1);
    }
  }

  void FindDepths() {
    std::vector<double> depths;
    std::vector<int> deepest;
    for (const Eigen::Matrix3Xd& joints : track_)
      depths.push_back((clearance_ - joints.row(1)).maxCoeff(&deepest.emplace_back()));
    AddStretches(MotionFaultKind::kUnderFloor, depths,
                 [&](int64_t frame) { return deepest[static_cast<size_t>(frame)]; });
  }

  void FindSnaps() {
    for (const Hinge& hinge : Hinges(skeleton_)) {
      for (const int end : {hinge.joint, FirstChild(skeleton_, hinge.joint)})
        if (end >= 0) FindSnaps(end);
    }
  }

  void FindSnaps(int end) {
    const int upper = skeleton_.parents[static_cast<size_t>(end)];
    const auto bone = [&](size_t frame) -> Eigen::Vector3d {
      return (track_[frame].col(end) - track_[frame].col(upper)).normalized();
    };
    std::vector<double> accelerations(track_.size());
    for (size_t at = 1; at + 1 < track_.size(); ++at)
      accelerations[at] = (bone(at + 1) - 2 * bone(at) + bone(at - 1)).norm() * fps_ * fps_;
    AddStretches(MotionFaultKind::kSnap, accelerations, [&](int64_t) { return end; });
  }

  void FindFloating(const std::vector<Balance>& balance) {
    std::vector<double> heights;
    for (const Eigen::Matrix3Xd& joints : track_)
      heights.push_back((joints.row(1) - clearance_).minCoeff());
    for (const auto& [first, end] :
         FindHovers(heights, balance, LimitOf(MotionFaultKind::kFloating))) {
      if (static_cast<double>(end - first) < kMoment * fps_) continue;
      const auto at = [&](size_t frame) { return heights.begin() + static_cast<int64_t>(frame); };
      found_.push_back({MotionFaultKind::kFloating, static_cast<int64_t>(first),
                        static_cast<int64_t>(end) - 1, 0, *std::max_element(at(first), at(end))});
    }
  }

  void FindSliding(const std::vector<Balance>& balance) {
    for (size_t foot = 0; foot < 4; foot += 2) {
      MotionFault slide = {MotionFaultKind::kSliding, 0, 0, skeleton_.feet[foot + 1]};
      for (size_t at = 1; at <= track_.size(); ++at) {
        const double way = at < track_.size() ? SlidOf(balance[at - 1], balance[at], foot) : 0;
        if (way > 0) {
          if (slide.worst == 0) slide.first = static_cast<int64_t>(at) - 1;
          slide.last = static_cast<int64_t>(at);
          slide.worst += way;
          continue;
        }
        if (slide.worst > LimitOf(slide.kind)) found_.push_back(slide);
        slide.worst = 0;
      }
    }
  }

  /// How far a foot, as a whole, slides over the floor from one frame to the next, metres; 0 if it
  /// steps or stands. A foot that turns on its toes or its heel does not slide.
  double SlidOf(const Balance& before, const Balance& now, size_t foot) const {
    double way = INFINITY;
    for (const size_t end : {foot, foot + 1}) {
      if (!before.on_floor[end] || !now.on_floor[end]) return 0;
      const auto column = static_cast<Eigen::Index>(end);
      const Eigen::Vector3d step = now.feet.col(column) - before.feet.col(column);
      way = std::min(way, std::hypot(step.x(), step.z()));
    }
    return way * fps_ > kSkateSpeed ? way : 0;
  }

  const Skeleton& skeleton_;
  const double fps_;
  const Eigen::RowVectorXd clearance_;
  std::vector<Eigen::Matrix3Xd> track_;
  std::vector<MotionFault> found_;
};

std::string Centimetres(double metres) { return Rounded(std::round(1000 * metres) / 10) + " cm"; }

}  // namespace

std::vector<MotionFault> FindMotionFaults(const Skeleton& skeleton, const Motion& motion) {
  if (motion.frames.empty()) return {};
  if (std::abs(motion.fps - kModelFps) <= kOnFrame) return FaultFinder(skeleton, motion).Find();
  std::vector<MotionFault> faults = FaultFinder(skeleton, Resample(motion, kModelFps)).Find();
  for (MotionFault& fault : faults) {
    fault = AtRate(fault, kModelFps, motion.fps);
    fault.last = std::min(fault.last, std::ssize(motion.frames) - 1);
  }
  return faults;
}

MotionFault AtRate(MotionFault fault, double from, double to) {
  const auto frame = [&](int64_t at) { return std::llround(static_cast<double>(at) * to / from); };
  const int64_t end = frame(fault.last + 1);
  fault.first = frame(fault.first);
  fault.last = std::max(fault.first, end - 1);
  return fault;
}

std::string Describe(const Skeleton& skeleton, const MotionFault& fault) {
  const std::string joint = skeleton.joint_names[static_cast<size_t>(fault.joint)] + ": ";
  switch (fault.kind) {
    case MotionFaultKind::kArmInside:
      return joint + "the arm is " + Centimetres(fault.worst) + " from the line of the spine";
    case MotionFaultKind::kFloating:
      return "the body floats " + Centimetres(fault.worst) + " above the floor";
    case MotionFaultKind::kSliding:
      return joint + "the foot slides " + Centimetres(fault.worst) + " while it is on the floor";
    case MotionFaultKind::kUnderFloor:
      return joint + Centimetres(fault.worst) + " under the floor";
    case MotionFaultKind::kSnap:
      break;
  }
  const int upper = skeleton.parents[static_cast<size_t>(fault.joint)];
  return skeleton.joint_names[static_cast<size_t>(upper)] + " to " + joint + "the limb snaps, at " +
         std::to_string(std::lround(fault.worst)) + " rad/s2";
}

std::string CountMotionFaults(std::span<const MotionFault> faults) {
  if (faults.empty()) return "no faults";
  std::string kinds;
  for (const MotionFaultRow& row : kMotionFaults) {
    const auto count = std::ranges::count(
        faults, row.name, [](const MotionFault& fault) { return fault.row().name; });
    if (count == 0) continue;
    kinds += (kinds.empty() ? ": " : ", ") + std::to_string(count) + " " + std::string(row.label);
  }
  return Counted(static_cast<int64_t>(faults.size()), "fault") + kinds;
}

double FaultShare(std::span<const MotionFault> faults, MotionFaultKind kind, int64_t frames) {
  if (frames <= 0) return 0;
  int64_t with = 0, end = 0;  // stretches of two joints may overlap
  for (const MotionFault& fault : faults) {
    if (fault.kind != kind) continue;
    with += std::max<int64_t>(0, fault.last + 1 - std::max(end, fault.first));
    end = std::max(end, fault.last + 1);
  }
  return static_cast<double>(with) / static_cast<double>(frames);
}

}  // namespace choreo
