#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/audio/music_analysis.h"
#include "model/dance/audio_feed.h"
#include "model/dance/control_track.h"
#include "model/dance/dance_music.h"
#include "model/dance/dance_start.h"
#include "model/dance/recurrence.h"
#include "model/dance/timeline.h"
#include "model/dance/transition.h"
#include "model/dance/warning.h"

namespace choreo {

using DanceEvents = std::vector<DanceEvent>;

/// What a dance's messages ask for so far, and which transition follows from it. It depends only on
/// the config, the order of its changes, and the music. Not thread-safe.
class DanceScore {
 public:
  /// A transition that may be sampled.
  struct Next {
    TransitionInputs inputs;  ///< those that the config alone states are still missing
    PlannedMusic music;
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
  /// on. The caller adds manner, seed, `before` and what
  /// it hears of the music. Call once per transition.
  std::optional<Next> TakeNext(size_t planned, int64_t ready);

 private:
  DanceEvent AnswerLate(const KeyRejected& rejection, std::optional<HandPose> hands);
  // `only`: the id of the one key to warn of.
  DanceEvents KeysBehindMusic(const std::string* only = nullptr) const;

  Timeline timeline_;
  ControlTrack controls_;
  DanceMusic music_;
  Recurrence recurrence_;
  const ModelInfo& model_;
  const AudioFeed* audio_;
  const int64_t first_frame_;
  const std::optional<int64_t> end_frame_;
  const bool recurs_;                       // dances repeated passages alike
  std::vector<KeyReached> reached_before_;  // the dance resumed, and not yet reported again
};

/// Has the timeline of a dance from `first_frame` on end transitions where controls change, and
/// warns of controls that come too late. `from`: the first frame that is not frozen.
DanceEvents NoteChanges(const std::vector<ControlChange>& changes, int64_t first_frame,
                        int64_t from, Timeline* timeline);

}  // namespace choreo
