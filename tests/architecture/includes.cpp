#include "tests/architecture/includes.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <stdexcept>

namespace choreo {

namespace fs = std::filesystem;

Includes::Includes(const fs::path& root, const std::vector<std::string>& folders) {
  const std::regex line_of(R"(^\s*#\s*include\s+(?:"([^"]+)\"|(<[^>]+>)).*)");
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      const std::string file = fs::relative(entry.path(), root).generic_string();
      files_.push_back(file);
      std::set<std::string>& found = includes_[file];
      std::ifstream stream(entry.path());
      std::smatch match;
      for (std::string line; std::getline(stream, line);) {
        if (line.find("include") == std::string::npos) continue;
        if (std::regex_match(line, match, line_of)) {
          found.insert(match[1].matched ? match[1].str() : match[2].str());
        }
      }
    }
  }
  std::ranges::sort(files_);
  if (files_.empty()) throw std::runtime_error("no sources below " + root.string());
}

const std::set<std::string>& Includes::Of(const std::string& file) const {
  static const std::set<std::string> kNone;  // system and generated headers
  const auto found = includes_.find(file);
  return found == includes_.end() ? kNone : found->second;
}

std::set<std::string> Includes::All(const std::string& file) const {
  std::set<std::string> seen;
  std::vector<std::string> open = {file};
  while (!open.empty()) {
    const std::string next = open.back();
    open.pop_back();
    for (const std::string& include : Of(next)) {
      if (seen.insert(include).second) open.push_back(include);
    }
  }
  return seen;
}

}  // namespace choreo
