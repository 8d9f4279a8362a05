#include "model/audio/beats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "model/audio/format.h"
#include "model/audio/fourier.h"
#include "model/audio/onset.h"

namespace choreo {
namespace {

constexpr double kFrameRate = static_cast<double>(kModelSampleRate) / kOnsetHop;  // a second

constexpr size_t kTempoWindow = kTempoWindowSeconds * kModelSampleRate / kOnsetHop;  // frames
constexpr size_t kTempoFft = 1024;  // long enough for a linear autocorrelation of the window
static_assert(kTempoFft >= 2 * kTempoWindow - 1);
constexpr double kPriorBpm = 120;  // its deviation is one octave
constexpr double kMaxBpm = 320;

constexpr double kTightness = 100;

double BpmOfLag(size_t lag) { return 60.0 * kFrameRate / static_cast<double>(lag); }

/// The envelope with half a window on either side, where it fades linearly from its end values to
/// 0.
std::vector<double> PadWithRamps(std::span<const float> envelope) {
  constexpr size_t kPad = kTempoWindow / 2;
  std::vector<double> padded(envelope.size() + 2 * kPad);
  for (size_t i = 0; i < kPad; ++i) {
    const double rise = static_cast<double>(i) / kPad;
    padded[i] = rise * envelope.front();
    padded[padded.size() - 1 - i] = rise * envelope.back();
  }
  std::copy(envelope.begin(), envelope.end(), padded.begin() + kPad);
  return padded;
}

/// Autocorrelation by lag of the windows around each frame, each scaled to a largest value of 1,
/// averaged.
std::vector<double> MeanAutocorrelation(std::span<const float> envelope) {
  const std::vector<double> padded = PadWithRamps(envelope);
  std::vector<double> hann(kTempoWindow);
  for (size_t i = 0; i < hann.size(); ++i) {
    hann[i] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / kTempoWindow);
  }
  RealFourier fourier(kTempoFft);
  std::vector<double> signal(kTempoFft);
  std::vector<double> mean(kTempoWindow, 0.0);
  for (size_t frame = 0; frame < envelope.size(); ++frame) {
    std::fill(signal.begin(), signal.end(), 0.0);
    for (size_t i = 0; i < kTempoWindow; ++i) signal[i] = hann[i] * padded[frame + i];
    for (auto& bin : fourier.Forward(signal)) bin = std::norm(bin);
    fourier.Inverse(signal);
    double largest = 0;
    for (size_t lag = 0; lag < kTempoWindow; ++lag) {
      largest = std::max(largest, std::abs(signal[lag]));
    }
    if (largest == 0) continue;
    for (size_t lag = 0; lag < kTempoWindow; ++lag) mean[lag] += signal[lag] / largest;
  }
  for (double& value : mean) value /= static_cast<double>(envelope.size());
  return mean;
}

/// The envelope in units of its standard deviation, smoothed by a Gaussian of 1/32 of a beat.
/// `beat` in frames.
std::vector<double> LocalScore(std::span<const float> envelope, int64_t beat) {
  const int64_t size = static_cast<int64_t>(envelope.size());
  double mean = 0, squares = 0;
  for (const float value : envelope) mean += value;
  mean /= static_cast<double>(size);
  for (const float value : envelope) squares += (value - mean) * (value - mean);
  const double deviation = std::sqrt(squares / static_cast<double>(size - 1)) +
                           static_cast<double>(std::numeric_limits<float>::min());

  std::vector<double> gauss(static_cast<size_t>(2 * beat + 1));
  for (int64_t i = -beat; i <= beat; ++i) {
    const double x = 32.0 * static_cast<double>(i) / static_cast<double>(beat);
    gauss[static_cast<size_t>(i + beat)] = std::exp(-0.5 * x * x);
  }
  std::vector<double> score(envelope.size(), 0.0);
  for (int64_t i = 0; i < size; ++i) {
    // The reference leaves the envelope's first value out of windows that reach it; it is 0 in
    // onset strengths.
    const int64_t first = std::max<int64_t>(0, i + beat - size + 1);
    const int64_t last = std::min(i + beat, 2 * beat + 1);
    for (int64_t k = first; k < last; ++k) {
      score[static_cast<size_t>(i)] +=
          gauss[static_cast<size_t>(k)] * (envelope[static_cast<size_t>(i + beat - k)] / deviation);
    }
  }
  return score;
}

struct Links {
  std::vector<int64_t> previous;  // the beat before, were there one here; -1: none
  std::vector<double> total;      // score of the best series of beats that ends here
};

/// Ellis's recurrence: each frame's best predecessor lies half a beat to two beats before.
Links LinkBeats(const std::vector<double>& score, int64_t beat) {
  const double silence = 0.01 * *std::max_element(score.begin(), score.end());
  const int64_t nearest = static_cast<int64_t>(std::nearbyint(static_cast<double>(beat) / 2.0));
  std::vector<double> penalty(static_cast<size_t>(2 * beat + 1), 0.0);
  for (int64_t lag = std::max<int64_t>(1, nearest); lag <= 2 * beat; ++lag) {
    const double octaves = std::log(static_cast<double>(lag)) - std::log(static_cast<double>(beat));
    penalty[static_cast<size_t>(lag)] = kTightness * octaves * octaves;
  }
  Links links{std::vector<int64_t>(score.size(), -1), score};
  bool before_first = true;
  for (int64_t i = 0; i < static_cast<int64_t>(score.size()); ++i) {
    double best = -std::numeric_limits<double>::infinity();
    int64_t from = -1;
    for (int64_t lag = std::max<int64_t>(1, nearest); lag <= std::min(2 * beat, i); ++lag) {
      const double total =
          links.total[static_cast<size_t>(i - lag)] - penalty[static_cast<size_t>(lag)];
      if (total > best) {
        best = total;
        from = i - lag;
      }
    }
    if (from >= 0) links.total[static_cast<size_t>(i)] += best;
    // Beats do not reach back into the silence before the music.
    if (before_first && score[static_cast<size_t>(i)] < silence) continue;
    links.previous[static_cast<size_t>(i)] = from;
    before_first = false;
  }
  return links;
}

/// The last local maximum of the totals that reaches half their median.
int64_t LastBeat(const std::vector<double>& total) {
  std::vector<int64_t> peaks;
  for (size_t i = 1; i < total.size(); ++i) {
    const bool falls = i + 1 == total.size() || total[i] >= total[i + 1];
    if (total[i] > total[i - 1] && falls) peaks.push_back(static_cast<int64_t>(i));
  }
  if (peaks.empty()) return static_cast<int64_t>(total.size()) - 1;
  std::vector<double> heights;
  for (const int64_t peak : peaks) heights.push_back(total[static_cast<size_t>(peak)]);
  std::sort(heights.begin(), heights.end());
  const size_t middle = heights.size() / 2;
  const double median =
      heights.size() % 2 ? heights[middle] : 0.5 * (heights[middle - 1] + heights[middle]);
  while (total[static_cast<size_t>(peaks.back())] < 0.5 * median) peaks.pop_back();
  return peaks.back();
}

/// Drops beats before the first and after the last frame whose score exceeds half the beats'
/// smoothed RMS.
void TrimWeakEnds(const std::vector<double>& score, std::vector<int64_t>& beats) {
  // The envelope of the beats is smoothed by (1/2, 1, 1/2); the reference's sum has two values more
  // than there are beats, one of them the last beat's half, the other 0.
  const auto at = [&](int64_t i) {
    const bool inside = i >= 0 && i < static_cast<int64_t>(beats.size());
    return inside ? score[static_cast<size_t>(beats[static_cast<size_t>(i)])] : 0.0;
  };
  double squares = 0;
  const int64_t terms = static_cast<int64_t>(beats.size()) + 2;
  for (int64_t i = 0; i < terms; ++i) {
    const double smooth = 0.5 * at(i - 1) + at(i) + 0.5 * at(i + 1);
    squares += smooth * smooth;
  }
  const double threshold = 0.5 * std::sqrt(squares / static_cast<double>(terms));
  const auto strong = [&](double value) { return value > threshold; };
  const int64_t first = std::find_if(score.begin(), score.end(), strong) - score.begin();
  const int64_t last =
      score.rend() - std::find_if(score.rbegin(), score.rend(), strong) - 1;  // -1: none
  std::erase_if(beats, [&](int64_t beat) { return beat < first || beat > last; });
}

bool HasOnsets(std::span<const float> envelope) {
  return envelope.size() > 1 &&
         std::any_of(envelope.begin(), envelope.end(), [](float value) { return value != 0; });
}

}  // namespace

std::vector<double> BeatTrack::Seconds() const {
  std::vector<double> seconds;
  for (const int64_t frame : frames) seconds.push_back(static_cast<double>(frame) / kFrameRate);
  return seconds;
}

double EstimateTempo(std::span<const float> onset_strength) {
  if (!HasOnsets(onset_strength)) return 0;
  const std::vector<double> correlation = MeanAutocorrelation(onset_strength);
  double best = -std::numeric_limits<double>::infinity();
  double tempo = 0;
  for (size_t lag = 1; lag < correlation.size(); ++lag) {
    const double bpm = BpmOfLag(lag);
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

BeatTrack TrackBeats(std::span<const float> onset_strength) {
  BeatTrack track;
  if (!HasOnsets(onset_strength)) return track;
  track.tempo_bpm = EstimateTempo(onset_strength);
  const int64_t beat = static_cast<int64_t>(std::nearbyint(60.0 * kFrameRate / track.tempo_bpm));
  const std::vector<double> score = LocalScore(onset_strength, beat);
  const Links links = LinkBeats(score, beat);
  for (int64_t frame = LastBeat(links.total); frame >= 0;
       frame = links.previous[static_cast<size_t>(frame)]) {
    track.frames.push_back(frame);
  }
  std::reverse(track.frames.begin(), track.frames.end());
  TrimWeakEnds(score, track.frames);
  return track;
}

BeatTrack FindBeats(std::span<const float> mono) { return TrackBeats(OnsetStrength(mono)); }

}  // namespace choreo
