#pragma once

#include <sstream>
#include <string>
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
  void Add(const Error& fault) { faults_.push_back(fault); }

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
