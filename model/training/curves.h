#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/training/report_row.h"

namespace choreo {

/// A run's history: one line a report, as CSV and as a plot.
class Curves {
 public:
  void Append(const LossRow& losses, double seconds, const NamedFigures& figures);
  /// Writes curves.csv, curves.png, gradients.png and validation.png into `folder`.
  void Write(const std::filesystem::path& folder) const;
  /// The CSV text, kept inside a run's state; and back.
  std::string Serialise() const;
  void Restore(const std::string& csv);

 private:
  std::string header_;
  std::vector<std::string> lines_;
};

}  // namespace choreo
