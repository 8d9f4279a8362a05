#pragma once

#include <span>
#include <vector>

#include "model/dance/requests/dance_start.h"
#include "model/dance/timeline/timeline.h"
#include "model/engine/sample_queue.h"

namespace choreo {

/// Makes the dance that the server would make to mono samples at 22,050 Hz: streams all of them,
/// and ends with them. `config` must not describe the music or its format. Throws what DanceStream
/// throws, and the error with which the stream ends.
std::vector<Pose> DanceTo(SampleQueue& queue, std::span<const float> mono, DanceConfig config,
                          std::span<const Key> keys = {}, const ControlRequest& controls = {});

/// Makes the dance that `choreo live` would get for the same music, whose beats the server
/// predicts: pushes a tenth of a second at a time, and announces repeats (PassageEar) as they are
/// heard.
std::vector<Pose> DanceLiveTo(SampleQueue& queue, std::span<const float> mono, DanceConfig config);

/// Makes keys for another dance from this one's poses every two seconds, in place.
std::vector<Key> KeysOf(std::span<const Pose> dance);

/// A circular path, once around every 24 s, 1.5 m wide.
ControlRequest Circle(size_t frames);

}  // namespace choreo
