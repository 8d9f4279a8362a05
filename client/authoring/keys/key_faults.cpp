#include "client/authoring/keys/key_faults.h"

#include <algorithm>
#include <optional>
#include <string>

#include "client/authoring/keys/key_file.h"
#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/motion/kinematics.h"

namespace choreo::authoring {
namespace {

constexpr double kJump = 0.1;  // metres: a jump's least height above the floor

/// Explains why a key in the air will be danced standing on the floor, as keys without a place are;
/// empty for other keys. Keys without a height have the rest pose's.
std::string LostJump(const client::KeyPose& key, const Skeleton& skeleton) {
  const double height = key.pose.root_position.y();
  if (key.mask.root_position || height == skeleton.pelvis_height) return "";
  const std::optional<double> standing = StandingHeight(skeleton, key.pose, key.mask);
  if (!standing || height - *standing < kJump) return "";
  return "the pose is " + Rounded(height - *standing) +
         " m in the air, but without a place it stands on the floor; give it one: \"place\": [x, "
         "z]";
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
  for (const TimedFault& fault : DanceFaults(skeleton, poses)) {
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
  for (const TimedFault& fault : DanceFaults(skeleton, poses)) {
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
