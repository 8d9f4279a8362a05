#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "model/evaluation/evaluation.h"
#include "model/papers/tables/study.h"

namespace choreo {

/// Dances beside the middle of each clip, through the clip's own poses each 100 frames, as every
/// method is served, and films them, METHOD/CLIP.mp4 in `folder`: real motion as it was danced;
/// interpolation that nobody put on its feet has no film. `songs`: a folder with CLIP.ogg (.wav,
/// .mp3), which the films play; silent if empty. `frames`: how long; less where a clip's music
/// ends. Keys are not marked: real motion has none. Throws Error(kNotFound) for a clip without a
/// song, and as VideoEncoder.
std::vector<StudyMethod> FilmDances(const ClipSet& set, std::span<const Method> methods, int frames,
                                    const std::filesystem::path& songs,
                                    const std::filesystem::path& folder);

}  // namespace choreo
