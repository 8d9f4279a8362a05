#pragma once

namespace choreo {

/// How fast a server answered a call.
struct CallTiming {
  double first_frame_latency_s = 0;
  double elapsed_s = 0;
  double real_time_factor = 0;  ///< seconds of dance a second
};

}  // namespace choreo
