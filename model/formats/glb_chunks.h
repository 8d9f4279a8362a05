#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// Binary glTF taken apart. Private to this folder.
namespace choreo {

struct GlbChunks {
  std::string_view json;
  std::string_view binary;  ///< empty where there is none
  std::string_view others;  ///< chunks behind these, as they stand
};

/// All bytes of a file. Throws Error(kNotFound) naming the path where it cannot be opened,
/// Error(kInvalidArgument) without it for what is no plain file or has 4 GiB or more, which no glb
/// can have.
std::string ReadGlbBytes(const std::filesystem::path& path);

/// The same of a glTF that is text: as a binary one, the buffer of the file beside it, if it has
/// one, as its binary chunk. Throws also Error(kInvalidArgument) naming that file where it cannot
/// be read or does not lie beside or below `path`, and for several.
std::string ReadGltfBytes(const std::filesystem::path& path);

/// Points into `bytes`. Throws Error(kInvalidArgument) without a field.
GlbChunks SplitGlb(std::string_view bytes);

/// The inverse; chunks are padded as the format asks. Throws Error(kInvalidArgument) for 4 GiB or
/// more.
std::string JoinGlb(const GlbChunks& chunks);

}  // namespace choreo
