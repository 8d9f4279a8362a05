#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace choreo::studio {

/// The files of npm's @mediapipe/pose, with which the page sees poses in photos. They are not part
/// of the program: scripts/photo_model.sh puts them into a folder, where npm can be had. Immutable.
class PhotoModel {
 public:
  explicit PhotoModel(std::filesystem::path folder);

  /// Whether all of them were there when this was made.
  bool is_there() const { return is_there_; }

  struct File {
    std::string_view type;  ///< MIME
    std::string data;
  };
  /// Null for what is none of them, or is not there.
  std::optional<File> Read(std::string_view name) const;

 private:
  std::filesystem::path folder_;
  bool is_there_;
};

}  // namespace choreo::studio
