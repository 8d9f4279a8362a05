#include "model/audio/beats/beats_ahead.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "model/audio/beats/onset_sums.h"

namespace choreo {
namespace {

constexpr size_t kSureBeats = 8;  // that determine the tempo ahead
constexpr size_t kMinBeats = 6;
constexpr double kStoppedSeconds = 3;  // without a beat, after which the music pauses
constexpr double kMinForesight = 0.75;
constexpr int kMinAhead = 2, kMaxAhead = 6;  // beats ahead, for which foresight is measured
constexpr int kMinPredictions = 6;

double PeriodOf(std::span<const double> seconds) { return 60 / TempoOf(seconds); }

/// Sums onsets on beats, and halfway to the next beats, because loud offbeats are a pulse, too.
struct Met {
  double on = 0, halfway = 0;
  int count = 0;

  void Add(const OnsetSums& sums, double frame, double period) {
    on += sums.OnBeat(std::llround(frame));
    halfway += sums.OnBeat(std::llround(frame + period / 2));
    ++count;
  }
  /// The excess over `even`, the mean: 0 to 1.
  double ExcessOver(double even) const { return Excess(std::max(on, halfway) / count, even); }
};

double ForesightOf(std::span<const Onset> onsets, const BeatTrack& track) {
  const std::vector<double> seconds = track.Seconds();
  const OnsetSums sums(onsets);
  const size_t known = std::clamp<size_t>(seconds.size() / 2, kSureBeats / 2, kSureBeats);
  Met predicted, found;
  for (size_t i = 0; i + 1 < seconds.size(); ++i) {
    const double at = seconds[i] * kOnsetRate;
    found.Add(sums, at, (seconds[i + 1] - seconds[i]) * kOnsetRate);
    if (i < known) continue;
    const double period = kOnsetRate * PeriodOf(std::span(seconds).subspan(i - known, known + 1));
    for (int ahead = kMinAhead; ahead <= kMaxAhead; ++ahead) {
      const double beat = at + ahead * period;
      if (beat + period / 2 + OnsetSums::kBeatFrames <= static_cast<double>(sums.frames()))
        predicted.Add(sums, beat, period);
    }
  }
  if (predicted.count < kMinPredictions) return 0;
  const double even =
      OnsetSums::kBeatFrames * sums.Between(0, sums.frames()) / static_cast<double>(sums.frames());
  const double excess = found.ExcessOver(even);
  return excess > 0 ? predicted.ExcessOver(even) / excess : 0;
}

}  // namespace

bool HeardBeats::Certain() const { return foresight >= kMinForesight; }

HeardBeats HearBeats(std::span<const Onset> onsets, int64_t first) {
  HeardBeats heard{.track = TrackBeats(onsets, {}, MusicExtent::kPart)};
  heard.foresight = ForesightOf(onsets, heard.track);
  for (int64_t& frame : heard.track.frames) frame += first;
  return heard;
}

void BeatsAhead::Keep(double from, double to) {
  for (std::vector<double>* some : {&beats, &downbeats})
    std::erase_if(*some, [=](double beat) { return beat < from || beat > to; });
}

BeatsAhead PredictBeats(const BeatTrack& track, double now, double until) {
  const std::vector<double> beats = track.Seconds();
  if (beats.size() < kMinBeats || now - beats.back() > kStoppedSeconds) return {};
  const double period = PeriodOf(std::span(beats).last(std::min(kSureBeats + 1, beats.size())));
  BeatsAhead ahead{.confidence = track.confidence.back()};
  int in_bar = track.in_bar.back();
  const int bar = track.beats_in_bar;
  for (double beat = beats.back() + period; beat < until; beat += period) {
    ++in_bar;
    if (beat <= now) continue;
    ahead.beats.push_back(beat);
    if (bar > 0 && in_bar % bar == 0) ahead.downbeats.push_back(beat);
  }
  return ahead;
}

}  // namespace choreo
