#include "model/dance/music_beats.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "model/audio/pulse.h"
#include "model/dance/transition.h"

namespace choreo {
namespace {

constexpr double kOnsetOverMean = 2;  // an onset is so much above what the music has on average

// Whether the music rose in the frame of a beat or in the one before.
bool HasOnset(const AudioFeed& audio, int64_t frame) {
  const std::vector<float> onsets = audio.Onsets(frame + 1);
  if (onsets.size() < 2) return false;
  const double mean =
      std::accumulate(onsets.begin(), onsets.end(), 0.0) / static_cast<double>(onsets.size());
  return std::max(onsets.back(), onsets[onsets.size() - 2]) > kOnsetOverMean * mean;
}

}  // namespace

MusicBeats::MusicBeats(double fps, const std::vector<double>& given, bool hear)
    : fps_(fps), hear_(hear && given.empty()) {
  if (!given.empty()) Replace(given, MusicBeat::Source::kGiven);
}

void MusicBeats::Replace(const std::vector<double>& seconds, MusicBeat::Source source) {
  std::erase_if(known_, [&](const MusicBeat& beat) { return beat.seconds >= seconds.front(); });
  for (const double second : seconds) known_.push_back({second, source});
  hear_ = false;
}

void MusicBeats::Find(const std::vector<double>& seconds) {
  known_.clear();
  if (!seconds.empty()) Replace(seconds, MusicBeat::Source::kFound);
}

void MusicBeats::Give(std::vector<double> seconds, int64_t frozen) {
  given_.push_back({frozen, std::move(seconds)});
}

std::vector<double> MusicBeats::Around(int64_t from, int64_t to, const AudioFeed* audio) {
  for (; !given_.empty() && given_.front().frozen < to; given_.pop_front())
    Replace(given_.front().seconds, MusicBeat::Source::kGiven);
  if (hear_) return audio == nullptr ? std::vector<double>() : Predict(from, to, *audio);
  std::vector<double> seconds;
  for (const MusicBeat& beat : known_) seconds.push_back(beat.seconds);
  return BeatsAround(seconds, fps_, from, static_cast<int>(to - from));
}

std::vector<double> MusicBeats::Predict(int64_t from, int64_t to, const AudioFeed& audio) {
  const Pulse pulse = HearPulse(audio.Onsets(from));
  if (!pulse.Certain()) return {};
  std::vector<double> beats;
  const auto frames = static_cast<double>(to - from);
  // One before the first frame, one behind the last. The last row heard is that before `from`.
  double beat = pulse.next - 1;
  while (beat >= 0) beat -= pulse.period;
  for (;; beat += pulse.period) {
    beats.push_back(beat);
    if (beat >= frames) return beats;
    const double second = (static_cast<double>(from) + beat) / fps_;
    // The transition before may have put a beat here already.
    const bool near = !known_.empty() && second - known_.back().seconds < 0.5 * pulse.period / fps_;
    if (beat >= 0 && !near)
      known_.push_back({second, MusicBeat::Source::kPredicted, pulse.confidence});
  }
}

std::vector<MusicBeat> MusicBeats::Between(double from, double to, const AudioFeed* audio) const {
  const auto first = std::ranges::lower_bound(known_, from, {}, &MusicBeat::seconds);
  const auto last = std::ranges::lower_bound(known_, to, {}, &MusicBeat::seconds);
  std::vector<MusicBeat> beats(first, last);
  for (MusicBeat& beat : beats) {
    if (beat.source != MusicBeat::Source::kPredicted) continue;
    const auto frame = static_cast<int64_t>(std::floor(beat.seconds * fps_));
    if (HasOnset(*audio, frame)) beat.source = MusicBeat::Source::kHeard;
  }
  return beats;
}

}  // namespace choreo
