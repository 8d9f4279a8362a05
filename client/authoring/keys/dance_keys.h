#pragma once

#include <string>
#include <vector>

#include "client/authoring/fields/counts.h"
#include "client/choreo_client.h"
#include "model/core/grid.h"

namespace choreo::authoring {

/// The value of `--keyframes` for a dance without keys.
inline constexpr const char* kNoKeys = "none";
/// Whether `sources` request a dance without keys. Throws Error(kInvalidArgument) if they also name
/// other sources.
bool IsNoKeys(const std::vector<std::string>& sources);
/// Returns the key files and motions among the sources of --keyframes.
std::vector<std::string> KeySources(const std::vector<std::string>& sources);

/// A dance's key poses in order of time, as sent.
struct DanceKeys {
  std::vector<client::KeyPose> poses;
  /// Each key's origin, such as "keys.json:keyframes[1]" (ParseKeyFile in key_file.h).
  std::vector<std::string> places;
  std::vector<client::Warning> warnings = {};  ///< about changes by ByTime
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

/// Moves a key at the very end of a dance, such as at second 30 of 30, to the last frame: people
/// mean that. Moves a key beside the first frame to that (FrameForKey in counts.h). Throws
/// Error(kInvalidArgument), whose field begins with the key's place, for a later key.
void FitIntoDance(const DanceLength& length, DanceKeys* keys);

/// Says that the hold of key `held` ends at frame `now`, not `was`, because of key `key`.
std::string DescribeHoldEnd(const std::string& held, int64_t now, int64_t was,
                            const std::string& key, int64_t key_frame, double fps);

/// The id of the key whose pose the key at `index` holds; empty if it holds none.
std::string HeldKey(const DanceKeys& keys, size_t index);

/// Sorts keys by time, because a key sent after a later one would be too late. A key within
/// another's hold ends the hold kWayFromHold before itself; `warnings` says so.
DanceKeys ByTime(DanceKeys keys, double fps);

/// Reads key poses from sources (see ReadKeys in key_file.h) and fits each into the dance. Throws
/// as ReadKeys does, and Error(kInvalidArgument), whose field begins with the key's place, for a
/// duplicate id, and for keys closer than kMinKeyDistance.
DanceKeys ReadDanceKeys(const std::vector<std::string>& sources, const DanceLength& length,
                        const Skeleton& skeleton, const Counts& counts = {});

/// Translates an error about "keyframes[i]", numbered as sent, to the place where the key was
/// written. Returns other errors unchanged.
Error InTermsOf(const DanceKeys& keys, const Error& error);

}  // namespace choreo::authoring
