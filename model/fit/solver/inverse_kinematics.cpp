#include "model/fit/solver/inverse_kinematics.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "model/core/grid.h"
#include "model/fit/solver/fit_problem.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

constexpr double kPinAccuracy = 0.0005;  // metres, of targets
constexpr int kIterations = 200;
// Weights of other joints' positions relative to targets: feet stay, a moved foot keeps its
// rotation, and the trunk and the ends of other limbs give way by centimetres.
constexpr double kFirm = 3;
constexpr double kAlong = 0.05;
constexpr double kLoose = 0.01;

/// A joint's position and its weight.
struct Pin {
  Eigen::Vector3d position;
  double weight;
};

// Distance from the present pose counts; distance from rest costs almost nothing.
constexpr FitOptions kDrawnOptions = {.rest_rad = 6,
                                      .stiff_rad = 3,
                                      .twist_rad = 3,
                                      .foot_turn_rad = 1,
                                      .hinge_side_rad = 0.08,
                                      .change_rad = 0.3};

// Pins by joint: the targets, and all joints that should stay.
std::map<int, Pin> PinsOf(const Skeleton& skeleton, const Eigen::Matrix3Xd& now,
                          std::span<const JointTarget> targets, UpperBody upper_body) {
  Eigen::Vector3d follows = Eigen::Vector3d::Zero();
  const auto pelvis = std::ranges::find(targets, 0, &JointTarget::joint);
  if (upper_body == UpperBody::kFollowsPelvis && pelvis != targets.end())
    follows = pelvis->position - now.col(0);
  std::map<int, Pin> pins = {{0, {now.col(0), kLoose}}};
  for (const char* name :
       {"spine3", "head", "left_wrist", "right_wrist", "left_hand", "right_hand"}) {
    if (const int joint = skeleton.Find(name); joint >= 0)
      pins[joint] = {now.col(joint) + follows, kLoose};
  }
  const auto& feet = skeleton.feet;
  for (const int foot : feet) {
    if (foot >= 0) pins[foot] = {now.col(foot), kFirm};
  }
  for (const JointTarget& target : targets) {
    const Eigen::Vector3d way = target.position - now.col(target.joint);
    // Joints above or below a target move along with it.
    for (auto pin = pins.begin(); pin != pins.end();) {
      const int joint = pin->first;
      const bool along =
          skeleton.parents[joint] == target.joint || skeleton.parents[target.joint] == joint;
      if (along) pin->second = {now.col(joint) + way, kAlong};
      const bool foot = std::ranges::find(feet, joint) != feet.end();
      pin = along && !foot ? pins.erase(pin) : std::next(pin);
    }
  }
  for (const JointTarget& target : targets) pins[target.joint] = {target.position, 1};
  return pins;
}

SourceMapping Landmarks(const Skeleton& skeleton, const std::map<int, Pin>& pins) {
  SourceMapping mapping{.name = "pins", .landmarks = {}, .accuracy_m = kPinAccuracy, .feet = {}};
  for (const auto& [joint, pin] : pins) {
    const std::string& name = skeleton.joint_names[joint];
    mapping.landmarks.push_back({.name = name,
                                 .source = {{name, 1}},
                                 .ours = {{.joint = name}},
                                 .parent = mapping.landmarks.empty() ? -1 : 0,
                                 .weight = pin.weight});
  }
  return mapping;
}

}  // namespace

DrawnPose DrawJoints(const Skeleton& skeleton, const Pose& pose,
                     std::span<const JointTarget> targets, UpperBody upper_body) {
  const Eigen::Matrix3Xd now = JointPositions(skeleton, pose);
  DrawnPose drawn{pose, {}};
  if (targets.empty()) return drawn;
  const std::map<int, Pin> pins = PinsOf(skeleton, now, targets, upper_body);
  Eigen::Matrix3Xd places(3, std::ssize(pins));
  Eigen::Index mark = 0;
  for (const auto& [joint, pin] : pins) places.col(mark++) = pin.position;
  FitProblem problem(skeleton, Landmarks(skeleton, pins), kDrawnOptions, kModelFps);
  problem.Solve(places, {.before = &pose}, kIterations, drawn.pose);
  MakeContinuous(drawn.pose, pose);
  const Eigen::Matrix3Xd ended = JointPositions(skeleton, drawn.pose);
  for (const JointTarget& target : targets)
    drawn.missed_m.push_back((ended.col(target.joint) - target.position).norm());
  return drawn;
}

}  // namespace choreo
