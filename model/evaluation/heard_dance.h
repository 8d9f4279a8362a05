#pragma once

#include <span>
#include <vector>

#include "model/dance/dance_config.h"
#include "model/dance/timeline.h"
#include "model/engine/sample_queue.h"

namespace choreo {

/// A dance to mono samples at 22 050 Hz as it is served: a stream that is sent all of them, and
/// ends with them. `config` says neither which music it is nor its format. Throws as DanceStream
/// does, and what it ends in.
std::vector<Pose> DanceTo(SampleQueue& queue, std::span<const float> mono, DanceConfig config,
                          std::span<const Key> keys = {}, const ControlRequest& controls = {});

/// Keys for another dance: the poses of this one each two seconds, wherever she stands then.
std::vector<Key> KeysOf(std::span<const Pose> dance);

/// A path once around each 24 s, a metre and a half wide.
ControlRequest Circle(size_t frames);

}  // namespace choreo
