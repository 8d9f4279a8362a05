#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace choreo {

/// One float32 tensor, row-major.
struct NamedTensor {
  std::vector<int64_t> shape;
  std::vector<float> data;
};

/// A safetensors file: named float32 tensors and string metadata. Nothing in it is executable.
struct Safetensors {
  std::map<std::string, NamedTensor> tensors;
  std::map<std::string, std::string> metadata;

  /// Throws Error(kInvalidArgument, name) if the tensor is missing or has another shape.
  const NamedTensor& Get(const std::string& name, const std::vector<int64_t>& shape) const;
};

/// Rounds values to bfloat16, which files store in half the bytes.
void RoundToBfloat16(NamedTensor* tensor);

/// Throws Error(kNotFound) for a missing file and Error(kInvalidArgument) for one that is
/// truncated, overlapping, not float32 or not safetensors at all; the message names the file and
/// the tensor.
Safetensors ReadSafetensors(const std::filesystem::path& path);

/// Writes atomically (AtomicFile): a kill leaves either the old file or the new one.
void WriteSafetensors(const std::filesystem::path& path, const Safetensors& content);

/// 128-bit XXH3 in hex of names, shapes, bytes and metadata (except the key `without`): equal
/// content, equal hash.
std::string ContentHash(const Safetensors& content, const std::string& without = {});

}  // namespace choreo
