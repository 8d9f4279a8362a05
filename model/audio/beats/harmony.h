#pragma once

#include <span>
#include <vector>

#include "model/audio/beats/bar_pointer.h"

/// Finds the beginnings of bars by harmony, for music whose drums do not show them: most chords
/// change there.
namespace choreo {

inline constexpr int kChroma = 12;  ///< pitch classes

/// The pitch class of a frequency, 0 for A; -1 for one too low or too high for a tone.
int ChromaOf(double hz);

/// Makes another beat the first of all bars if harmony changes clearly more there than on the
/// present one. `mono`: the music at 22 050 Hz. `path`: beats of consecutive bars, in frames of
/// kOnsetHop samples.
void CountByHarmony(std::span<const float> mono, std::vector<BarPointer::Step>* path);

}  // namespace choreo
