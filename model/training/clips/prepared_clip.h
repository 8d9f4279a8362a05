#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/motion/floor/contacts.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A clip for training and evaluation. On disk: one safetensors file NAME.clip with
///   root_positions [frames, 3] metres, Y up, floor y = 0; rotations [frames, joints, 3]
///   axis-angle, local, radians; contacts [frames, 4]; audio [frames, 40] MFCC rows
///   (FeatureStream's), absent for a dance without music; and in the metadata: name, source,
///   fps, skeleton (motion/skeleton_json.h), terms, the preparation's steps ("corrections",
///   "fit_error_m", ...), and for motion on beats of its own beat_period_s, beat_offset_s and
///   beats_per_bar (training/prepare/beat_grid.h).
struct PreparedClip {
  std::string name;
  std::string source;  ///< the original layout: "tang2018", "bvh", ...
  Skeleton skeleton;
  Motion motion;                             ///< on that skeleton
  Eigen::MatrixXf contacts;                  ///< [4, frames]
  Eigen::MatrixXf audio;                     ///< [40, frames], or no columns
  std::map<std::string, std::string> notes;  ///< all other metadata
};

/// Throws Error(kNotFound) or Error(kInvalidArgument) naming the file.
PreparedClip ReadPreparedClip(const std::filesystem::path& path);
/// Throws Error(kInvalidArgument) for poses of another joint count than the skeleton's.
void WritePreparedClip(const std::filesystem::path& folder, const PreparedClip& clip);
/// Every .clip in a folder, sorted by name. Throws Error if there is none, or no folder.
std::vector<std::filesystem::path> ListPreparedClips(const std::filesystem::path& folder);

/// The XXH3 hash of all clips' names and motions, in order, 16 hex digits. It identifies the data
/// behind a checkpoint or a motion encoder. `before`, such as settings or the hash of other clips,
/// is hashed first.
std::string HashOfClips(std::span<const PreparedClip> clips, std::string_view before = {});

/// The style (mood or genre) in a clip's name, as requests name it: "afraid" for Sophie_Afraid_v2,
/// "waltz" for DANCE_W_12. "" if there is none.
std::string StyleOf(const std::string& clip_name);

}  // namespace choreo
