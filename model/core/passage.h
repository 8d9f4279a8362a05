#pragma once

namespace choreo {

/// Music that repeats: [from, to) sounds like the music from `like` on. Seconds from the start.
struct Passage {
  double from = 0, to = 0;
  double like = 0;  ///< before `from`

  friend bool operator==(const Passage&, const Passage&) = default;
};

}  // namespace choreo
