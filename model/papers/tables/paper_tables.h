#pragma once

#include <vector>

#include "model/evaluation/evaluation.h"

namespace choreo {

/// Paper F's tables for every method, raw (without arrival and footwork) and as served, at the
/// method's default temperature unless one is given:
///   paper_l2p_SET     Table 2: mean of EvalOptions::best_of samples
///   paper_dances_SET  Table 1: long dances with keys each 100 frames
///   paper_beats_SET   Table 4; only for sets with music
std::vector<Table> EvaluatePaperTransitions(const Evaluation& evaluation);
std::vector<Table> EvaluatePaperDances(const Evaluation& evaluation);

}  // namespace choreo
