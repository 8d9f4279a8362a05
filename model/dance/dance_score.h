#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/audio/music_analysis.h"
#include "model/dance/audio_feed.h"
#include "model/dance/control_track.h"
#include "model/dance/dance_start.h"
#include "model/dance/music_beats.h"
#include "model/dance/music_turn.h"
#include "model/dance/recurrence.h"
#include "model/dance/timeline.h"
#include "model/dance/transition.h"
#include "model/dance/warning.h"

namespace choreo {

/// What a transition of a dance depends on. Values, so that later messages change nothing.
struct TransitionInputs {
  DanceManner manner;
  uint64_t seed = 0;  ///< the music's identity included
  ControlTrack controls;
  Segment segment;
  /// The poses danced or given before the transition; without any it starts from
  /// ControlTrack::Stance.
  DancedState before = {};
  std::optional<Pose> after = {};        ///< TransitionSpec::after
  std::vector<double> beats = {};        ///< of the music, seconds, ascending
  std::vector<int64_t> noise_like = {};  ///< TransitionSpec::noise_like
  const AudioFeed* audio = nullptr;      ///< null without music
  /// The energy of the song before the transition and in it; none: heard before it.
  std::optional<EnergyShift> song_energy = {};
  int64_t rows_end = 0;  ///< rows before it must be ready; the model gets no music from later ones
};

struct PreparedTransition {
  TransitionRun run;
  std::vector<Warning> warnings;  ///< about its controls and its key
};

/// The energies of a song (KnownMusic::music_energies) before a transition and in it; none if they
/// are unknown.
std::optional<EnergyShift> SongEnergy(std::span<const float> energies, const Segment& segment);

/// Prepares one transition of a dance. Throws what TransitionRun throws.
PreparedTransition PrepareTransition(const ModelInfo& model, const TransitionInputs& inputs);

using DanceEvents = std::vector<DanceEvent>;

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
  DanceScore(const ModelInfo& model, const ValidDance& config, const AudioFeed* audio);

  // Messages, as DanceStream describes them. Each returns what the sink must know. One that throws
  // changes nothing; its error has the field's path in the message of the API: "keyframe.mask".
  DanceEvents SetKey(const Key& key, const KeyMoment& when);
  DanceEvents RejectKey(const std::string& id, const std::optional<KeyMoment>& when,
                        const std::string& field, const std::string& reason);
  DanceEvents RemoveKey(const std::string& id);
  DanceEvents SetControls(const ControlRequest& request);
  DanceEvents GiveBeats(const std::vector<double>& seconds, const std::vector<double>& downbeats,
                        std::optional<double> confidence);
  DanceEvents GivePassages(const std::vector<Passage>& passages);
  DanceEvents GenerateUntil(int64_t frame);
  DanceEvents KeysComplete();
  /// Sets what is known about the whole music; the config has precedence.
  DanceEvents SetMusic(const MusicAnalysis& music);
  DanceEvents NoteMusicDamaged(const std::vector<std::string>& notes, double seconds) const {
    return {MusicDamaged(notes, seconds, model_.fps)};
  }
  /// The music ends with the samples so far.
  DanceEvents EndOfAudio();

  const Timeline& timeline() const { return timeline_; }
  const ControlTrack& controls() const { return controls_; }
  /// The first planned transition; null without one.
  const Segment* Current() { return timeline_.Planned(); }
  /// Ends it.
  void Finish() { timeline_.Finish(); }
  /// Whether the dance has no frames from `frame` on, as far as is known.
  bool EndsBy(int64_t frame) const;
  /// Whether the first planned transition is over once the frames before `frame` are danced.
  bool Overtakes(int64_t frame);

  /// Ends the last of the first `planned` transitions where the music turns. Reads the rows of
  /// music below `ready`. Returns whether later rows can change nothing.
  bool TurnWithMusic(size_t planned, int64_t ready);
  /// The transition after the first `planned`; none while it may change or needs rows from `ready`
  /// on. The caller sets `before`. Call once per transition.
  std::optional<Next> TakeNext(size_t planned, int64_t ready);

 private:
  DanceEvent AnswerLate(const KeyRejected& rejection, std::optional<HandPose> hands);
  // `only`: the id of the one key to warn of.
  DanceEvents KeysBehindMusic(const std::string* only = nullptr) const;

  Timeline timeline_;
  ControlTrack controls_;
  MusicBeats beats_;
  Recurrence recurrence_;
  const ModelInfo& model_;
  const AudioFeed* audio_;
  const int64_t first_frame_;
  const std::optional<int64_t> end_frame_;
  std::vector<float> energies_;  // KnownMusic::music_energies
  const bool has_beats_;         // the config has
  DanceManner manner_;
  uint64_t seed_, music_id_;
  MusicTurn turn_;                          // watches the transition that was taken last
  std::vector<KeyReached> reached_before_;  // the dance resumed, and not yet reported again
};

/// Has the timeline of a dance from `first_frame` on end transitions where controls change, and
/// warns of controls that come too late. `from`: the first frame that is not frozen.
DanceEvents NoteChanges(const std::vector<ControlChange>& changes, int64_t first_frame,
                        int64_t from, Timeline* timeline);

}  // namespace choreo
