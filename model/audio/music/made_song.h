#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/audio/beats/meter.h"

/// The plan of a synthetic song with known beats, made from our own grooves, basses and chords.
/// Beat trackers are developed on some seeds and judged on others.
namespace choreo {

struct SongPlan {
  struct Tempo {
    double second, bpm;
  };
  struct Span {
    double begin, end;  // seconds
  };

  uint64_t seed = 1;  ///< determines groove, instruments, harmony, timing accuracy and loudness
  double seconds = 40;
  /// Ascending in time; tempo is linear between entries and constant outside. Two entries at the
  /// same second make a step at the next beat.
  std::vector<Tempo> tempo{{0, 120}};
  Meter meter = Meter::kFour;
  bool swing = false;                 ///< beats are divided by three; 4/4 only
  std::vector<Span> without_drums{};  ///< intros and breaks: bass and chords continue
  std::vector<Span> silent{};         ///< digital silence without beats
  bool only_pad = false;              ///< swelling chords without attacks
};

struct MadeSong {
  std::string groove;
  std::vector<float> mono;               ///< 22 050 Hz
  std::vector<double> beats, downbeats;  ///< seconds, ascending
};

/// Synthesises a song. The same plan gives the same bits on one machine.
MadeSong MakeSong(const SongPlan& plan);

}  // namespace choreo
