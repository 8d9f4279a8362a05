#include "client/live/music_ear.h"

namespace choreo::live {

MusicEar::MusicEar(int sample_rate, int channels, const LiveBeatHint& hint)
    : resampler_(sample_rate, channels), beats_(hint) {}

MusicEar::Ahead MusicEar::Hear(std::span<const float> piece) {
  mono_.clear();
  resampler_.Push(piece);
  resampler_.Pull(mono_);
  BeatsAhead beats = beats_.Hear(mono_);
  if (beats_.hint() != LiveBeatHint() && !beats.beats.empty())
    beats.beats.push_back(kBeatBehindMusic_s);
  return {std::move(beats), passages_.Hear(mono_)};
}

}  // namespace choreo::live
