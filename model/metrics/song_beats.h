#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace choreo {

/// The beats of a prepared clip's music, in (fractional) frames of its motion, ascending. Clips
/// contain MFCC rows, not samples. The inverse cosine transform of the rows is a mel spectrum,
/// whose rises are the onsets that audio/beats/beats.h tracks. `rows`: [coefficients, frames], 30
/// per second. Empty for silence.
std::vector<double> SongBeats(const Eigen::MatrixXf& rows, double fps);

/// The beat alignment score of AIST++ (Li et al. 2021, Section 5), as in its published evaluation:
/// the mean over motion beats of exp(-d^2 / 2 sigma^2), where d is the distance to the nearest
/// music beat and sigma 0.05 s. A motion beat is a frame whose mean joint speed is *below* all
/// others within 1/6 s on each side; KinematicBeats are maxima, and smoothed. 1 is perfect; 0
/// without beats of either kind. `speeds[i]` belongs to frame i + 1. Music beats are in frames.
double BeatAlignmentScore(std::span<const float> speeds, std::span<const double> music_beats,
                          double fps);

/// The F measure of found beats: a beat within 70 ms of a known beat is a hit (Davies et al. 2009).
/// `found`, `known`: seconds, ascending. Counts only beats in [from, to). 1 if there are none.
double BeatFMeasure(std::vector<double> found, std::vector<double> known, double from = 0,
                    double to = 1e9);

}  // namespace choreo
