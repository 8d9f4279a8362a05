#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/motion/motion.h"

namespace choreo {

/// Steers a model's frames to a key, frame by frame, without look-ahead. In Arrival's window, the
/// last frames of a transition, the emitted pose is y_t = x_t (+) w (h_t (-) x_t): x_t is the
/// model's frame; w rises smoothly from 0 to 1 over the first two thirds of the window; h_t is the
/// next frame of the path from y_{t-1} to the key with the least sum of squared second differences
/// and, at the key, the velocity of the model's own frames (docs/decisions.md). Root and joints (on
/// the tangent space at y_{t-1}) are treated alike. Degrees of freedom outside the key's mask are
/// unchanged, except that the root takes the velocity after the key, if known. All poses are in the
/// canonical frame. Not thread-safe.
class Arrival {
 public:
  /// Whether the path alone determines the poses, from the first frame on (w = 1), as for a held
  /// pose.
  enum class Lead { kWithModel, kAlone };

  /// `window`: in frames, at most the transition's. `before`: the poses before frame 0, at least
  /// one, oldest first. `after`: the pose one frame after the key, if the following motion is known
  /// (edits of one interval, loops). The path then arrives with the velocity towards `after`.
  Arrival(int window, int transition_frames, const Target& target, const std::vector<Pose>& before,
          const std::optional<Pose>& after = std::nullopt, Lead lead = Lead::kWithModel);

  /// Returns the emitted pose of the next frame. Call once per frame of the transition, in order.
  Pose Apply(const Pose& raw);

  int window() const { return window_; }

 private:
  /// A step between frames.
  struct Velocity {
    Eigen::Vector3d root;
    // [3, joints] radians, each on the tangent space at the joint's earlier rotation.
    Eigen::Matrix3Xd joints;
  };
  static Velocity Between(const Pose& a, const Pose& b);
  // The next step of the path, which has `frames_left` steps left.
  static Eigen::Vector3d Step(const Eigen::Vector3d& way, const Eigen::Vector3d& velocity,
                              const Eigen::Vector3d& end_velocity, int frames_left);
  Pose Steered(const Pose& raw);

  int left_;  // frames to the key, including the next one
  int window_;
  Lead lead_;
  Target target_;
  std::optional<Velocity> after_;  // velocity after the key, if known
  Pose previous_;                  // the last emitted pose
  Velocity velocity_;              // the step to previous_
  Pose last_raw_;
  Velocity model_velocity_;        // of the model's own frames, smoothed
  Eigen::Matrix3Xd expected_way_;  // [3, joints] the remaining turn if all goes to plan: fixes
                                   // its sense near pi
  bool has_expected_way_ = false;
};

}  // namespace choreo
