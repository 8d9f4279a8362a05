#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/audio/format.h"
#include "model/audio/music_analysis.h"
#include "model/audio/music_dynamics.h"
#include "model/dance/audio_feed.h"
#include "model/dance/dance_start.h"
#include "model/dance/timeline.h"
#include "model/messages/dance_event.h"

namespace choreo {

/// Rows of music, before a transition, that its beats can depend on.
inline constexpr int kBeatMemory = 13 * static_cast<int>(kModelFps);

/// What a transition hears of its dance's music.
struct TransitionMusic {
  std::vector<Beat> beats = {};        ///< ascending; those around the transition included
  std::optional<MusicRows> rows = {};  ///< for models that hear
  EnergyShift energy = {};             ///< as much of it as the dance follows
  uint64_t id = 0;                     ///< KnownMusic::music_id
};

/// The beats heard in a dance's music, remembered for transitions that begin in the same second.
class BeatMemory;

/// What is known of the music when a transition is planned. A value: later messages change nothing.
class PlannedMusic {
 public:
  /// Listens to the music before the transition, and to that of its own that the model hears. All
  /// of these rows must be ready.
  TransitionMusic Hear() const;

 private:
  friend class DanceMusic;

  // Seconds in which only given beats count. Spans ascend and do not overlap.
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
  std::optional<EnergyShift> song_energy_;  // none: it is heard
  std::vector<Beat> beats_;                 // given or found
  std::vector<Span> spans_;
  std::shared_ptr<BeatMemory> heard_;  // null: predicts none
};

/// The music of a dance, as its transitions hear it: its beats, its energy, where it turns, and the
/// rows of a model that hears.
///
/// Beats are given by the client or found in the whole music. A dance that starts without any
/// detects them: when a transition begins, the beats of the 12 s before the last whole second
/// (HearBeats) predict its own. The energy is that of the whole song around the transition, where
/// it is known, else that of the music before it. So all is a function of the ordered messages and
/// of samples, whatever their chunks and timing. Not thread-safe.
class DanceMusic {
 public:
  /// `audio`: the dance's; null without music. `detects`: whether to detect beats if none are
  /// given. Model and audio must outlive this and what it plans.
  DanceMusic(const ModelInfo& model, const DanceStart& start, const AudioFeed* audio,
             bool detects = true);

  /// Sets what is known about the whole music, which ends the detection of beats. What the config
  /// gives has precedence.
  void SetWhole(const MusicAnalysis& music);

  /// Gives beats, ascending, for transitions that begin at `from` or later. From the first to the
  /// last they replace beats given or detected. Beats given earlier are dropped if they are after
  /// the last, or less than half a beat before the first. Beats before `from` are late and are
  /// dropped; returns how many. `from` never decreases between calls. `downbeats`: those of the
  /// beats that begin a bar. `confidence`: of a client that predicts them from this music, else
  /// none. Throws Error(kInvalidArgument) beyond kMaxBeats.
  int64_t GiveBeats(std::span<const double> seconds, int64_t from, const std::string& field,
                    std::span<const double> downbeats = {}, std::optional<double> confidence = {});

  /// What is known for this transition; call in order of time. Watches it for a turn from now on.
  /// Rows before it must be ready. `rows_end`: the first row whose music the model does not get.
  PlannedMusic PlanFor(const Segment& segment, int64_t rows_end);

  /// The frame before `stop` where the music has changed so much that the transition watched should
  /// be danced anew from there, as far as rows below `ready` tell. Less than a second of music
  /// before the transition tells nothing.
  std::optional<int64_t> FindTurn(int64_t ready, int64_t stop);

 private:
  // The beats of one GiveBeats.
  struct Given {
    int64_t from;
    double begin;                 // its first beat, late or not
    std::vector<double> seconds;  // without late ones
    std::vector<double> downbeats;
    std::optional<double> confidence;  // of predicted ones
  };

  void ReplaceBeats(double begin, std::span<const double> seconds,
                    std::span<const double> downbeats, const Beat& like);
  void WatchForTurn(const Segment& segment);

  PlannedMusic plan_;            // of the transition planned last, and then of the next
  const bool has_beats_;         // the config has
  std::vector<float> energies_;  // KnownMusic::music_energies
  std::deque<Given> given_;      // not yet in plan_
  size_t count_;                 // of beats given in all

  const MusicDynamicsOptions turns_ = {};
  MusicLevel level_;          // before the transition watched
  int64_t next_ = 0;          // the next frame to look at
  int64_t last_ = next_ - 1;  // the last one
};

/// Beats -> their seconds.
std::vector<double> SecondsOf(std::span<const Beat> beats);

/// Picks from the music's beats (seconds, ascending) those of frames [first_frame, first_frame +
/// frames), one before and one after, as TransitionSpec::beats: in frames from the first.
std::vector<double> BeatsAround(std::span<const double> seconds, double fps, int64_t first_frame,
                                int frames);

/// The distance from a beat to its nearer neighbour; 0 without neighbours.
double BeatStep(std::span<const double> seconds, size_t beat);

/// The onsets of the last 12 s before a row, which must be ready.
std::vector<Onset> OnsetsBefore(const AudioFeed& audio, int64_t row);

}  // namespace choreo
