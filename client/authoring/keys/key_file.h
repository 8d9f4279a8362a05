#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "client/authoring/fields/counts.h"
#include "client/choreo_client.h"

/// Reads key poses that people write.
namespace choreo::authoring {

/// Least seconds between keys that hold a pose. Limbs tremble between nearer keys, and drift
/// between farther ones.
inline constexpr double kHoldStep = 0.2;
/// Least seconds in which people change pose. A new key replaces keys nearer than this.
inline constexpr double kTooNear = 0.2;
/// Seconds that people need from a held pose to the next key. A hold ends this much before a key
/// that is set within it.
inline constexpr double kWayFromHold = 0.5;
/// Seconds that an edit changes before or after a key if no other key is near on that side.
inline constexpr double kEditAround = 2;
/// Seconds within which a neighbouring key is near, so that an edit ends at it. A dance approaches
/// a key for as long.
inline constexpr double kNextKeyNear = 4;
/// Between the id of a key and the number of a key that holds it: "kick held 2".
inline constexpr const char* kHeldStep = " held ";
inline constexpr double kMinHoldSeconds = 0.1, kMaxHoldSeconds = 60;
/// How hard a held key is hit by default: in the dancer's own time.
inline constexpr double kUsualHit = 1;

/// Parses a key file, JSON, as in docs/poses.md. Ignores unknown members of the outermost object,
/// so that files may describe themselves; within a key they are errors.
///
/// Throws Error(kInvalidArgument) whose field is NAME:keyframes[i].MEMBER, naming value and limit.
/// `name`: the file's. `counts`: the music's, for times in counts. `places`, if given, receives
/// each key's place in the file: NAME:keyframes[i], or NAME:keyframes[i].hold for keys that hold a
/// pose.
std::vector<client::KeyPose> ParseKeyFile(std::string_view text, const std::string& name,
                                          const Skeleton& skeleton,
                                          std::vector<std::string>* places = nullptr,
                                          const Counts& counts = {});
/// Reads the keys of a parsed file.
std::vector<client::KeyPose> KeysIn(const nlohmann::json& file, const std::string& name,
                                    const Skeleton& skeleton, std::vector<std::string>* places,
                                    const Counts& counts);

/// Throws Error(kInvalidArgument), whose field is the key's place, for two keys with one id.
void RequireOwnIds(const std::vector<client::KeyPose>& keys,
                   const std::vector<std::string>& places);

/// Returns keys that hold the pose of `key` for `seconds`, so close together that the dancer only
/// settles between them. Uses the key's time, not its frame. Gives a key without a hit kUsualHit,
/// so that the dancer comes to rest. Throws Error(kInvalidArgument, field) for less than 0.1 s or
/// more than 60 s.
std::vector<client::KeyPose> Holding(client::KeyPose* key, double seconds,
                                     const std::string& field);

/// The place of keys that hold the pose of the key at `place`.
std::string HoldOf(const std::string& place);
/// Whether the key at this place only holds the previous key's pose.
bool IsHeld(const std::string& place);

/// The field, in errors, of `member` (".time") of the key at `place`. The time of a key that only
/// holds a pose is the held key's ".hold".
std::string FieldOf(const std::string& place, const std::string& member);

/// The file that a source names: FILE in FILE@.... The name of an existing file may contain "@".
std::filesystem::path FileOf(const std::string& source);

/// Reads key poses named on a command line:
///   keys.json              a key file
///   {"name": "a.json:b", "keyframes": [...]}
///                          the text of a key file, whose errors begin with this name
///   keys.json@ID           one key of the file, with keys that hold it
///   walk.bvh@1.2,3.4       the poses of a motion file (formats/motion_file.h) at these seconds,
///                          each at the same second of the dance
///   walk.npz@1.2=4,3.4=9c  the pose at 1.2 s at second 4 of the dance, that at 3.4 s on count 9
/// Errors and `places` are as for ParseKeyFile; throws Error(kNotFound) for a missing file.
std::vector<client::KeyPose> ReadKeys(const std::string& source, const Skeleton& skeleton,
                                      std::vector<std::string>* places = nullptr,
                                      const Counts& counts = {});

}  // namespace choreo::authoring
