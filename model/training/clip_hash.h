#pragma once

#include <span>
#include <string>
#include <string_view>

#include "model/training/prepared_clip.h"

namespace choreo {

/// XXH3 of every clip's name and motion, in order, 16 hex digits: which data made a checkpoint or a
/// motion encoder. `before` is hashed in front: settings, or the hash of other clips.
std::string HashOfClips(std::span<const PreparedClip> clips, std::string_view before = {});

}  // namespace choreo
