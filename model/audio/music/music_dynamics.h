#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/audio/music/row_sound.h"

namespace choreo {

/// Options of the music's energy, which makes a dance livelier or calmer. Energies (logarithms of
/// speed factors, as far as the model follows them) are added to the EnergyLevel of body parts
/// without a control.
struct MusicDynamicsOptions {
  /// Weights of loudness, onset density and bass.
  double loud = 0.4, busy = 0.4, deep = 0.2;
  double silent = -1.6;  ///< energy of silence

  /// A weight counts in full at `range` standard deviations above the mean of the last two minutes
  /// or, in music that hardly changes, at the least_ values: dB, dB of onsets per row, dB.
  double range = 0.75;
  double least_loud = 2, least_busy = 0.35, least_deep = 3;
  /// A prior: as if `usual_seconds` of music with these onsets had preceded the song.
  double usual_onsets = 1.7, usual_seconds = 20;

  /// Music below `silence` LUFS, or `far_below` LU below the loudest second of the last two
  /// minutes, is silent. From `fade` LU above that on it counts fully.
  double silence = -65, far_below = 40, fade = 10;

  /// Music turns where it is louder or softer by `turn_loud` LU than in the second before a
  /// transition, or has `turn_deep` dB more or less bass. Music without a turn varies less within
  /// two seconds, in 95 of 100 cases. Bass counts as at least `bass_below` dB below the loudness,
  /// because less is inaudible.
  double turn_loud = 5, turn_deep = 10, bass_below = 20;
  /// The newest rows that count after a turn to louder music, because most of the last second is
  /// from before it.
  int turn_heard = 6;
  /// In rows: the step at which turns are examined; the least length of a transition, so that it
  /// looks like a movement; and the time before a key without turns, which feet need to get there.
  int turn_step = 3, turn_after = 15, turn_before_key = 30;
};

/// Rows of memory: two minutes.
inline constexpr int kDynamicsMemory = 3600;

/// The energy of the last second of music, relative to the last kDynamicsMemory rows. `rows`: one
/// per frame, oldest first, or as many as there are. 0 for less than a second. If the music has
/// just turned, at least the energy of its last `turn_heard` rows. Pure.
double HearEnergy(std::span<const RowSound> rows, const MusicDynamicsOptions& options = {});

/// Rows in a step of a song's energies.
inline constexpr int kEnergyRows = 15;
/// The energy of a whole song in steps of kEnergyRows rows, relative to all of it. A step has the
/// energy of the kTypicalFrames rows around its middle. `rows`: one per frame, from the song's
/// start. Pure.
std::vector<float> SongEnergies(std::span<const RowSound> rows,
                                const MusicDynamicsOptions& options = {});
/// The mean of SongEnergies over rows [from, to), with silence after the last. Rows before the song
/// do not count; 0 if no row counts.
double MeanEnergy(std::span<const float> energies, int64_t from, int64_t to,
                  const MusicDynamicsOptions& options = {});

/// The loudness and bass of music.
struct MusicLevel {
  double loud = 0;  ///< LUFS
  double deep = 0;  ///< dB, its bass
};
/// Rows over which levels are measured: a second.
inline constexpr int kLevelRows = 30;
MusicLevel HearLevel(std::span<const RowSound> rows, const MusicDynamicsOptions& options = {});

/// Whether the music turns from one level to another.
bool Turns(const MusicLevel& from, const MusicLevel& to, const MusicDynamicsOptions& options = {});

}  // namespace choreo
