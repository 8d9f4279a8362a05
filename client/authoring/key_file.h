#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "client/authoring/counts.h"
#include "client/choreo_client.h"

/// Reads key poses that people write.
namespace choreo::authoring {

/// Least seconds between keys that hold a pose: limbs tremble between nearer ones, and wander
/// between farther ones.
inline constexpr double kHoldStep = 0.2;
/// Seconds: the least in which people change pose. A new key replaces those nearer.
inline constexpr double kTooNear = 0.2;
/// Seconds that people need to get from a held pose to a key set into its hold, which ends that
/// much earlier.
inline constexpr double kWayFromHold = 0.5;
/// Seconds that an edit changes on a side of a key where no other one is near.
inline constexpr double kEditAround = 2;
/// Seconds within which the next key is near: there the edit ends. As far a dance leads to a key.
inline constexpr double kNextKeyNear = 4;
inline constexpr double kMaxHoldSeconds = 60;  ///< seconds
/// How hard a held key is hit by default: in the dancer's own time.
inline constexpr double kUsualHit = 1;

/// A key file, JSON, as in docs/poses.md. Ignores unknown members of the outermost object, so that
/// files may describe themselves; within a key they are errors.
///
/// Throws Error(kInvalidArgument) whose field is NAME:keyframes[i].MEMBER, naming value and limit.
/// `name`: the file's. `counts`: those of the music, for times in counts. `places`, if given,
/// becomes the place of each key in the file: NAME:keyframes[i], for keys that hold a pose
/// NAME:keyframes[i].hold.
std::vector<client::KeyPose> ParseKeyFile(std::string_view text, const std::string& name,
                                          const Skeleton& skeleton,
                                          std::vector<std::string>* places = nullptr,
                                          const Counts& counts = {});

/// Keys that hold the pose of this one for `seconds`, so close together that the dancer only
/// settles between them; uses its time, not its frame. Unless it says how it is hit, it is hit at
/// kUsualHit: the dancer comes to rest in it. Throws Error(kInvalidArgument, field) for a
/// time of less than 0.1 or more than 60 s.
std::vector<client::KeyPose> Holding(client::KeyPose* key, double seconds,
                                     const std::string& field);

/// Whether the key at this place only holds the previous one's pose.
bool IsHeld(const std::string& place);

/// The field of `member` (".time") of the key at `place`: for the time of a held one its ".hold".
std::string FieldOf(const std::string& place, const std::string& member);

/// The file that a source names: FILE in FILE@.... The name of an existing file may contain an @.
std::filesystem::path FileOf(const std::string& source);

/// Key poses named on a command line:
///   keys.json              a key file
///   {"name": "a.json:b", "keyframes": [...]}
///                          the text of one, whose errors begin with this name
///   keys.json@ID           one key of it, with those that hold it
///   walk.bvh@1.2,3.4       the poses of a motion file (formats/motion_file.h) at these seconds,
///                          each at the same second of the dance
///   walk.npz@1.2=4,3.4=9c  the pose at 1.2 s at second 4 of the dance, that at 3.4 s on count 9
/// Errors and `places` as above; Error(kNotFound) for a file that is not there.
std::vector<client::KeyPose> ReadKeys(const std::string& source, const Skeleton& skeleton,
                                      std::vector<std::string>* places = nullptr,
                                      const Counts& counts = {});

}  // namespace choreo::authoring
