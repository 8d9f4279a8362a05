#pragma once

#include <span>
#include <vector>

#include "model/dance/dance_config.h"
#include "model/dance/timeline.h"
#include "model/engine/sample_queue.h"

namespace choreo {

/// Dances to mono samples at 22 050 Hz as served: streams all of them and ends with them. `config`
/// must not describe the music or its format. Throws what DanceStream throws, and the error that
/// ends it.
std::vector<Pose> DanceTo(SampleQueue& queue, std::span<const float> mono, DanceConfig config,
                          std::span<const Key> keys = {}, const ControlRequest& controls = {});

/// Makes keys for another dance: this one's poses every two seconds, in place.
std::vector<Key> KeysOf(std::span<const Pose> dance);

/// A path once around every 24 s, a metre and a half wide.
ControlRequest Circle(size_t frames);

}  // namespace choreo
