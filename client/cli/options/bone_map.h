#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/fit/bones/find_bones.h"

/// Bone maps: JSON that assigns nodes of a rig to bones, such as {"bones": {"pelvis": "Hips",
/// "left_hip": "UpLeg_L", "left_foot": null}}.
namespace choreo::cli {

/// Reads a bone map. Null removes a bone. A node is given by name, or by number from 0 if its name
/// is ambiguous. Throws Error(kNotFound) if the file cannot be opened, and Error(kInvalidArgument)
/// whose field is FILE:bones.BONE for other values. FindBones checks whether bones and nodes exist.
std::vector<BoneChoice> ReadBoneMap(const std::filesystem::path& path);

/// Writes a map for people to correct, and a picture of the rig with all names (draw/bone_chart.h).
void WriteBoneMap(const std::filesystem::path& json, const std::filesystem::path& png,
                  const RigNodes& rig, const HumanBones& bones);

/// Writes a suggested map for a rig whose names are unclear: OUT.map.json, with the `found` bones
/// and guesses of the others, and OUT.map.png. Then throws Error(kInvalidArgument), whose field is
/// `name`, naming both files.
[[noreturn]] void SuggestBoneMap(const std::filesystem::path& out, const std::string& name,
                                 const RigNodes& rig, HumanBones found);

}  // namespace choreo::cli
