#pragma once

#include <string>
#include <vector>

#include "model/engine/sample_queue.h"
#include "model/evaluation/table.h"

namespace choreo {

/// A song that is danced to, 22 050 Hz.
struct NamedSong {
  std::string name;
  std::vector<float> mono;
};

struct HearingOptions {
  uint64_t first_seed = 2'000'000;  ///< of the songs that are made; development had those below
  int seeds = 3;                    ///< dances of each song; songs of each kind
  int part_seconds = 20;            ///< of songs that are put together, above 4
};

/// hearing: how far a dance shows that its music is heard, at usual settings and at others: dances
/// of streams, as they are served, of songs that are made (audio/made_song.h) and of `songs`.
///   drums ÷ pad, silence ÷ drums  mean joint speeds of parts of one song, from its fifth second on
///   loudness and speed            their correlation over windows of 4 s, mean over seeds
///   a part again ÷ another part   mean distances of joints, both dancers standing at one place,
///                                 facing one way
///   two songs ÷ two seeds         the same of dances of one part each
///   hits over chance              points by which kinematic beats stand on known beats more often
///                                 than on the same beats moved, as HitsOverChance has it: without
///                                 keys, through poses of another dance each 2 s, and on a circle
Table EvaluateHearing(SampleQueue& queue, const std::vector<NamedSong>& songs,
                      const HearingOptions& options = {});

}  // namespace choreo
