#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace choreo {

/// One term of a training loss: its running mean and its last gradient's norm, weighted as it is
/// trained with; 0 where it was not computed yet.
struct LossFigure {
  double value = 0, gradient = 0;
};

/// Where a run stands: its terms by name (losses.h).
struct LossRow {
  int64_t step = 0;
  std::map<std::string, LossFigure> terms;
};

/// What else a run reports, in the order of its columns.
using NamedFigures = std::vector<std::pair<std::string, double>>;

}  // namespace choreo
