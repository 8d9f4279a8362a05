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

/// Rounds the values to bfloat16. Files store such tensors in half the bytes.
void RoundToBfloat16(NamedTensor* tensor);

/// Throws Error(kNotFound) for a missing file and Error(kInvalidArgument) for a file that is
/// truncated, is no safetensors file, or has tensors that overlap or are neither float32 nor
/// bfloat16. The message names the file and the tensor.
Safetensors ReadSafetensors(const std::filesystem::path& path);

/// Writes atomically (AtomicFile): a killed process leaves either the old file or the new one.
void WriteSafetensors(const std::filesystem::path& path, const Safetensors& content);

/// The 128-bit XXH3 hash, in hex, of names, shapes, values and metadata, except the metadata key
/// `without`. Equal content has equal hashes.
std::string ContentHash(const Safetensors& content, const std::string& without = {});

}  // namespace choreo
