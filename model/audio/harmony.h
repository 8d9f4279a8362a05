#pragma once

#include <span>
#include <vector>

#include "model/audio/bar_pointer.h"

/// Harmony tells where bars begin when drums do not: most chords change there.
namespace choreo {

inline constexpr int kChroma = 12;  ///< pitch classes

/// The pitch class of a frequency, 0 for A; -1 for one too low or too high to be a tone's.
int ChromaOf(double hz);

/// Makes another beat the first of all bars if harmony changes there clearly more than on the
/// present one. `mono`: the music at 22 050 Hz; `path`: beats that bars follow without a gap, in
/// frames of kOnsetHop samples of it.
void CountByHarmony(std::span<const float> mono, std::vector<BarPointer::Step>* path);

}  // namespace choreo
