#pragma once

#include <span>
#include <vector>

#include "model/core/hit.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"
#include "model/plan/plan_options.h"
#include "model/plan/transition_noise.h"

/// The stages of a plan after the network, and of its arms after arrival (plan/process_plan.h), for
/// what the network does not know or a rule does better. Pure functions, thread-safe.
namespace choreo {

inline constexpr double kPauseSeconds = 1.5;  ///< least time between beats that is a pause

/// The context of a plan. The plan itself is the model's poses for a whole transition, in its
/// canonical frame.
struct PlanContext {
  const Skeleton& skeleton;
  std::span<const Pose> history;       ///< before the first frame, oldest first, at least one
  std::span<const double> beats = {};  ///< frames from the first, ascending
  bool keyed = false;                  ///< the plan ends on a key
  bool has_path = false,
       has_heights = false;  ///< controls give the root's position, and its height
  double fps;                ///< of the model
  PlanOptions options = {};  ///< from the model's checkpoint
  TransitionNoise noise = {};
};

/// Limits knees and elbows to bends between straight and folded, with a soft stop at both ends, and
/// limits their change per frame to NextBend (motion/kinematics/limb.h).
void LimitHinges(const PlanContext& context, std::vector<Pose>* plan);

/// Returns the dancer to the floor, which dancers touch at least every few seconds. Lowers or
/// raises a plan without key or path heights so that its lowest foot is on the floor. The
/// correction grows from 0 at the first poses to its full size at the last.
void ReturnToFloor(const PlanContext& context, std::vector<Pose>* plan);

/// Retimes a plan (TimesOnBeats) so that the dancer is fastest on the music's beats, like kinematic
/// beats (paper F, Section 4.2). A root path keeps its positions and heights.
void TimeToBeats(const PlanContext& context, std::vector<Pose>* plan);

/// For each frame of a plan, the time, in frames, from which to take its pose so that the plan is
/// fastest on the beats. `speeds`: the speed at which the plan reaches each frame. Aligns the
/// plan's kinematic beats with the music's by the path through time with the largest sum of speed
/// times cos(2 pi phase of the beat). The pace of time starts at 1 and stays within 1 - A and 1 +
/// A, where A is the accent. The last frame keeps its time. Without beats, and where the music
/// pauses, the pace stays even. `paces`: each frame's fastest pace, at least 1; none: no limit.
std::vector<double> TimesOnBeats(const PlanContext& context, std::span<const double> speeds,
                                 std::span<const double> paces = {});

/// Replaces the poses of the plan's frames from `first` on by the plan's poses at `times`, in [-1,
/// frames - 1]; -1 is the history's last pose. A root path keeps its positions and heights.
void Retime(const PlanContext& context, int first, std::span<const double> times,
            std::vector<Pose>* plan);

/// Retimes the frames before a plan's key, the last frame, by its hit, 0 to kMaxHit. The last
/// kHitSeconds, or the whole of a shorter plan, start at their usual speed and reach the key at
/// `hit` times that speed (HitTime). A hit of 1 changes nothing. A root path keeps its positions
/// and heights.
void HitKey(const PlanContext& context, double hit, std::vector<Pose>* plan);

/// Maps the share u, 0 to 1, of the stretch that HitKey changes to the share whose pose it
/// takes: the cubic from 0 to 1 with slopes 1 and `hit`.
double HitTime(double u, double hit);

/// Turns shoulders, by a quarter turn at most, so that forearms and hands stay out of the trunk:
/// kTrunkDepth (motion/floor/floor_clearance.h) from the line through its joints or, near the
/// history and a key, as far as these are. Each time that an arm would pass through, it goes round
/// in front, behind or outside, whichever leaves it least inside and then shakes it least. A
/// quick arm stays inside in part, because no shoulder turns faster than 20 rad/s or than the
/// plan's. For a plan after arrival, as arrival moves arms, too.
void KeepArmsOutside(const PlanContext& context, std::vector<Pose>* plan);

/// Turns the wrists, which the network has never seen turn, as recorded dancers do: at random, but
/// as fast as shoulder and elbow turn, so that hands move with their arms and rest with them. A
/// Gaussian process (WristOptions) that continues from the history and, by the noise's temperature,
/// differs from dance to dance. Arrival leads from it to a key's wrists.
void TurnWrists(const PlanContext& context, std::vector<Pose>* plan);

/// The stages in order, for models with ModelInfo::plan_stages.
inline constexpr void (*kPlanStages[])(const PlanContext&, std::vector<Pose>*) = {
    TimeToBeats, LimitHinges, ReturnToFloor, TurnWrists};

}  // namespace choreo
