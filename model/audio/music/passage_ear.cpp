#include "model/audio/music/passage_ear.h"

#include <algorithm>
#include <cmath>

namespace choreo {
namespace {

// Moments between reports.
const auto kReportEvery = std::lround(1 / PassageListener::kMomentSeconds);

}  // namespace

std::optional<Passage> PassageEar::Hear(std::span<const float> mono) {
  mono_.insert(mono_.end(), mono.begin(), mono.end());
  lags_.Hear(mono);
  std::optional<Passage> found;
  static_assert(PassageListener::kHop >= PassageListener::kWindow);
  while (mono_.size() >= PassageListener::kHop) {
    listener_.Add(std::span(mono_).first(PassageListener::kWindow));
    mono_.erase(mono_.begin(), mono_.begin() + PassageListener::kHop);
    const std::optional<int64_t> lag = listener_.Lag();
    const int64_t now = listener_.moments();
    if (lag == sent_lag_ && (!lag || now - sent_at_ < kReportEvery)) continue;
    const double from = static_cast<double>(now) * PassageListener::kMomentSeconds;
    if (from >= kMaxAudioSeconds) break;
    // A passage without length ends the repeat: it revokes the announced passage.
    const double behind =
        static_cast<double>(lag ? *lag : *sent_lag_) * PassageListener::kMomentSeconds;
    found = Passage{from, lag ? std::min<double>(from + kAheadSeconds, kMaxAudioSeconds) : from,
                    std::max(0.0, from - lags_.Near(behind, from - kAheadSeconds, from))};
    sent_lag_ = lag;
    sent_at_ = now;
  }
  return found;
}

}  // namespace choreo
