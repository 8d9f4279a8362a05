#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace choreo {

/// Rest skeleton. Right-handed, Y up, metres; the rest pose faces +Z, its left side towards +X.
/// Immutable after construction, hence safe to share between threads.
struct Skeleton {
  std::string name;
  std::vector<std::string> joint_names;
  std::vector<int> parents;  ///< parents[0] = -1; parents always stand before their children
  Eigen::Matrix3Xd offsets;  ///< [3, joints] rest offset from the parent, metres; column 0 is zero
  double pelvis_height = 0;  ///< height of joint 0 above the floor when standing at rest, metres

  /// Joints that the motion mathematics asks for by role.
  int left_hip = -1, right_hip = -1, left_knee = -1, right_knee = -1;
  int left_shoulder = -1, right_shoulder = -1, left_elbow = -1, right_elbow = -1;
  /// Left ankle, left toes, right ankle, right toes: the order of paper F's contacts c_t
  /// (Section 3.2.1).
  std::array<int, 4> feet = {-1, -1, -1, -1};

  int joints() const { return static_cast<int>(parents.size()); }

  /// Index of a joint by name, or -1.
  int Find(const std::string& joint_name) const;

  /// Sets the roles above from the joint names: left_hip, right_hip, left_knee, ..., left_ankle,
  /// and for the toes left_foot, left_toes or left_toe. A role that no joint plays stays -1.
  void AssignRoles();

  /// Sets pelvis_height so that at rest the lowest joint stands `clearance` metres above the floor.
  void StandOnFloor(double clearance);

  /// Throws Error(kInvalidArgument) naming the first joint that breaks an invariant above.
  void Validate() const;

  /// SMPL's 24 joints (neutral body). The only place that knows them. At rest the lower toe joint
  /// stands 2 cm above the floor (half a toe's thickness), which puts the ankles about 8 cm above
  /// it.
  static const Skeleton& Smpl24();
};

}  // namespace choreo
