#pragma once

#include <Eigen/Core>
#include <span>

#include "model/audio/signal/mel.h"
#include "model/core/grid.h"

namespace choreo {

/// Computes a row of cepstral coefficients: the first kMfccCount of the orthonormal DCT-II of a mel
/// spectrum in dB.
void MfccOfMelDb(std::span<const double, kMelBands> db, std::span<float, kMfccCount> row);

/// [row, coefficient]
using FeatureMatrix = Eigen::Matrix<float, Eigen::Dynamic, kMfccCount, Eigen::RowMajor>;

/// MFCC-40 of mono samples at 22 050 Hz, as librosa 0.10.2 computes them with n_fft 2048, centred
/// windows and top_db None (a stream cannot know its loudest frame in advance). Row r is centred at
/// sample r * kFeatureHop; there are 1 + samples / kFeatureHop. Throws what MelSpectrogram throws.
FeatureMatrix Mfcc(std::span<const float> mono);

}  // namespace choreo
