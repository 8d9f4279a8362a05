#include "model/dance/music_turn.h"

#include <algorithm>

namespace choreo {

void MusicTurn::Watch(const AudioFeed& audio, const Segment& segment) {
  level_ = HearLevel(audio.Sounds(segment.from, kLevelRows), options_);
  next_ = segment.from + options_.turn_after;
  next_ += (options_.turn_step - next_ % options_.turn_step) % options_.turn_step;
  last_ = segment.key ? segment.to - options_.turn_before_key : segment.to - 1;
  if (!listens_ || segment.from < kLevelRows) last_ = next_ - 1;
}

std::optional<int64_t> MusicTurn::Find(const AudioFeed& audio, int64_t ready, int64_t stop) {
  const int64_t last = std::min({last_, ready, stop - 1});
  for (; next_ <= last; next_ += options_.turn_step) {
    if (Turns(level_, HearLevel(audio.Sounds(next_, kLevelRows), options_), options_)) return next_;
  }
  return std::nullopt;
}

}  // namespace choreo
