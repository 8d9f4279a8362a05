#pragma once

#include <cstdint>
#include <vector>

#include "model/core/progress.h"
#include "model/evaluation/method.h"
#include "model/evaluation/table.h"
#include "model/evaluation/windows.h"

namespace choreo {

/// Whether a dance lives, beside real motion:
///   liveliness_SET      a figure a row. Through the clips' own poses each 2 s (keyed_dances.h)
///                       and no other word of the clip: lively_figures.h, how far seeds and songs
///                       part, hits on regular beats that it was told of, Frechet distances at
///                       60 frames (window_figures.h), the critic (metrics/critic.h). Without keys:
///                       long_figures.h.
///   liveliness_bands_SET  how fast joints go in each band of frequency (spectrum_table.h)
///   liveliness_l2p_SET  L2P over interpolation's at temperature 0, at the served one, and of the
///                       best of EvalOptions::best_of samples there
/// Everything is danced as it is served: engine, arrival, foot lock, closed loop. Figures named
/// "÷ real" are the sum over dances over the same of the clips; intervals over clips. No rows of
/// keyed dances where no clip has 20 s. Deterministic.
std::vector<Table> EvaluateLiveliness(const ClipSet& set, const Method& method,
                                      const EvalOptions& options, ProgressBar* progress);

/// How many frames that will dance.
int64_t CountLivelyFrames(const ClipSet& set, const ModelInfo& model, const EvalOptions& options);

}  // namespace choreo
