#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/audio/beats/bar_pointer.h"
#include "model/audio/beats/onset.h"

namespace choreo {

/// When an intro is counted anew.
struct IntroOptions {
  /// The beats after the intro that tell the drums' tempo and phase: two bars of four, because a
  /// fill or a syncopation lasts one at most.
  size_t leading = 8;
  /// The least sound that the new beats hear of the intro, as a share of what its own beats hear.
  /// The own beats were chosen among all tempi to hear the most, so equal ones hear a little less.
  double as_much = 0.9;
};

/// Returns `path` with the beats before its drums recounted at the drums' tempo, in frames of
/// `onsets`. An intro of one chord per bar fits any tempo, so its own tempo proves nothing. Keeps
/// the path if its intro already has that tempo, or if the new beats hear less of the intro. Bars
/// are counted back from the drums. Pure.
std::vector<BarPointer::Step> CountIntro(std::span<const Onset> onsets,
                                         std::vector<BarPointer::Step> path,
                                         const IntroOptions& options = {});

}  // namespace choreo
