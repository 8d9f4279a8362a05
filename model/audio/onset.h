#pragma once

#include <span>
#include <vector>

namespace choreo {

/// Samples at 22 050 Hz from one onset value, and one beat frame, to the next.
inline constexpr int kOnsetHop = 512;

/// How the rise of the mel bands becomes one number.
enum class OnsetAggregate {
  kMean,    ///< librosa.onset.onset_strength's default
  kMedian,  ///< what librosa.beat.beat_track uses on samples; less swayed by one loud band
};

/// Onset strength of mono samples at 22 050 Hz, as librosa 0.10.2: the mean or median over the mel
/// bands of how many dB each rose since the frame before (top_db 80). Value f describes sample f *
/// kOnsetHop; there are 1 + samples / kOnsetHop, all >= 0, the first three 0. Errors as
/// MelSpectrogramDb.
std::vector<float> OnsetStrength(std::span<const float> mono,
                                 OnsetAggregate aggregate = OnsetAggregate::kMean);

}  // namespace choreo
