#pragma once

#include <optional>
#include <string_view>

#include "model/messages/style_figures.h"

namespace choreo {

/// The measurements (docs/results.md) of the shipped checkpoint in a model's fingerprint, or none.
/// Thread-safe.
std::optional<StyleFigures> FindStyleFigures(std::string_view fingerprint);

}  // namespace choreo
