#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/audio/meter.h"

/// Songs whose beats are known, without end: grooves, basses and chords of our own, synthesized.
/// Beat trackers are developed on some seeds and judged on others.
namespace choreo {

struct SongPlan {
  struct Tempo {
    double second, bpm;
  };
  struct Span {
    double begin, end;  // seconds
  };

  uint64_t seed = 1;  ///< groove, instruments, harmony, how exactly it is played, how loud
  double seconds = 40;
  /// Ascending in time; linear in between, constant outside. Two at one second: a step, from the
  /// first beat behind it on.
  std::vector<Tempo> tempo{{0, 120}};
  Meter meter = Meter::kFour;
  bool swing = false;                 ///< beats are divided by three; 4/4 only
  std::vector<Span> without_drums{};  ///< intros and breaks: bass and chords go on
  std::vector<Span> silent{};         ///< digital silence; no beats are there
  bool only_pad = false;              ///< chords that swell, and nothing that strikes
};

struct MadeSong {
  std::string groove;
  std::vector<float> mono;               ///< 22 050 Hz
  std::vector<double> beats, downbeats;  ///< seconds, ascending
};

/// The same bits for the same plan on one machine.
MadeSong MakeSong(const SongPlan& plan);

}  // namespace choreo
