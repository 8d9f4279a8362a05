#include "model/dance/group_request.h"

#include <algorithm>

#include "model/audio/format.h"
#include "model/core/error.h"
#include "model/dance/audio_feed.h"
#include "model/dance/timeline.h"
#include "model/dance/validation.h"

namespace choreo {

void GroupRequest::Validate(const ModelInfo& model) const {
  if (candidates < 1 || candidates > kMaxCandidates) {
    throw InvalidArgument("candidates", std::to_string(candidates) + " is not in [1, " +
                                            std::to_string(kMaxCandidates) + "]");
  }
  const int longest = std::min(kMaxTransitionFrames, model.max_transition_frames);
  if (frames < 1 || frames > longest) {
    throw InvalidArgument(
        "frames", std::to_string(frames) + " is not in [1, " + std::to_string(longest) + "]");
  }
  ValidateStart(model, "");
  const int64_t first = FirstFrame();
  if (first < 0 || first > kMaxDanceFrames) {
    throw InvalidArgument("first_frame", std::to_string(first) + " is not in [0, " +
                                             std::to_string(kMaxDanceFrames) + "]");
  }
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
  if (!has_audio()) {
    if (!samples.empty()) throw InvalidArgument("audio.sample_rate", "0 with samples");
    return;
  }
  ValidateAudioStart(model, sample_rate, channels, first_sample, first, "audio");
  if (samples.empty()) throw InvalidArgument("audio", "has no samples");
  if (samples.size() % static_cast<size_t>(channels) != 0) {
    throw InvalidArgument("audio.data", std::to_string(samples.size()) +
                                            " values are no multiple of the " +
                                            std::to_string(channels) + " channels");
  }
  CheckFinite(samples, channels, first_sample);
}

}  // namespace choreo
