#pragma once

#include <filesystem>

#include "model/training/prepare.h"

namespace choreo {

/// The dancers of "Dance with Melody" (Tang et al. 2018), 25 fps, centimetres. Each reader throws
/// Error(kInvalidArgument) or Error(kNotFound) naming the file.

/// tang2018: NAME.npy [frames, 24, 3] beside NAME.ogg (.wav, .mp3), which begins with the motion.
/// Row 0 is the world's centre, the others are joints relative to it.
Recording ReadTang2018Npy(const std::filesystem::path& path, const PrepareOptions& options);

/// tang2018 as it is public: NAME/skeletons.json, config.json (the dance's start and end frame
/// within the music), audio.mp3.
Recording ReadTang2018Folder(const std::filesystem::path& folder, const PrepareOptions& options);

/// tang61: NAME.npy [frames, 21, 3] in the world, beside its music. The dances are not stretched to
/// their songs: they stand on a beat grid of their own, which the recording tells where its speed
/// shows it.
Recording ReadTang61(const std::filesystem::path& path, const PrepareOptions& options);

}  // namespace choreo
