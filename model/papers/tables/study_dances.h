#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "model/evaluation/evaluation.h"
#include "model/papers/tables/study.h"

namespace choreo {

/// Makes every method's dances in the middle of each clip as served, through the clip's own poses
/// every 100 frames. Films them and the real motion as METHOD/CLIP.mp4 in `folder`. Leaves out raw
/// interpolation. `songs`: a folder with the films' music, CLIP.ogg (.wav, .mp3); empty: silent
/// films. `frames`: the length, or less if a clip's music ends earlier. Keys are not marked,
/// because real motion has none. Throws Error(kNotFound) for a clip without a song, and what
/// VideoEncoder throws.
std::vector<StudyMethod> FilmDances(const ClipSet& set, std::span<const Method> methods, int frames,
                                    const std::filesystem::path& songs,
                                    const std::filesystem::path& folder);

}  // namespace choreo
