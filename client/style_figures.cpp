#include "client/style_figures.h"

#include <utility>

namespace choreo::client {

std::optional<StyleFigures> FindStyleFigures(std::string_view fingerprint) {
  // By the checkpoints' content hashes: another training is measured anew.
  constexpr std::pair<std::string_view, StyleFigures> kMeasured[] = {
      {"881e3a0e7178423ec4ee49a3bf378b1f", {6.7, 6.25, 6}},       // default: 16 moods
      {"fb44abc8b99abe2d4ef011e7bc6249eb", {51, 100.0 / 3, 49}},  // free: 3 genres
  };
  for (const auto& [hash, figures] : kMeasured)
    if (fingerprint.find(hash) != std::string_view::npos) return figures;
  return std::nullopt;
}

}  // namespace choreo::client
