#include "model/metrics/song_beats.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/audio/beats/beats.h"
#include "model/audio/beats/onset.h"
#include "model/audio/signal/format.h"
#include "model/audio/signal/mel.h"

namespace choreo {
namespace {

constexpr double kSigma = 3.0 / 60;  // seconds
constexpr double kTolerance = 0.07;  // seconds of tolerance for a beat
constexpr double kAround =
    10.0 / 60;  // seconds on each side within which a motion beat is the slowest
// A rise appears when a sound enters the window, half the window's length before its centre.
constexpr double kOnsetDelay = kFftSize / 2.0 / kModelSampleRate;  // seconds

// Onsets row by row: mean rises of the mel bands, dB; none in the first row.
std::vector<Onset> RowOnsets(const Eigen::MatrixXf& rows) {
  const Eigen::Index coefficients = rows.rows();
  Eigen::MatrixXd inverse(kMelBands, coefficients);  // of the orthonormal DCT-II
  for (Eigen::Index band = 0; band < kMelBands; ++band) {
    for (Eigen::Index c = 0; c < coefficients; ++c) {
      inverse(band, c) = std::sqrt((c == 0 ? 1.0 : 2.0) / kMelBands) *
                         std::cos(M_PI * c * (static_cast<double>(band) + 0.5) / kMelBands);
    }
  }
  constexpr double kRange = 80;  // dB below the loudest, as in librosa's onset strength
  // Slaney's bands up to 160 Hz, to 1600 Hz, and above, as in Onset.
  constexpr std::array<Eigen::Index, 4> kEnds{0, 6, 56, kMelBands};
  Eigen::MatrixXd mel = inverse * rows.cast<double>();
  mel = mel.cwiseMax(mel.maxCoeff() - kRange);
  std::vector<Onset> onsets(static_cast<size_t>(rows.cols()));
  for (Eigen::Index t = 0; t < rows.cols(); ++t) {
    Onset& onset = onsets[static_cast<size_t>(t)];
    onset.loud_db = static_cast<float>(mel.col(t).maxCoeff() - mel.maxCoeff());
    for (size_t band = 0; t > 0 && band < Onset::kBands; ++band) {
      const auto rises =
          (mel.col(t) - mel.col(t - 1)).segment(kEnds[band], kEnds[band + 1] - kEnds[band]);
      onset.rise[band] = static_cast<float>(rises.cwiseMax(0).mean());
    }
  }
  return onsets;
}

// Frames of the strict minima among the steps within kAround. The published code puts a standstill
// before the first step, so it finds none within kAround of it. The last step does not count,
// either.
std::vector<int64_t> MotionBeats(std::span<const float> speeds, double fps) {
  const auto count = static_cast<int64_t>(speeds.size());
  const int64_t order = std::max(int64_t{1}, static_cast<int64_t>(std::lround(kAround * fps)));
  std::vector<int64_t> frames;
  for (int64_t i = order; i + 1 < count; ++i) {
    const auto from = speeds.begin() + i - order;
    const auto to = speeds.begin() + std::min(count, i + order + 1);
    const float speed = speeds[i];
    if (std::count_if(from, to, [=](float other) { return other <= speed; }) == 1)
      frames.push_back(i + 1);
  }
  return frames;
}

}  // namespace

std::vector<double> SongBeats(const Eigen::MatrixXf& rows, double fps) {
  if (rows.cols() < 2) return {};
  const std::vector<Onset> by_row = RowOnsets(rows);
  // The tracker counts in steps of kOnsetHop.
  const double hop = static_cast<double>(kOnsetHop) / kModelSampleRate;
  const double seconds = static_cast<double>(rows.cols() - 1) / fps;
  std::vector<Onset> onsets;
  for (int64_t i = 0; static_cast<double>(i) * hop <= seconds; ++i) {
    const double at = std::max(0.0, (static_cast<double>(i) * hop - kOnsetDelay) * fps);
    const auto before = static_cast<size_t>(at);
    const Onset& one = by_row[before];
    const Onset& other = by_row[std::min(before + 1, by_row.size() - 1)];
    const auto part = static_cast<float>(at - static_cast<double>(before));
    Onset& onset = onsets.emplace_back();
    onset.loud_db = std::lerp(one.loud_db, other.loud_db, part);
    for (size_t band = 0; band < Onset::kBands; ++band)
      onset.rise[band] = std::lerp(one.rise[band], other.rise[band], part);
  }
  std::vector<double> beats;
  for (const double second : TrackBeats(onsets).Seconds()) beats.push_back(second * fps);
  return beats;
}

double BeatAlignmentScore(std::span<const float> speeds, std::span<const double> music_beats,
                          double fps) {
  const std::vector<int64_t> motion_beats = MotionBeats(speeds, fps);
  if (motion_beats.empty() || music_beats.empty()) return 0;
  double sum = 0;
  for (const int64_t frame : motion_beats) {
    double nearest = INFINITY;  // seconds
    for (const double beat : music_beats)
      nearest = std::min(nearest, std::abs(beat - static_cast<double>(frame)) / fps);
    sum += std::exp(-nearest * nearest / (2 * kSigma * kSigma));
  }
  return sum / motion_beats.size();
}

double BeatFMeasure(std::vector<double> found, std::vector<double> known, double from, double to) {
  const auto outside = [=](double time) { return time < from || time >= to; };
  std::erase_if(found, outside);
  std::erase_if(known, outside);
  size_t hits = 0;
  for (size_t i = 0, j = 0; i < found.size() && j < known.size();) {
    if (std::abs(found[i] - known[j]) <= kTolerance) {
      ++hits, ++i, ++j;
    } else {
      found[i] < known[j] ? ++i : ++j;
    }
  }
  const size_t all = found.size() + known.size();
  return all == 0 ? 1 : 2.0 * static_cast<double>(hits) / static_cast<double>(all);
}

}  // namespace choreo
