#include "model/dance/group_request.h"

#include <algorithm>

#include "model/audio/format.h"
#include "model/core/error.h"
#include "model/dance/audio_feed.h"
#include "model/dance/timeline.h"
#include "model/dance/validation.h"

namespace choreo {

void GroupRequest::Validate(const ModelInfo& model) const {
  CheckedIn(candidates, 1, kMaxCandidates, "candidates");
  CheckedIn(frames, 1, std::min(kMaxTransitionFrames, model.max_transition_frames), "frames");
  ValidateStart(model, "");
  CheckedIn(FirstFrame(), 0, kMaxDanceFrames, "first_frame");
  if (target) {
    ValidatePose(model.skeleton, target->pose, "target");
    ValidateMask(model.skeleton, target->mask, "target.mask");
  }
  ValidateKeyId(target_id, "target_id");
  if (after) {
    if (!target) throw InvalidArgument("after", "needs a target");
    ValidatePose(model.skeleton, *after, "after");
  }
  controls.Validate(model, "controls");
  if (!audio) {
    if (!samples.empty()) throw InvalidArgument("audio.sample_rate", "0 with samples");
    return;
  }
  ValidateAudioStart(model, *audio, FirstFrame(), "audio");
  if (samples.empty()) throw InvalidArgument("audio", "has no samples");
  CheckSamples(samples, audio->channels, audio->first_sample);
}

}  // namespace choreo
