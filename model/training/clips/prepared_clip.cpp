#include "model/training/clips/prepared_clip.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>

#include "model/core/error.h"
#include "model/core/files/safetensors.h"
#include "model/motion/skeleton_json.h"

namespace choreo {

PreparedClip ReadPreparedClip(const std::filesystem::path& path) {
  Safetensors content = ReadSafetensors(path);
  const auto tensor = [&](const char* name, size_t dimensions) -> const NamedTensor& {
    const auto found = content.tensors.find(name);
    if (found == content.tensors.end() || found->second.shape.size() != dimensions) {
      throw InvalidArgument(path.string(),
                            std::string("not a prepared clip: no usable tensor '") + name + "'");
    }
    return found->second;
  };
  const NamedTensor& roots = tensor("root_positions", 2);
  const NamedTensor& rotations = tensor("rotations", 3);
  const NamedTensor& contacts = tensor("contacts", 2);
  const int64_t frames = roots.shape[0], joints = rotations.shape[1];
  if (roots.shape[1] != 3 || rotations.shape[0] != frames || rotations.shape[2] != 3 ||
      contacts.shape != std::vector<int64_t>{frames, 4}) {
    throw InvalidArgument(path.string(), "not a prepared clip: its tensors disagree on the frames");
  }
  PreparedClip clip;
  clip.name = content.metadata["name"];
  clip.source = content.metadata["source"];
  // A file only names SMPL's skeleton, but contains any other.
  const std::string& skeleton = content.metadata["skeleton"];
  clip.skeleton =
      skeleton == Skeleton::Smpl24().name ? Skeleton::Smpl24() : SkeletonFromJson(skeleton);
  if (clip.skeleton.joints() != joints) {
    throw InvalidArgument(path.string(), std::to_string(joints) + " joints, but its skeleton is " +
                                             clip.skeleton.Describe());
  }
  clip.motion.fps = std::atof(content.metadata["fps"].c_str());
  if (!(clip.motion.fps > 0))
    throw InvalidArgument(path.string(), "fps '" + content.metadata["fps"] + "' is not above 0");
  clip.motion.frames.resize(static_cast<size_t>(frames));
  for (int64_t f = 0; f < frames; ++f) {
    Pose& pose = clip.motion.frames[f];
    pose.root_position =
        Eigen::Map<const Eigen::Vector3f>(roots.data.data() + 3 * f).cast<double>();
    pose.rotations =
        Eigen::Map<const Eigen::Matrix3Xf>(rotations.data.data() + 3 * joints * f, 3, joints)
            .cast<double>();
  }
  clip.contacts = Eigen::Map<const Eigen::MatrixXf>(contacts.data.data(), 4, frames);
  if (content.tensors.count("audio") > 0) {
    const NamedTensor& audio = tensor("audio", 2);
    if (audio.shape[0] != frames)
      throw InvalidArgument(path.string(), "as many audio rows as frames are needed");
    clip.audio = Eigen::Map<const Eigen::MatrixXf>(audio.data.data(), audio.shape[1], frames);
  }
  clip.notes = std::move(content.metadata);
  for (const char* own : {"name", "source", "fps", "skeleton"}) clip.notes.erase(own);
  return clip;
}

void WritePreparedClip(const std::filesystem::path& folder, const PreparedClip& clip) {
  const auto frames = static_cast<int64_t>(clip.motion.frames.size());
  const int64_t joints = clip.skeleton.joints();
  NamedTensor roots{{frames, 3}, {}}, rotations{{frames, joints, 3}, {}};
  for (const Pose& pose : clip.motion.frames) {
    if (pose.rotations.cols() != joints) {
      throw InvalidArgument(clip.name, std::to_string(pose.rotations.cols()) +
                                           " joints, but its skeleton is " +
                                           clip.skeleton.Describe());
    }
    const Eigen::Vector3f root = pose.root_position.cast<float>();
    const Eigen::Matrix3Xf turned = pose.rotations.cast<float>();
    roots.data.insert(roots.data.end(), root.data(), root.data() + 3);
    rotations.data.insert(rotations.data.end(), turned.data(), turned.data() + turned.size());
  }
  Safetensors content;
  content.tensors["root_positions"] = std::move(roots);
  content.tensors["rotations"] = std::move(rotations);
  content.tensors["contacts"] = {
      {frames, 4}, {clip.contacts.data(), clip.contacts.data() + clip.contacts.size()}};
  if (clip.audio.cols() > 0) {
    content.tensors["audio"] = {{frames, clip.audio.rows()},
                                {clip.audio.data(), clip.audio.data() + clip.audio.size()}};
  }
  content.metadata = clip.notes;
  content.metadata["name"] = clip.name;
  content.metadata["source"] = clip.source;
  content.metadata["fps"] = std::to_string(clip.motion.fps);
  content.metadata["skeleton"] =
      clip.skeleton == Skeleton::Smpl24() ? clip.skeleton.name : SkeletonToJson(clip.skeleton);
  WriteSafetensors(folder / (clip.name + ".clip"), content);
}

std::vector<std::filesystem::path> ListPreparedClips(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder))
    throw Error(ErrorCode::kNotFound, folder.string(), "no such folder");
  if (!std::filesystem::is_directory(folder))
    throw InvalidArgument(folder.string(), "not a folder");
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".clip") paths.push_back(entry.path());
  }
  if (paths.empty())
    throw Error(ErrorCode::kNotFound, folder.string(), "no prepared clips (*.clip) here");
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string HashOfClips(std::span<const PreparedClip> clips, std::string_view before) {
  XXH64_hash_t hash = before.empty() ? 0 : XXH3_64bits(before.data(), before.size());
  for (const PreparedClip& clip : clips) {
    hash = XXH3_64bits_withSeed(clip.name.data(), clip.name.size(), hash);
    for (const Pose& pose : clip.motion.frames) {
      hash = XXH3_64bits_withSeed(pose.root_position.data(), 3 * sizeof(double), hash);
      hash = XXH3_64bits_withSeed(
          pose.rotations.data(), static_cast<size_t>(pose.rotations.size()) * sizeof(double), hash);
    }
  }
  char hex[17];
  std::snprintf(hex, sizeof(hex), "%016llx", static_cast<unsigned long long>(hash));
  return hex;
}

std::string StyleOf(const std::string& clip_name) {
  static const std::map<std::string, std::string> kStyles = {
      {"afraid", "afraid"},       {"angry", "angry"},     {"annoyed", "annoyed"},
      {"bored", "bored"},         {"excited", "excited"}, {"happy", "happy"},
      {"miserable", "miserable"}, {"active", "active"},   {"neutral", "neutral"},
      {"pleased", "pleased"},     {"relaxed", "relaxed"}, {"sad", "sad"},
      {"satisfied", "satisfied"}, {"tired", "tired"},     {"salsa", "salsa"},
      {"indian", "indian"},       {"martial", "martial"}, {"w", "waltz"},
      {"c", "cha-cha"},           {"r", "rumba"},         {"t", "tango"},
      {"nervous", "nervous"},     {"scary", "scary"},     {"005", "modern"},
      {"aachan", "pop"},          {"kashiyuka", "pop"},   {"nocchi", "pop"}};
  std::string word;
  for (const char c : clip_name + "_") {
    if (c != '_') {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      continue;
    }
    if (const auto found = kStyles.find(word); found != kStyles.end()) return found->second;
    word.clear();
  }
  return "";
}

}  // namespace choreo
