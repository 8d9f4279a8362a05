#pragma once

#include <cmath>

#include "model/evaluation/evaluation.h"

namespace choreo {

/// Paper F's figures in the codes of Evaluation::encoder (EvaluateEncoded).
struct EncodedFigures {
  double fid = NAN, variability = NAN, diversity = NAN;
};

/// Measures an engine or real motion. NaN without an encoder or with too little motion.
EncodedFigures MeasureEncoded(const Evaluation& evaluation, const Method& method);

}  // namespace choreo
