#pragma once

#include <string>

#include "server/serving.h"

namespace choreo {

/// What a server has done and does, and what its process uses, as Prometheus reads it. Thread-safe.
std::string FiguresOf(const Serving& serving);

}  // namespace choreo
