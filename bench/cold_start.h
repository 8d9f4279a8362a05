#pragma once

#include "client/choreo_client.h"

namespace choreo::bench {

/// A dance for which a choreod is started, as `choreo dance` does without a server.
struct ColdStart {
  double listens_ms = 0;      ///< from the start until the server listens
  double first_frame_ms = 0;  ///< from the start until the first frame arrives; 0: none came
};

/// Starts a choreod that serves `default`, and dances to all of `song`, whose samples are sent at
/// once.
ColdStart DanceFromStart(const client::Audio& song);

}  // namespace choreo::bench
