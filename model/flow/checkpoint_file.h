#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "model/core/error.h"
#include "model/core/json_limits.h"
#include "model/core/safetensors.h"
#include "model/motion/skeleton.h"

/// What every checkpoint has around its tensors: a format's name, configuration, skeleton, model
/// card, and a content hash that guards the whole.
namespace choreo {

/// Takes up a file that has been read. Throws Error(kInvalidArgument) that names the file: another
/// format, something missing or unreadable, a wrong hash.
class CheckpointFile {
 public:
  /// `name` is what errors call the file; `format` is the one that is expected. Keeps a reference
  /// to `content`.
  CheckpointFile(const Safetensors& content, const std::string& name, const std::string& format);

  const std::string& card() const { return Text("card"); }  ///< JSON text
  const std::string& hash() const { return Text("hash"); }  ///< 128-bit content hash, hex
  Skeleton skeleton() const;

  /// Another field, which is JSON.
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

/// Writes atomically what `content` holds, tensors and fields of its own, as such a file; returns
/// the content hash.
std::string WriteCheckpointFile(const std::filesystem::path& path, Safetensors content,
                                const std::string& format, const nlohmann::json& config,
                                const Skeleton& skeleton, const nlohmann::json& card);

}  // namespace choreo
