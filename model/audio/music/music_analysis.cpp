#include "model/audio/music/music_analysis.h"

#include <utility>

#include "model/audio/beats/beats.h"
#include "model/audio/music/feature_stream.h"
#include "model/audio/music/music_dynamics.h"
#include "model/audio/music/music_id.h"
#include "model/audio/music/passages.h"

namespace choreo {

MusicAnalysis AnalyseMusic(std::span<const float> mono) {
  const BeatTrack track = FindBeats(mono);
  MusicAnalysis music = AnalyseMusic(mono, track.Seconds(), track.DownbeatSeconds());
  music.confidence = track.confidence;
  return music;
}

MusicAnalysis AnalyseMusic(std::span<const float> mono, std::vector<double> beats,
                           std::vector<double> downbeats) {
  std::vector<Passage> passages = FindPassages(mono, beats);
  return {.beats = std::move(beats),
          .downbeats = std::move(downbeats),
          .passages = std::move(passages),
          .energies = SongEnergies(SoundsOf(mono)),
          .id = MusicId(mono)};
}

}  // namespace choreo
