#pragma once

#include <filesystem>

#include "model/formats/character_file.h"

/// Which node of a character is which bone, as people say it: JSON as in
/// {"bones": {"pelvis": "Hips", "left_hip": "UpLeg_L", "left_foot": null}}.
namespace choreo::cli {

/// `found`, as far as the file does not say otherwise: null takes a bone away. A node is named, or
/// counted from 0 where names are there twice. Throws Error(kNotFound) where the file cannot be
/// opened, Error(kInvalidArgument) whose field is FILE:bones.BONE for bones and nodes that are not
/// known.
HumanBones ReadBoneMap(const std::filesystem::path& path, const CharacterFile& character,
                       HumanBones found);

/// Writes a map for somebody to correct, and a picture of the rig with all names
/// (draw/bone_chart.h).
void WriteBoneMap(const std::filesystem::path& json, const std::filesystem::path& png,
                  const CharacterFile& character, const HumanBones& bones);

}  // namespace choreo::cli
