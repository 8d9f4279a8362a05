#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "client/choreo_client.h"

/// Key poses as people write them down.
namespace choreo::cli {

/// A key file, JSON:
///
///     {"keyframes": [{"id": "a", "time": 2.0, "root_position": [x, y, z], "rotations": [[x, y, z],
///     ...]}]}
///
/// `rotations` holds one axis-angle vector for each joint, radians, local to the parent. `time` is
/// in seconds; `frame` may stand in its place. `id` may be absent: "key1", "key2", ... are given.
/// Without `root_position` the key asks nothing of where the dancer is; `joints`, a list of joint
/// names, limits it to these. In place of `root_position` and `rotations` there may be
/// `smpl_poses` and `smpl_trans` as EDGE gives them (72 numbers, Z up, the translation is the
/// pelvis), or `poses` and `trans` as AMASS does (72, 156 or 165 numbers, Z up, the translation is
/// SMPL's): formats/amass_npz.h; a model of another skeleton takes them retargeted.
///
/// Or `pose` names one of the library, which `place` ([x, z], metres) and `facing` (degrees) put
/// somewhere; without `place` the key asks nothing of where the dancer is. `joints` may be an
/// object of joints in degrees (motion/joint_angles.h), on top of the pose; without a pose the key
/// asks for these joints alone. In a list, "arms", "left_leg" ... stand for whole limbs. `hold`
/// keeps the pose for seconds, with further keys "ID held 1", "ID held 2", ... Other members
/// of the file's outermost object are ignored, so that it may describe itself; within a key they
/// are errors, so that a misspelt one is found.
///
/// Throws Error(kInvalidArgument) whose field is NAME:keyframes[i].MEMBER, naming value and limit.
/// `name` is the file's. `places`, where it is wanted, becomes the place of each key in the file:
/// NAME:keyframes[i], of keys that hold a pose NAME:keyframes[i].hold.
std::vector<client::KeyPose> ParseKeyFile(std::string_view text, const std::string& name,
                                          const Skeleton& skeleton,
                                          std::vector<std::string>* places = nullptr);

/// Whether the key at this place only holds the pose of the one before.
bool IsHeld(const std::string& place);

/// The field that says `member` (".time") of the key at `place`: the time of a held one is its
/// ".hold".
std::string FieldOf(const std::string& place, const std::string& member);

/// The file that such a source names: FILE of FILE@.... One whose name has an @ is a file.
std::filesystem::path FileOf(const std::string& source);

/// Key poses named on a command line:
///   keys.json              a key file
///   keys.json@ID           one key of it, with those that hold it
///   walk.bvh@1.2,3.4       the poses of a motion file (formats/motion_file.h) at these seconds,
///                          each at the same second of the dance
///   walk.npz@1.2=4,3.4=8   the pose at 1.2 s at second 4 of the dance, that at 3.4 s at second 8
/// Errors and `places` as above; Error(kNotFound) for a file that is not there.
std::vector<client::KeyPose> ReadKeys(const std::string& source, const Skeleton& skeleton,
                                      std::vector<std::string>* places = nullptr);

}  // namespace choreo::cli
