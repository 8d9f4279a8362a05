#include "model/motion/kinematics/joint_angles.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <string_view>

#include "model/core/error.h"
#include "model/core/text/nearest.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

// Degrees either way about each axis, by part of the joint's name.
constexpr struct {
  std::string_view part;
  double most;
} kMaxTurn[] = {{"collar", 60}, {"wrist", 90}, {"ankle", 80}, {"foot", 60},
                {"toe", 60},    {"spine", 60}, {"neck", 80},  {"head", 80}};

std::optional<Hinge> HingeAt(const Skeleton& skeleton, int joint) {
  for (const Hinge& hinge : Hinges(skeleton)) {
    if (hinge.joint == joint) return hinge;
  }
  return std::nullopt;
}

}  // namespace

AngleRange RangeOf(const Skeleton& skeleton, int joint) {
  if (HingeAt(skeleton, joint)) return {0, kFolded};
  const std::string& name = skeleton.joint_names[static_cast<size_t>(joint)];
  for (const auto& [part, most] : kMaxTurn) {
    if (name.find(part) != std::string::npos) return {-most, most};
  }
  return {-180, 180};
}

int RequireJoint(const Skeleton& skeleton, const std::string& name, const std::string& field) {
  const int joint = skeleton.Find(name);
  if (joint >= 0) return joint;
  // "elbow_left" is left_elbow.
  const size_t side = name.rfind('_');
  Nearest meant(side == std::string::npos ? name
                                          : name.substr(side + 1) + "_" + name.substr(0, side));
  Nearest misspelt(name);
  for (const std::string& known : skeleton.joint_names) meant.Offer(known), misspelt.Offer(known);
  const std::string near = misspelt.nearest().empty() ? meant.nearest() : misspelt.nearest();
  throw InvalidArgument(field, "\"" + name + "\" is not a joint of " + skeleton.name +
                                   (near.empty() ? ", which has " + Joined(skeleton.joint_names)
                                                 : "; did you mean " + near + "?"));
}

Eigen::Vector3d RotationFromDegrees(const Skeleton& skeleton, int joint,
                                    std::span<const double> degrees, const std::string& field) {
  const std::string& name = skeleton.joint_names[static_cast<size_t>(joint)];
  const std::optional<Hinge> hinge = HingeAt(skeleton, joint);
  if (degrees.size() != (hinge ? 1 : 3)) {
    throw InvalidArgument(field, name + " takes " +
                                     (hinge ? "one number, the degrees of its bend"
                                            : "three numbers, degrees about x, y and z") +
                                     "; there are " + std::to_string(degrees.size()));
  }
  const auto [low, high] = RangeOf(skeleton, joint);
  for (size_t i = 0; i < degrees.size(); ++i) {
    if (degrees[i] >= low && degrees[i] <= high) continue;
    std::ostringstream message;
    message << name << " is at " << degrees[i] << " degrees"
            << (hinge ? "" : std::string(" about ") + kAxes[i]) << ", must be " << low << " to "
            << high;
    throw InvalidArgument(field, message.str());
  }
  if (hinge) return degrees[0] / kDegrees * hinge->axis;
  const auto turn = [&](int axis) {
    return ExpMap(degrees[static_cast<size_t>(axis)] / kDegrees * Eigen::Vector3d::Unit(axis));
  };
  return LogMap(turn(2) * turn(1) * turn(0));
}

std::vector<double> DegreesFromRotation(const Skeleton& skeleton, int joint,
                                        const Eigen::Vector3d& rotation) {
  if (const auto hinge = HingeAt(skeleton, joint)) return {kDegrees * hinge->axis.dot(rotation)};
  const Eigen::Matrix3d r = ExpMap(rotation);
  const double cosine = std::hypot(r(0, 0), r(1, 0));  // of the turn about y
  // At a quarter turn about y, x and z turn about the same axis: x takes it all.
  const bool locked = cosine < 1e-9;
  const double x = locked ? std::atan2(-r(1, 2), r(1, 1)) : std::atan2(r(2, 1), r(2, 2));
  const double y = std::atan2(-r(2, 0), cosine);
  const double z = locked ? 0 : std::atan2(r(1, 0), r(0, 0));
  return {kDegrees * x, kDegrees * y, kDegrees * z};
}

}  // namespace choreo
