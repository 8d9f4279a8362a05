#pragma once

#include <span>
#include <string_view>

namespace choreo::studio {

/// A file of the built page (studio/page/dist), part of the program.
struct PageFile {
  std::string_view path;  ///< as browsers ask for it: "/index.html"
  std::string_view type;  ///< MIME
  std::string_view data;
};

std::span<const PageFile> PageFiles();

/// Null for what is no file of it; "/" is its "/index.html".
const PageFile* FindPageFile(std::string_view path);

}  // namespace choreo::studio
