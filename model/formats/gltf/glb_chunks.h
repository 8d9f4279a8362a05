#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// Splits and joins the chunks of binary glTF. Private to this folder.
namespace choreo {

struct GlbChunks {
  std::string_view json;
  std::string_view binary;  ///< empty if there is none
  std::string_view others;  ///< any further chunks, unchanged
};

/// Reads all bytes of a file. Throws Error(kNotFound), naming the path, if it cannot be opened;
/// Error(kInvalidArgument), without a field, unless it is a regular file of less than 4 GiB, a
/// glb's limit.
std::string ReadGlbBytes(const std::filesystem::path& path);

/// Reads a text glTF and converts it to binary; its buffer file, if any, becomes the binary chunk.
/// Throws what ReadGlbBytes throws, and Error(kInvalidArgument) for several buffer files and for
/// one that is unreadable or not beside or below `path`, naming it.
std::string ReadGltfBytes(const std::filesystem::path& path);

/// The result points into `bytes`. Throws Error(kInvalidArgument) without a field.
GlbChunks SplitGlb(std::string_view bytes);

/// The inverse. Pads chunks as glTF requires. Throws Error(kInvalidArgument) for 4 GiB or more.
std::string JoinGlb(const GlbChunks& chunks);

}  // namespace choreo
