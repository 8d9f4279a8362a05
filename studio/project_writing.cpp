#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "client/authoring/control_json.h"
#include "client/authoring/dance_keys.h"
#include "client/authoring/project_file.h"
#include "client/convert.h"
#include "model/motion/controls.h"
#include "proto/wire/control_messages.h"
#include "studio/project_document.h"

namespace choreo::studio {
namespace {

using google::protobuf::RepeatedPtrField;
using nlohmann::ordered_json;

/// A number as people write it: 2, not 2.0.
ordered_json Number(double value) {
  const bool is_whole = std::abs(value) < 1e9 && std::round(value) == value;
  const bool is_minus_zero = value == 0 && std::signbit(value);
  return is_whole && !is_minus_zero ? ordered_json(std::llround(value)) : ordered_json(value);
}

/// The fewest digits that give the same float when read.
ordered_json Number(float value) {
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
  double digits = 0;
  std::from_chars(std::begin(text), end, digits);
  return Number(static_cast<float>(digits) == value ? digits : double{value});
}

/// Writes all floats within a JSON value with the fewest digits that preserve them.
ordered_json AsFloats(ordered_json value) {
  if (value.is_number_float()) return Number(value.get<float>());
  if (value.is_structured())
    for (ordered_json& part : value) part = AsFloats(std::move(part));
  return value;
}

/// A time in readable form that gives the same frame when read.
ordered_json Seconds(int64_t frame, double fps) {
  return Number(std::round(static_cast<double>(frame) / fps * 1e5) / 1e5);
}

ordered_json KeysOf(const RepeatedPtrField<ProjectKey>& keys, const StudioContext& context) {
  const double fps = context.model().fps;
  ordered_json list = ordered_json::array();
  for (const ProjectKey& item : keys) {
    const v1::Keyframe& key = item.key();
    ordered_json& written = list.emplace_back();
    written = {{"id", key.id()}, {"time", Seconds(key.frame(), fps)}};
    if (item.hold() != 0) written["hold"] = Seconds(item.hold(), fps);
    if (key.has_hit()) written["hit"] = Number(key.hit());
    if (const auto hands = wire::FromProto(key.hands()))
      written["hands"] = kHandPoseNames[static_cast<size_t>(*hands)];
    for (const uint32_t joint : key.mask().joints())
      written["joints"].push_back(context.model().skeleton.joint_names.at(joint));
    if (key.pose().has_root_position()) {
      const v1::Vector3& root = key.pose().root_position();
      written["root_position"] =
          ordered_json::array({Number(root.x()), Number(root.y()), Number(root.z())});
    }
    ordered_json& rotations = written["rotations"] = ordered_json::array();
    for (int i = 0; i < key.pose().rotations_size(); ++i) {
      if (i % 3 == 0) rotations.emplace_back();
      rotations.back().push_back(Number(key.pose().rotations(i)));
    }
  }
  return list;
}

ordered_json DancersOf(const Project& project) {
  ordered_json dancers = ordered_json::array();
  for (const StageDancer& item : project.dancers()) {
    ordered_json& dancer = dancers.emplace_back();
    dancer = {{"id", item.id()},
              {"place", ordered_json::array({Number(item.x()), Number(item.z())})}};
    if (item.facing() != 0) dancer["facing"] = Number(item.facing());
    if (item.mirrored()) dancer["mirrored"] = true;
    if (item.after() != 0) {
      const ordered_json after = Number(item.after());
      dancer["after"] = item.in_counts() ? ordered_json(after.dump() + " counts") : after;
    }
    if (item.has_seed()) dancer["seed"] = item.seed();
    if (!item.style().empty()) dancer["style"] = item.style();
  }
  return dancers;
}

}  // namespace

ordered_json ProjectJson(const StudioContext& context, const Project& project) {
  const double fps = context.model().fps;
  ordered_json file = {{"studio", 1}, {"song", project.song()}};
  if (project.has_seconds()) file["seconds"] = Number(project.seconds());
  if (project.has_seed()) file["seed"] = project.seed();
  const auto write = [&file](const char* name, const auto& setting) {
    if constexpr (requires { setting.has_value(); }) {
      if (setting) file[name] = Number(*setting);
    } else {
      file[name] = setting;
    }
  };
  DanceManner::VisitSettings(write, wire::MannerOf(project));
  if (project.has_beats()) {
    file["bar"] = project.beats().bar();
    ordered_json& beats = file["beats"] = ordered_json::array();
    for (int i = 0; i < project.beats().times_size(); ++i)
      beats.push_back(
          ordered_json::array({Number(project.beats().times(i)), project.beats().counts(i)}));
  }
  const ControlRequest controls = wire::FromProto(project.controls(), "project.controls");
  ControlRequest::VisitControls(
      [&file](size_t row, const auto& control) {
        if (control)
          file["controls"][std::string(kControls[row].name)] =
              AsFloats(authoring::ControlJson(*control));
      },
      controls);
  for (const Marker& marker : project.markers())
    file["markers"].push_back({{"time", Seconds(marker.frame(), fps)}, {"name", marker.name()}});
  if (project.dancers_size() > 0) {
    ordered_json& dancers = file["dancers"] = DancersOf(project);
    for (int i = 0; i < project.dancers_size(); ++i) {
      const StageDancer& item = project.dancers(i);
      if (!item.has_keys()) continue;
      ordered_json& own = dancers[static_cast<size_t>(i)]["keyframes"];
      own = item.keys().empty() ? ordered_json(authoring::kNoKeys) : KeysOf(item.keys(), context);
    }
    file["apart"] = Number(project.apart());
  }
  file["keyframes"] = KeysOf(project.keys(), context);
  return file;
}

Response WriteProject(const StudioContext& context, const Project& project) {
  ProjectFile written;
  written.mutable_file()->set_name(kUnnamed);
  written.mutable_file()->set_data(authoring::ProjectText(ProjectJson(context, project)));
  ReadProject(context, written);
  Response response;
  *response.mutable_file() = std::move(*written.mutable_file());
  return response;
}

ordered_json DancersJson(const Project& project) {
  return {{"dancers", DancersOf(project)}, {"apart", Number(project.apart())}};
}

}  // namespace choreo::studio
