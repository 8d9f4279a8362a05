#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/error.h"

namespace choreo {

/// Collects the faults that several checks find, to name all at once.
class FaultList {
 public:
  template <class Check>
  void Try(Check check) {
    try {
      check();
    } catch (const Error& error) {
      Add(error);
    }
  }
  /// Ignores a fault that is in the list already, because several models can have one in common.
  void Add(const Error& fault) {
    const auto is_same = [&](const Error& one) { return std::string(one.what()) == fault.what(); };
    if (std::ranges::none_of(faults_, is_same)) faults_.push_back(fault);
  }
  void Add(const FaultList& others) {
    for (const Error& fault : others.faults_) Add(fault);
  }

  /// Whether the text of a fault begins so, as in "--workers:".
  bool HasOneOf(const std::string& beginning) const {
    return std::ranges::any_of(faults_, [&](const Error& one) {
      return std::string_view(one.what()).starts_with(beginning);
    });
  }

  /// Throws if there are faults: a single fault as it is, several as one Error with a line for each
  /// and the first one's code.
  void Throw() const {
    if (faults_.empty()) return;
    if (faults_.size() == 1) throw Error(faults_.front());
    std::string lines;
    for (const Error& fault : faults_)
      lines += (lines.empty() ? "" : "\n") + std::string(fault.what());
    throw Error(faults_.front().code(), "", lines);
  }

 private:
  std::vector<Error> faults_;
};

/// The faults in the text of such an Error.
inline std::vector<std::string> FaultsIn(const std::string& lines) {
  std::vector<std::string> faults;
  std::istringstream text(lines);
  for (std::string line; std::getline(text, line);) faults.push_back(line);
  return faults;
}

}  // namespace choreo
