#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/dance/controls/control_track.h"
#include "model/dance/delivery/beat_schedule.h"
#include "model/dance/delivery/dance_meter.h"
#include "model/dance/delivery/dance_sink.h"
#include "model/dance/delivery/mailbox.h"
#include "model/dance/input/audio_feed.h"
#include "model/dance/requests/dance_start.h"
#include "model/dance/timeline/timeline.h"

namespace choreo {

/// Posts an event to a dance's sink.
inline void PostEvent(Mailbox<DanceSink>& mailbox, const DanceEvent& event) {
  mailbox.Post([event](DanceSink& sink) { sink.OnEvent(event); });
}

/// Reports a dance's frames, beats, keys, continuations and summary to its sink. Not thread-safe.
class DanceReporter {
 public:
  /// `audio`: null without music. Model, audio and mailbox must outlive this object.
  DanceReporter(const ModelInfo& model, const ValidDance& config, const AudioFeed* audio,
                Mailbox<DanceSink>& mailbox);

  /// Starts a transition.
  void StartTransition(const Segment& segment, const std::vector<Warning>& warnings,
                       const std::vector<Beat>& beats);
  /// Adds the next frame, with number `number`.
  void Add(int64_t number, const DanceFrame& frame);
  /// Adds the key reached at the last added frame.
  void AddKey(const Key& key, KeyReached reached);
  /// Ends a transition. The dance continues with `frame`.
  void End(int64_t frame, const DancedState& danced);
  /// Reports the summary of a dance that ended before `frame` and had these controls.
  void Summarise(int64_t frame, const ControlTrack& controls);

 private:
  void Post(const DanceEvent& event) { PostEvent(mailbox_, event); }

  const bool hears_beats_;  // whether the dance detects beats in the music
  Mailbox<DanceSink>& mailbox_;
  BeatSchedule beats_;
  DanceMeter meter_;
};

}  // namespace choreo
