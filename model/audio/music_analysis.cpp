#include "model/audio/music_analysis.h"

#include <utility>

#include "model/audio/beats.h"
#include "model/audio/music_id.h"
#include "model/audio/passages.h"

namespace choreo {

MusicAnalysis AnalyseMusic(std::span<const float> mono) {
  const BeatTrack track = FindBeats(mono);
  return AnalyseMusic(mono, track.Seconds(), track.DownbeatSeconds());
}

MusicAnalysis AnalyseMusic(std::span<const float> mono, std::vector<double> beats,
                           std::vector<double> downbeats) {
  std::vector<Passage> passages = FindPassages(mono, beats);
  return {std::move(beats), std::move(downbeats), std::move(passages), MusicId(mono)};
}

}  // namespace choreo
