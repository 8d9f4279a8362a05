#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace choreo {

/// A skeleton at rest: joint names, tree and offsets. Right-handed, Y up, metres; the rest pose
/// faces +Z, its left side towards +X. Safe to share between threads once built.
struct Skeleton {
  std::string name;
  std::vector<std::string> joint_names;
  std::vector<int> parents;  ///< parents[0] = -1; parents precede their children
  Eigen::Matrix3Xd offsets;  ///< [3, joints] rest offset from the parent, metres; column 0 is zero
  double pelvis_height = 0;  ///< height of joint 0 above the floor when standing at rest, metres

  /// Joints with a role in motion code; -1 if the skeleton lacks one.
  int left_hip = -1, right_hip = -1, left_knee = -1, right_knee = -1;
  int left_shoulder = -1, right_shoulder = -1, left_elbow = -1, right_elbow = -1;
  /// Left ankle, left toes, right ankle, right toes.
  std::array<int, 4> feet = {-1, -1, -1, -1};

  int joints() const { return static_cast<int>(parents.size()); }
  bool operator==(const Skeleton&) const = default;
  /// Describes the skeleton in error messages: "'smpl24' of 24 joints".
  std::string Describe() const;

  /// Index of a joint by name, or -1.
  int Find(std::string_view joint_name) const;

  /// Appends a joint and returns its index.
  int AddJoint(const std::string& joint_name, int parent, const Eigen::Vector3d& offset);

  /// Sets the roles above from the joint names: left_hip, right_hip, left_knee, ..., left_ankle,
  /// and for the toes left_foot, left_toes or left_toe. Unfilled roles stay -1.
  void AssignRoles();

  /// Sets pelvis_height so that at rest the lowest joint stands `clearance` metres above the floor;
  /// by default half a toe's thickness.
  void StandOnFloor(double clearance = 0.02);

  /// Throws Error(kInvalidArgument), naming the first joint that breaks an invariant above or has
  /// two roles.
  void Check() const;
  /// Throws Error(kInvalidArgument), naming the first role that no joint has. Dancing needs only
  /// the feet; fitting, retargeting and judging limbs need all roles.
  void RequireRoles() const;

  /// SMPL's 24 joints (neutral body), defined only here. At rest the lower toe joint is 2 cm above
  /// the floor, and the ankles about 8 cm.
  static const Skeleton& Smpl24();
};

/// The index of the first element of `names` that equals `name`, or -1.
int IndexOf(const std::vector<std::string>& names, std::string_view name);

/// Whether `node` is `ancestor` or descends from it. `parents`: -1 for none.
bool IsBelow(int node, int ancestor, const std::vector<int>& parents);

/// Bones that differ by at most this, metres, count as equal, because files and messages round
/// them.
inline constexpr double kSameBone = 0.001;

/// Whether two skeletons can share poses, because they have the same joints, tree and bones.
bool SameBones(const Skeleton& a, const Skeleton& b);

/// A knee or elbow, which bends about one axis. `axis` is in the frame of the bone above at rest. A
/// positive rotation about it bends the natural way (shin backwards, forearm forwards).
struct Hinge {
  int joint = -1;
  int upper = -1;                                  ///< the hip or shoulder above
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< unit length
};

inline constexpr double kMaxHingeBend = 2.7;  ///< radians: the largest bend in plans and fits
inline constexpr double kFolded = 165;        ///< degrees: the largest bend of any body
inline constexpr double kBrokenBackwards =
    15;  ///< degrees: more than limbs, and recordings of them, reach

/// Left knee, right knee, left elbow, right elbow, as far as the skeleton has them.
std::vector<Hinge> Hinges(const Skeleton& skeleton);

}  // namespace choreo
