#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "client/authoring/fields/control_json.h"
#include "client/authoring/keys/key_file.h"
#include "client/authoring/project/project_file.h"
#include "model/core/hand_pose.h"
#include "model/motion/controls/controls.h"

namespace choreo::authoring {
namespace {

using nlohmann::ordered_json;

/// A number as people write it: 2, not 2.0.
ordered_json Number(double value) {
  const bool is_whole = std::abs(value) < 1e9 && std::round(value) == value;
  const bool is_minus_zero = value == 0 && std::signbit(value);
  return is_whole && !is_minus_zero ? ordered_json(std::llround(value)) : ordered_json(value);
}

/// The fewest digits that give the same float when read.
ordered_json Float(double exact) {
  const auto value = static_cast<float>(exact);
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
  double digits = 0;
  std::from_chars(std::begin(text), end, digits);
  return Number(static_cast<float>(digits) == value ? digits : double{value});
}

/// Writes all floats within a JSON value with the fewest digits that preserve them.
ordered_json AsFloats(ordered_json value) {
  if (value.is_number_float()) return Float(value.get<double>());
  if (value.is_structured())
    for (ordered_json& part : value) part = AsFloats(std::move(part));
  return value;
}

/// `held`: for how many frames the dancer holds the pose.
ordered_json KeyJson(const client::KeyPose& key, int64_t held, const Skeleton& skeleton,
                     double fps) {
  const auto time = [fps](int64_t frames) { return Number(SecondsOf(frames, fps)); };
  ordered_json written = {{"id", key.id}, {"time", time(FrameOf(key, fps))}};
  if (held != 0) written["hold"] = time(held);
  if (key.hit && (held == 0 || *key.hit != kUsualHit)) written["hit"] = Number(*key.hit);
  if (key.hands) written["hands"] = kHandPoseNames[static_cast<size_t>(*key.hands)];
  for (size_t joint = 0; joint < key.mask.joints.size(); ++joint)
    if (key.mask.joints[joint]) written["joints"].push_back(skeleton.joint_names.at(joint));
  if (const Eigen::Vector3d& root = key.pose.root_position; key.mask.root_position)
    written["root_position"] =
        ordered_json::array({Number(root.x()), Number(root.y()), Number(root.z())});
  ordered_json& rotations = written["rotations"] = ordered_json::array();
  for (const auto& turn : key.pose.rotations.colwise())
    rotations.push_back(ordered_json::array({Float(turn.x()), Float(turn.y()), Float(turn.z())}));
  return written;
}

ordered_json KeysJson(const DanceKeys& keys, const Skeleton& skeleton, double fps) {
  ordered_json list = ordered_json::array();
  for (size_t i = 0, end = 0; i < keys.poses.size(); i = end) {
    for (end = i + 1; end < keys.poses.size() && IsHeld(keys.places[end]);) ++end;
    const int64_t held = FrameOf(keys.poses[end - 1], fps) - FrameOf(keys.poses[i], fps);
    list.push_back(KeyJson(keys.poses[i], held, skeleton, fps));
  }
  return list;
}

ordered_json DancerJson(const Dancer& dancer, const Skeleton& skeleton, double fps) {
  ordered_json written = {
      {"id", dancer.id},
      {"place", ordered_json::array({Number(dancer.place.x()), Number(dancer.place.y())})}};
  if (dancer.facing != 0) written["facing"] = Number(dancer.facing);
  if (dancer.mirrored) written["mirrored"] = true;
  if (dancer.after) {
    const ordered_json after = Number(dancer.after->amount);
    written["after"] = dancer.after->counts ? ordered_json(after.dump() + " counts") : after;
  }
  if (dancer.seed) written["seed"] = *dancer.seed;
  if (!dancer.style.empty()) written["style"] = dancer.style;
  if (const auto& own = dancer.own_keys)
    written["keyframes"] =
        own->poses.empty() ? ordered_json(kNoKeys) : KeysJson(*own, skeleton, fps);
  return written;
}

std::string Readable(const nlohmann::ordered_json& value, const std::string& indent) {
  const bool is_flat =
      std::ranges::none_of(value, [](const ordered_json& part) { return part.is_structured(); });
  const bool is_line = !indent.empty() && is_flat && (value.is_array() || value.size() < 4);
  if (!value.is_structured()) return value.dump();
  const std::string next = is_line ? "" : "\n" + indent + " ";
  std::string parts;
  for (const auto& [member, part] : value.items()) {
    if (!parts.empty()) parts += is_line ? ", " : ",";
    parts += next;
    if (value.is_object()) parts += ordered_json(member).dump() + ": ";
    parts += Readable(part, indent + " ");
  }
  if (!is_line) parts += "\n" + indent;
  return value.is_object() ? "{" + parts + "}" : "[" + parts + "]";
}

}  // namespace

double SecondsOf(int64_t frame, double fps) {
  return std::round(static_cast<double>(frame) / fps * 1e5) / 1e5;
}

ordered_json ProjectJson(const Project& project, const Skeleton& skeleton, double fps) {
  ordered_json file = {{"studio", kProjectFormat}, {"song", project.song}};
  if (project.seconds) file["seconds"] = Number(*project.seconds);
  if (project.seed) file["seed"] = *project.seed;
  const auto write = [&file](const SettingRow& row, const auto& setting) {
    if constexpr (requires { setting.has_value(); }) {
      if (setting) file[row.name] = Number(*setting);
    } else {
      file[row.name] = setting;
    }
  };
  DanceManner::VisitSettings(write, project);
  if (!project.beats.empty()) {
    file["bar"] = project.bar;
    for (size_t i = 0; i < project.beats.size(); ++i)
      file["beats"].push_back(ordered_json::array({Number(project.beats[i]), project.counts[i]}));
  }
  for (size_t row = 0; row < std::size(kControls); ++row) {
    if (const ordered_json& control = project.controls.InProject(row); !control.is_null())
      file["controls"][std::string(kControls[row].name)] = AsFloats(control);
  }
  for (const Marker& marker : project.markers)
    file["markers"].push_back({{"time", Number(marker.time_s)}, {"name", marker.name}});
  if (!project.stage.dancers.empty()) {
    for (const Dancer& dancer : project.stage.dancers)
      file["dancers"].push_back(DancerJson(dancer, skeleton, fps));
    file["apart"] = Number(project.stage.apart);
  }
  file["keyframes"] = KeysJson(project.keys, skeleton, fps);
  return file;
}

std::string ProjectText(const nlohmann::ordered_json& project) {
  return Readable(project, "") + "\n";
}

}  // namespace choreo::authoring
