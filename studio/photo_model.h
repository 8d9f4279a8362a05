#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace choreo::studio {

/// The files of npm's @mediapipe/pose, with which the page finds poses in photos. They are not part
/// of the program: scripts/photo_model.sh downloads them into a folder. Immutable.
class PhotoModel {
 public:
  explicit PhotoModel(std::filesystem::path folder);

  /// Whether all files were present at construction.
  bool is_there() const { return is_there_; }

  struct File {
    std::string_view type;  ///< MIME
    std::string data;
  };
  /// Null if no file has this name, or it is missing.
  std::optional<File> Read(std::string_view name) const;

 private:
  std::filesystem::path folder_;
  bool is_there_;
};

}  // namespace choreo::studio
