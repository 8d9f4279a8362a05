#pragma once

#include <span>
#include <vector>

#include "model/core/hit.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"
#include "model/plan/plan_options.h"

/// Stages of a plan between model and arrival, for what no network can know, or a rule does better.
/// Pure functions, thread-safe. kPlanStages lists them.
namespace choreo {

inline constexpr double kPauseSeconds = 1.5;  ///< between beats that count as a pause of the music

/// The context of a plan, which is the poses that a model proposes for a whole transition in its
/// canonical frame.
struct PlanContext {
  const Skeleton& skeleton;
  std::span<const Pose> history;       ///< before the first frame, oldest first, at least one
  std::span<const double> beats = {};  ///< frames from the first, ascending
  bool keyed = false;                  ///< it ends on a key
  bool has_path = false,
       has_heights = false;  ///< controls give the root's position, and its height
  double fps;                ///< of the model
  PlanOptions options = {};  ///< from the model's checkpoint
};

/// Knees and elbows bend only one way, until folded: leads each hinge's bend softly to a stop at
/// both ends, and limits its change per frame to NextBend (motion/limb.h).
void LimitHinges(const PlanContext& context, std::vector<Pose>* plan);

/// Dancers touch the floor at least every few seconds: lowers or raises a plan without key or path
/// heights so that its lowest foot is on the floor; the correction grows from 0 at the first poses
/// to the whole at the last.
void ReturnToFloor(const PlanContext& context, std::vector<Pose>* plan);

/// Times a plan (TimesOnBeats) so that the dancer is fastest on the music's beats, like kinematic
/// beats (paper F, Section 4.2). A root path keeps its positions and heights.
void TimeToBeats(const PlanContext& context, std::vector<Pose>* plan);

/// The times, in frames, whose poses a plan's frames take so that it is fastest on the beats;
/// `speeds` are the ones with which it reaches its frames. Moves the plan's own kinematic beats
/// onto the music's, along the path through time with the largest sum of speed times cos(2 pi phase
/// of the beat). The pace of time is 1 at first and within 1 - A and 1 + A; A is the accent. The
/// last frame keeps its time. Time is as even as before without beats and where the music pauses.
/// `paces`: the fastest pace of each frame's time, at least 1; none: any.
std::vector<double> TimesOnBeats(const PlanContext& context, std::span<const double> speeds,
                                 std::span<const double> paces = {});

/// Gives the plan's frames from `first` on the poses of other times, in [-1, frames - 1]; -1 is the
/// history's last pose. A root path keeps its positions and heights.
void Retime(const PlanContext& context, int first, std::span<const double> times,
            std::vector<Pose>* plan);

/// Seconds before a key in which its hit shows: 0.5 would hardly do, as Arrival smooths the last
/// 0.4.
inline constexpr double kHitSeconds = 0.8;

/// Times the frames before a plan's key, the last one, by how hard it is hit, 0 to kMaxHit: the
/// last kHitSeconds, or all if it is shorter, run at their usual speed first and at `hit` times
/// that at the key (HitTime). 1 changes nothing. A root path keeps its positions and heights.
void HitKey(const PlanContext& context, double hit, std::vector<Pose>* plan);

/// The share of that stretch whose pose comes at its share u, 0 to 1: the cubic from 0 to 1 with
/// slopes 1 and `hit`.
double HitTime(double u, double hit);

/// The stages of every plan, in their order.
inline constexpr void (*kPlanStages[])(const PlanContext&, std::vector<Pose>*) = {
    TimeToBeats, LimitHinges, ReturnToFloor};

}  // namespace choreo
