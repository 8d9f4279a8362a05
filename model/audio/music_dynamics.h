#pragma once

#include <span>

#include "model/audio/row_sound.h"

namespace choreo {

/// How music's energy moves a dance. Energies are what is added to the EnergyLevel of a body that
/// nobody asks for more of: logarithms of speeds, as far as the model answers them.
struct MusicDynamicsOptions {
  /// Of music that is as loud, as full of onsets or as deep as it becomes.
  double loud = 0.4, busy = 0.4, deep = 0.2;
  double silent = -1.6;  ///< where nothing sounds, instead

  /// As it becomes: so many standard deviations of its own last 30 s above their mean. Of music
  /// that hardly changes at least so much, in dB, dB of onsets a row, dB.
  double range = 0.75;
  double least_loud = 2, least_busy = 0.35, least_deep = 3;
  /// Onsets of ordinary music, which counts as if it had been heard for so many seconds before.
  double usual_onsets = 1.7, usual_seconds = 20;

  /// LUFS below which nothing sounds, or LU below the loudest second of the last 30; all is heard
  /// where `fade` LU more are.
  double silence = -65, far_below = 40, fade = 10;
};

/// Rows that it is heard in: 30 s.
inline constexpr int kDynamicsMemory = 900;

/// The energy of the last second of music, against that of the last kDynamicsMemory rows: of
/// `rows`, one a frame, oldest first, or of as many as there are; 0 for less than a second of them.
/// A pure function.
double HearEnergy(std::span<const RowSound> rows, const MusicDynamicsOptions& options = {});

}  // namespace choreo
