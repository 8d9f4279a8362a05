#pragma once

#include <span>
#include <vector>

#include "model/audio/bar_pointer.h"
#include "model/audio/onset.h"

namespace choreo {

/// The beats of a path, with those before its drums at the drums' tempo if these hear as much of
/// the intro: a chord a bar fits any tempo, and the path takes the one whose patterns expect least.
/// Bars are counted back from the drums.
std::vector<BarPointer::Step> CountIntro(std::span<const Onset> onsets,
                                         std::vector<BarPointer::Step> path);

}  // namespace choreo
