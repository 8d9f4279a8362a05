#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "model/fit/fit_start.h"
#include "model/fit/fit_terms.h"
#include "model/fit/landmarks.h"
#include "model/fit/position_fitter.h"

namespace choreo {

/// The least-squares problem of one frame (fit_terms.h), solved by Levenberg-Marquardt on the
/// rotations' tangent space. Preallocated; not thread-safe.
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

  /// FitStart.
  void Start(const Eigen::Matrix3Xd& targets, Pose& pose) const { start_.Start(targets, pose); }
  double TrunkTurn(const Pose& pose) const { return start_.TrunkTurn(pose); }

  int landmarks_count() const { return marks_.size(); }
  /// Of the pose that Solve returned last, [3, landmarks].
  const Eigen::Matrix3Xd& landmarks() const { return places_.marks; }

 private:
  double Cost(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours, const Pose& pose);
  void Linearise(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours,
                 const Pose& pose);
  void Place(const Pose& pose);

  const Skeleton skeleton_;
  const LandmarkSet marks_;
  const LandmarkTerm landmark_term_;
  HingePlaneTerm hinge_term_;
  const JointTerm joint_term_;
  const FitStart start_;

  FitPlaces places_;
  FitRows rows_;
  Eigen::MatrixXd normal_, damped_;
  Eigen::VectorXd gradient_, step_;
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
  Pose trial_;
};

}  // namespace choreo
