#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/audio/music_analysis.h"
#include "model/dance/audio_feed.h"
#include "model/dance/control_track.h"
#include "model/dance/dance_config.h"
#include "model/dance/music_beats.h"
#include "model/dance/music_turn.h"
#include "model/dance/recurrence.h"
#include "model/dance/timeline.h"
#include "model/dance/transition.h"

namespace choreo {

/// The state from which a transition continues.
struct DancedState {
  std::vector<Pose> history = {};  ///< the last tau poses; empty: the dance begins without any
  std::optional<GroundFrame> stage = {};  ///< TransitionSpec::stage
};

/// What a transition of a dance depends on. Values, so that later messages change nothing.
struct TransitionInputs {
  DanceManner manner;
  ControlTrack controls;
  Segment segment;
  /// The poses danced or given before the transition; without any it starts from
  /// ControlTrack::Stance.
  DancedState before = {};
  std::vector<int64_t> noise_like = {};  ///< TransitionSpec::noise_like
  const AudioFeed* audio = nullptr;      ///< null without music
  int64_t rows_end = 0;  ///< rows before it must be ready; the model gets no music from later ones
};

struct PreparedTransition {
  TransitionRequest request;
  std::string key_id;             ///< names its target in warnings
  std::vector<Warning> warnings;  ///< about its controls and its key
};

/// Builds the request for one transition of a dance that is timed to these beats
/// (TransitionSpec::beats).
PreparedTransition PrepareTransition(const ModelInfo& model, const TransitionInputs& inputs,
                                     std::vector<double> beats);

/// Adds a warning if the key is too far away for the time left.
void WarnOfSpeed(const ModelInfo& model, const TransitionRun& run, PreparedTransition* prepared);

/// What a dance's messages ask for so far, and which transition follows from it. It depends only on
/// the config, the order of its changes, and the music. Not thread-safe.
class DanceScore {
 public:
  /// A transition that may be sampled.
  struct Next {
    TransitionInputs inputs;
    PlannedBeats beats;
  };

  /// Model and music must outlive it. `audio`: null for a dance without music.
  DanceScore(const ModelInfo& model, const ValidDance& asked, const AudioFeed* audio);

  // What messages change:
  Timeline timeline;
  ControlTrack controls;
  MusicBeats beats;
  Recurrence recurrence;

  /// Sets what is known about the whole music; the config has precedence.
  void SetMusic(const MusicAnalysis& music);

  /// The answer to a key with these hands that came too late: it is rejected, or was reached before
  /// the dance was resumed.
  DanceEvent AnswerLate(const KeyRejected& rejection, std::optional<HandPose> hands);

  /// Whether no frame from `frame` on is danced, as far as is known.
  bool EndsBy(int64_t frame) const;
  /// Whether the first planned transition is over once the frames before `frame` are danced.
  bool Overtakes(int64_t frame);

  /// Ends the last of the first `planned` transitions where the music turns, as far as rows below
  /// `ready` tell. Returns whether they tell all.
  bool TurnWithMusic(size_t planned, int64_t ready);
  /// The transition after the first `planned`, if it is certain and rows below `ready` suffice for
  /// it. `before` is left to the caller. Call once per transition.
  std::optional<Next> TakeNext(size_t planned, int64_t ready);

 private:
  const ModelInfo& model_;
  const AudioFeed* audio_;
  const int64_t first_frame_;
  const std::optional<int64_t> end_frame_;
  const bool has_beats_;  // the config has
  DanceManner manner_;
  MusicTurn turn_;                          // watches the transition that was taken last
  std::vector<KeyReached> reached_before_;  // the dance resumed, and not yet reported again
};

}  // namespace choreo
