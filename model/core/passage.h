#pragma once

namespace choreo {

/// Music that comes back: what sounds in [from, to) sounded from `like` on before. Seconds from the
/// music's start.
struct Passage {
  double from = 0, to = 0;
  double like = 0;  ///< before `from`

  friend bool operator==(const Passage&, const Passage&) = default;
};

}  // namespace choreo
