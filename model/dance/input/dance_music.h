#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/audio/music/music_analysis.h"
#include "model/audio/music/music_dynamics.h"
#include "model/audio/signal/format.h"
#include "model/dance/input/audio_feed.h"
#include "model/dance/timeline/timeline.h"
#include "model/messages/dance_event.h"
#include "model/messages/dance_manner.h"
#include "model/plan/model_info.h"
#include "model/plan/transition_spec.h"

namespace choreo {

/// The number of rows before a transition on which its beats can depend.
inline constexpr int kBeatMemory = 13 * static_cast<int>(kModelFps);

/// The music that a transition hears.
struct TransitionMusic {
  std::vector<Beat> beats = {};  ///< ascending; includes the nearest ones outside the transition
  std::optional<MusicRows> rows = {};  ///< for models that hear
  EnergyShift energy = {};             ///< scaled by how much the dance follows it
  uint64_t id = 0;                     ///< KnownMusic::music_id
};

/// Caches the beats heard in a dance's music for transitions that begin in the same second.
class BeatMemory;

/// What is known of the music when a transition is planned. A value: later messages do not change
/// it.
class PlannedMusic {
 public:
  /// Analyses the music before the transition, and the part within it that the model hears. All
  /// these rows must be ready.
  TransitionMusic Hear() const;

 private:
  friend class DanceMusic;

  // An interval, in seconds, in which only given beats count. Spans ascend and do not overlap.
  struct Span {
    double begin, end;
  };

  double Seconds(int64_t frame) const;
  void AddPredicted(std::vector<Beat>* beats) const;

  const ModelInfo* model_ = nullptr;
  const AudioFeed* audio_ = nullptr;  // null without music
  int64_t from_ = 0, to_ = 0;         // the transition's frames
  int64_t rows_end_ = 0;              // the model gets no music from later rows
  double dynamics_ = 0;
  uint64_t id_ = 0;
  std::optional<EnergyShift> song_energy_;  // none: measured from the audio
  std::vector<Beat> beats_;                 // given by the client or found in the whole music
  std::vector<Span> spans_;
  std::shared_ptr<BeatMemory> heard_;  // null: predicts no beats
};

/// The music of a dance as its transitions hear it: beats, energy, turns, and the rows for a model
/// that hears.
///
/// Beats are given by the client or found in the whole music. Without either, each transition's
/// beats are predicted (HearBeats) from 12 s of music that end at the last whole second before it.
/// The energy comes from the whole song around the transition if known, otherwise from the music
/// before the transition. So results depend only on the ordered messages and the samples, not on
/// chunks or timing. Not thread-safe.
class DanceMusic {
 public:
  /// `dynamics`: DanceManner::Dynamics. `audio`: the dance's audio; null without music. `detects`:
  /// whether to detect beats if none are given. Model and audio must outlive this object and its
  /// PlannedMusic.
  DanceMusic(const ModelInfo& model, const KnownMusic& known, double dynamics,
             const AudioFeed* audio, bool detects = true);

  /// Sets what is known about the whole music, which ends the detection of beats. Values in the
  /// config have precedence.
  void SetWhole(const MusicAnalysis& music);

  /// The config's beats that are later than this second.
  std::vector<double> GivenAfter(double second) const;

  /// Sets beats, ascending, for transitions that begin at `from` or later. They replace all given
  /// and detected beats between the first and the last of them. Earlier given beats are dropped if
  /// they are after the last, or less than half a beat before the first. Beats before `from` are
  /// late and are dropped; returns their number. `from` must not decrease between calls.
  /// `downbeats`: the beats that begin a bar. `confidence`: set by a client that predicts beats
  /// from this music; otherwise none. Throws Error(kInvalidArgument) beyond kMaxBeats.
  int64_t GiveBeats(std::span<const double> seconds, int64_t from, const std::string& field,
                    std::span<const double> downbeats = {}, std::optional<double> confidence = {});

  /// Returns what is known for this transition, and starts to watch it for a turn. Call in order of
  /// time. Rows before the transition must be ready. `rows_end`: the first row that the model does
  /// not get.
  PlannedMusic PlanFor(const Segment& segment, int64_t rows_end);

  /// The frame before `stop` at which the music has changed so much that the watched transition
  /// should be planned anew from there. Uses the rows below `ready`. Finds none with less than a
  /// second of music before the transition.
  std::optional<int64_t> FindTurn(int64_t ready, int64_t stop);

 private:
  // The beats of one GiveBeats call.
  struct Given {
    int64_t from;
    double begin;                 // the first beat, even if late
    std::vector<double> seconds;  // beats that were not late
    std::vector<double> downbeats;
    std::optional<double> confidence;  // set for predicted beats
  };

  void ReplaceBeats(double begin, std::span<const double> seconds,
                    std::span<const double> downbeats, const Beat& like);
  void WatchForTurn(const Segment& segment);

  PlannedMusic planned_;         // for the last planned transition; modified for the next
  const bool has_beats_;         // whether the config has beats
  std::vector<float> energies_;  // KnownMusic::music_energies
  std::deque<Given> given_;      // beats not yet in planned_
  size_t count_;                 // total number of given beats

  const MusicDynamicsOptions turns_ = {};
  MusicLevel level_;          // level before the watched transition
  int64_t next_ = 0;          // the next frame to check
  int64_t last_ = next_ - 1;  // the last frame to check
};

/// The times of beats, in seconds.
std::vector<double> SecondsOf(std::span<const Beat> beats);

/// Selects the beats in frames [first_frame, first_frame + frames), one before and one after.
/// `seconds`: the music's beats, ascending. Returns them in frames from the first, as in
/// TransitionSpec::beats.
std::vector<double> BeatsAround(std::span<const double> seconds, double fps, int64_t first_frame,
                                int frames);

/// The distance from a beat to its nearer neighbour, in seconds; 0 without neighbours.
double BeatStep(std::span<const double> seconds, size_t beat);

/// The onsets of the last 12 s before `row`. These rows must be ready.
std::vector<Onset> OnsetsBefore(const AudioFeed& audio, int64_t row);

}  // namespace choreo
