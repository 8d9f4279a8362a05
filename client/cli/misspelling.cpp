#include "client/cli/misspelling.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace choreo::cli {
namespace {

/// The number of wrong letters allowed in a word of this length; short words are all near each
/// other.
size_t MostEdits(size_t letters) { return letters < 3 ? 0 : letters < 6 ? 1 : 2; }

// Letters inserted, removed or changed between two words (Levenshtein).
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

/// The distance of a word from a candidate, if it may be meant: a prefix, as temp of temperature,
/// is near.
std::optional<size_t> Distance(const std::string& word, const std::string& known) {
  if (word.size() >= 2 && known.starts_with(word)) return 0;
  const size_t edits = Edits(word, known);
  if (edits > MostEdits(word.size())) return std::nullopt;
  return edits;
}

/// Finds the candidate nearest to a word; empty if none is near.
class Nearest {
 public:
  explicit Nearest(std::string word) : word_(std::move(word)) {}
  void Offer(const std::string& known) {
    const std::optional<size_t> distance = Distance(word_, known);
    if (!distance || (least_ && *distance >= *least_)) return;
    least_ = distance;
    nearest_ = known;
  }
  const std::string& nearest() const { return nearest_; }

 private:
  std::string word_, nearest_;
  std::optional<size_t> least_;
};

std::string DescribeCommand(const CLI::App& program, const std::string& word) {
  Nearest command(word);
  for (const CLI::App* known : program.get_subcommands([](const CLI::App*) { return true; }))
    command.Offer(known->get_name());
  return word + " is no command; " +
         (command.nearest().empty() ? "see --help" : "did you mean " + command.nearest() + "?");
}

}  // namespace

std::string DescribeMisspelling(const CLI::App& program) {
  if (program.get_subcommands().empty()) {
    for (const std::string& word : program.remaining())
      if (!word.starts_with("-")) return DescribeCommand(program, word);
  }
  for (const CLI::App* command : program.get_subcommands()) {
    for (const std::string& word : command->remaining()) {
      if (!word.starts_with("--")) continue;
      const std::string name = word.substr(0, word.find('='));
      Nearest option(name.substr(2));
      for (const CLI::Option* known : command->get_options()) {
        if (known->get_group().empty()) continue;  // hidden
        for (const std::string& long_name : known->get_lnames()) option.Offer(long_name);
      }
      if (option.nearest().empty()) continue;
      return name + " is no option of " + command->get_name() + "; did you mean --" +
             option.nearest() + "?";
    }
  }
  return "";
}

}  // namespace choreo::cli
