#include "model/flow/checkpoint/checkpoint_file.h"

#include "model/motion/skeleton_json.h"

namespace choreo {
namespace {

constexpr const char* kHashKey = "hash";

}  // namespace

CheckpointFile::CheckpointFile(const Safetensors& content, const std::string& name,
                               const std::string& format)
    : content_(content), name_(name) {
  if (Text("format") != format) {
    throw InvalidArgument(name,
                          "format '" + Text("format") + "', but this build reads '" + format + "'");
  }
  const std::string actual = ContentHash(content, kHashKey);
  if (actual != hash()) {
    throw InvalidArgument(name, "content hash " + actual + ", but the file states " + hash() +
                                    ": it is damaged or was edited");
  }
}

const std::string& CheckpointFile::Text(const std::string& key) const {
  const auto found = content_.metadata.find(key);
  if (found == content_.metadata.end()) {
    throw InvalidArgument(name_, "not a choreo checkpoint: it has no '" + key + "'");
  }
  return found->second;
}

Skeleton CheckpointFile::skeleton() const {
  try {
    return SkeletonFromJson(Text("skeleton"));
  } catch (const std::exception& error) {  // in the JSON or its skeleton
    throw InvalidArgument(name_, std::string("its skeleton can't be read: ") + error.what());
  }
}

std::string WriteCheckpointFile(const std::filesystem::path& path, Safetensors content,
                                const std::string& format, const nlohmann::json& config,
                                const Skeleton& skeleton, const nlohmann::json& card) {
  content.metadata.insert_or_assign("format", format);
  content.metadata.insert_or_assign("config", config.dump());
  content.metadata.insert_or_assign("skeleton", SkeletonToJson(skeleton));
  content.metadata.insert_or_assign("card", card.dump());
  const std::string hash = ContentHash(content, kHashKey);
  content.metadata[kHashKey] = hash;
  WriteSafetensors(path, content);
  return hash;
}

}  // namespace choreo
