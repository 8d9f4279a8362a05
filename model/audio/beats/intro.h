#pragma once

#include <span>
#include <vector>

#include "model/audio/beats/bar_pointer.h"
#include "model/audio/beats/onset.h"

namespace choreo {

/// Returns `path` with the beats before its drums recounted at the drums' tempo, in frames of
/// `onsets`. An intro of one chord per bar fits any tempo, so its own tempo proves nothing. Keeps
/// the path if its intro already has that tempo, or if the new beats hear less of the intro. Bars
/// are counted back from the drums. Pure.
std::vector<BarPointer::Step> CountIntro(std::span<const Onset> onsets,
                                         std::vector<BarPointer::Step> path);

}  // namespace choreo
