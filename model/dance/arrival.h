#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/engine/step_engine.h"
#include "model/motion/motion.h"

namespace choreo {

/// Leads a model's frames onto a key, frame by frame, without look-ahead. Over the last A frames of
/// a transition the emitted pose is y_t = x_t (+) w (h_t (-) x_t): x_t is the model's frame, w
/// rises smoothly from 0 to 1 over the first two thirds of them, and h_t is the next frame of the
/// path from y_{t-1} to the key that has the least sum of squared second differences and passes the
/// key with the velocity of the model's own frames (with a free end it would race through the key:
/// docs/decisions.md). Root and joints (on the tangent space at y_{t-1}) are treated alike; what
/// the key's mask leaves free passes through.
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
  Arrival(Options options, int transition_frames, const Target& target,
          const std::vector<Pose>& before, const std::optional<Pose>& after = std::nullopt);

  /// The emitted pose of the next frame; call once for each of the transition's frames, in order.
  Pose Apply(const Pose& raw);

 private:
  /// A step from one frame to the next.
  struct Velocity {
    Eigen::Vector3d root;
    Eigen::Matrix3Xd
        joints;  // [3, joints] radians, each on the tangent space at the joint's former rotation
  };
  static Velocity Between(const Pose& a, const Pose& b);
  // The next of `frames_left` steps along the path.
  static Eigen::Vector3d Step(const Eigen::Vector3d& way, const Eigen::Vector3d& velocity,
                              const Eigen::Vector3d& end_velocity, int frames_left);
  void Remember(const Pose& emitted);

  int frames_;
  int window_;
  int next_ = 0;
  Target target_;
  std::optional<Velocity> after_;  // from the key on, where it is known
  Pose previous_;                  // emitted last
  Velocity velocity_;              // to it, from the one before
  Pose last_raw_;
  Velocity model_velocity_;        // of the model's own frames, smoothed
  Eigen::Matrix3Xd expected_way_;  // [3, joints] what is left to turn if all goes to plan: keeps
                                   // its sense near pi
  bool has_expected_way_ = false;
};

}  // namespace choreo
