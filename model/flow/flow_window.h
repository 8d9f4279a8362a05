#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/flow/motion_prior.h"
#include "model/motion/canonical.h"
#include "model/motion/controls.h"
#include "model/motion/mirror.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// What is asked of a window of frames and known of it, besides noise. All poses stand in the
/// canonical frame of the last history pose (motion/canonical.h). What is left empty is unknown.
struct WindowRequest {
  int frames = 0;                  ///< w >= 1
  std::vector<Pose> history = {};  ///< tau poses, oldest first
  /// The pose to reach and which of it counts; none: nothing is awaited.
  std::optional<Pose> key = {};
  PoseMask mask = {};
  bool height = false;  ///< whether the key's height counts where its position does not
  int to_key = 0;       ///< N >= frames, frames from the history to the key; unread without one
  /// The way round that the root is known to turn to its key, a rotation vector. None: the one
  /// that the history leads to.
  std::optional<Eigen::Vector3d> turning = {};
  Controls controls = {};          ///< of its frames
  std::vector<double> beats = {};  ///< in frames from the window's first, ascending, or empty
  EnergyShift energy_shift = {};   ///< of the body parts whose velocity factors nobody asks for
  int style = -1;                  ///< index of a style, or -1
  /// The middle of the floor that the dancer keeps to, or unknown; unread where a key or a path
  /// says where the root goes.
  std::optional<Eigen::Vector3d> stage = {};

  /// What is asked of its frames [from, from + count) alone, behind `poses` instead of its history;
  /// those, and all else, stand in the frame that `ground` is of the request's.
  WindowRequest Part(int from, int count, std::span<const Pose> poses,
                     const GroundFrame& ground) const;
  bool StageCounts() const {
    return stage && !controls[kRootPath].IsGiven() && !(key && mask.root_position);
  }
};

/// The same of a dancer whose left is its right, who stands in the mirrored canonical frame.
WindowRequest Mirror(const std::vector<int>& pairs, const WindowRequest& request);

/// EnergyLevel of each body part in each frame, [kBodyParts, w], NaN where it is not asked for.
Eigen::MatrixXd LevelCurves(const WindowRequest& request,
                            const std::array<double, kBodyParts>& medians);
/// EnergyLevel of the mean factor of each body part that is asked for.
std::array<std::optional<double>, kBodyParts> LevelsOf(
    const WindowRequest& request, const std::array<double, kBodyParts>& medians);

/// A window in the coordinates of the flow: residuals x [dimensions, w] from the motion prior's
/// mean, which the prior's spread makes white, z. Dimensions: root position (metres), then a
/// rotation vector a joint, local to the mean's rotation (radians). A key that counts is the mean's
/// own last pose.
class FlowWindow {
 public:
  /// The request is valid.
  FlowWindow(const MotionPrior& prior, const WindowRequest& request);

  int frames() const { return static_cast<int>(mean_.cols()); }
  /// Displacements from the last history pose, as its own tangent space has them. [dimensions, w]
  const Eigen::MatrixXd& mean() const { return mean_; }
  /// The same of the history's poses, [dimensions, tau]; the last column is zero.
  const Eigen::MatrixXd& history() const { return history_; }
  /// To the key, [dimensions]; zero where it asks for nothing.
  const Eigen::VectorXd& displacement() const { return displacement_; }
  /// Which dimensions the key fixes, [dimensions].
  const std::vector<bool>& keyed() const { return keyed_; }
  /// The stage says how the root's place goes on.
  bool staged() const { return stage_ != nullptr; }

  /// How far the key is or, without one, how fast the history was, of what the prior expects: mean
  /// square.
  double surprise() const { return surprise_; }
  /// MotionPrior::Scales of that and of the energy asked for, [dimensions, w]: white coordinates
  /// are in their units.
  const Eigen::MatrixXd& scales() const { return scales_; }
  /// Another energy is asked for than the request that it was made of asks for; all else is alike.
  void SetEnergy(const MotionPrior& prior, const WindowRequest& request);

  /// Poses of that many frames → x; none where a joint strays from the mean farther than the
  /// coordinates reach, or ends a turn away from the key.
  std::optional<Eigen::MatrixXd> Encode(std::span<const Pose> poses) const;
  std::vector<Pose> Decode(const Eigen::MatrixXd& x) const;
  /// z → x, and back for one dimension's row.
  Eigen::MatrixXd Colour(const Eigen::MatrixXd& z) const;
  /// Where `skeleton`'s joints are in Decode(x)'s poses, [3 joints, w].
  Eigen::MatrixXf PlaceJoints(const Skeleton& skeleton, const Eigen::MatrixXd& x) const;
  Eigen::VectorXd Whiten(int dimension, const Eigen::VectorXd& x) const;

 private:
  // A joint's local rotation in Decode(x)'s poses.
  Eigen::Quaterniond Turn(const Eigen::MatrixXd& x, int frame, int joint) const;
  const MotionPrior::Bridge& At(int dimension) const {
    const auto d = static_cast<size_t>(dimension);
    return (keyed_[d] ? *to_key_ : d < 3 && stage_ ? *stage_ : *free_)[d];
  }

  std::shared_ptr<const std::vector<MotionPrior::Bridge>> to_key_, free_, stage_;
  std::vector<bool> keyed_;
  Eigen::MatrixXd mean_, history_;
  Eigen::VectorXd displacement_;
  double surprise_ = 1;
  Eigen::MatrixXd scales_;
  std::vector<Pose> base_;                      // the mean, as poses
  std::vector<Eigen::Quaterniond> base_turns_;  // their local rotations, frame by frame
};

}  // namespace choreo
