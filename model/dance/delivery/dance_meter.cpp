#include "model/dance/delivery/dance_meter.h"

#include <utility>

namespace choreo {

DanceMeter::DanceMeter(const ModelInfo& model, const DanceStart& start,
                       const std::optional<Pose>& before, std::vector<KeyReached> reached)
    : model_(model),
      audio_(start.audio),
      dynamics_(start.Dynamics()),
      output_(model.fps, start.output_fps, start.FirstFrame(), before),
      quality_(model.skeleton, model.fps, start.FirstFrame(), std::move(reached)),
      watch_(model.skeleton, model.fps, before) {}

void DanceMeter::StartTransition(const Segment& segment) {
  watch_.StartTransition(segment.key ? segment.key->id : "", segment.to - segment.from);
}

OutputFrames DanceMeter::Add(int64_t number, const DanceFrame& frame) {
  quality_.Add(frame);
  watch_.Add(number, frame.pose);
  return output_.Push(frame);
}

Continuation DanceMeter::ContinuationAt(int64_t frame, const DancedState& danced,
                                        bool hears_beats) const {
  Continuation continuation{frame, danced.history, model_.fingerprint};
  if (audio_) {
    continuation.audio_from_sample = ResumeSample(*audio_, dynamics_, frame, model_, hears_beats);
  }
  continuation.stage = danced.stage;
  return continuation;
}

}  // namespace choreo
