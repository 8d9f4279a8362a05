#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/core/joined.h"

namespace choreo {

/// Finds the candidate nearest to a misspelt word. Not thread-safe.
class Nearest {
 public:
  explicit Nearest(std::string word) : word_(std::move(word)) {}

  void Offer(const std::string& known) {
    const std::optional<size_t> distance = Distance(known);
    if (!distance || (least_ && *distance >= *least_)) return;
    least_ = distance;
    nearest_ = known;
  }

  /// The nearest candidate so far, or "" if none is near.
  const std::string& nearest() const { return nearest_; }

 private:
  // The number of wrong letters allowed in a word of this length. Short words are all near each
  // other.
  static size_t MostEdits(size_t letters) { return letters < 3 ? 0 : letters < 6 ? 1 : 2; }

  // The optimal string alignment distance: letters inserted, removed, changed, or exchanged with
  // the next.
  size_t Edits(const std::string& known) const {
    std::vector<size_t> two_before, before, row(known.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 0; i < word_.size(); ++i) {
      two_before = std::exchange(before, row);
      row[0] = i + 1;
      for (size_t j = 0; j < known.size(); ++j) {
        const size_t changed = before[j] + (word_[i] == known[j] ? 0 : 1);
        row[j + 1] = std::min({changed, before[j + 1] + 1, row[j] + 1});
        const bool is_exchanged =
            i > 0 && j > 0 && word_[i] == known[j - 1] && word_[i - 1] == known[j];
        if (is_exchanged) row[j + 1] = std::min(row[j + 1], two_before[j - 1] + 1);
      }
    }
    return row.back();
  }

  // None unless the candidate may be meant. A prefix, such as temp of temperature, is at distance
  // 0.
  std::optional<size_t> Distance(const std::string& known) const {
    if (word_.size() >= 2 && known.starts_with(word_)) return 0;
    const size_t edits = Edits(known);
    if (edits > MostEdits(word_.size())) return std::nullopt;
    return edits;
  }

  std::string word_, nearest_;
  std::optional<size_t> least_;
};

/// The end of an error about a word that is not in `known`: "did you mean kick?", or, if none is
/// near, a list of at most `most` elements: "it has kick, dab". `text` converts an element to text.
template <typename Range, typename Text = std::identity>
std::string DidYouMean(const std::string& word, const Range& known, const Text& text = {},
                       size_t most = std::numeric_limits<size_t>::max()) {
  Nearest meant(word);
  std::vector<std::string> named;
  for (const auto& one : known) {
    const std::string name = std::invoke(text, one);
    meant.Offer(name);
    if (named.size() <= most) named.push_back(name);
  }
  if (!meant.nearest().empty()) return "did you mean " + meant.nearest() + "?";
  if (named.empty()) return "it has none";
  if (named.size() > most) named.back() = "...";
  return "it has " + Joined(named);
}

}  // namespace choreo
