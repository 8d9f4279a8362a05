#pragma once

#include <string>
#include <vector>

#include "client/authoring/counts.h"
#include "client/choreo_client.h"
#include "model/core/grid.h"

namespace choreo::authoring {

/// What `--keyframes` says for a dance without keys.
inline constexpr const char* kNoKeys = "none";
/// Whether it asks for no keys. Throws Error(kInvalidArgument) if others are given,
/// too.
bool SaysNoKeys(const std::vector<std::string>& sources);
/// The key files and motions in --keyframes.
std::vector<std::string> KeySources(const std::vector<std::string>& sources);

/// A dance's key poses in order of time, as sent.
struct DanceKeys {
  std::vector<client::KeyPose> poses;
  /// The origin of each, "keys.json:keyframes[1]" (ParseKeyFile in key_file.h).
  std::vector<std::string> places;
  std::vector<client::Warning> warnings = {};  ///< about what ByTime changed
};

/// The length of a dance.
struct DanceLength {
  int64_t frames = 0;
  double fps = kModelFps;  ///< of the model
};

/// Describes a frame after the dance's end: "at 20 s is after the dance's end: its last frame is
/// at 9.97 s".
std::string DescribeAfterEnd(int64_t frame, const DanceLength& length);

/// A key's frame at the model's rate.
int64_t FrameOf(const client::KeyPose& key, double fps);

/// Moves a key at second 30 of a dance of 30 seconds to its last frame, which it means. Throws
/// Error(kInvalidArgument), whose field begins with `place`, for a later one.
void FitIntoDance(const DanceLength& length, const std::string& place, client::KeyPose* key);

/// Says that a hold, which lasted until `was`, ends at `now` because of a key; frames.
std::string DescribeHoldEnd(const std::string& held, int64_t now, int64_t was,
                            const std::string& key, int64_t key_frame, double fps);

/// The id of the key whose pose this one holds; empty if it holds none.
std::string HeldKey(const DanceKeys& keys, size_t index);

/// Sorts keys by time for sending: an earlier key after a later one would come too late. A key that
/// comes while another one is held ends that hold kWayFromHold before it; `warnings` says so.
DanceKeys ByTime(DanceKeys keys, double fps);

/// Reads key poses from sources (see ReadKeys in key_file.h) and fits each into the dance. Throws
/// like ReadKeys, and Error(kInvalidArgument), whose field begins with the key's place, for a
/// duplicate id, and for keys closer than kMinKeyDistance.
DanceKeys ReadDanceKeys(const std::vector<std::string>& sources, const DanceLength& length,
                        const Skeleton& skeleton, const Counts& counts = {});

/// Translates an error about "keyframes[i]", numbered as sent, to the place where the key was
/// written; returns other errors unchanged.
Error InTermsOf(const DanceKeys& keys, const Error& error);

}  // namespace choreo::authoring
