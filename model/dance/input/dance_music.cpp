#include "model/dance/input/dance_music.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "model/audio/beats/beats_ahead.h"
#include "model/core/error.h"
#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

constexpr int kHeard = 12 * static_cast<int>(kModelFps);  // rows
// Beats are tracked once a second, so that many short transitions share the result.
constexpr int kTracked = static_cast<int>(kModelFps);
static_assert(kHeard + kTracked <= kBeatMemory);

// The energy of the music before a frame.
double HearEnergyAt(const AudioFeed& audio, int64_t frame) {
  return HearEnergy(audio.Sounds(frame, kDynamicsMemory));
}

// The energies of a song before and in a transition; none if unknown.
std::optional<EnergyShift> SongEnergy(std::span<const float> energies, const Segment& segment) {
  if (energies.empty()) return std::nullopt;
  return EnergyShift{MeanEnergy(energies, segment.from - kTypicalFrames, segment.from),
                     MeanEnergy(energies, segment.from, segment.to)};
}

}  // namespace

std::vector<double> SecondsOf(std::span<const Beat> beats) {
  std::vector<double> seconds;
  for (const Beat& beat : beats) seconds.push_back(beat.time_s);
  return seconds;
}

std::vector<double> BeatsAround(std::span<const double> seconds, double fps, int64_t first_frame,
                                int frames) {
  const auto first = static_cast<double>(first_frame);
  auto from = std::ranges::upper_bound(seconds, (first - 1) / fps);
  auto to = std::ranges::lower_bound(seconds, (first + frames) / fps);
  if (from != seconds.begin()) --from;
  if (to != seconds.end()) ++to;
  std::vector<double> beats(from, to);
  for (double& beat : beats) beat = beat * fps - first;
  return beats;
}

double BeatStep(std::span<const double> seconds, size_t beat) {
  double step = std::numeric_limits<double>::infinity();
  if (beat > 0) step = seconds[beat] - seconds[beat - 1];
  if (beat + 1 < seconds.size()) step = std::min(step, seconds[beat + 1] - seconds[beat]);
  return step > kPauseSeconds ? 0 : step;
}

std::vector<Onset> OnsetsBefore(const AudioFeed& audio, int64_t row) {
  std::vector<Onset> onsets;
  for (const RowSound& sound : audio.Sounds(row, kHeard))
    onsets.insert(onsets.end(), sound.onsets.begin(), sound.onsets.end());
  return onsets;
}

/// Thread-safe.
class BeatMemory {
 public:
  /// The beats in the rows before `row`, which must be ready. Depends only on their samples.
  HeardBeats Before(const AudioFeed& audio, int64_t row) {
    std::lock_guard lock(mutex_);
    if (row != until_) {
      const std::vector<Onset> onsets = OnsetsBefore(audio, row);
      heard_ = HearBeats(onsets, kRowOnsets * row - std::ssize(onsets));
      until_ = row;
    }
    return heard_;
  }

 private:
  std::mutex mutex_;    // guards the members below
  int64_t until_ = -1;  // end (exclusive) of the rows behind heard_
  HeardBeats heard_;
};

DanceMusic::DanceMusic(const ModelInfo& model, const KnownMusic& known, double dynamics,
                       const AudioFeed* audio, bool detects)
    : has_beats_(!known.music_beats.empty()),
      energies_(known.music_energies),
      count_(known.music_beats.size()) {
  planned_.model_ = &model;
  planned_.audio_ = audio;
  planned_.dynamics_ = dynamics;
  planned_.id_ = known.music_id;
  if (has_beats_) {
    ReplaceBeats(known.music_beats.front(), known.music_beats, known.music_downbeats,
                 {.source = Beat::Source::kGiven});
  } else if (audio != nullptr && detects) {
    planned_.heard_ = std::make_shared<BeatMemory>();
  }
}

void DanceMusic::ReplaceBeats(double begin, std::span<const double> seconds,
                              std::span<const double> downbeats, const Beat& like) {
  std::vector<Beat>& known = planned_.beats_;
  auto& spans = planned_.spans_;
  const auto at = [&](double time) {
    return std::ranges::lower_bound(known, time, {}, &Beat::time_s);
  };
  // A beat given slightly earlier is the same as the first of these.
  double step = BeatStep(seconds, 0);
  if (const auto before = at(begin); step == 0 && before - known.begin() > 1)
    step = (before - 1)->time_s - (before - 2)->time_s;
  known.erase(at(begin - 0.5 * step), known.end());
  const double first = seconds.front();
  while (!spans.empty() && spans.back().begin >= first) spans.pop_back();
  if (!spans.empty()) spans.back().end = std::min(spans.back().end, first);
  for (const double second : seconds) {
    Beat& beat = known.emplace_back(like);
    beat.time_s = second;
    beat.downbeat = std::ranges::binary_search(downbeats, second);
  }
  spans.push_back({first, seconds.back()});
}

void DanceMusic::SetWhole(const MusicAnalysis& music) {
  if (planned_.id_ == 0) planned_.id_ = music.id;
  if (energies_.empty()) energies_ = music.energies;
  if (has_beats_) return;
  planned_.heard_.reset();
  planned_.beats_.clear();
  if (music.beats.empty()) return;
  ReplaceBeats(music.beats.front(), music.beats, music.downbeats, {.source = Beat::Source::kFound});
  for (size_t i = 0; i < music.confidence.size(); ++i)
    planned_.beats_[i].confidence = music.confidence[i];
}

std::vector<double> DanceMusic::GivenAfter(double second) const {
  if (!has_beats_) return {};
  std::vector<double> after = SecondsOf(planned_.beats_);
  std::erase_if(after, [second](double beat) { return beat <= second; });
  return after;
}

int64_t DanceMusic::GiveBeats(std::span<const double> seconds, int64_t from,
                              const std::string& field, std::span<const double> downbeats,
                              std::optional<double> confidence) {
  if (count_ + seconds.size() > kMaxBeats) {
    throw InvalidArgument(field, "bring the dance's beats to " +
                                     std::to_string(count_ + seconds.size()) + ", the limit is " +
                                     std::to_string(kMaxBeats));
  }
  count_ += seconds.size();
  const auto ahead = std::ranges::lower_bound(seconds, planned_.Seconds(from));
  if (ahead != seconds.end()) {
    given_.push_back({.from = from,
                      .begin = seconds.front(),
                      .seconds = {ahead, seconds.end()},
                      .downbeats = {downbeats.begin(), downbeats.end()},
                      .confidence = confidence});
  }
  return ahead - seconds.begin();
}

PlannedMusic DanceMusic::PlanFor(const Segment& segment, int64_t rows_end) {
  for (; !given_.empty() && given_.front().from <= segment.from; given_.pop_front()) {
    const Given& given = given_.front();
    const bool is_predicted = given.confidence && planned_.audio_ != nullptr;
    ReplaceBeats(given.begin, given.seconds, given.downbeats,
                 {.source = is_predicted ? Beat::Source::kPredicted : Beat::Source::kGiven,
                  .confidence = given.confidence.value_or(1)});
  }
  planned_.from_ = segment.from;
  planned_.to_ = segment.to;
  planned_.rows_end_ = rows_end;
  planned_.song_energy_ = SongEnergy(energies_, segment);
  WatchForTurn(segment);
  return planned_;
}

void DanceMusic::WatchForTurn(const Segment& segment) {
  last_ = next_ - 1;
  // A model that hears gets the music of the transition itself.
  const bool listens =
      planned_.audio_ != nullptr && planned_.dynamics_ > 0 && !planned_.model_->music_features;
  if (!listens || segment.from < kLevelRows) return;
  level_ = HearLevel(planned_.audio_->Sounds(segment.from, kLevelRows), turns_);
  next_ = segment.from + turns_.turn_after;
  next_ += (turns_.turn_step - next_ % turns_.turn_step) % turns_.turn_step;
  last_ = segment.key ? segment.to - turns_.turn_before_key : segment.to - 1;
}

std::optional<int64_t> DanceMusic::FindTurn(int64_t ready, int64_t stop) {
  const int64_t last = std::min({last_, ready, stop - 1});
  for (; next_ <= last; next_ += turns_.turn_step) {
    if (Turns(level_, HearLevel(planned_.audio_->Sounds(next_, kLevelRows), turns_), turns_))
      return next_;
  }
  return std::nullopt;
}

double PlannedMusic::Seconds(int64_t frame) const {
  return static_cast<double>(frame) / model_->fps;
}

TransitionMusic PlannedMusic::Hear() const {
  TransitionMusic music{.beats = beats_, .id = id_};
  if (heard_) AddPredicted(&music.beats);
  if (audio_ == nullptr) return music;
  if (model_->music_features) {
    const auto heard = static_cast<int>(rows_end_ - from_);
    music.rows.emplace();
    music.rows->history = audio_->History(from_, model_->history_frames);
    music.rows->rows =
        Eigen::MatrixXf::Zero(model_->music_features.count, static_cast<Eigen::Index>(to_ - from_));
    music.rows->rows.leftCols(heard) = audio_->History(rows_end_, heard);
  }
  const EnergyShift energy = song_energy_
                                 ? *song_energy_
                                 : EnergyShift{HearEnergyAt(*audio_, from_ - kTypicalFrames),
                                               HearEnergyAt(*audio_, from_)};
  music.energy = {dynamics_ * energy.before, dynamics_ * energy.now};
  return music;
}

void PlannedMusic::AddPredicted(std::vector<Beat>* beats) const {
  const int64_t until = from_ - from_ % kTracked;
  const HeardBeats heard = heard_->Before(*audio_, until);
  // The span from the last beat before the transition to the first one after it.
  const double slowest_s = 60 / TempoLimits().slowest_bpm;
  const BeatsAhead ahead = PredictBeats(heard.track, Seconds(until), Seconds(to_) + slowest_s);
  if (!heard.Certain() || ahead.beats.empty()) return;
  std::vector<double> seconds = heard.track.Seconds(), downbeats = heard.track.DownbeatSeconds();
  std::erase_if(seconds, [&](double second) { return second < Seconds(from_) - 2 * slowest_s; });
  seconds.insert(seconds.end(), ahead.beats.begin(), ahead.beats.end());
  downbeats.insert(downbeats.end(), ahead.downbeats.begin(), ahead.downbeats.end());
  for (size_t i = 0; i < seconds.size(); ++i) {
    const double second = seconds[i], slack = 0.5 * BeatStep(seconds, i);
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

}  // namespace choreo
