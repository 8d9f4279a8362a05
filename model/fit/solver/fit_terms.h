#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/fit/sources/landmarks.h"
#include "model/motion/kinematics/kinematics.h"

/// The terms of one frame's least-squares problem, each with its residual, cost and Jacobian. The 3
/// + 3 * joints unknowns are the root's position and a rotation of each joint in its parent's
/// frame.
namespace choreo {

/// Standard deviations of the least-squares terms, besides SourceMapping::accuracy_m.
struct FitOptions {
  double rest_rad = 1.2;           ///< of every joint from its rest rotation
  double stiff_rad = 0.5;          ///< of spine, collars, neck, head, wrists, feet: likewise
  double twist_rad = 0.7;          ///< of hips and shoulders about the bone below
  double foot_turn_rad = 0.35;     ///< of ankles about the shin
  double hinge_side_rad = 0.35;    ///< of knees and elbows off their hinge axis
  double hinge_limit_rad = 0.006;  ///< of knees and elbows beyond straight
  double change_rad = 0.12;        ///< of every joint since the frame before, at 30 fps
  int iterations = 3;              ///< per frame with a predecessor
  bool recover = true;             ///< restart where the fit is lost, even if the motion then jumps
  bool ground = true;              ///< FitClip only: put the body on the floor (Ground)
};

/// A frame's neighbours in time; either may be null.
struct FitNeighbours {
  const Pose* before = nullptr;
  const Pose* after = nullptr;
};

/// Positions of a pose's joints and landmarks.
struct FitPlaces {
  JointPlacement joints;
  Eigen::Matrix3Xd marks;  ///< [3, landmarks]
};

/// Residuals, three rows each, and their Jacobian, [rows, 3 + 3 * joints].
struct FitRows {
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd residual;
};

/// Pulls landmarks to their targets. Skeleton and marks must outlive the term.
class LandmarkTerm {
 public:
  LandmarkTerm(const Skeleton& skeleton, const LandmarkSet& marks, double accuracy_m)
      : skeleton_(skeleton), marks_(marks), accuracy_m_(accuracy_m) {}

  void AddCost(const FitPlaces& places, const Eigen::Matrix3Xd& targets, double* cost) const;
  /// Fills the first rows, landmark by landmark. Expects a zero Jacobian.
  void Linearise(const FitPlaces& places, const Eigen::Matrix3Xd& targets, FitRows* rows) const;

 private:
  static Eigen::Vector3d Missed(int mark, const FitPlaces& places,
                                const Eigen::Matrix3Xd& targets) {
    return places.marks.col(mark) - targets.col(mark);
  }

  const Skeleton& skeleton_;
  const LandmarkSet& marks_;
  double accuracy_m_;
};

inline constexpr double kSineOfSureBend = 0.3;  ///< a limb bent this much is not straight

/// The plane of a bent limb. Its normal is the hinge axis, which determines the twist of the bone
/// above.
struct HingePlane {
  int upper_joint;
  int upper_mark, hinge_mark, end_mark;
  Eigen::Vector3d axis;                              ///< in the upper joint's frame
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< from this frame's targets, unit length
  double weight = 0;                                 ///< in this frame: 0 for a straight limb
};

/// Pulls hinge axes to the normals of bent limbs' planes. Skeleton and marks must outlive the term.
class HingePlaneTerm {
 public:
  HingePlaneTerm(const Skeleton& skeleton, const LandmarkSet& marks);

  const std::vector<HingePlane>& planes() const { return planes_; }
  int rows() const { return 3 * static_cast<int>(planes_.size()); }

  /// Sets the planes from a frame's targets.
  void Aim(const Eigen::Matrix3Xd& targets);
  void AddCost(const FitPlaces& places, double* cost) const;
  /// Fills the last rows. Expects a zero Jacobian.
  void Linearise(const FitPlaces& places, FitRows* rows) const;

 private:
  static Eigen::Vector3d Axis(const HingePlane& plane, const FitPlaces& places) {
    return places.joints.rotations[plane.upper_joint] * plane.axis;
  }

  const Skeleton& skeleton_;
  std::vector<HingePlane> planes_;
};

/// Pulls each joint weakly to its rest rotation and to its neighbours in time. Keeps knees and
/// elbows on their hinge axes and from bending beyond straight.
class JointTerm {
 public:
  JointTerm(const Skeleton& skeleton, const FitOptions& options, double fps);

  void AddCost(const Pose& pose, const FitNeighbours& neighbours, double* cost) const;
  /// Adds to the normal equations, which have 3 + 3 * joints rows and columns.
  void Linearise(const Pose& pose, const FitNeighbours& neighbours, Eigen::MatrixXd* normal,
                 Eigen::VectorXd* gradient) const;

 private:
  struct Prior {
    Eigen::Matrix3d information;  ///< of log(R) around rest, inverse square radians
    Eigen::Vector3d hinge_axis;   ///< zero if the joint is no hinge

    Eigen::Vector3d Turn(const Eigen::Vector3d& w) const;
    double Beyond(const Eigen::Vector3d& turn) const;
  };

  std::vector<Prior> priors_;
  double change_information_;
  double limit_rad_;
};

}  // namespace choreo
