#pragma once

#include <string>
#include <vector>

#include "client/choreo_client.h"
#include "model/core/grid.h"

namespace choreo::cli {

/// Whether `--keyframes none` asks for no keys at all. Throws Error(kInvalidArgument) where others
/// stand beside it.
bool SaysNoKeys(const std::vector<std::string>& sources);
/// The key files and motions among what --keyframes names.
std::vector<std::string> KeySources(const std::vector<std::string>& sources);

/// The key poses of a dance in the order of their times, as they are sent.
struct DanceKeys {
  std::vector<client::KeyPose> poses;
  /// Of each where it was written, "keys.json:keyframes[1]" (ParseKeyFile in key_file.h).
  std::vector<std::string> places;
};

/// How long a dance is.
struct DanceLength {
  int64_t frames = 0;
  double fps = kModelFps;  ///< the model's
};

/// Of something at a frame that the dance does not reach: "at 20 s lies behind the dance's end:
/// its last frame is at 9.97 s".
std::string SayBehindEnd(int64_t frame, const DanceLength& length);

/// The frame that a key asks for, at the model's rate.
int64_t FrameOf(const client::KeyPose& key, double fps);

/// Whoever asks for second 30 of a dance of 30 seconds means its end: a key there stands on the
/// last frame. Throws Error(kInvalidArgument), whose field begins with `place`, for one behind
/// that.
void FitIntoDance(const DanceLength& length, const std::string& place, client::KeyPose* key);

/// The id of the key whose pose this one only holds; empty for one that stands for itself.
std::string HeldKey(const DanceKeys& keys, size_t index);

/// In the order in which they are sent: a key that comes after a later one would come too late.
DanceKeys ByTime(DanceKeys keys, double fps);

/// Reads key poses from sources as ReadKeys (key_file.h) takes them. Throws what that does, and
/// Error(kInvalidArgument), whose field begins with the key's place, for an id that an earlier key
/// has; each is fitted into the dance.
DanceKeys ReadDanceKeys(const std::vector<std::string>& sources, const DanceLength& length,
                        const Skeleton& skeleton);

/// An error about "keyframes[i]", numbered as the keys were sent, in terms of where the key was
/// written; any other error as it is.
Error InTermsOf(const DanceKeys& keys, const Error& error);

}  // namespace choreo::cli
