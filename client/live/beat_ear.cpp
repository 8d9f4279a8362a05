#include "client/live/beat_ear.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace choreo::live {
namespace {

constexpr double kMemorySeconds = 120;  // less would mistake an intro's half beats for beats
constexpr double kEverySeconds = 1.5;

int64_t Onsets(double seconds) { return std::llround(seconds * kOnsetRate); }

/// Counts from the beat nearest to frame `one`, and returns the last downbeat.
int64_t CountAround(int64_t one, BeatTrack* track) {
  const int64_t first = NearestBeat(*track, one);
  CountFrom(first, 0, track);
  const auto last = std::find(track->in_bar.rbegin(), track->in_bar.rend(), 0).base() - 1;
  return track->frames[static_cast<size_t>(last - track->in_bar.begin())];
}

}  // namespace

// Silence precedes the music.
BeatEar::BeatEar(const LiveBeatHint& hint) : mono_(kOnsetWindow / 2) { SetHint(hint); }

void BeatEar::SetHint(const LiveBeatHint& hint) {
  hint_ = hint;
  kept_.reset();
  one_.reset();
  if (hint.downbeat_s) kept_ = one_ = Onsets(*hint.downbeat_s - hint.later_s);
  if (searched_ > 0) searched_ -= std::min(searched_ - 1, Onsets(kEverySeconds));
}

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
    Follow(hint_.beats, &track, kept_);
    if (track.frames.empty()) return {};
    kept_ = track.frames.back();
    if (one_) one_ = CountAround(*one_, &track);
    BeatsAhead ahead =
        PredictBeats(track, now - hint_.later_s, now - hint_.later_s + kAheadSeconds);
    for (std::vector<double>* some : {&ahead.beats, &ahead.downbeats}) {
      for (double& beat : *some) beat += hint_.later_s;
    }
    return ahead;
  }
  if (heard - searched_ < Onsets(kEverySeconds)) return {};
  searched_ = heard;
  const int64_t old = std::ssize(onsets_) - Onsets(kMemorySeconds);
  if (old > 0) {
    onsets_.erase(onsets_.begin(), onsets_.begin() + old);
    first_ += old;
  }
  const std::optional<int64_t> kept = kept_ ? std::optional(*kept_ - first_) : std::nullopt;
  found_ =
      std::async(std::launch::async, [onsets = onsets_, first = first_, hint = hint_.beats, kept] {
        BeatTrack track = TrackNear(hint, onsets, {}, kept);
        for (int64_t& frame : track.frames) frame += first;
        return track;
      });
  return {};
}

}  // namespace choreo::live
