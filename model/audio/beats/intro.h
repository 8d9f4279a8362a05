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
  /// The least onsets on the new beats of the intro, as a share of the onsets on its own beats. Its
  /// own tempo was chosen for the most onsets, so equally good beats have a little less.
  double as_much = 0.9;
};

/// Returns `path` with the beats before its drums recounted at the drums' tempo, in frames of
/// `onsets`. An intro of one chord per bar fits any tempo, so its own tempo proves nothing. Keeps
/// the path if its intro already has that tempo, or if the new beats have fewer onsets than
/// `as_much`. Counts bars back from the drums. Pure.
std::vector<BarPointer::Step> CountIntro(std::span<const Onset> onsets,
                                         std::vector<BarPointer::Step> path,
                                         const IntroOptions& options = {});

}  // namespace choreo
