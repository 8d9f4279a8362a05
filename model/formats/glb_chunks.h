#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// Splits and joins binary glTF. Private to this folder.
namespace choreo {

struct GlbChunks {
  std::string_view json;
  std::string_view binary;  ///< empty if there is none
  std::string_view others;  ///< any further chunks, unchanged
};

/// All bytes of a file. Throws Error(kNotFound) naming the path if it cannot be opened,
/// Error(kInvalidArgument) without it for anything but a regular file, or 4 GiB or more, which no
/// glb can have.
std::string ReadGlbBytes(const std::filesystem::path& path);

/// Reads the same from a text glTF, converted to binary with the buffer file beside it, if any, as
/// its binary chunk. Throws, too, Error(kInvalidArgument) naming that file if it is unreadable or
/// not beside or below `path`, and for several.
std::string ReadGltfBytes(const std::filesystem::path& path);

/// Points into `bytes`. Throws Error(kInvalidArgument) without a field.
GlbChunks SplitGlb(std::string_view bytes);

/// The inverse; pads chunks as required. Throws Error(kInvalidArgument) for 4 GiB or more.
std::string JoinGlb(const GlbChunks& chunks);

}  // namespace choreo
