#include "model/audio/beats.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/audio/format.h"
#include "model/audio/fourier.h"
#include "model/audio/onset.h"

namespace choreo {
namespace {

using Eigen::ArrayXd;

constexpr double kFrameRate = static_cast<double>(kModelSampleRate) / kOnsetHop;  // a second

constexpr int64_t kTempoWindow = kTempoWindowSeconds * kModelSampleRate / kOnsetHop;  // frames
constexpr int64_t kTempoFft = 1024;  // long enough for a linear autocorrelation of the window
static_assert(kTempoFft >= 2 * kTempoWindow - 1);
constexpr double kPriorBpm = 120;  // its deviation is one octave
constexpr double kMaxBpm = 320;

constexpr double kTightness = 100;

/// The envelope with half a window on either side, where it fades linearly from its end values to
/// 0.
ArrayXd PadWithRamps(std::span<const float> envelope) {
  constexpr int64_t kPad = kTempoWindow / 2;
  ArrayXd padded(std::ssize(envelope) + 2 * kPad);
  for (int64_t i = 0; i < kPad; ++i) {
    const double rise = static_cast<double>(i) / kPad;
    padded[i] = rise * envelope.front();
    padded[padded.size() - 1 - i] = rise * envelope.back();
  }
  std::ranges::copy(envelope, padded.begin() + kPad);
  return padded;
}

/// Autocorrelation by lag of the windows around each frame, each scaled to a largest value of 1,
/// averaged.
ArrayXd MeanAutocorrelation(std::span<const float> envelope) {
  const ArrayXd padded = PadWithRamps(envelope);
  ArrayXd hann(kTempoWindow);
  for (int64_t i = 0; i < kTempoWindow; ++i) {
    hann[i] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / kTempoWindow);
  }
  RealFourier fourier(kTempoFft);
  ArrayXd signal(kTempoFft), mean = ArrayXd::Zero(kTempoWindow);
  for (int64_t frame = 0; frame < std::ssize(envelope); ++frame) {
    signal.setZero();
    signal.head(kTempoWindow) = hann * padded.segment(frame, kTempoWindow);
    for (auto& bin : fourier.Forward({signal.data(), kTempoFft})) bin = std::norm(bin);
    fourier.Inverse({signal.data(), kTempoFft});
    const double largest = signal.head(kTempoWindow).abs().maxCoeff();
    if (largest > 0) mean += signal.head(kTempoWindow) / largest;
  }
  return mean / static_cast<double>(envelope.size());
}

/// The envelope in units of its standard deviation, smoothed by a Gaussian of 1/32 of a beat.
/// `beat` in frames.
ArrayXd LocalScore(std::span<const float> envelope, int64_t beat) {
  const int64_t size = std::ssize(envelope);
  double mean = 0, squares = 0;
  for (const float value : envelope) mean += value;
  mean /= static_cast<double>(size);
  for (const float value : envelope) squares += (value - mean) * (value - mean);
  const double deviation = std::sqrt(squares / static_cast<double>(size - 1)) +
                           static_cast<double>(std::numeric_limits<float>::min());

  ArrayXd gauss(2 * beat + 1);
  for (int64_t i = -beat; i <= beat; ++i) {
    const double x = 32.0 * static_cast<double>(i) / static_cast<double>(beat);
    gauss[i + beat] = std::exp(-0.5 * x * x);
  }
  ArrayXd score = ArrayXd::Zero(size);
  for (int64_t i = 0; i < size; ++i) {
    // The reference leaves the envelope's first value out of windows that reach it; it is 0 in
    // onset strengths.
    const int64_t first = std::max<int64_t>(0, i + beat - size + 1);
    const int64_t last = std::min(i + beat, 2 * beat + 1);
    for (int64_t k = first; k < last; ++k) {
      score[i] += gauss[k] * (envelope[static_cast<size_t>(i + beat - k)] / deviation);
    }
  }
  return score;
}

struct Links {
  std::vector<int64_t> previous;  // the beat before, were there one here; -1: none
  ArrayXd total;                  // score of the best series of beats that ends here
};

/// Ellis's recurrence: each frame's best predecessor lies half a beat to two beats before.
Links LinkBeats(const ArrayXd& score, int64_t beat) {
  const double silence = 0.01 * score.maxCoeff();
  const int64_t nearest = static_cast<int64_t>(std::nearbyint(static_cast<double>(beat) / 2.0));
  ArrayXd penalty = ArrayXd::Zero(2 * beat + 1);
  for (int64_t lag = std::max<int64_t>(1, nearest); lag <= 2 * beat; ++lag) {
    const double octaves = std::log(static_cast<double>(lag)) - std::log(static_cast<double>(beat));
    penalty[lag] = kTightness * octaves * octaves;
  }
  Links links{std::vector<int64_t>(static_cast<size_t>(score.size()), -1), score};
  bool before_first = true;
  for (int64_t i = 0; i < score.size(); ++i) {
    double best = -std::numeric_limits<double>::infinity();
    int64_t from = -1;
    for (int64_t lag = std::max<int64_t>(1, nearest); lag <= std::min(2 * beat, i); ++lag) {
      const double total = links.total[i - lag] - penalty[lag];
      if (total > best) {
        best = total;
        from = i - lag;
      }
    }
    if (from >= 0) links.total[i] += best;
    // Beats do not reach back into the silence before the music.
    if (before_first && score[i] < silence) continue;
    links.previous[static_cast<size_t>(i)] = from;
    before_first = false;
  }
  return links;
}

/// The last local maximum of the totals that reaches half their median.
int64_t LastBeat(const ArrayXd& total) {
  std::vector<int64_t> peaks;
  std::vector<double> heights;
  for (int64_t i = 1; i < total.size(); ++i) {
    const bool falls = i + 1 == total.size() || total[i] >= total[i + 1];
    if (total[i] <= total[i - 1] || !falls) continue;
    peaks.push_back(i);
    heights.push_back(total[i]);
  }
  if (peaks.empty()) return total.size() - 1;
  std::ranges::sort(heights);
  const size_t middle = heights.size() / 2;
  const double median =
      heights.size() % 2 ? heights[middle] : 0.5 * (heights[middle - 1] + heights[middle]);
  while (total[peaks.back()] < 0.5 * median) peaks.pop_back();
  return peaks.back();
}

/// Drops beats before the first and after the last frame whose score exceeds half the beats'
/// smoothed RMS.
void TrimWeakEnds(const ArrayXd& score, std::vector<int64_t>& beats) {
  // The envelope of the beats is smoothed by (1/2, 1, 1/2); the reference's sum has two values more
  // than there are beats, one of them the last beat's half, the other 0.
  const auto at = [&](int64_t i) {
    return i >= 0 && i < std::ssize(beats) ? score[beats[static_cast<size_t>(i)]] : 0.0;
  };
  double squares = 0;
  const int64_t terms = std::ssize(beats) + 2;
  for (int64_t i = 0; i < terms; ++i) {
    const double smooth = 0.5 * at(i - 1) + at(i) + 0.5 * at(i + 1);
    squares += smooth * smooth;
  }
  const double threshold = 0.5 * std::sqrt(squares / static_cast<double>(terms));
  int64_t first = 0, last = score.size() - 1;
  while (first <= last && !(score[first] > threshold)) ++first;
  while (first <= last && !(score[last] > threshold)) --last;
  std::erase_if(beats, [&](int64_t beat) { return beat < first || beat > last; });
}

/// The tempo in beats a minute of an onset envelope, as librosa.feature.tempo (0.10.2):
/// autocorrelation within kTempoWindowSeconds, averaged, weighed by a log-normal prior around 120,
/// below 320.
double EstimateTempo(std::span<const float> envelope) {
  const ArrayXd correlation = MeanAutocorrelation(envelope);
  double best = -std::numeric_limits<double>::infinity();
  double tempo = 0;
  for (int64_t lag = 1; lag < correlation.size(); ++lag) {
    const double bpm = 60.0 * kFrameRate / static_cast<double>(lag);
    if (bpm >= kMaxBpm) continue;
    const double octaves = std::log2(bpm) - std::log2(kPriorBpm);
    const double score = std::log1p(1e6 * correlation[lag]) - 0.5 * octaves * octaves;
    if (score > best) {
      best = score;
      tempo = bpm;
    }
  }
  return tempo;
}

}  // namespace

std::vector<double> BeatTrack::Seconds() const {
  std::vector<double> seconds;
  for (const int64_t frame : frames) seconds.push_back(static_cast<double>(frame) / kFrameRate);
  return seconds;
}

BeatTrack TrackBeats(std::span<const float> onset_strength) {
  BeatTrack track;
  const bool silent = std::ranges::all_of(onset_strength, [](float value) { return value == 0; });
  if (onset_strength.size() < 2 || silent) return track;
  track.tempo_bpm = EstimateTempo(onset_strength);
  const int64_t beat = static_cast<int64_t>(std::nearbyint(60.0 * kFrameRate / track.tempo_bpm));
  const ArrayXd score = LocalScore(onset_strength, beat);
  const Links links = LinkBeats(score, beat);
  for (int64_t frame = LastBeat(links.total); frame >= 0;
       frame = links.previous[static_cast<size_t>(frame)]) {
    track.frames.push_back(frame);
  }
  std::ranges::reverse(track.frames);
  TrimWeakEnds(score, track.frames);
  return track;
}

BeatTrack FindBeats(std::span<const float> mono) { return TrackBeats(OnsetStrength(mono)); }

}  // namespace choreo
