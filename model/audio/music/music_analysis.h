#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/core/passage.h"

namespace choreo {

/// The analysis of a complete piece of music.
struct MusicAnalysis {
  std::vector<double> beats = {};       ///< seconds, ascending
  std::vector<double> downbeats = {};   ///< the beats that begin a bar
  std::vector<double> confidence = {};  ///< [beats] as in BeatTrack; empty for known beats
  std::vector<Passage> passages = {};   ///< repeats
  std::vector<float> energies = {};     ///< SongEnergies (music_dynamics.h)
  uint64_t id = 0;                      ///< MusicId
};

/// Analyses mono samples at 22 050 Hz, including their beats. Throws what FindOnsets throws.
/// Thread-safe.
MusicAnalysis AnalyseMusic(std::span<const float> mono);
/// The same for music whose beats are known.
MusicAnalysis AnalyseMusic(std::span<const float> mono, std::vector<double> beats,
                           std::vector<double> downbeats = {});

}  // namespace choreo
