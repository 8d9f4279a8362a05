#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/core/passage.h"

namespace choreo {

/// What a complete piece of music tells.
struct MusicAnalysis {
  std::vector<double> beats = {};       ///< seconds, ascending
  std::vector<double> downbeats = {};   ///< those of the beats that begin a bar
  std::vector<double> confidence = {};  ///< of each beat, as BeatTrack's; empty if not found here
  std::vector<Passage> passages = {};   ///< repeats
  std::vector<float> energies = {};     ///< SongEnergies (music_dynamics.h)
  uint64_t id = 0;                      ///< MusicId
};

/// Finds the beats of mono samples at 22 050 Hz, and the rest. Throws like FindOnsets. Thread-safe.
MusicAnalysis AnalyseMusic(std::span<const float> mono);
/// The same for music whose beats are known.
MusicAnalysis AnalyseMusic(std::span<const float> mono, std::vector<double> beats,
                           std::vector<double> downbeats = {});

}  // namespace choreo
