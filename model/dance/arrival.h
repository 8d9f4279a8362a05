#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/engine/step_engine.h"
#include "model/motion/motion.h"

namespace choreo {

/// Leads a model's frames onto a key, frame by frame, without look-ahead (DESIGN section 5).
///
/// Over the last A frames of a transition the emitted pose is y_t = x_t (+) w (h_t (-) x_t): x_t is
/// the model's frame, w rises smoothly from 0 to 1, and h_t is the next frame of the path from
/// y_{t-1}, with the velocity that y has there, to the key. That path has the least sum of squared
/// accelerations (second differences) of all; its acceleration falls to zero at the key and its
/// velocity there is free, so the dance passes through the key and moves on. Followed from frame to
/// frame it closes the loop: what the model adds in between is made up for in the frames that are
/// left, and with w = 1 in the last frame the key is hit to rounding. Root position and joint
/// rotations (on the tangent space at y_{t-1}) are treated alike; degrees of freedom that the key's
/// mask leaves free pass through untouched.
///
/// All poses stand in one frame (the transition's canonical one). Not thread-safe.
class Arrival {
 public:
  struct Options {
    int frames = 12;  ///< A; a shorter transition has as many as it is long. 0: arrival is off
  };

  /// `before`: the last one or two poses before frame 0, oldest first. `after`: the pose one frame
  /// after the key, where the motion that follows is known (the edit of one interval, loops): the
  /// path then also arrives with the velocity towards it.
  Arrival(Options options, int transition_frames, const Target& target, std::vector<Pose> before,
          std::optional<Pose> after = std::nullopt);

  /// The emitted pose of the next frame; call once for each of the transition's frames, in order.
  Pose Apply(const Pose& raw);

 private:
  struct Velocity {
    Eigen::Vector3d root;
    Eigen::Matrix3Xd joints;
  };
  // The next of `frames_left` steps along the path; `end_velocity` may be null.
  static Eigen::Vector3d Step(const Eigen::Vector3d& way, const Eigen::Vector3d& velocity,
                              const Eigen::Vector3d* end_velocity, int frames_left);
  bool Asked(int joint) const;
  void Remember(const Pose& emitted);

  Options options_;
  int frames_;
  int window_;
  int next_ = 0;
  Target target_;
  std::optional<Velocity> end_velocity_;
  Pose previous_;
  Eigen::Vector3d root_velocity_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3Xd joint_velocity_;  // [3, joints] radians a frame
  Eigen::Matrix3Xd expected_way_;    // [3, joints] what is left to turn if all goes to plan: keeps
                                     // its sense near pi
  bool has_expected_way_ = false;
};

}  // namespace choreo
