#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/dance/delivery/body_watch.h"
#include "model/dance/delivery/output_rate.h"
#include "model/dance/delivery/quality_meter.h"
#include "model/dance/requests/dance_start.h"
#include "model/dance/timeline/timeline.h"

namespace choreo {

/// Resamples the frames of a dance, or of one candidate, for output, and measures them. Not
/// thread-safe.
class DanceMeter {
 public:
  /// `before`: the pose before the first frame, if any. `reached`: keys reached before it. The
  /// model must outlive this object.
  DanceMeter(const ModelInfo& model, const DanceStart& start, const std::optional<Pose>& before,
             std::vector<KeyReached> reached = {});

  void StartTransition(const Segment& segment);
  /// Adds the dance's next frame, with number `number`. Returns the output frames that it
  /// completes.
  OutputFrames Add(int64_t number, const DanceFrame& frame);
  /// Adds the key reached at the last added frame.
  void AddKey(const KeyReached& key) { quality_.AddKey(key); }

  /// Returns warnings about motion beyond the limits of human bodies since StartTransition.
  std::vector<Warning> TakeWarnings() { return watch_.TakeWarnings(); }
  /// The report on all frames added so far. `music_beats`: seconds, ascending.
  QualityReport Report(std::span<const double> music_beats) const {
    return quality_.Report(music_beats);
  }
  /// All keys so far, without the accelerations around each.
  const std::vector<KeyReached>& keys() const { return quality_.keys(); }
  /// The continuation at `frame`, without the fields that only streams know: the last beat and the
  /// reached keys. `hears_beats`: whether the dance detects beats in the music.
  Continuation ContinuationAt(int64_t frame, const DancedState& danced, bool hears_beats) const;

 private:
  const ModelInfo& model_;
  const std::optional<DanceStart::Audio> audio_;
  const double dynamics_;
  OutputRate output_;
  QualityMeter quality_;
  BodyWatch watch_;
};

}  // namespace choreo
