#include "client/authoring/key_faults.h"

#include <algorithm>
#include <optional>
#include <string>

#include "client/authoring/key_file.h"
#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/motion/kinematics.h"

namespace choreo::authoring {
namespace {

constexpr double kJump = 0.1;  // metres: the least height above the floor that is one

/// Explains why a key in the air will stand, if it will: a key without a place stands on the floor.
/// Keys without a height have that of the rest pose.
std::string LostJump(const client::KeyPose& key, const Skeleton& skeleton) {
  const double height = key.pose.root_position.y();
  if (key.mask.root_position || height == skeleton.pelvis_height) return "";
  const std::optional<double> standing = StandingHeight(skeleton, key.pose, key.mask);
  if (!standing || height - *standing < kJump) return "";
  return "the pose is " + Rounded(height - *standing) +
         " m in the air, but without a place it stands on the floor; give it one: \"place\": [x, "
         "z]";
}

/// Where a path leads, on the straight way between its points.
Eigen::Vector2d PlaceOn(const ControlRequest::RootPath& path, int64_t frame) {
  const auto after = std::ranges::upper_bound(path.frames, frame);
  if (after == path.frames.begin()) return path.points.front();
  if (after == path.frames.end()) return path.points.back();
  const auto i = static_cast<size_t>(after - path.frames.begin());
  const double share = static_cast<double>(frame - path.frames[i - 1]) /
                       static_cast<double>(path.frames[i] - path.frames[i - 1]);
  return path.points[i - 1] + share * (path.points[i] - path.points[i - 1]);
}

/// How far it leads away within these frames, at most.
double FarthestOn(const ControlRequest::RootPath& path, int64_t first, int64_t last) {
  const Eigen::Vector2d begin = PlaceOn(path, first);
  double farthest = (PlaceOn(path, last) - begin).norm();
  for (size_t i = 0; i < path.frames.size(); ++i) {
    if (path.frames[i] > first && path.frames[i] < last)
      farthest = std::max(farthest, (path.points[i] - begin).norm());
  }
  return farthest;
}

TimedPose Timed(const client::KeyPose& key, double fps) {
  return {key.id, static_cast<double>(FrameOf(key, fps)) / fps, key.pose, key.mask};
}

}  // namespace

std::vector<client::Warning> KeyFaults(const DanceKeys& keys, double fps,
                                       const Skeleton& skeleton) {
  std::vector<TimedPose> poses;
  for (const client::KeyPose& key : keys.poses) poses.push_back(Timed(key, fps));
  std::vector<client::Warning> warnings = keys.warnings;
  for (const TimedFault& fault : DanceFaults(skeleton, poses)) {
    // A held pose has the faults of its first key.
    const bool is_held = !keys.places.empty() && IsHeld(keys.places[fault.pose]);
    const auto is_said = [&](const client::Warning& warning) {
      return warning.message.ends_with(": " + fault.message);
    };
    if (is_held && std::ranges::any_of(warnings, is_said)) continue;
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
    throw InvalidArgument(keys.places[i], "key \"" + key.id + "\": " + faults.front() +
                                              "; with --allow-bends it is danced all the same");
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

std::vector<client::Warning> HeldOnPath(const DanceKeys& keys, const ControlRequest::RootPath& path,
                                        double fps) {
  const auto at = [&](int64_t frame) { return Rounded(static_cast<double>(frame) / fps) + " s"; };
  std::vector<client::Warning> warnings;
  for (size_t i = 0; i < keys.poses.size(); ++i) {
    size_t last = i;
    while (last + 1 < keys.poses.size() && IsHeld(keys.places[last + 1])) ++last;
    if (last == i || IsHeld(keys.places[i])) continue;
    const int64_t from = FrameOf(keys.poses[i], fps), until = FrameOf(keys.poses[last], fps);
    const double metres = FarthestOn(path, from, until);
    if (metres <= client::kMaxKeyError_m) continue;
    const bool stays = keys.poses[i].mask.root_position;
    warnings.push_back({.frame = from,
                        .message = "the path goes on for " + Rounded(metres) + " m while \"" +
                                   keys.poses[i].id + "\" is held from " + at(from) + " to " +
                                   at(until) +
                                   (stays ? "; the key wins" : ": the pose slides along it") +
                                   "; the same point at both times lets the path wait"});
  }
  return warnings;
}

bool IsOfHold(const client::Warning& warning, const DanceKeys& keys) {
  if (warning.code != client::Warning::Code::kKeyOffPath) return false;
  for (size_t i = 0; i < keys.poses.size(); ++i)
    if (keys.poses[i].id == warning.key_id) return IsHeld(keys.places[i]);
  return false;
}

std::vector<client::Warning> KeyFaults(const std::vector<client::KeyPose>& keys, double fps,
                                       const Skeleton& skeleton) {
  DanceKeys by_time{.poses = keys, .places = {}};
  std::ranges::stable_sort(by_time.poses, {},
                           [&](const client::KeyPose& key) { return FrameOf(key, fps); });
  return KeyFaults(by_time, fps, skeleton);
}

std::vector<client::Warning> KeyFaults(const client::KeyPose& key, double fps,
                                       const Skeleton& skeleton,
                                       const std::vector<TimedPose>& around) {
  std::vector<TimedPose> poses = around;
  const TimedPose timed = Timed(key, fps);
  const auto place = std::ranges::find_if(
      poses, [&](const TimedPose& pose) { return pose.seconds > timed.seconds; });
  const auto index = static_cast<size_t>(place - poses.begin());
  poses.insert(place, timed);
  std::vector<client::Warning> warnings;
  for (const TimedFault& fault : DanceFaults(skeleton, poses)) {
    // Ignores faults of other keys, except on the ways to and from this key.
    const bool its_own = fault.pose == index;
    const bool way_from = fault.pose == index + 1 &&
                          fault.message.find("from \"" + key.id + "\"") != std::string::npos;
    if (!its_own && !way_from) continue;
    client::Warning& warning = warnings.emplace_back();
    warning.frame = FrameOf(key, fps);
    warning.message = "key \"" + key.id + "\": " + fault.message;
  }
  return warnings;
}

}  // namespace choreo::authoring
