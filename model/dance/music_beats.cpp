#include "model/dance/music_beats.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "model/audio/pulse.h"
#include "model/core/error.h"
#include "model/dance/transition.h"

namespace choreo {
namespace {

constexpr double kOnsetOverMedian = 2;  // an onset is so much above what the music mostly has

// Whether the music rose in the frame of a beat or in the one before.
bool HasOnset(const AudioFeed& audio, int64_t frame) {
  std::vector<float> onsets = audio.Onsets(frame + 1);
  if (onsets.size() < 2) return false;
  const float here = std::max(onsets.back(), onsets[onsets.size() - 2]);
  const auto median = onsets.begin() + static_cast<std::ptrdiff_t>(onsets.size() / 2);
  std::nth_element(onsets.begin(), median, onsets.end());
  return here > kOnsetOverMedian * *median;
}

}  // namespace

MusicBeats::MusicBeats(double fps, const std::vector<double>& given, std::optional<double> last,
                       const AudioFeed* audio)
    : fps_(fps), audio_(audio), hears_(audio != nullptr && given.empty()), count_(given.size()) {
  if (hears_ && last) known_.push_back({*last, MusicBeat::Source::kPredicted});
  Replace(given, MusicBeat::Source::kGiven);
}

void MusicBeats::Replace(const std::vector<double>& seconds, MusicBeat::Source source) {
  if (seconds.empty()) return;
  std::erase_if(known_, [&](const MusicBeat& beat) { return beat.seconds >= seconds.front(); });
  for (const double second : seconds) known_.push_back({second, source});
}

void MusicBeats::Find(const std::vector<double>& seconds) {
  hears_ = false;
  known_.clear();
  Replace(seconds, MusicBeat::Source::kFound);
}

void MusicBeats::Give(std::vector<double> seconds, int64_t from, const std::string& field) {
  if (seconds.empty()) return;
  if (count_ + seconds.size() > kMostBeats) {
    throw InvalidArgument(field, "bring the dance's beats to " +
                                     std::to_string(count_ + seconds.size()) + ", the limit is " +
                                     std::to_string(kMostBeats));
  }
  count_ += seconds.size();
  given_.push_back({from, std::move(seconds)});
}

void MusicBeats::Cut(int64_t frame) {
  const double end = static_cast<double>(frame) / fps_;
  std::erase_if(known_, [end](const MusicBeat& beat) {
    return beat.source == MusicBeat::Source::kPredicted && beat.seconds >= end;
  });
}

bool MusicBeats::HearsFrom(int64_t frame) const {
  // What is known ahead was given.
  return hears_ && (known_.empty() || known_.back().seconds < static_cast<double>(frame) / fps_);
}

std::vector<double> MusicBeats::Around(int64_t from, int64_t to) {
  for (; !given_.empty() && given_.front().from <= from; given_.pop_front())
    Replace(given_.front().seconds, MusicBeat::Source::kGiven);
  if (HearsFrom(from)) return Predict(from, to);
  std::vector<double> seconds;
  for (const MusicBeat& beat : known_) seconds.push_back(beat.seconds);
  return BeatsAround(seconds, fps_, from, static_cast<int>(to - from));
}

std::vector<double> MusicBeats::Predict(int64_t from, int64_t to) {
  const Pulse pulse = HearPulse(audio_->Onsets(from));
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

std::vector<MusicBeat> MusicBeats::Of(int64_t frame) const {
  const auto from = [this](int64_t of) {
    return std::ranges::lower_bound(known_, static_cast<double>(of) / fps_, {},
                                    &MusicBeat::seconds);
  };
  std::vector<MusicBeat> beats(from(frame), from(frame + 1));
  for (MusicBeat& beat : beats) {
    if (beat.source == MusicBeat::Source::kPredicted && HasOnset(*audio_, frame))
      beat.source = MusicBeat::Source::kHeard;
  }
  return beats;
}

std::optional<double> MusicBeats::Last(int64_t frame) const {
  const auto behind =
      std::ranges::lower_bound(known_, static_cast<double>(frame) / fps_, {}, &MusicBeat::seconds);
  if (!hears_ || behind == known_.begin()) return std::nullopt;
  return std::prev(behind)->seconds;
}

}  // namespace choreo
