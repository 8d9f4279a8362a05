#include "client/authoring/keys/key_faults.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "client/authoring/keys/key_file.h"
#include "model/core/error.h"
#include "model/core/grid.h"
#include "model/core/rounded.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/floor/support.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo::authoring {
namespace {

/// How far a pose is above where it would stand, metres; none if that is unknown.
std::optional<double> InAir(const Pose& pose, const PoseMask& mask, const Skeleton& skeleton) {
  const std::optional<double> standing = StandingHeight(skeleton, pose, mask);
  if (!standing) return std::nullopt;
  return pose.root_position.y() - *standing;
}

/// Explains why a key in the air will be danced standing on the floor, as keys without a place are;
/// empty for other keys. Keys without a height have the rest pose's.
std::string LostJump(const client::KeyPose& key, const Skeleton& skeleton) {
  const double height = key.pose.root_position.y();
  if (key.mask.root_position || height == skeleton.pelvis_height) return "";
  const std::optional<double> in_air = InAir(key.pose, key.mask, skeleton);
  if (!in_air || *in_air <= kInAir) return "";
  return "the pose is " + Rounded(*in_air) +
         " m in the air, but without a place it stands on the floor; give it one: \"place\": [x, "
         "z]";
}

/// The height of a jump, metres; 0 for a pose that is none.
double JumpHeight(const TimedPose& one, const Skeleton& skeleton) {
  const double in_air =
      one.mask.root_position ? InAir(one.pose, one.mask, skeleton).value_or(0) : 0;
  return in_air <= kInAir ? 0 : in_air;
}

bool IsOnFloor(const TimedPose& one, const Skeleton& skeleton) {
  const std::optional<double> stands = StandingHeight(skeleton, one.pose, one.mask);
  if (!stands || JumpHeight(one, skeleton) > 0) return false;
  Pose on_floor = one.pose;
  on_floor.root_position.y() = *stands;
  return RestsOnFloor(skeleton, on_floor);
}

/// Describes a way from the floor into a jump, or out of one to the floor, for which the time is
/// too short. A jump takes off and lands upright; DanceFaults knows how long the way between that
/// and the floor takes.
std::string JumpFault(const Skeleton& skeleton, TimedPose from, TimedPose to) {
  const bool rises = IsOnFloor(from, skeleton);
  const TimedPose& jump = rises ? to : from;
  const double height = JumpHeight(jump, skeleton);
  if (height == 0 || (!rises && !IsOnFloor(to, skeleton))) return "";
  TimedPose upright{(rises ? "the take-off of " : "the landing of ") + jump.name, 0,
                    RestPose(skeleton)};
  upright.mask.joints.assign(static_cast<size_t>(skeleton.joints()), false);
  const double flight = std::sqrt(2 * height / kGravity);
  constexpr double kFrame = 1 / kModelFps;  // seconds: no flight leaves less than that for the way
  upright.seconds = rises ? std::max(to.seconds - flight, from.seconds + kFrame)
                          : std::min(from.seconds + flight, to.seconds - kFrame);
  (rises ? to : from) = upright;
  to.hit.reset();
  for (const TimedFault& fault : DanceFaults(skeleton, {from, to}))
    if (fault.pose == 1) return fault.message;
  return "";
}

/// The faults of DanceFaults and JumpFault, by pose.
std::vector<TimedFault> WayFaults(const Skeleton& skeleton, const std::vector<TimedPose>& poses) {
  std::vector<TimedFault> faults = DanceFaults(skeleton, poses);
  for (size_t i = 1; i < poses.size(); ++i) {
    std::string fault = JumpFault(skeleton, poses[i - 1], poses[i]);
    if (!fault.empty()) faults.push_back({i, true, std::move(fault)});
  }
  std::ranges::stable_sort(faults, {}, &TimedFault::pose);
  return faults;
}

TimedPose Timed(const client::KeyPose& key, double fps) {
  return {key.id, static_cast<double>(FrameOf(key, fps)) / fps, key.pose, key.mask, key.hit};
}

}  // namespace

std::vector<client::Warning> KeyFaults(const DanceKeys& keys, double fps,
                                       const Skeleton& skeleton) {
  std::vector<TimedPose> poses;
  for (const client::KeyPose& key : keys.poses) poses.push_back(Timed(key, fps));
  std::vector<client::Warning> warnings = keys.warnings;
  for (const TimedFault& fault : WayFaults(skeleton, poses)) {
    client::Warning& warning = warnings.emplace_back();
    warning.frame = FrameOf(keys.poses[fault.pose], fps);
    const std::string place = keys.places.empty() ? "" : " (" + keys.places[fault.pose] + ")";
    warning.message = "key \"" + keys.poses[fault.pose].id + "\"" + place + ": " + fault.message;
  }
  for (size_t i = 0; i < keys.poses.size(); ++i) {
    const client::KeyPose& key = keys.poses[i];
    const std::string lost = LostJump(key, skeleton);
    if (lost.empty() || (!keys.places.empty() && IsHeld(keys.places[i]))) continue;
    client::Warning& warning = warnings.emplace_back();
    warning.frame = FrameOf(key, fps);
    warning.message = "key \"" + key.id + "\": " + lost;
  }
  return warnings;
}

void RefuseBends(const DanceKeys& keys, const Skeleton& skeleton) {
  for (size_t i = 0; i < keys.poses.size(); ++i) {
    const client::KeyPose& key = keys.poses[i];
    const std::vector<std::string> faults = BendFaults(skeleton, key.pose, key.mask);
    if (faults.empty()) continue;
    throw InvalidArgument(
        keys.places[i], "key \"" + key.id + "\": " + faults.front() + "; --allow-bends accepts it");
  }
}

void RefuseHeldInAir(const client::KeyPose& key, double seconds, const std::string& field,
                     const Skeleton& skeleton) {
  const std::string fault = HoldFault(skeleton, key.pose, key.mask, seconds);
  if (fault.empty()) return;
  throw InvalidArgument(field, "key \"" + key.id + "\": " + fault + "; hold the landing instead");
}

void RefuseHeldInAir(const DanceKeys& keys, double fps, const Skeleton& skeleton) {
  for (size_t i = 0, end = 0; i < keys.poses.size(); i = end) {
    end = i + 1;
    while (end < keys.poses.size() && IsHeld(keys.places[end])) ++end;
    if (end == i + 1) continue;
    const int64_t frames = FrameOf(keys.poses[end - 1], fps) - FrameOf(keys.poses[i], fps);
    RefuseHeldInAir(keys.poses[i], static_cast<double>(frames) / fps, keys.places[i + 1], skeleton);
  }
}

std::vector<client::Warning> KeyFaults(const std::vector<client::KeyPose>& keys, double fps,
                                       const Skeleton& skeleton) {
  DanceKeys by_time{.poses = keys, .places = {}};
  std::ranges::stable_sort(by_time.poses, {},
                           [&](const client::KeyPose& key) { return FrameOf(key, fps); });
  return KeyFaults(by_time, fps, skeleton);
}

std::vector<client::Warning> KeyFaults(const client::KeyPose& key, int64_t held_to, double fps,
                                       const Skeleton& skeleton,
                                       const std::vector<TimedPose>& around) {
  std::vector<TimedPose> poses = around;
  const TimedPose timed = Timed(key, fps);
  const auto place = std::ranges::find_if(
      poses, [&](const TimedPose& pose) { return pose.seconds > timed.seconds; });
  const auto index = static_cast<size_t>(place - poses.begin());
  // The way from the key begins where its hold ends.
  TimedPose end = timed;
  end.seconds = static_cast<double>(held_to) / fps;
  end.hit.reset();
  poses.insert(place, {timed, end});
  std::vector<client::Warning> warnings;
  for (const TimedFault& fault : WayFaults(skeleton, poses)) {
    // Ignores faults of other keys, except on the transitions to and from this key.
    const bool its_own = fault.pose == index || fault.pose == index + 1;
    const bool way_from = fault.pose == index + 2 && fault.on_way;
    if (!its_own && !way_from) continue;
    client::Warning& warning = warnings.emplace_back();
    warning.frame = FrameOf(key, fps);
    warning.message = "key \"" + key.id + "\": " + fault.message;
  }
  return warnings;
}

}  // namespace choreo::authoring
