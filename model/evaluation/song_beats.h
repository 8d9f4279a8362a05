#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace choreo {

/// The beats of a prepared clip's music, in frames of its motion (fractions allowed), ascending.
///
/// Clips keep MFCC rows, not samples: the rows' inverse cosine transform is the mel spectrum, 40
/// coefficients smooth, whose rise is the onset envelope that audio/beats.h tracks (Ellis 2007, as
/// librosa, which paper F uses). `rows`: [coefficients, frames], 30 a second. Empty for silence.
std::vector<double> SongBeats(const Eigen::MatrixXf& rows, double fps);

/// Beat alignment score (Li et al. 2021, AIST++, Section 5): mean over kinematic beats, which are
/// the *minima* of the smoothed mean joint speed there, of exp(-d^2 / 2 sigma^2), d frames to the
/// nearest music beat, sigma 3 frames. 1 is perfect. 0 without beats of either kind.
double BeatAlignmentScore(std::span<const float> speeds, std::span<const double> music_beats,
                          double fps);

}  // namespace choreo
