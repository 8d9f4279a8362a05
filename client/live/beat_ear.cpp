#include "client/live/beat_ear.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace choreo::live {
namespace {

constexpr double kMemorySeconds = 120;  // an intro's half beats sound like beats within one window
constexpr double kFirstSeconds = 4, kEverySeconds = 1.5;

int64_t Onsets(double seconds) { return std::llround(seconds * kOnsetRate); }

}  // namespace

// Silence precedes the music.
BeatEar::BeatEar(const BeatHint& hint) : mono_(kOnsetWindow / 2), hint_(hint) {}

BeatsAhead BeatEar::Hear(std::span<const float> mono) {
  mono_.insert(mono_.end(), mono.begin(), mono.end());
  size_t from = 0;
  for (; mono_.size() - from >= kOnsetWindow; from += kOnsetHop)
    onsets_.push_back(meter_.Add(std::span(mono_).subspan(from, kOnsetWindow)));
  mono_.erase(mono_.begin(), mono_.begin() + static_cast<std::ptrdiff_t>(from));
  const int64_t heard = first_ + std::ssize(onsets_);
  const double now = static_cast<double>(heard) / kOnsetRate;

  if (found_.valid()) {
    if (found_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
    BeatTrack track = found_.get();
    Follow(hint_, &track, kept_);
    if (!track.frames.empty()) kept_ = track.frames.back();
    return PredictBeats(track, now, now + kAheadSeconds);
  }
  if (heard - asked_ < Onsets(asked_ == 0 ? kFirstSeconds : kEverySeconds)) return {};
  asked_ = heard;
  const int64_t old = std::ssize(onsets_) - Onsets(kMemorySeconds);
  if (old > 0) {
    onsets_.erase(onsets_.begin(), onsets_.begin() + old);
    first_ += old;
  }
  found_ =
      std::async(std::launch::async, [onsets = onsets_, first = first_, limits = LimitsOf(hint_)] {
        BeatTrack track = TrackBeats(onsets, limits);
        for (int64_t& frame : track.frames) frame += first;
        return track;
      });
  return {};
}

}  // namespace choreo::live
