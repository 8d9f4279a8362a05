#include "server/messages/message_error.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "model/core/text/field.h"

namespace choreo {
namespace {

/// The rest of `text` after `start`; none unless it begins with `start`.
bool Skip(std::string_view start, std::string_view* text) {
  if (!text->starts_with(start)) return false;
  text->remove_prefix(start.size());
  return true;
}

/// "keyframe.pose.rotations[16]" -> "keyframes[3].rotations[16]".
std::string Numbered(const std::string& path, int number) {
  const size_t end = std::min(path.find('.'), path.size());
  std::string kind = path.substr(0, end);
  std::string_view rest = std::string_view(path).substr(end);
  if (kind.ends_with("keyframe")) kind += 's';  // the others are plural
  if (rest != ".pose") Skip(".pose", &rest);
  return At(kind, number) + std::string(rest);
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

}  // namespace

MessageError::MessageError(const Error& error, int number, std::string key_id)
    : Error(error.Of(Numbered(error.field(), number))),
      path_(error.field()),
      key_id_(std::move(key_id)) {}

std::string PathInMessage(const Error& error) {
  const auto* of_message = dynamic_cast<const MessageError*>(&error);
  const std::string& path = of_message != nullptr ? of_message->path() : error.field();
  if (path.starts_with("config.continuation.poses")) {
    const bool is_root = path.find("root_position") != std::string::npos;
    return is_root ? "config.continuation.root_positions" : "config.continuation.rotations";
  }
  return WithCoordinates(path);
}

}  // namespace choreo
