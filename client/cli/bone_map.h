#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/fit/find_bones.h"

/// Which node of a rig is which bone, as people say it: JSON as in
/// {"bones": {"pelvis": "Hips", "left_hip": "UpLeg_L", "left_foot": null}}.
namespace choreo::cli {

/// Null takes a bone away. A node is named, or counted from 0 where names are there twice. Throws
/// Error(kNotFound) where the file cannot be opened, Error(kInvalidArgument) whose field is
/// FILE:bones.BONE for what is neither. Whether there are such bones and nodes, FindBones says.
std::vector<BoneChoice> ReadBoneMap(const std::filesystem::path& path);

/// Writes a map for somebody to correct, and a picture of the rig with all names
/// (draw/bone_chart.h).
void WriteBoneMap(const std::filesystem::path& json, const std::filesystem::path& png,
                  const RigNodes& rig, const HumanBones& bones);

/// Of a rig whose names tell too little: writes OUT.map.json, what was `found` and a guess of the
/// rest, and OUT.map.png, and throws Error(kInvalidArgument) whose field is `name`, naming them.
[[noreturn]] void SuggestBoneMap(const std::filesystem::path& out, const std::string& name,
                                 const RigNodes& rig, HumanBones found);

}  // namespace choreo::cli
