#pragma once

namespace choreo {

/// A repeated passage of music: [from, to) sounds like the music that starts at `like`. Seconds
/// from the start.
struct Passage {
  double from = 0, to = 0;
  double like = 0;  ///< before `from`

  friend bool operator==(const Passage&, const Passage&) = default;
};

}  // namespace choreo
