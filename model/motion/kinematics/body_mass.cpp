#include "model/motion/kinematics/body_mass.h"

#include <algorithm>
#include <initializer_list>

#include "model/motion/kinematics/limb.h"

namespace choreo {
namespace {

// Percent of the body's mass, and the position of the centre along the segment from its first end.
struct Segment {
  double mass, centre;
};
// The trunk reaches from the middle of the shoulders to the middle of the hips. The head's joint
// lies midway between crown and last cervical vertebra, as does the head's centre; the foot's
// centre lies between ankle and toe joints.
constexpr double kHead = 6.81;
constexpr Segment kTrunkSegment = {43.015, 0.40465};
constexpr Segment kUpperArm = {2.63, 0.5763}, kForearm = {1.5, 0.45665}, kHand = {0.585, 0.76870};
constexpr Segment kThigh = {14.47, 0.38535}, kShank = {4.57, 0.43735}, kFoot = {1.33, 0.5};

}  // namespace

Eigen::VectorXd MassWeights(const Skeleton& skeleton) {
  const int head = skeleton.Find("head");
  if (std::min({head, skeleton.left_hip, skeleton.right_hip, skeleton.left_knee,
                skeleton.right_knee, skeleton.left_shoulder, skeleton.right_shoulder,
                skeleton.left_elbow, skeleton.right_elbow}) < 0 ||
      std::ranges::min(skeleton.feet) < 0)
    return {};
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(skeleton.joints());
  const auto add = [&](const Segment& segment, std::initializer_list<int> from,
                       std::initializer_list<int> to) {
    for (const int joint : from)
      weights[joint] += segment.mass * (1 - segment.centre) / static_cast<double>(from.size());
    for (const int joint : to)
      weights[joint] += segment.mass * segment.centre / static_cast<double>(to.size());
  };
  weights[head] += kHead;
  add(kTrunkSegment, {skeleton.left_shoulder, skeleton.right_shoulder},
      {skeleton.left_hip, skeleton.right_hip});
  const auto add_arm = [&](int shoulder, int elbow) {
    const int wrist = FirstChild(skeleton, elbow);
    if (wrist < 0) return false;
    const int hand = FirstChild(skeleton, wrist);
    add(kUpperArm, {shoulder}, {elbow});
    add(kForearm, {elbow}, {wrist});
    add(kHand, {wrist}, {hand < 0 ? wrist : hand});
    return true;
  };
  const auto add_leg = [&](int hip, int knee, int ankle, int toes) {
    add(kThigh, {hip}, {knee});
    add(kShank, {knee}, {ankle});
    add(kFoot, {ankle}, {toes});
  };
  if (!add_arm(skeleton.left_shoulder, skeleton.left_elbow) ||
      !add_arm(skeleton.right_shoulder, skeleton.right_elbow))
    return {};
  add_leg(skeleton.left_hip, skeleton.left_knee, skeleton.feet[0], skeleton.feet[1]);
  add_leg(skeleton.right_hip, skeleton.right_knee, skeleton.feet[2], skeleton.feet[3]);
  return weights / weights.sum();
}

}  // namespace choreo
