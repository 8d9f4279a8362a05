#include "model/dance/music_beats.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/core/error.h"
#include "model/core/quantile.h"
#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

constexpr double kOnsetOverMedian = 2;  // an onset exceeds the median by this factor

constexpr int kHeard = 12 * static_cast<int>(kModelFps);  // rows
// A crowd of short transitions shares what was heard: it is tracked once a second.
constexpr int kTracked = static_cast<int>(kModelFps);
static_assert(kHeard + kTracked <= kBeatMemory);

// Of the rows before `row`.
std::vector<Onset> OnsetsBefore(const AudioFeed& audio, int64_t row) {
  std::vector<Onset> onsets;
  for (const RowSound& sound : audio.Sounds(row, kHeard))
    onsets.insert(onsets.end(), sound.onsets.begin(), sound.onsets.end());
  return onsets;
}

// The beats heard in the rows before `row`.
HeardBeats HearBefore(const AudioFeed& audio, int64_t row) {
  const std::vector<Onset> onsets = OnsetsBefore(audio, row);
  return HearBeats(onsets, kRowOnsets * row - std::ssize(onsets));
}

// Whether the music rose in the frame of a beat or in the one before.
bool HasOnset(const AudioFeed& audio, int64_t frame) {
  std::vector<float> onsets;
  for (const RowSound& sound : audio.Sounds(frame + 1, kHeard)) onsets.push_back(sound.onset);
  if (onsets.size() < 2) return false;
  const float here = std::max(onsets.back(), onsets[onsets.size() - 2]);
  return here > kOnsetOverMedian * Median(onsets);
}

// The distance from a beat to its nearer neighbour; 0 without neighbours.
double StepAt(std::span<const double> seconds, size_t i) {
  double step = std::numeric_limits<double>::infinity();
  if (i > 0) step = seconds[i] - seconds[i - 1];
  if (i + 1 < seconds.size()) step = std::min(step, seconds[i + 1] - seconds[i]);
  return step > kPauseSeconds ? 0 : step;
}

}  // namespace

std::vector<double> SecondsOf(std::span<const Beat> beats) {
  std::vector<double> seconds;
  for (const Beat& beat : beats) seconds.push_back(beat.time_s);
  return seconds;
}

HeardBeats HeardMusic::Before(int64_t row) {
  std::lock_guard lock(mutex_);
  if (row != until_) {
    heard_ = HearBefore(*audio_, row);
    until_ = row;
  }
  return heard_;
}

MusicBeats::MusicBeats(double fps, const std::vector<double>& given, const AudioFeed* audio,
                       std::span<const double> downbeats)
    : fps_(fps),
      audio_(audio),
      heard_(audio != nullptr && given.empty() ? std::make_shared<HeardMusic>(*audio) : nullptr),
      count_(given.size()) {
  if (!given.empty()) Replace(given.front(), given, downbeats, {.source = Beat::Source::kGiven});
}

void MusicBeats::Replace(double begin, std::span<const double> seconds,
                         std::span<const double> downbeats, const Beat& like) {
  const auto at = [&](double time) {
    return std::ranges::lower_bound(known_, time, {}, &Beat::time_s);
  };
  // A beat given a little earlier is the same as the first of these.
  double step = StepAt(seconds, 0);
  if (const auto before = at(begin); step == 0 && before - known_.begin() > 1)
    step = (before - 1)->time_s - (before - 2)->time_s;
  known_.erase(at(begin - 0.5 * step), known_.end());
  const double first = seconds.front();
  while (!spans_.empty() && spans_.back().begin >= first) spans_.pop_back();
  if (!spans_.empty()) spans_.back().end = std::min(spans_.back().end, first);
  for (const double second : seconds) {
    Beat& beat = known_.emplace_back(like);
    beat.time_s = second;
    beat.downbeat = std::ranges::binary_search(downbeats, second);
  }
  spans_.push_back({first, seconds.back()});
}

void MusicBeats::ReplaceAll(const MusicAnalysis& music) {
  heard_.reset();
  known_.clear();
  if (music.beats.empty()) return;
  Replace(music.beats.front(), music.beats, music.downbeats, {.source = Beat::Source::kFound});
  for (size_t i = 0; i < music.confidence.size(); ++i) known_[i].confidence = music.confidence[i];
}

int64_t MusicBeats::AddGiven(std::span<const double> seconds, int64_t from,
                             const std::string& field, std::span<const double> downbeats,
                             std::optional<double> confidence) {
  if (count_ + seconds.size() > kMaxBeats) {
    throw InvalidArgument(field, "bring the dance's beats to " +
                                     std::to_string(count_ + seconds.size()) + ", the limit is " +
                                     std::to_string(kMaxBeats));
  }
  count_ += seconds.size();
  const auto ahead = std::ranges::lower_bound(seconds, Seconds(from));
  if (ahead != seconds.end()) {
    given_.push_back({from,
                      seconds.front(),
                      {ahead, seconds.end()},
                      {downbeats.begin(), downbeats.end()},
                      confidence});
  }
  return ahead - seconds.begin();
}

PlannedBeats MusicBeats::PlanFrom(int64_t from) {
  for (; !given_.empty() && given_.front().from <= from; given_.pop_front()) {
    const Given& given = given_.front();
    const bool is_predicted = given.confidence && audio_ != nullptr;
    Replace(given.begin, given.seconds, given.downbeats,
            {.source = is_predicted ? Beat::Source::kPredicted : Beat::Source::kGiven,
             .confidence = given.confidence.value_or(1)});
  }
  return {fps_, known_, spans_, heard_};
}

PlannedBeats::PlannedBeats(double fps, std::vector<Beat> known, std::vector<Span> spans,
                           std::shared_ptr<HeardMusic> heard)
    : fps_(fps), known_(std::move(known)), spans_(std::move(spans)), heard_(std::move(heard)) {}

std::vector<Beat> PlannedBeats::For(int64_t from, int64_t to) const {
  std::vector<Beat> beats = known_;
  if (heard_) Predict(from, to, &beats);
  return beats;
}

void BeatReport::Start(std::span<const Beat> beats, int64_t from) {
  const std::vector<double> seconds = SecondsOf(beats);
  ahead_.clear();
  std::optional<double> last = last_;
  const auto first =
      static_cast<size_t>(std::ranges::lower_bound(seconds, Seconds(from)) - seconds.begin());
  // Includes the last beat before this transition: the previous one may have left it out.
  for (size_t i = last && first > 0 ? first - 1 : first; i < beats.size(); ++i) {
    if (last && seconds[i] - *last <= 0.5 * StepAt(seconds, i))
      continue;  // reported a little earlier
    ahead_.push_back({beats[i], StepAt(seconds, i)});
    last = seconds[i];
  }
}

void PlannedBeats::Predict(int64_t from, int64_t to, std::vector<Beat>* beats) const {
  const int64_t until = from - from % kTracked;
  const HeardBeats heard = heard_->Before(until);
  // The span from a beat before the transition to one after it.
  const double slowest_s = 60 / TempoLimits().slowest_bpm;
  const BeatsAhead ahead = PredictBeats(heard.track, Seconds(until), Seconds(to) + slowest_s);
  if (!heard.Certain() || ahead.beats.empty()) return;
  std::vector<double> seconds = heard.track.Seconds(), downbeats = heard.track.DownbeatSeconds();
  std::erase_if(seconds, [&](double second) { return second < Seconds(from) - 2 * slowest_s; });
  seconds.insert(seconds.end(), ahead.beats.begin(), ahead.beats.end());
  downbeats.insert(downbeats.end(), ahead.downbeats.begin(), ahead.downbeats.end());
  for (size_t i = 0; i < seconds.size(); ++i) {
    const double second = seconds[i], slack = 0.5 * StepAt(seconds, i);
    const bool is_given = std::ranges::any_of(spans_, [=](const Span& span) {
      return second > span.begin - slack && second < span.end + slack;
    });
    if (is_given) continue;
    Beat& beat = beats->emplace_back(Beat{.time_s = second,
                                          .source = Beat::Source::kPredicted,
                                          .confidence = heard.track.confidence.back()});
    beat.downbeat = std::ranges::binary_search(downbeats, second);
  }
  std::ranges::stable_sort(*beats, {}, &Beat::time_s);
}

std::vector<Beat> BeatReport::TakeAt(int64_t frame) {
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
