#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/dance/audio_feed.h"
#include "model/dance/beat_report.h"
#include "model/dance/body_watch.h"
#include "model/dance/control_track.h"
#include "model/dance/dance_sink.h"
#include "model/dance/dance_start.h"
#include "model/dance/mailbox.h"
#include "model/dance/quality_meter.h"
#include "model/dance/timeline.h"

namespace choreo {

/// Tells a dance's sink of an event.
inline void PostEvent(Mailbox<DanceSink>& mailbox, const DanceEvent& event) {
  mailbox.Post([event](DanceSink& sink) { sink.OnEvent(event); });
}

/// Where a dance continues with `frame`, but for what only streams know: its last beat and the keys
/// that it has reached. `hears_beats`: whether it detects beats in the music.
Continuation ContinuationAt(int64_t frame, const DancedState& danced, const ModelInfo& model,
                            const DanceStart& config, bool hears_beats);

/// Tells the sink of a dance about its frames: their beats and keys, the continuations between
/// them, the summary. Not thread-safe.
class DanceReport {
 public:
  /// The mailbox must outlive it, as must model and music. `audio`: null without music.
  DanceReport(const ModelInfo& model, const ValidDance& config, const AudioFeed* audio,
              Mailbox<DanceSink>& mailbox);

  /// Starts a transition.
  void Begin(const Segment& segment, const std::vector<Warning>& warnings,
             const std::vector<Beat>& beats);
  /// The next frame, whose number is `number`; the sink has it.
  void Add(int64_t number, const DanceFrame& frame);
  /// That frame reaches this key.
  void Reach(const Key& key, KeyReached reached);
  /// A transition is over, and the dance continues with `frame`.
  void End(int64_t frame, const DancedState& danced);
  /// The dance ended before `frame`; these were its controls.
  void Summarise(int64_t frame, const ControlTrack& controls);

 private:
  void Post(const DanceEvent& event) { PostEvent(mailbox_, event); }

  const ModelInfo& model_;
  const DanceConfig config_;
  Mailbox<DanceSink>& mailbox_;
  BeatReport beats_;
  QualityMeter meter_;
  BodyWatch watch_;
};

}  // namespace choreo
