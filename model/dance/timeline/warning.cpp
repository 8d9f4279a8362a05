#include "model/dance/timeline/warning.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/core/grid.h"
#include "model/core/joined.h"
#include "model/core/rounded.h"
#include "model/motion/pose/body_limits.h"

namespace choreo {
namespace {

/// Formats a time in seconds for people; programs have the event's frame.
std::string Seconds(int64_t frames) {
  return Rounded(static_cast<double>(frames) / kModelFps) + " s";
}

}  // namespace

Warning IntervalTooShort(const Skeleton& skeleton, const std::string& id, int64_t first_frame,
                         int64_t frames, const RequiredSpeed& speed) {
  std::string message = "the way to key \"" + id + "\" in " + Seconds(frames) + " asks for ";
  if (speed.root_m_per_s > RequiredSpeed::kRootLimit) {
    message += RoundedBeyond(speed.root_m_per_s, RequiredSpeed::kRootLimit) +
               " m/s of the root; people reach " + Rounded(RequiredSpeed::kRootLimit);
  } else {
    message += RoundedBeyond(speed.joint_rad_per_s, RequiredSpeed::kJointLimit) + " rad/s of " +
               skeleton.joint_names[static_cast<size_t>(speed.joint)] + "; people reach " +
               Rounded(RequiredSpeed::kJointLimit);
  }
  const bool root = speed.root_m_per_s > RequiredSpeed::kRootLimit;
  return {first_frame + frames - 1,
          std::move(message),
          Warning::Code::kIntervalTooShort,
          id,
          root ? speed.root_m_per_s : speed.joint_rad_per_s,
          root ? RequiredSpeed::kRootLimit : RequiredSpeed::kJointLimit};
}

Warning InexactResume(const Continuation& continuation, const ModelInfo& model) {
  return {continuation.frame,
          "the continuation is of \"" + continuation.fingerprint + "\", this server is \"" +
              model.fingerprint + "\": the dance continues differently",
          Warning::Code::kInexactResume};
}

Warning TemperatureTooHigh(int64_t frame, double requested, double most) {
  return {frame,
          "temperature " + RoundedBeyond(requested, most) + " is beyond " + Rounded(most) +
              ", the highest that the model is trained for: it dances as at " + Rounded(most),
          Warning::Code::kTemperatureTooHigh};
}

Warning PathTooFast(int64_t frame, double m_per_s) {
  return {frame,
          "the root path asks for " + RoundedBeyond(m_per_s, RequiredSpeed::kRootLimit) +
              " m/s; people reach " + Rounded(RequiredSpeed::kRootLimit),
          Warning::Code::kPathTooFast};
}

Warning KeyOffPath(const std::string& id, int64_t frame, double metres) {
  return {frame,
          "key \"" + id + "\" lies " + Rounded(metres) + " m off the root path; the key wins",
          Warning::Code::kKeyOffPath, id};
}

Warning ControlsTooLate(std::string_view control, int64_t last_frame, int64_t earliest) {
  return {last_frame,
          "the " + std::string(control) + " ends at " + Seconds(last_frame) + ", and all before " +
              Seconds(earliest) + " is frozen: it has no effect",
          Warning::Code::kControlsTooLate};
}

Warning BeatsTooLate(int64_t frame, int64_t count, int64_t earliest) {
  return {frame,
          std::to_string(count) + " beats from " + Seconds(frame) +
              " on came too late, all before " + Seconds(earliest) +
              " is frozen: they have no effect",
          Warning::Code::kBeatsTooLate};
}

Warning PathBehindEnd(int64_t first_frame, int64_t end) {
  return {first_frame,
          "the root path begins at " + Seconds(first_frame) + ", after the last frame at " +
              Seconds(end - 1) + ": it has no effect",
          Warning::Code::kPathBehindEnd};
}

Warning KeyOffHeight(const std::string& id, int64_t frame, double standing, double height) {
  return {frame,
          "key \"" + id + "\" stands on the floor with its root at " + Rounded(standing) +
              " m, the root path has " + Rounded(height) + " m: it is " +
              Rounded(std::abs(height - standing)) +
              (height > standing ? " m in the air" : " m too low for its feet") + "; the path wins",
          Warning::Code::kKeyOffHeight, id};
}

Warning KeyImpossible(const std::string& id, int64_t frame, const std::string& fault) {
  return {frame, "key \"" + id + "\": " + fault, Warning::Code::kKeyImpossible, id};
}

Warning PathAway(int64_t frame, double metres) {
  return {frame,
          "the root path is " + Rounded(metres) + " m from the dancer at " + Seconds(frame) +
              ": the root is led there first",
          Warning::Code::kPathAway};
}

Warning MusicDamaged(const std::vector<std::string>& notes, double seconds, double fps) {
  const auto frames = static_cast<int64_t>(std::ceil(seconds * fps));
  return {std::max<int64_t>(frames - 1, 0),
          "the music's file: " + Joined(notes, std::identity(), "; "),
          Warning::Code::kMusicDamaged};
}

Warning MusicSilent(int64_t last_frame, double seconds) {
  return {
      last_frame,
      "all " + Rounded(seconds) + " s of the music are silent: the dance has no music to follow",
      Warning::Code::kMusicSilent};
}

Warning ChannelsCancel(int64_t last_frame) {
  return {last_frame,
          "the channels of the music cancel each other in their mix: the dance has no music to "
          "follow; send one of them, or the file",
          Warning::Code::kMusicSilent};
}

Warning KeyBehindMusic(const std::string& id, int64_t frame, double seconds) {
  return {frame,
          "key \"" + id + "\" at " + Seconds(frame) + " lies " + Rounded(seconds) +
              " s behind the end of the music: the dance continues to it in silence",
          Warning::Code::kKeyBehindMusic, id};
}

Warning DanceBehindMusic(int64_t music_end, double seconds) {
  return {
      music_end,
      "the dance is longer than the music: it continues for " + Rounded(seconds) + " s in silence",
      Warning::Code::kDanceBehindMusic};
}

Warning BeatsBehindMusic(int64_t music_end, size_t count, double first) {
  return {music_end,
          std::to_string(count) + (count == 1 ? " given beat lies" : " given beats lie") +
              " behind the end of the music at " + Seconds(music_end) + ", from " + Rounded(first) +
              " s on",
          Warning::Code::kBeatsBehindMusic};
}

Warning JointTooFast(const Skeleton& skeleton, int64_t frame, int joint, double m_per_s,
                     const std::string& id, double seconds) {
  std::string message = skeleton.joint_names[static_cast<size_t>(joint)] + " moves at " +
                        RoundedBeyond(m_per_s, kFastestJoint) + " m/s; people reach " +
                        Rounded(kFastestJoint);
  if (!id.empty()) {
    message = "on the way to key \"" + id + "\" in " + Rounded(seconds) + " s " + message + "; " +
              Rounded(seconds * m_per_s / kFastestJoint) + " s would do";
  }
  return {frame, std::move(message), Warning::Code::kJointTooFast, id, m_per_s, kFastestJoint};
}

Warning FlightTooLong(int64_t frame, double seconds, const std::string& id) {
  return {frame,
          "nothing touches the floor for " + RoundedBeyond(seconds, kLongestFlight) +
              " s; people reach " + Rounded(kLongestFlight),
          Warning::Code::kFlightTooLong,
          id,
          seconds,
          kLongestFlight};
}

Warning VelocityNotMet(int64_t last_frame, const std::string& misses) {
  return {last_frame,
          "parts do not move as their velocity factors request, cm a frame on average: " + misses,
          Warning::Code::kVelocityNotMet};
}

}  // namespace choreo
