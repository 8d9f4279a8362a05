#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/audio/music/music_analysis.h"
#include "model/dance/controls/control_track.h"
#include "model/dance/input/audio_feed.h"
#include "model/dance/input/dance_music.h"
#include "model/dance/input/recurrence.h"
#include "model/dance/requests/dance_start.h"
#include "model/dance/timeline/timeline.h"
#include "model/dance/timeline/warning.h"
#include "model/messages/dance_event.h"

namespace choreo {

using DanceEvents = std::vector<DanceEvent>;

/// The state requested by a dance's messages so far, and the transitions that follow from it.
/// Depends only on the config, the order of messages, and the music. Not thread-safe.
class DanceScore {
 public:
  /// A transition that may be sampled, and what the messages so far say about it. Its controls are
  /// controls().
  struct Next {
    Segment segment;
    std::vector<int64_t> noise_like;  ///< TransitionSpec::noise_like
    PlannedMusic music;
  };

  /// `audio`: null for a dance without music. Model and audio must outlive this object.
  DanceScore(const ModelInfo& model, const ValidDance& config, const AudioFeed* audio);
  DanceScore(const DanceScore&) = delete;
  DanceScore& operator=(const DanceScore&) = delete;

  // The functions below apply messages, which DanceStream documents. Each returns the events for
  // the sink. A function that throws changes nothing; its error names parameters and their members,
  // such as "key.mask".
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
  /// Sets what is known about the whole music. Values in the config have precedence.
  DanceEvents SetMusic(const MusicAnalysis& music);
  DanceEvents NoteMusicDamaged(const std::vector<std::string>& notes, double seconds) const {
    return {MusicDamaged(notes, seconds, model_.fps)};
  }
  /// Ends the music after the samples so far.
  DanceEvents EndOfAudio();

  const Timeline& timeline() const { return timeline_; }
  const ControlTrack& controls() const { return controls_; }
  /// The first planned transition; null if none.
  const Segment* Current() { return timeline_.Planned(); }
  /// Marks the current transition as danced.
  void Finish() { timeline_.Finish(); }
  /// Whether the dance is known to have no frames from `frame` on.
  bool EndsBy(int64_t frame) const;
  /// Whether the current transition is over once the frames before `frame` are danced.
  bool Overtakes(int64_t frame);

  /// Ends the last of the first `planned` transitions where the music turns. Reads the music's rows
  /// below `ready`. Returns whether later rows can no longer change the result.
  bool TurnWithMusic(size_t planned, int64_t ready);
  /// Returns the transition after the first `planned`; none while it may change or needs rows from
  /// `ready` on. Call once per transition.
  std::optional<Next> TakeNext(size_t planned, int64_t ready);

 private:
  DanceEvent AnswerLate(const KeyRejected& rejection, std::optional<HandPose> hands);
  // `only`: the id of the only key to warn about; null: all keys.
  DanceEvents KeysBehindMusic(const std::string* only = nullptr) const;

  Timeline timeline_;
  ControlTrack controls_;
  DanceMusic music_;
  Recurrence recurrence_;
  const ModelInfo& model_;
  const AudioFeed* audio_;
  const int64_t first_frame_;
  const std::optional<int64_t> end_frame_;
  const bool recurs_;                       // whether repeated passages are danced alike
  std::vector<KeyReached> reached_before_;  // before the dance was resumed; not yet reported again
};

/// Makes the timeline end transitions where controls change, and warns about controls that come too
/// late. `first_frame`: where the dance begins. `from`: the first frame that is not frozen.
DanceEvents NoteChanges(const std::vector<ControlChange>& changes, int64_t first_frame,
                        int64_t from, Timeline* timeline);

}  // namespace choreo
