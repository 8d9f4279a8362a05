#include "server/field_path.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "choreo/v1/choreography.pb.h"

namespace choreo {
namespace {

struct Kind {
  std::string_view numbered, message;
};
constexpr std::string_view kKeyframe = "keyframe";
/// Messages of a stream that may come more than once.
constexpr std::array kKinds = {
    Kind{"keyframes[", kKeyframe},
    Kind{"remove_keyframes[", "remove_keyframe"},
    Kind{"controls[", "controls"},
    Kind{"music_beats[", "music_beats"},
    Kind{"music_passages[", "music_passages"},
};

/// The message field for the poses of a continuation in errors.
constexpr std::string_view kPoses = "config.continuation.poses";

bool IsOfKeyframe(std::string_view path) {
  const std::string member(path.substr(0, path.find_first_of(".[")));
  return v1::Keyframe::descriptor()->FindFieldByName(member) != nullptr;
}

/// Errors index coordinates; messages name them.
std::string WithCoordinates(std::string path) {
  constexpr std::string_view kRoot = "root_position[", kNames = "xyz";
  const size_t at = path.find(kRoot);
  if (at == std::string::npos) return path;
  const size_t digit = at + kRoot.size();
  const auto axis = static_cast<size_t>(path[digit] - '0');
  return path.replace(digit - 1, 3, {'.', kNames[std::min(axis, kNames.size() - 1)]});
}

std::string InMessage(const std::string& field) {
  if (field.starts_with(kPoses)) {
    const bool is_root = field.find("root_position") != std::string::npos;
    return is_root ? "config.continuation.root_positions" : "config.continuation.rotations";
  }
  for (const auto& [numbered, message] : kKinds) {
    const size_t close = field.find(']');
    if (!field.starts_with(numbered) || close == std::string::npos) continue;
    const std::string rest = field.substr(close + 1);  // ".rotations[16]", or nothing
    const bool in_pose = message == kKeyframe && !rest.empty() && !IsOfKeyframe(rest.substr(1));
    return std::string(message) + (in_pose ? ".pose" : "") + rest;
  }
  return field;
}

}  // namespace

std::string PathInMessage(const std::string& field) { return WithCoordinates(InMessage(field)); }

}  // namespace choreo
