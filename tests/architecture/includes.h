#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace choreo {

/// Who includes whom in a source tree, read from its quoted includes ("model/motion/skeleton.h",
/// from the root).
class Includes {
 public:
  /// Reads every .h and .cpp below `root`'s `folders`.
  Includes(const std::filesystem::path& root, const std::vector<std::string>& folders);

  /// Paths from the root.
  const std::vector<std::string>& files() const { return files_; }
  /// Own files and <system headers> that `file` includes itself.
  const std::set<std::string>& Of(const std::string& file) const;
  /// The same with all that these include.
  std::set<std::string> All(const std::string& file) const;

 private:
  std::vector<std::string> files_;
  std::map<std::string, std::set<std::string>> includes_;
};

}  // namespace choreo
