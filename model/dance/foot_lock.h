#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "model/engine/step_engine.h"
#include "model/motion/contacts.h"
#include "model/motion/limb.h"
#include "model/motion/motion.h"

namespace choreo {

/// Keeps feet from sliding: a model's mean motion glides where a dancer steps. The toes of a foot
/// on the floor stay where they touched down, and when the body has gone on too far (or the model
/// lifts the foot) they travel in one step through the air, one foot at a time. The legs follow by
/// inverse kinematics; all else stays. Frame by frame, without look-ahead, after arrival. The last
/// steps land where the key has its feet, a tenth of a second ahead of it where there is time. All
/// poses stand in one frame, whose floor is y = 0. Not thread-safe.
class FootLock {
 public:
  /// False for a skeleton without legs and for a transition too short to step in.
  static bool Fits(const Skeleton& skeleton, double fps, int transition_frames);

  /// For a transition that Fits; `history` has at least one pose.
  FootLock(const Skeleton& skeleton, double fps, int transition_frames,
           const std::vector<Pose>& history, const std::optional<Target>& target);

  /// The emitted pose of the next frame; call once for each of the transition's frames, in order.
  Pose Apply(const Pose& steered);

  /// Of the pose emitted last: toes by their lock, ankles by their height.
  const Contacts& contacts() const { return contacts_; }

 private:
  struct Foot {
    Leg leg;
    bool planted = false;
    Eigen::Vector3d at;   // the toes, emitted last
    Eigen::Vector3d raw;  // the same before
    double bend = 0;      // the knee's, emitted last
    // Of a foot in the air: it left `from` at frame `start` and comes down `duration` later.
    Eigen::Vector3d from;
    int start = 0, duration = 0;
    bool last_step = false;                  // it comes down where the key has it
    std::optional<Eigen::Vector3d> landing;  // the key's toes, if the key has them on the floor
    int last_start = 0;                      // frame of the last step; the transition's end: none
  };

  void PlanLastSteps(const Target& target);
  void Lift(Foot* foot);
  bool WantsToStep(const Foot& foot, const Eigen::Vector3d& raw, double reach) const;
  Eigen::Vector3d Move(Foot* foot, const Eigen::Vector3d& raw);
  Eigen::Vector3d Stand(const Foot& foot) const;

  Skeleton skeleton_;
  int frames_;
  int step_frames_;  // of a step in the air
  double fps_;
  double rest_height_ = 0, ankle_height_ = 0;  // of a foot that stands: toes, ankle
  bool ends_on_key_ = false;
  int next_ = 0;
  std::array<Foot, 2> feet_;
  Contacts contacts_ = {};
  JointPlacement placement_;
};

}  // namespace choreo
