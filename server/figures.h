#pragma once

#include <string>

#include "server/calls/serving.h"

namespace choreo {

/// The metrics of a server and its process, in Prometheus' text format. Thread-safe.
std::string FiguresOf(const Serving& serving);

}  // namespace choreo
