#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/dance/audio_feed.h"
#include "model/dance/beat_report.h"
#include "model/dance/body_watch.h"
#include "model/dance/controls/control_track.h"
#include "model/dance/dance_sink.h"
#include "model/dance/dance_start.h"
#include "model/dance/mailbox.h"
#include "model/dance/quality_meter.h"
#include "model/dance/timeline.h"

namespace choreo {

/// Posts an event to a dance's sink.
inline void PostEvent(Mailbox<DanceSink>& mailbox, const DanceEvent& event) {
  mailbox.Post([event](DanceSink& sink) { sink.OnEvent(event); });
}

/// The continuation of a dance at `frame`, without the fields that only streams know: the last beat
/// and the reached keys. `hears_beats`: whether the dance detects beats in the music.
Continuation ContinuationAt(int64_t frame, const DancedState& danced, const ModelInfo& model,
                            const DanceStart& config, bool hears_beats);

/// Reports to a dance's sink what goes with its frames: beats, keys, continuations and the summary.
/// Not thread-safe.
class DanceReport {
 public:
  /// `audio`: null without music. Model, audio and mailbox must outlive this object.
  DanceReport(const ModelInfo& model, const ValidDance& config, const AudioFeed* audio,
              Mailbox<DanceSink>& mailbox);

  /// Starts a transition.
  void Begin(const Segment& segment, const std::vector<Warning>& warnings,
             const std::vector<Beat>& beats);
  /// Adds the next frame, with number `number`. The sink has already received it.
  void Add(int64_t number, const DanceFrame& frame);
  /// Records that the last added frame reaches this key.
  void Reach(const Key& key, KeyReached reached);
  /// Ends a transition. The dance continues with `frame`.
  void End(int64_t frame, const DancedState& danced);
  /// Reports the summary of a dance that ended before `frame` and had these controls.
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
