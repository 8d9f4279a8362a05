#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/training/validation.h"

namespace choreo {

/// Running means of a run's losses and the last gradient norms of their terms; 0 where a term was
/// not computed yet.
struct LossRow {
  int64_t step = 0;
  double planner = 0, likelihood = 0, key_pose = 0, contacts = 0;
  double planner_gradient = 0, likelihood_gradient = 0, rollout_gradient = 0;
};

/// A run's history: one line a report, as CSV and as a plot.
class Curves {
 public:
  void Append(const LossRow& losses, double seconds, const std::vector<ValidationRow>& rows);
  /// Writes curves.csv and curves.png into `folder`.
  void Write(const std::filesystem::path& folder) const;
  /// The CSV text, kept inside a run's state; and back.
  std::string Serialise() const;
  void Restore(const std::string& csv);

 private:
  std::string header_;
  std::vector<std::string> lines_;
};

}  // namespace choreo
