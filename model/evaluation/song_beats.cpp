#include "model/evaluation/song_beats.h"

#include <algorithm>
#include <cmath>

#include "model/audio/beats.h"
#include "model/audio/mel.h"
#include "model/audio/onset.h"
#include "model/dance/quality_report.h"

namespace choreo {
namespace {

constexpr double kSampleRate = 22050;
constexpr double kSigma = 3;  // frames
// librosa's onset frames lie half an analysis window behind the windows' centres.
constexpr double kOnsetDelay = kFftSize / 2 / kSampleRate;  // seconds

// Mean rise of the mel bands from row to row, dB; the first is 0.
std::vector<double> Rises(const Eigen::MatrixXf& rows) {
  const Eigen::Index coefficients = rows.rows();
  Eigen::MatrixXd inverse(kMelBands, coefficients);  // of the orthonormal DCT-II
  for (Eigen::Index band = 0; band < kMelBands; ++band) {
    for (Eigen::Index c = 0; c < coefficients; ++c) {
      inverse(band, c) =
          std::sqrt((c == 0 ? 1.0 : 2.0) / kMelBands) *
          std::cos(M_PI * static_cast<double>(c) * (static_cast<double>(band) + 0.5) / kMelBands);
    }
  }
  constexpr double kRange = 80;  // dB below the loudest, as librosa's onset strength has it
  Eigen::MatrixXd mel = inverse * rows.cast<double>();
  mel = mel.cwiseMax(mel.maxCoeff() - kRange);
  std::vector<double> rises(static_cast<size_t>(rows.cols()), 0.0);
  for (Eigen::Index t = 1; t < rows.cols(); ++t)
    rises[static_cast<size_t>(t)] = (mel.col(t) - mel.col(t - 1)).cwiseMax(0).mean();
  return rises;
}

}  // namespace

std::vector<double> SongBeats(const Eigen::MatrixXf& rows, double fps) {
  if (rows.cols() < 2) return {};
  const std::vector<double> rises = Rises(rows);
  // The tracker counts in steps of kOnsetHop.
  const double hop = kOnsetHop / kSampleRate;
  const double seconds = static_cast<double>(rows.cols() - 1) / fps;
  std::vector<float> envelope;
  for (int64_t i = 0; static_cast<double>(i) * hop <= seconds; ++i) {
    const double at = std::max(0.0, (static_cast<double>(i) * hop - kOnsetDelay) * fps);
    const auto before = static_cast<size_t>(at);
    const size_t after = std::min(before + 1, rises.size() - 1);
    const double part = at - static_cast<double>(before);
    envelope.push_back(static_cast<float>((1 - part) * rises[before] + part * rises[after]));
  }
  std::vector<double> beats;
  for (const double second : TrackBeats(envelope).Seconds()) beats.push_back(second * fps);
  return beats;
}

double BeatAlignmentScore(std::span<const float> speeds, std::span<const double> music_beats,
                          double fps) {
  std::vector<float> slowness(speeds.begin(), speeds.end());
  for (float& value : slowness) value = -value;
  const std::vector<int64_t> minima = KinematicBeats(slowness, fps);
  if (minima.empty() || music_beats.empty()) return 0;
  double sum = 0;
  for (const int64_t frame : minima) {
    double nearest = INFINITY;
    for (const double beat : music_beats)
      nearest = std::min(nearest, std::abs(beat - static_cast<double>(frame)));
    sum += std::exp(-nearest * nearest / (2 * kSigma * kSigma));
  }
  return sum / static_cast<double>(minima.size());
}

}  // namespace choreo
