#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace choreo {

/// The beats of a prepared clip's music, in (fractional) frames of its motion, ascending. Clips
/// keep MFCC rows, not samples; their inverse cosine transform is a mel spectrum, whose rises are
/// the onsets that audio/beats.h tracks. `rows`: [coefficients, frames], 30 a second. Empty for
/// silence.
std::vector<double> SongBeats(const Eigen::MatrixXf& rows, double fps);

/// Beat alignment score of AIST++ (Li et al. 2021, Section 5), as in its published evaluation: mean
/// over motion beats of exp(-d^2 / 2 sigma^2), with d seconds to the nearest music beat and sigma
/// 0.05 s. A motion beat is a frame whose mean joint speed is *below* all others within 1/6 s on
/// each side (KinematicBeats are maxima, and smoothed). 1 is perfect, 0 without beats of either
/// kind. `speeds[i]` belongs to frame i + 1; music beats are in frames.
double BeatAlignmentScore(std::span<const float> speeds, std::span<const double> music_beats,
                          double fps);

/// F measure of beats, both in seconds, ascending: a found beat within 70 ms of a known one is a
/// hit (Davies et al. 2009). Counts only those in [from, to). 1 if both are empty.
double BeatFMeasure(std::vector<double> found, std::vector<double> known, double from = 0,
                    double to = 1e9);

}  // namespace choreo
