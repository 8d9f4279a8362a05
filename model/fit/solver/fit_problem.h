#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "model/fit/solver/fit_terms.h"
#include "model/fit/sources/landmarks.h"

namespace choreo {

/// Solves the least-squares problem of one frame (fit_terms.h) by Levenberg-Marquardt in the
/// tangent space of the rotations. Not thread-safe.
class FitProblem {
 public:
  FitProblem(const Skeleton& skeleton, const SourceMapping& mapping, const FitOptions& options,
             double fps);
  FitProblem(const FitProblem&) = delete;
  FitProblem& operator=(const FitProblem&) = delete;

  /// Improves `pose` by at most `iterations` accepted steps. Returns the weighted RMS distance of
  /// landmarks from targets, metres.
  double Solve(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours, int iterations,
               Pose& pose);

  /// Computes an initial pose for a frame without a predecessor. From the root outwards, each joint
  /// takes the rotation that best turns its landmarks' rest directions into the targets' (Kabsch).
  /// A bent limb's plane determines the twist of its hip or shoulder.
  Pose Start(const Eigen::Matrix3Xd& targets) const;
  /// The total rotation from rest over all joints of the trunk, radians.
  double TrunkTurn(const Pose& pose) const;

  /// The landmarks of the pose that Solve returned last, [3, landmarks].
  const Eigen::Matrix3Xd& landmarks() const { return places_.marks; }

 private:
  double Cost(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours, const Pose& pose);
  void Linearise(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours,
                 const Pose& pose);
  void Place(const Pose& pose);
  bool InTrunk(int joint) const;  ///< whether it is between the root and both shoulders

  const Skeleton skeleton_;
  const LandmarkSet marks_;
  const LandmarkTerm landmark_term_;
  HingePlaneTerm hinge_term_;
  const JointTerm joint_term_;

  FitPlaces rest_, places_;
  FitRows rows_;
  Eigen::MatrixXd normal_, damped_;
  Eigen::VectorXd gradient_, step_;
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
  Pose trial_;
};

}  // namespace choreo
