#pragma once

#include <string>
#include <vector>

#include "model/engine/sample_queue.h"
#include "model/evaluation/table.h"

namespace choreo {

/// A song to dance to: mono samples at 22,050 Hz.
struct NamedSong {
  std::string name;
  std::vector<float> mono;
};

struct HearingOptions {
  uint64_t first_seed = 2'000'000;  ///< of synthetic songs; development used lower ones
  int seeds = 3;                    ///< dances per song, and songs of each kind
  int part_seconds = 20;            ///< length of a part of assembled songs, above 4
  /// Mean joint speeds in Olivia's recordings, m/s (`eval --liveliness --split validation`): of the
  /// fastest frame, and the speed that one frame in a thousand exceeds.
  double top_speed = 4.73, rare_speed = 2.79;
};

/// The table "hearing": how much a dance responds to its music, at usual and at other settings.
/// Dances are streamed as served, to synthetic songs (audio/music/made_song.h) and to `songs`.
///
///   drums ÷ pad, silence ÷ drums  mean joint speeds in parts of one song, from its fifth second on
///   loudness and speed            their correlation over windows of 4 s, mean over seeds
///   seconds from a drop ...       until the dances' mean speed is half way from what it was before
///                                 to what it becomes
///   a part again ÷ another part   mean distances of joints, with both dancers moved to one place
///                                 and facing
///   two songs ÷ two seeds         the same for dances of one part each
///   hits                          share of kinematic beats that hit known beats: without keys,
///                                 through poses of another dance every 2 s, and both on a circle
///   hits over chance              points by which that is more than of the same beats moved, as in
///                                 HitsOverChance
///   rarely fast frames            share of all these dances' frames above `rare_speed`
///   exploded                      share of these dances with a frame above `top_speed`
Table EvaluateHearing(SampleQueue& queue, const std::vector<NamedSong>& songs,
                      const HearingOptions& options = {});

}  // namespace choreo
