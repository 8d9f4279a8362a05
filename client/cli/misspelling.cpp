#include "client/cli/misspelling.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace choreo::cli {
namespace {

constexpr size_t kMostEdits = 2;

// Letters put in, left out or changed between two words (Levenshtein).
size_t Edits(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string DescribeMisspelling(const CLI::App& program) {
  for (const CLI::App* command : program.get_subcommands()) {
    for (const std::string& word : command->remaining()) {
      if (!word.starts_with("--")) continue;
      const std::string name = word.substr(0, word.find('='));
      std::string nearest;
      size_t least = kMostEdits + 1;
      for (const CLI::Option* option : command->get_options()) {
        for (const std::string& known : option->get_lnames()) {
          const size_t edits = Edits(name, "--" + known);
          if (edits >= least) continue;
          least = edits;
          nearest = "--" + known;
        }
      }
      if (nearest.empty()) continue;
      return name + " is no option of " + command->get_name() + "; did you mean " + nearest + "?";
    }
  }
  return "";
}

}  // namespace choreo::cli
