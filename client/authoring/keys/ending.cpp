#include "client/authoring/keys/ending.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "client/authoring/keys/key_file.h"
#include "client/authoring/notes/notes.h"
#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/motion/kinematics/canonical.h"

namespace choreo::authoring {
namespace {

constexpr double kHeld = 1;  // least seconds of the hold
constexpr double kHeldWithoutBeats = 1.5;
constexpr double kShortest = 3;  // seconds of a dance that has an ending
constexpr const char* kField = "--end";

/// The second at which the pose is reached.
double BeginOf(const std::vector<double>& beats, double last_s) {
  const auto after = std::ranges::upper_bound(beats, last_s - kHeld);
  if (after != beats.begin() && *std::prev(after) >= kHeld) return *std::prev(after);
  return last_s - kHeldWithoutBeats;
}

/// The place to which the dance leads by this frame.
Eigen::Vector3d PlaceAt(int64_t frame, const ControlRequest& controls, double fps,
                        const DanceKeys& keys) {
  if (const auto& path = controls.root_path) {
    const auto after = std::ranges::upper_bound(path->frames, frame);
    if (after != path->frames.begin()) {
      const Eigen::Vector2d& point =
          path->points[static_cast<size_t>(after - path->frames.begin()) - 1];
      return {point.x(), 0, point.y()};
    }
  }
  std::optional<int64_t> last;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (const client::KeyPose& key : keys.poses) {
    if (!key.mask.root_position || FrameOf(key, fps) < last.value_or(0)) continue;
    last = FrameOf(key, fps);
    place = GroundFrame::Of(key.pose).origin;
  }
  return place;
}

}  // namespace

client::KeyPose Ending(const NamedPose& pose, const std::vector<double>& beats,
                       const DanceLength& length) {
  const double last_s = static_cast<double>(length.frames - 1) / length.fps;
  if (last_s < kShortest) {
    throw InvalidArgument(kField, "the dance has its last frame at " + Rounded(last_s) +
                                      " s, an ending needs " + Rounded(kShortest) + " s");
  }
  client::KeyPose end = pose.key;
  end.id = "end-" + pose.key.id;
  end.time_s = BeginOf(beats, last_s);
  end.frame = std::llround(end.time_s * length.fps);
  return end;
}

void NoteOwnHold(const NamedPose& pose) {
  if (pose.held.empty()) return;
  Note("note: --end holds \"" + pose.key.id + "\" to the last frame, not for " +
       Rounded(HeldSeconds(pose)) + " s as its file says");
}

std::vector<std::string> EndIn(const NamedPose& pose, const std::vector<double>& beats,
                               const ControlRequest& controls, const DanceLength& length,
                               DanceKeys* keys) {
  const double last_s = static_cast<double>(length.frames - 1) / length.fps;
  client::KeyPose end = Ending(pose, beats, length);
  std::vector<std::string> gone;
  DanceKeys stay;
  const int64_t way = std::llround(kWayFromHold * length.fps);
  for (size_t i = 0; i < keys->poses.size(); ++i) {
    const int64_t frame = FrameOf(keys->poses[i], length.fps);
    const std::string held = HeldKey(*keys, i);
    // ByTime ends the holds of keys that stay, and warns.
    if (held.empty() ? frame <= *end.frame - way || frame == 0
                     : std::ranges::find(gone, held) == gone.end()) {
      stay.poses.push_back(keys->poses[i]);
      stay.places.push_back(keys->places[i]);
    } else if (held.empty()) {
      gone.push_back(keys->poses[i].id);
    }
  }
  if (!pose.has_place)
    end.pose = GroundFrame{.origin = PlaceAt(*end.frame, controls, length.fps, stay)}.ToWorld(
        pose.key.pose);
  const std::vector<client::KeyPose> holding = Holding(&end, last_s - end.time_s, kField);
  stay.poses.push_back(end);
  stay.places.emplace_back(kField);
  for (client::KeyPose key : holding) {
    key.frame = std::llround(key.time_s * length.fps);
    stay.poses.push_back(std::move(key));
    stay.places.push_back(std::string(kField) + ".hold");
  }
  std::vector<client::Warning> warnings = std::move(keys->warnings);
  *keys = ByTime(std::move(stay), length.fps);
  std::ranges::move(warnings, std::inserter(keys->warnings, keys->warnings.begin()));
  return gone;
}

}  // namespace choreo::authoring
