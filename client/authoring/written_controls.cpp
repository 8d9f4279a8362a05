#include "client/authoring/written_controls.h"

#include <algorithm>
#include <charconv>

#include "client/authoring/json_fields.h"
#include "client/authoring/velocities.h"
#include "model/motion/controls.h"

namespace choreo::authoring {
namespace {

bool Has(const client::ModelDescription& model, const std::string& control) {
  return std::ranges::find(model.controls, control) != model.controls.end();
}

void RequireControl(size_t row, const std::string& field, const client::ModelDescription& model,
                    const client::ServerDescription& server) {
  const std::string control(kControls[row].name);
  if (Has(model, control)) return;
  std::string others;
  for (const client::ModelDescription& other : server.models) {
    if (Has(other, control)) others += (others.empty() ? "" : ", ") + ('"' + other.name + '"');
  }
  throw InvalidArgument(field, "the model \"" + model.name + "\" does not have this control, " +
                                   (others.empty() ? "nor has any other of the server"
                                                   : "but these of the server do: " + others));
}

ControlRequest::RootPath ReadPath(const nlohmann::json& file, const std::string& name, double fps,
                                  const Counts& counts) {
  const nlohmann::json& list = ListIn(file, name, "points");
  CheckFileMembers(file, name, {"points", "about"}, "a path file has points and perhaps about");
  if (list.size() < 2) {
    throw InvalidArgument(name + ":points", "has 1 point, a path needs at least 2");
  }
  ControlRequest::RootPath path;
  for (size_t i = 0; i < list.size(); ++i) {
    const nlohmann::json& point = list[i];
    const std::string field = name + ":points[" + std::to_string(i) + "]";
    CheckMembers(point, field, {"time", "frame", "x", "y", "z"},
                 "a point has time or frame, x, z and perhaps y");
    const auto coordinate = [&](const char* axis) {
      if (!point.contains(axis)) throw InvalidArgument(field + "." + axis, "is missing");
      return JsonNumber(point[axis], field + "." + axis);
    };
    AppendFrame(point, field, fps, counts, &path.frames);
    path.points.emplace_back(coordinate("x"), coordinate("z"));
    if (point.contains("y") != list[0].contains("y")) {
      throw InvalidArgument(field + ".y", "must be in all points or in none");
    }
    if (point.contains("y")) path.heights.push_back(coordinate("y"));
  }
  return path;
}

}  // namespace

ControlRequest::RootPath ParsePathFile(std::string_view text, const std::string& name, double fps,
                                       const Counts& counts) {
  return ReadPath(ParseJson(text, name), name, fps, counts);
}

void WrittenControls::Follow(const WrittenControls& project) {
  project_path = project.project_path;
  project_path_name = project.project_path_name;
  if (velocities.empty()) velocity_name = project.velocity_name;
  factors = project.factors;
}

ControlRequest WrittenControls::Read(const client::ModelDescription& model,
                                     const client::ServerDescription& server,
                                     const Counts& counts) const {
  ControlRequest controls;
  if (!path.empty() || !project_path.is_null()) {
    RequireControl(kRootPath, NameOf(kRootPath), model, server);
    controls.root_path = path.empty()
                             ? ReadPath(project_path, project_path_name, model.fps, counts)
                             : ParsePathFile(ReadText(path, "path file"), path, model.fps, counts);
  }
  if (!velocities.empty() || factors != PartFactors()) {
    RequireControl(kVelocityFactors, velocity_name, model, server);
    controls.velocity_factors = ReadVelocities(velocities, reference, model.fps, counts, factors);
  } else if (!reference.empty()) {
    throw InvalidArgument("velocity_factors.reference", "there is no velocity that it could be of");
  }
  return controls;
}

void WrittenControls::RequireBegun(const ControlRequest& controls,
                                   const DanceLength& length) const {
  const bool has_path = !path.empty() || !project_path.is_null();
  if (const auto& asked = controls.root_path;
      has_path && asked && asked->frames.front() >= length.frames) {
    throw InvalidArgument(
        PathName() + ":points[0]",
        "the path's first point " + DescribeAfterEnd(asked->frames.front(), length));
  }
  const auto& asked = controls.velocity_factors;
  if (!asked || asked->frames.empty() || asked->frames.front() < length.frames) return;
  const auto file = std::ranges::find_if(velocities, IsVelocityFile);
  if (file == velocities.end()) return;
  throw InvalidArgument(
      *file + (asked->speeds.empty() ? ":factors[0]" : ":speeds[0]"),
      "the velocities' first point " + DescribeAfterEnd(asked->frames.front(), length));
}

std::string WrittenControls::NameOf(size_t row) const {
  if (row == kVelocityFactors) return velocity_name;
  return path.empty() && !project_path.is_null() ? project_path_name
                                                 : std::string(kControls[row].name);
}

Error WrittenControls::InTermsOf(const Error& error) const {
  // The command sends one message: controls[0] of a stream, controls of a transition.
  std::string_view field = error.field();
  for (const std::string_view prefix : {"controls[0].", "controls."}) {
    if (!field.starts_with(prefix)) continue;
    field.remove_prefix(prefix.size());
    if (field == "velocity_factors.reference") return error.Of(std::string(field));
    const auto row =
        std::ranges::find(kControls, field.substr(0, field.find('.')), &ControlRow::name);
    if (row == std::end(kControls)) break;
    if (!field.starts_with("root_path."))
      return error.Of(NameOf(static_cast<size_t>(row - kControls)));
    const size_t bracket = field.find('[');
    size_t index = 0;
    if (bracket != std::string_view::npos)
      std::from_chars(field.data() + bracket + 1, field.data() + field.size(), index);
    // root_path.points[3] is z of the second point.
    const bool two_a_point = field.starts_with("root_path.points[");
    const char* member = field.starts_with("root_path.heights") ? ".y"
                         : !two_a_point                         ? ""
                         : index % 2 == 0                       ? ".x"
                                                                : ".z";
    return error.Of(PathName() + ":points[" + std::to_string(two_a_point ? index / 2 : index) +
                    "]" + member);
  }
  return error;
}

}  // namespace choreo::authoring
