#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace choreo {

/// A term of a training loss: its running mean and its last gradient's norm, weighted as in
/// training. 0 until computed.
struct LossFigure {
  double value = 0, gradient = 0;
};

using LossFigures = std::map<std::string, LossFigure>;  ///< by the term's name (loss_terms.h)

/// Other figures of a run, in column order.
using NamedFigures = std::vector<std::pair<std::string, double>>;

/// A run's history: one line per report, as CSV and as plots.
class Curves {
 public:
  void Append(int64_t step, double seconds, const LossFigures& losses, const NamedFigures& figures);
  /// Writes curves.csv, curves.png, gradients.png and validation.png into `folder`.
  void Write(const std::filesystem::path& folder) const;
  /// The CSV text, stored in a run's state, and its inverse.
  std::string Serialise() const;
  void Restore(const std::string& csv);

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> rows_;  // one per report
};

}  // namespace choreo
