#include "client/cli/json_fields.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "model/core/error.h"
#include "model/core/json_depth.h"

namespace choreo::cli {

using nlohmann::json;

std::string Shown(const json& value) {
  std::string text = value.dump();
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

double JsonNumber(const json& value, const std::string& field) {
  if (!value.is_number()) throw InvalidArgument(field, Shown(value) + " is not a number");
  return value.get<double>();
}

std::string ReadText(const std::filesystem::path& path, const std::string& kind) {
  if (std::filesystem::is_directory(path)) {
    throw InvalidArgument(path.string(), "is a folder, not a " + kind);
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorCode::kNotFound, path.string(), "cannot be opened");
  return {std::istreambuf_iterator<char>(file), {}};
}

json ParseList(std::string_view text, const std::string& name, const std::string& list) {
  CheckJsonDepth(text, name);
  json root;
  try {
    root = json::parse(text);
  } catch (const json::exception& error) {  // numbers too large for any, too
    throw InvalidArgument(name, "is not JSON: " + std::string(error.what()));
  }
  if (!root.is_object() || !root.contains(list) || !root[list].is_array()) {
    throw InvalidArgument(name, "has no list \"" + list + '"');
  }
  if (root[list].empty()) throw InvalidArgument(name + ":" + list, "is empty");
  return root[list];
}

void CheckMembers(const json& value, const std::string& field,
                  std::initializer_list<std::string_view> members, const std::string& described) {
  if (!value.is_object()) throw InvalidArgument(field, Shown(value) + " is not an object");
  for (const auto& [member, ignored] : value.items()) {
    if (std::find(members.begin(), members.end(), member) == members.end()) {
      throw InvalidArgument(field + "." + member, "is not known; " + described);
    }
  }
}

Moment ParseMoment(const json& value, const std::string& field) {
  if (value.contains("time") == value.contains("frame")) {
    throw InvalidArgument(field + ".time", value.contains("time")
                                               ? "stands beside frame; only one may be there"
                                               : "is missing, and so is frame");
  }
  Moment moment;
  if (value.contains("frame")) {
    if (!IsFrameNumber(value["frame"])) {
      throw InvalidArgument(field + ".frame", Shown(value["frame"]) +
                                                  " is not a whole number from 0 to " +
                                                  std::to_string(kMaxFrameNumber));
    }
    moment.frame = value["frame"].get<int64_t>();
    return moment;
  }
  moment.time_s = JsonNumber(value["time"], field + ".time");
  if (!(moment.time_s >= 0))
    throw InvalidArgument(field + ".time", Shown(value["time"]) + " s is before 0");
  if (moment.time_s > kMaxSeconds)
    throw InvalidArgument(field + ".time", Shown(value["time"]) + " s is beyond 1e9 s");
  return moment;
}

}  // namespace choreo::cli
