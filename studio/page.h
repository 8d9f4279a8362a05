#pragma once

#include <span>
#include <string_view>

namespace choreo::studio {

/// A file of the built page (studio/page/dist), part of the program.
struct PageFile {
  std::string_view path;  ///< as browsers request it: "/index.html"
  std::string_view type;  ///< MIME
  std::string_view data;
};

std::span<const PageFile> PageFiles();

/// Null if no file has this path; "/" is "/index.html".
const PageFile* FindPageFile(std::string_view path);

}  // namespace choreo::studio
