#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "model/motion/fit.h"
#include "model/motion/fit_landmarks.h"
#include "model/motion/kinematics.h"

namespace choreo {

/// The least-squares problem of one frame: unknown are the root's position and every joint's local
/// rotation. Terms: landmarks on their targets; every joint near its rest rotation (weakly, and
/// knees and elbows on their hinge); no hinge beyond straight; little change from the neighbours in
/// time. Solved by Levenberg-Marquardt on the rotations' tangent space. Preallocated; not
/// thread-safe.
class FitProblem {
 public:
  FitProblem(const Skeleton& skeleton, const SourceMapping& mapping, const FitOptions& options,
             double fps);

  /// What the frame is tied to; either may be null.
  struct Neighbours {
    const Pose* before = nullptr;
    const Pose* after = nullptr;
  };

  /// Improves `pose` by at most `iterations` steps, not counting trials that are refused.
  /// Returns the landmarks' root mean square
  /// distance from the targets, each by its weight, metres.
  double Solve(const Eigen::Matrix3Xd& targets, const Neighbours& neighbours, int iterations,
               Pose& pose);

  /// A start without a predecessor: joint by joint from the root, the rotation that best turns the
  /// rest directions of the landmarks below onto the targets' (Kabsch), with a bent limb's plane
  /// for the twist of hips and shoulders.
  void Initialise(const Eigen::Matrix3Xd& targets, Pose& pose) const;

  /// How far the trunk is turned from rest, all its joints together, radians.
  double TrunkTurn(const Pose& pose) const;

  int landmarks_count() const { return marks_.size(); }
  /// Of the pose that Solve returned last, [3, landmarks].
  const Eigen::Matrix3Xd& landmarks() const { return positions_; }

 private:
  struct JointPrior {
    Eigen::Matrix3d information;  ///< of log(R) around rest, inverse square radians
    Eigen::Vector3d hinge_axis;   ///< zero where the joint is no hinge
  };

  /// A bent limb's plane tells where its hinge axis points, which fixes the twist of the bone
  /// above.
  struct HingePlane {
    int upper_joint;
    int upper_mark, hinge_mark, end_mark;
    Eigen::Vector3d axis;    ///< in the upper joint's frame
    Eigen::Vector3d normal;  ///< of this frame's targets, unit length
    double weight;           ///< of this frame: 0 for a straight limb
  };

  void AimHinges(const Eigen::Matrix3Xd& targets);
  double Cost(const Eigen::Matrix3Xd& targets, const Neighbours& neighbours, const Pose& pose);
  void Linearise(const Eigen::Matrix3Xd& targets, const Neighbours& neighbours, const Pose& pose);
  void AddPositionRows(const Eigen::Matrix3Xd& targets);
  void AddHingeRows();
  void SetHinge(const Hinge& hinge);
  bool IsBelow(int joint, int ancestor) const;
  bool InTrunk(int joint) const;  ///< between the root and both shoulders

  const Skeleton skeleton_;
  const LandmarkSet marks_;
  const FitOptions options_;
  double accuracy_m_;
  double change_information_;
  std::vector<JointPrior> priors_;
  std::vector<HingePlane> hinges_;
  Eigen::Matrix3Xd rest_joints_, rest_marks_;

  JointPlacement placement_;
  Eigen::Matrix3Xd positions_;
  Eigen::MatrixXd jacobian_;  ///< [3 landmarks + 3 hinges, 3 + 3 joints]
  Eigen::VectorXd residual_;
  Eigen::MatrixXd normal_, damped_;
  Eigen::VectorXd gradient_, step_;
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
  Pose trial_;
};

}  // namespace choreo
