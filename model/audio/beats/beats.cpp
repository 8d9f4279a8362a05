#include "model/audio/beats/beats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <utility>

#include "model/audio/beats/bar_pointer.h"
#include "model/audio/beats/half_beats.h"
#include "model/audio/beats/harmony.h"
#include "model/audio/beats/intro.h"
#include "model/audio/beats/onset_sums.h"
#include "model/audio/beats/same_tempo.h"
#include "model/audio/signal/format.h"

namespace choreo {
namespace {

// Silence: 60 dB below the loudest of the last 12 s, or below what 16-bit audio can hold.
constexpr float kSilentBelowDb = 60, kSilentDb = -90;
constexpr int64_t kLoudFrames = 12 * kModelSampleRate / kOnsetHop;
constexpr int64_t kPauseFrames = 2 * kModelSampleRate / kOnsetHop;
constexpr int64_t kMinFrames = kModelSampleRate / kOnsetHop;  // of music between pauses

constexpr size_t kConfidenceBeats = 8;  // on either side
constexpr double kMinExcess = 0.25;
constexpr float kAudibleRise_dB = 2;  // of a band; swells of held chords rise by less than one
// Both ends of an interval are rounded to rows. Above 216 beats a minute this is more than 6 %.
constexpr double kRounding_s = 1.5 / kOnsetRate;

// If onsets on straight beats are stronger than on swung ones by this factor, the swung beats are
// offbeats of the straight ones.
constexpr double kLouder = 2;
// Listeners rarely tap faster than this unless beats are subdivided.
constexpr double kMaxTappedBpm = 160;
constexpr double kAlike = 0.9, kAlikeInStretch = 0.7;  // HalfBeats::AreAlike

using Path = std::vector<BarPointer::Step>;

std::vector<bool> Sounding(std::span<const Onset> onsets) {
  std::vector<bool> sounding(onsets.size());
  std::deque<size_t> loudest;  // descending, within kLoudFrames
  for (size_t f = 0; f < onsets.size(); ++f) {
    while (!loudest.empty() && onsets[loudest.back()].loud_db <= onsets[f].loud_db)
      loudest.pop_back();
    loudest.push_back(f);
    if (static_cast<int64_t>(f - loudest.front()) >= kLoudFrames) loudest.pop_front();
    sounding[f] =
        onsets[f].loud_db > std::max(onsets[loudest.front()].loud_db - kSilentBelowDb, kSilentDb);
  }
  return sounding;
}

struct Part {
  int64_t begin, end;  // frames; both have sound
};

/// The spans between pauses.
std::vector<Part> PartsOf(const std::vector<bool>& sounding) {
  std::vector<Part> parts;
  for (int64_t f = 0; f < std::ssize(sounding); ++f) {
    if (!sounding[static_cast<size_t>(f)]) continue;
    if (parts.empty() || f - parts.back().end >= kPauseFrames) parts.push_back({f, f});
    parts.back().end = f + 1;
  }
  std::erase_if(parts, [](const Part& part) { return part.end - part.begin < kMinFrames; });
  return parts;
}

/// Whether a frame lies in a pause: more than `period` after its start, and before its end.
bool IsInPause(const std::vector<bool>& sounding, int64_t frame, int period) {
  constexpr int64_t kEarly = 3;  // a beat may precede its sound by this much
  const int64_t from = std::max<int64_t>(0, frame - period);
  const int64_t to = std::min<int64_t>(std::ssize(sounding), frame + kEarly + 1);
  for (int64_t f = from; f < to; ++f) {
    if (sounding[static_cast<size_t>(f)]) return false;
  }
  return true;
}

enum class Where { kOnBeats, kOnBeatsOrHalfBeats };

/// How much more of the music begins on these beats (or half beats) than elsewhere between the
/// first and the last: 0 to 1.
double ExcessOf(const OnsetSums& sums, std::span<const int64_t> frames, Where where) {
  if (frames.size() < 2) return 0;
  double on = 0, halfway = 0;
  for (size_t k = 0; k + 1 < frames.size(); ++k) {
    on += sums.OnBeat(frames[k]);
    halfway += sums.OnBeat((frames[k] + frames[k + 1]) / 2);
  }
  if (where == Where::kOnBeatsOrHalfBeats) on = std::max(on, halfway);
  const double even = sums.Between(frames.front(), frames.back()) *
                      static_cast<double>((std::ssize(frames) - 1) * OnsetSums::kBeatFrames) /
                      static_cast<double>(frames.back() - frames.front());
  return Excess(on, even);
}

/// BeatTrack::confidence of each beat, from the beats around it.
std::vector<double> Confidences(std::span<const Onset> onsets, std::span<const int64_t> frames) {
  const OnsetSums sums(onsets);
  std::vector<double> confidences;
  for (size_t i = 0; i < frames.size(); ++i) {
    const size_t first = i - std::min(i, kConfidenceBeats);
    const size_t last = std::min(frames.size() - 1, i + kConfidenceBeats);
    confidences.push_back(ExcessOf(sums, frames.subspan(first, last - first + 1), Where::kOnBeats));
  }
  return confidences;
}

/// How many beats, before each, have a sound that can be heard to begin by the next.
std::vector<size_t> Audible(std::span<const Onset> onsets, std::span<const int64_t> frames) {
  std::vector<size_t> audible{0};
  for (size_t i = 0; i < frames.size(); ++i) {
    const int64_t end = i + 1 < frames.size() ? frames[i + 1] : frames[i] + OnsetSums::kBeatFrames;
    const auto at = [&](int64_t frame) {  // the last beats may be ahead of the music
      return static_cast<size_t>(std::clamp<int64_t>(frame, 0, std::ssize(onsets)));
    };
    const size_t from = at(frames[i] - 1), to = std::max(from, at(end));
    const bool is = std::ranges::any_of(onsets.subspan(from, to - from), [](const Onset& onset) {
      return std::ranges::max(onset.rise) >= kAudibleRise_dB;
    });
    audible.push_back(audible.back() + (is ? 1 : 0));
  }
  return audible;
}

/// Whether each beat belongs to a pulse: most beats around it stand out on both sides, and most
/// have a sound that can be heard to begin. In noise and held notes none do. A pulse starts, and
/// ends, with the beats next to these that stand out themselves.
std::vector<bool> HavePulse(std::span<const Onset> onsets, const Path& path) {
  const OnsetSums sums(onsets);
  std::vector<int64_t> frames;
  for (const BarPointer::Step& step : path) frames.push_back(step.frame);
  const std::vector<size_t> audible = Audible(onsets, frames);
  constexpr size_t kBeats = kConfidenceBeats;
  const size_t last = frames.size() - std::min(frames.size(), kBeats + 1);
  const auto is_clear = [&](size_t first) {
    const size_t count = std::min(frames.size(), kBeats + 1);
    return 2 * (audible[first + count] - audible[first]) > count &&
           ExcessOf(sums, std::span(frames).subspan(first, count), Where::kOnBeatsOrHalfBeats) >=
               kMinExcess;
  };
  std::vector<size_t> clear{0};  // before each beat
  for (size_t i = 0; i < frames.size(); ++i) {
    const bool is =
        is_clear(std::min(i, last)) && is_clear(std::min(i - std::min(i, kBeats), last));
    clear.push_back(clear.back() + (is ? 1 : 0));
  }
  std::vector<bool> have;
  for (size_t i = 0; i < frames.size(); ++i) {
    const size_t first = i - std::min(i, kBeats), end = std::min(frames.size(), i + kBeats + 1);
    have.push_back(2 * (clear[end] - clear[first]) > end - first);
  }
  const auto leads = [&](size_t beat, size_t first) {  // to the pulse of the beats from `first` on
    const auto pulse = std::span(frames).subspan(first, std::min(frames.size(), kBeats + 1));
    const double even = sums.Between(pulse.front(), pulse.back()) * OnsetSums::kBeatFrames /
                        static_cast<double>(pulse.back() - pulse.front());
    return is_clear(first) && audible[beat + 1] > audible[beat] &&
           Excess(sums.OnBeat(frames[beat]), even) >= kMinExcess;
  };
  for (size_t i = frames.size(); i-- > 1;)
    if (have[i] && !have[i - 1]) have[i - 1] = leads(i - 1, std::min(i - 1, last));
  for (size_t i = 1; i < frames.size(); ++i)
    if (have[i - 1] && !have[i]) have[i] = leads(i, std::min(i - std::min(i, kBeats), last));
  return have;
}

Path BestPath(std::span<const Onset> onsets, std::span<const BarPattern> patterns,
              MusicExtent extent, const TempoLimits& limits) {
  BarPointer pointer(patterns, {limits.slowest_bpm, limits.fastest_bpm});
  if (extent == MusicExtent::kPart) pointer.Settle(onsets);
  pointer.Reserve(onsets.size());
  for (const Onset& onset : onsets) pointer.Add(onset);
  return pointer.Path();
}

/// The mean strength of the onsets on a path's beats.
double Sounds(const OnsetSums& sums, const Path& path) {
  double sum = 0;
  for (const BarPointer::Step& step : path) sum += sums.OnBeat(step.frame);
  return path.empty() ? 0 : sum / static_cast<double>(path.size());
}

/// The best path in four-four time. Beats may be divided by two or by three; by three only if the
/// music on those beats is about as loud.
Path PathInFour(std::span<const Onset> onsets, MusicExtent extent, const TempoLimits& limits) {
  const auto patterns = BarPatterns();
  Path path = BestPath(onsets, patterns.first(2), extent, limits);
  if (path.empty() || path.back().pattern == 0) return path;
  Path straight = BestPath(onsets, patterns.first(1), extent, limits);
  const OnsetSums sums(onsets);
  return Sounds(sums, straight) > kLouder * Sounds(sums, path) ? straight : path;
}

/// The best path in the metre of the music.
Path PathOf(std::span<const Onset> onsets, MusicExtent extent, const TempoLimits& limits) {
  const auto patterns = BarPatterns();
  const Path path = PathInFour(onsets, extent, limits);
  if (path.empty() || path.back().pattern != 0) return path;
  const HalfBeats halves(onsets, path);
  const double fastest = std::min(limits.fastest_bpm, kMaxTappedBpm);
  const int slow = static_cast<int>(std::ceil(2 * 60 * kOnsetRate / fastest - 0.5));
  if (halves.Period() >= slow) {
    const double alike = extent == MusicExtent::kWhole ? kAlike : kAlikeInStretch;
    if (halves.AreAlike(alike) || halves.AreAlikeButForAccent(alike)) return Doubled(path, slow);
    if (const int snare = halves.SnareHalf(); snare >= 0) return Doubled(path, slow, 1 - snare);
  }
  const Meter meter = halves.MeterOf();
  if (meter == Meter::kFour)
    return halves.BassIsBetween() ? HalfABeatEarly(path, std::ssize(onsets)) : path;
  const Path other =
      BestPath(onsets, patterns.subspan(meter == Meter::kThree ? 2 : 3, 1), extent, limits);
  return other.empty() ? path : other;
}

int MostFrequent(std::span<const int> values) {
  std::array<int, 8> counts{};
  for (const int value : values) ++counts[static_cast<size_t>(value)];
  return static_cast<int>(std::ranges::max_element(counts) - counts.begin());
}

}  // namespace

std::vector<double> BeatTrack::Seconds() const {
  std::vector<double> seconds;
  for (const int64_t frame : frames) seconds.push_back(static_cast<double>(frame) / kOnsetRate);
  return seconds;
}

std::vector<double> BeatTrack::DownbeatSeconds() const {
  std::vector<double> seconds;
  for (size_t i = 0; i < frames.size(); ++i) {
    if (in_bar[i] == 0) seconds.push_back(static_cast<double>(frames[i]) / kOnsetRate);
  }
  return seconds;
}

double TempoOf(std::span<const double> seconds) {
  std::vector<double> steps;
  for (size_t i = 1; i < seconds.size(); ++i) steps.push_back(seconds[i] - seconds[i - 1]);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + std::ssize(steps) / 2;
  std::ranges::nth_element(steps, middle);
  const double median = *middle, slack = std::max(kSameTempo * median, kRounding_s);
  double sum = 0, count = 0;
  for (const double step : steps) {
    if (std::abs(step - median) > slack) continue;
    sum += step;
    ++count;
  }
  return 60 * count / sum;
}

std::vector<std::pair<double, double>> WithoutBeats(std::span<const double> beats, double seconds) {
  constexpr double kMissed_s = 4;  // more than three of the slowest beats
  std::vector<std::pair<double, double>> without;
  double last = 0;
  const auto until = [&](double next) {
    if (next - last > kMissed_s) without.emplace_back(last, next);
    last = next;
  };
  for (const double beat : beats) until(beat);
  until(seconds);
  return without;
}

BeatTrack TrackBeats(std::span<const Onset> onsets, const TempoLimits& limits, MusicExtent extent,
                     std::span<const float> mono) {
  BeatTrack track;
  std::vector<int> bars;
  const std::vector<bool> sounding = Sounding(onsets);
  for (const Part& part : PartsOf(sounding)) {
    const auto part_onsets =
        onsets.subspan(static_cast<size_t>(part.begin), static_cast<size_t>(part.end - part.begin));
    const auto begins = [](const Onset& onset) {
      return std::ranges::any_of(onset.rise, [](float rise) { return rise > 0; });
    };
    if (std::ranges::none_of(part_onsets, begins)) continue;
    Path path = PathOf(part_onsets, extent, limits);
    if (extent == MusicExtent::kWhole) path = CountIntro(part_onsets, std::move(path));
    if (!mono.empty())
      CountByHarmony(mono.subspan(static_cast<size_t>(part.begin * kOnsetHop)), &path);
    std::erase_if(path, [&](const BarPointer::Step& step) {
      const int64_t frame = part.begin + step.frame;
      const bool behind =
          extent == MusicExtent::kWhole && frame >= std::ssize(onsets) - OnsetSums::kBeatFrames;
      return behind || IsInPause(sounding, frame, step.period);
    });
    const std::vector<bool> have_pulse = HavePulse(part_onsets, path);
    for (size_t i = 0; i < path.size(); ++i) {
      if (!have_pulse[i]) continue;
      track.frames.push_back(part.begin + path[i].frame);
      track.in_bar.push_back(path[i].in_bar);
      bars.push_back(path[i].beats);
    }
  }
  track.confidence = Confidences(onsets, track.frames);
  if (!bars.empty()) track.beats_in_bar = MostFrequent(bars);
  track.tempo_bpm = TempoOf(track.Seconds());
  return track;
}

bool EndInPause(std::span<const Onset> onsets, double period_s) {
  if (onsets.empty()) return true;
  return IsInPause(Sounding(onsets), std::ssize(onsets) - 1,
                   static_cast<int>(std::lround(period_s * kOnsetRate)));
}

BeatTrack FindBeats(std::span<const float> mono) {
  return TrackBeats(FindOnsets(mono), {}, MusicExtent::kWhole, mono);
}

}  // namespace choreo
