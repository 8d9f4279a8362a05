#pragma once

#include <string>

#include "server/serving.h"

namespace choreo {

/// A server's and its process's figures, in Prometheus' format. Thread-safe.
std::string FiguresOf(const Serving& serving);

}  // namespace choreo
