#pragma once

#include <span>
#include <vector>

#include "model/flow/plan_options.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// What is done to a plan, between the model and arrival: what no network can know, or what a rule
/// does better. Stages are pure functions, thread-safe. One more is listed in plan_stages.cpp.
namespace choreo {

inline constexpr double kPauseSeconds = 1.5;  ///< from beat to beat, and the music pauses

/// What is known of a plan: the poses that a model proposes for a whole transition, in the
/// transition's canonical frame.
struct PlanContext {
  const Skeleton& skeleton;
  std::span<const Pose> history;       ///< before the first frame, oldest first, at least one
  std::span<const double> beats = {};  ///< frames from the first, ascending
  bool keyed = false;                  ///< it ends on a key
  bool has_path = false, has_heights = false;  ///< the root's place, and its height, were asked for
  double fps;                                  ///< the model's
  PlanOptions options = {};                    ///< the model's, of its checkpoint
};

/// Knees and elbows bend one way, until the limb is folded: the bend of each about its hinge is led
/// softly to a stop at both ends, and from frame to frame not beyond NextBend (motion/limb.h).
void LimitHinges(const PlanContext& context, std::vector<Pose>* plan);

/// Whoever dances for seconds touches the floor: by the last pose of a plan without key or path
/// heights the root is as much lower, or higher, as the lowest foot of all poses was above the
/// floor, or below it. The first poses stay.
void ReturnToFloor(const PlanContext& context, std::vector<Pose>* plan);

/// The dancer of a plan goes fastest on the music's beats, which is what a kinematic beat is (paper
/// F, Section 4.2). Where a path says where the root is, and how high, the root keeps to it.
void TimeToBeats(const PlanContext& context, std::vector<Pose>* plan);

/// Where on a plan of so many frames it takes the pose of frame `t` from, in frames; t in [-1,
/// frames - 1], where -1 is the history's last pose. Between two beats time runs as t + A P / 2 pi
/// sin(2 pi (t - beat) / P): at 1 + A on each beat, at 1 - A half way between, A being the accent.
/// A way to a key has a larger A at either end that stands on a beat, as dancers are slow at key
/// poses. The ends stay where they are; before the first beat, behind the last and where the music
/// pauses time runs evenly.
double BeatTime(const PlanContext& context, int frames, double t);

/// All stages, in the order of plan_stages.cpp.
void FinishPlan(const PlanContext& context, std::vector<Pose>* plan);

}  // namespace choreo
