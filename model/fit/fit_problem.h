#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "model/fit/fit_terms.h"
#include "model/fit/landmarks.h"

namespace choreo {

/// The least-squares problem of one frame (fit_terms.h), solved by Levenberg-Marquardt on the
/// rotations' tangent space. Not thread-safe.
class FitProblem {
 public:
  FitProblem(const Skeleton& skeleton, const SourceMapping& mapping, const FitOptions& options,
             double fps);
  FitProblem(const FitProblem&) = delete;
  FitProblem& operator=(const FitProblem&) = delete;

  /// Improves `pose` by at most `iterations` steps, not counting trials that are refused. Returns
  /// the landmarks' root mean square distance from the targets, each by its weight, metres.
  double Solve(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours, int iterations,
               Pose& pose);

  /// Where to begin without a predecessor: joint by joint from the root, the rotation that best
  /// turns the rest directions of the landmarks below onto the targets' (Kabsch), with a bent
  /// limb's plane for the twist of hips and shoulders.
  Pose Start(const Eigen::Matrix3Xd& targets) const;
  /// How far the trunk is turned from rest, all its joints together, radians.
  double TrunkTurn(const Pose& pose) const;

  /// Of the pose that Solve returned last, [3, landmarks].
  const Eigen::Matrix3Xd& landmarks() const { return places_.marks; }

 private:
  double Cost(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours, const Pose& pose);
  void Linearise(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours,
                 const Pose& pose);
  void Place(const Pose& pose);
  bool InTrunk(int joint) const;  ///< between the root and both shoulders

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
