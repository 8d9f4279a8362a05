#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "model/core/error.h"
#include "model/core/files/json_limits.h"
#include "model/core/files/safetensors.h"
#include "model/motion/skeleton.h"

/// The data that accompany every checkpoint's tensors: a format name, configuration, skeleton,
/// model card, and a content hash over everything.
namespace choreo {

/// Checks a file's content. Throws Error(kInvalidArgument) naming the file for another format,
/// missing or unreadable parts, or a wrong hash.
class CheckpointFile {
 public:
  /// `name`: the file's name in errors. `format`: the expected format. Keeps a reference to
  /// `content`.
  CheckpointFile(const Safetensors& content, const std::string& name, const std::string& format);

  const std::string& card() const { return Text("card"); }  ///< JSON text
  const std::string& hash() const { return Text("hash"); }  ///< 128-bit content hash, hex
  Skeleton skeleton() const;

  /// Another field that contains JSON.
  template <typename Value>
  Value Get(const std::string& key) const {
    try {
      const auto json = nlohmann::json::parse(Text(key));
      CheckJsonNumbers(json, name_ + ": its '" + key + "'");
      return json.get<Value>();
    } catch (const nlohmann::json::exception& error) {
      throw InvalidArgument(name_, "its '" + key + "' can't be read: " + error.what());
    }
  }

 private:
  const std::string& Text(const std::string& key) const;

  const Safetensors& content_;
  std::string name_;
};

/// Writes the tensors and fields of `content` atomically as a checkpoint file. Returns the content
/// hash.
std::string WriteCheckpointFile(const std::filesystem::path& path, Safetensors content,
                                const std::string& format, const nlohmann::json& config,
                                const Skeleton& skeleton, const nlohmann::json& card);

}  // namespace choreo
