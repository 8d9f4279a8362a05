#include "model/dance/delivery/beat_schedule.h"

#include <algorithm>
#include <cmath>

#include "model/audio/beats/beats.h"
#include "model/core/numbers/quantile.h"
#include "model/dance/input/dance_music.h"

namespace choreo {
namespace {

constexpr double kOnsetOverMedian = 2;  // an onset exceeds the median by this factor
constexpr int kMedianRows = 12 * static_cast<int>(kModelFps);

// Whether the music had an onset in a beat's frame or in the one before.
bool HasOnset(const AudioFeed& audio, int64_t frame) {
  std::vector<float> onsets;
  for (const RowSound& sound : audio.Sounds(frame + 1, kMedianRows)) onsets.push_back(sound.onset);
  if (onsets.size() < 2) return false;
  const float here = std::max(onsets.back(), onsets[onsets.size() - 2]);
  return here > kOnsetOverMedian * Median(onsets);
}

}  // namespace

void BeatSchedule::StartTransition(std::span<const Beat> beats, int64_t from) {
  const std::vector<double> seconds = SecondsOf(beats);
  ahead_.clear();
  std::optional<double> last = last_;
  const auto first =
      static_cast<size_t>(std::ranges::lower_bound(seconds, Seconds(from)) - seconds.begin());
  // Includes the last beat before this transition, which the previous one may have omitted.
  for (size_t i = last && first > 0 ? first - 1 : first; i < beats.size(); ++i) {
    if (last && seconds[i] - *last <= 0.5 * BeatStep(seconds, i))
      continue;  // already reported, slightly earlier
    ahead_.push_back({beats[i], BeatStep(seconds, i)});
    last = seconds[i];
  }
}

std::vector<Beat> BeatSchedule::TakeAt(int64_t frame) {
  std::vector<Beat> beats;
  for (; !ahead_.empty() && ahead_.front().beat.time_s < Seconds(frame + 1); ahead_.pop_front()) {
    auto [beat, step] = ahead_.front();
    if (beat.source == Beat::Source::kPredicted) {
      const auto row = std::min(frame, static_cast<int64_t>(beat.time_s * fps_));
      if (step > 0 && EndInPause(OnsetsBefore(*audio_, row + 1), step)) continue;
      if (HasOnset(*audio_, frame)) beat.source = Beat::Source::kHeard;
    }
    beat.frame = std::min<int64_t>(frame, std::llround(beat.time_s * fps_));
    reported_.push_back(beat.time_s);
    last_ = beat.time_s;
    beats.push_back(beat);
  }
  return beats;
}

}  // namespace choreo
