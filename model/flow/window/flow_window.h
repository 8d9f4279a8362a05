#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/flow/priors/motion_prior.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/mirror.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"
#include "model/plan/motion_request.h"

namespace choreo {

/// A request for a window of frames, apart from noise, in the canonical frame of the last history
/// pose (motion/kinematics/canonical.h). Without a path the dancer returns to the stage's middle
/// and faces its audience, unless a key fixes the root's position or rotation. A target's height is
/// its pose's.
struct WindowRequest : MotionRequest {
  int to_key = 0;  ///< frames from the history to the target, if any, >= the window's
  /// The rotation vector by which the root turns to its key. None: what the history suggests.
  std::optional<Eigen::Vector3d> turn_to_key = {};
  /// About how far the root turns about the vertical by the window's end, radians, if no key fixes
  /// the rotation. The dancer faces the audience by the whole turns nearest to this. None: what the
  /// history suggests.
  std::optional<double> free_turn = {};
  int style = -1;  ///< index of a style, or -1

  /// The request for the frames [from, from + count) only, with `poses` as history. `ground`: the
  /// new canonical frame, in this request's frame.
  WindowRequest Part(int from, int count, std::span<const Pose> poses,
                     const GroundFrame& ground) const;
  /// Whether the stage's middle counts, and whether its front does.
  bool StageCounts() const {
    return stage && !controls[kRootPath].IsGiven() && !(target && target->mask.root_position);
  }
  bool FrontCounts() const {
    return stage && !controls[kRootPath].IsGiven() && !(target && target->mask.Constrains(0));
  }
};

/// The mirrored request, in the mirrored canonical frame.
WindowRequest Mirror(const std::vector<int>& pairs, const WindowRequest& request);

/// A typical free turn for the request (WindowRequest::free_turn). `normal`: a standard normal
/// number.
double FreeTurn(const MotionPrior& prior, const WindowRequest& request, double normal);

/// EnergyLevel of each body part in each frame, [kBodyParts, w]; NaN if not requested.
Eigen::MatrixXd LevelCurves(const WindowRequest& request,
                            const std::array<double, kBodyParts>& medians);
/// EnergyLevel of the mean factor of each requested body part.
std::array<std::optional<double>, kBodyParts> LevelsOf(
    const WindowRequest& request, const std::array<double, kBodyParts>& medians);

/// A window in the flow's coordinates: residuals x [dimensions, w] from the motion prior's mean, or
/// z, whitened by the prior's spread. Dimensions: root position (metres), then a rotation vector
/// per joint, local to the mean's rotation (radians). A key that counts is the mean's last pose.
class FlowWindow {
 public:
  /// The request must be valid.
  FlowWindow(const MotionPrior& prior, const WindowRequest& request);

  int frames() const { return static_cast<int>(mean_.cols()); }
  /// [dimensions, w] Displacements from the last history pose, in its own tangent space.
  const Eigen::MatrixXd& mean() const { return mean_; }
  /// Displacements of the history's poses, [dimensions, tau]; the last column is zero.
  const Eigen::MatrixXd& history() const { return history_; }
  /// The history's last step, [dimensions], at most MotionPrior::kMaxSpeed.
  const Eigen::VectorXd& velocity() const { return velocity_; }
  /// The displacement to the key, [dimensions]; zero in dimensions that it leaves open.
  const Eigen::VectorXd& displacement() const { return displacement_; }
  /// Which dimensions the key fixes, [dimensions].
  const std::vector<bool>& keyed() const { return keyed_; }
  /// Whether the stage determines how the root's position continues.
  bool staged() const { return stage_ != nullptr; }

  /// Mean square of the displacement to the key or, without a key, of the history's velocity,
  /// relative to what the prior expects.
  double surprise() const { return surprise_; }
  /// MotionPrior::Scales for the surprise and the requested energy, [dimensions, w]: the units of
  /// white coordinates.
  const Eigen::MatrixXd& scales() const { return scales_; }
  /// Replaces the energy of the window's request. All other fields must be equal.
  void SetEnergy(const MotionPrior& prior, const WindowRequest& request);

  /// Poses of all frames → x; none if a joint is farther from the mean than coordinates reach, or
  /// ends a whole turn away from the key.
  std::optional<Eigen::MatrixXd> Encode(std::span<const Pose> poses) const;
  std::vector<Pose> Decode(const Eigen::MatrixXd& x) const;
  /// Converts z to x, and one dimension's row back.
  Eigen::MatrixXd Colour(const Eigen::MatrixXd& z) const;
  /// Positions of `skeleton`'s joints in Decode(x)'s poses, [3 joints, w].
  Eigen::MatrixXf PlaceJoints(const Skeleton& skeleton, const Eigen::MatrixXd& x) const;
  Eigen::VectorXd Whiten(int dimension, const Eigen::VectorXd& x) const;

 private:
  // The steps of the constructor, in this order. `velocities`: the last ones, [dimensions, kPast].
  void SetKey(const MotionPrior& prior, const WindowRequest& request);
  void SetMean(const MotionPrior& prior, const WindowRequest& request,
               const Eigen::MatrixXd& velocities);
  void FaceAudience(const MotionPrior& prior, const WindowRequest& request,
                    const Eigen::MatrixXd& velocities);
  void SetBase(const Pose& last);

  // A joint's local rotation in Decode(x)'s poses.
  Eigen::Quaterniond RotationOf(const Eigen::MatrixXd& x, int frame, int joint) const;
  const MotionPrior::Bridge& BridgeOf(int dimension) const {
    const auto d = static_cast<size_t>(dimension);
    if (dimension == MotionPrior::kTurn && facing_) return *facing_;
    return (keyed_[d] ? *to_key_ : d < 3 && stage_ ? *stage_ : *free_)[d];
  }

  std::shared_ptr<const std::vector<MotionPrior::Bridge>> to_key_, free_, stage_;
  std::shared_ptr<const MotionPrior::Bridge> facing_;
  std::vector<bool> keyed_;
  Eigen::MatrixXd mean_, history_;
  Eigen::VectorXd velocity_, displacement_;
  double surprise_ = 1;
  Eigen::MatrixXd scales_;
  std::vector<Pose> base_;                      // the mean, as poses
  std::vector<Eigen::Quaterniond> base_turns_;  // their local rotations, frame by frame
};

}  // namespace choreo
