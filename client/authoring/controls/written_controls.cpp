#include "client/authoring/controls/written_controls.h"

#include <algorithm>
#include <charconv>

#include "client/authoring/controls/velocities.h"

namespace choreo::authoring {
namespace {

constexpr std::string_view kPath = kControls[kRootPath].name;
constexpr std::string_view kVelocity = kControls[kVelocityFactors].name;

bool Has(const client::ModelDescription& model, const std::string& control) {
  return std::ranges::find(model.controls, control) != model.controls.end();
}

/// Whether a project's path has the form of a path file instead of the API's message.
bool HasPoints(const nlohmann::ordered_json& path) { return !path.contains("frames"); }

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

/// The place in a path file that corresponds to a field of the API's message.
std::string PlaceInFile(const std::string& name, std::string_view field) {
  const size_t bracket = field.find('[');
  size_t index = 0;
  if (bracket != std::string_view::npos)
    std::from_chars(field.data() + bracket + 1, field.data() + field.size(), index);
  // points[3] is the z of the second point.
  const bool two_a_point = field.starts_with("points[");
  const char* member = field.starts_with("heights") ? ".y"
                       : !two_a_point               ? ""
                       : index % 2 == 0             ? ".x"
                                                    : ".z";
  return name + ":points[" + std::to_string(two_a_point ? index / 2 : index) + "]" + member;
}

}  // namespace

ControlRequest::RootPath ParsePathFile(std::string_view text, const std::string& name, double fps,
                                       const Counts& counts) {
  return ReadPath(ParseJson(text, name), name, fps, counts);
}

void ReadWritten(const WrittenControl& written, double fps, const Counts& counts,
                 ControlRequest::RootPath* path) {
  const auto& [sources, reference, project, name] = written;
  if (!sources.empty()) {
    *path = ParsePathFile(ReadText(sources.front(), "path file"), sources.front(), fps, counts);
  } else if (HasPoints(project)) {
    *path = ReadPath(project, name, fps, counts);
  } else {
    ReadControlJson(project, name, path);
  }
}

void ReadWritten(const WrittenControl& written, double fps, const Counts& counts,
                 ControlRequest::VelocityFactors* velocity) {
  const auto& [sources, reference, project, name] = written;
  if (!project.is_null()) {
    ReadControlJson(project, name, velocity);
  } else if (sources.empty()) {
    throw InvalidArgument("velocity_factors.reference", "needs a velocity");
  }
  if (!sources.empty() || !reference.empty())
    *velocity = ReadVelocities(sources, reference, fps, counts, *velocity);
}

void WrittenControls::Follow(const WrittenControls& project) {
  for (const auto& [control, written] : project.controls_) {
    controls_[control].project = written.project;
    controls_[control].project_name = written.project_name;
  }
}

const nlohmann::ordered_json& WrittenControls::InProject(size_t row) const {
  static const nlohmann::ordered_json kNone;
  const auto written = controls_.find(kControls[row].name);
  return written != controls_.end() ? written->second.project : kNone;
}

const std::vector<std::string>& WrittenControls::SourcesOf(size_t row) const {
  static const std::vector<std::string> kNone;
  const auto written = controls_.find(kControls[row].name);
  return written != controls_.end() ? written->second.sources : kNone;
}

void WrittenControls::RequireControl(const std::string& control,
                                     const client::ModelDescription& model,
                                     const client::ServerDescription& server) const {
  if (Has(model, control)) return;
  std::string others;
  for (const client::ModelDescription& other : server.models) {
    if (Has(other, control)) others += (others.empty() ? "" : ", ") + ('"' + other.name + '"');
  }
  throw InvalidArgument(PlaceOf(control, ""),
                        "the model \"" + model.name + "\" does not have this control, " +
                            (others.empty() ? "and no other model of the server has it"
                                            : "but these models of the server have it: " + others));
}

void WrittenControls::RequireBegun(const ControlRequest& controls,
                                   const DanceLength& length) const {
  ControlRequest::VisitControls(
      [&](size_t row, const auto& control) {
        const std::string name(kControls[row].name);
        const auto written = controls_.find(name);
        if (written == controls_.end() || !written->second.IsGiven() || !control ||
            control->frames.empty() || control->frames.front() < length.frames)
          return;
        throw InvalidArgument(
            PlaceOf(name, "frames[0]"),
            "the first point " + DescribeAfterEnd(control->frames.front(), length));
      },
      controls);
}

std::string WrittenControls::PlaceOf(const std::string& control, std::string_view field) const {
  const auto found = controls_.find(control);
  if (found == controls_.end() || !found->second.IsGiven()) return control;
  const auto& [sources, reference, project, name] = found->second;
  const bool is_file = !sources.empty() || project.is_null();
  if (field.empty()) return is_file ? control : name;
  if (control == kPath && (is_file || HasPoints(project)))
    return PlaceInFile(is_file ? sources.front() : name, field);
  if (!is_file) return name + "." + std::string(field);
  if (control != kVelocity) return sources.front() + ":" + std::string(field);
  const auto file = std::ranges::find_if(sources, IsVelocityFile);
  return field.starts_with("frames") && file != sources.end() ? *file : control;
}

Error WrittenControls::InTermsOf(const Error& error) const {
  // Commands send one message of controls: controls[0] of a stream, or controls of a transition.
  std::string_view field = error.field();
  for (const std::string_view prefix : {"controls[0].", "controls."}) {
    if (!field.starts_with(prefix)) continue;
    field.remove_prefix(prefix.size());
    if (field == "velocity_factors.reference") return error.Of(std::string(field));
    const size_t dot = std::min(field.find('.'), field.size());
    const std::string control(field.substr(0, dot));
    if (!controls_.contains(control)) break;
    return error.Of(PlaceOf(control, field.substr(std::min(dot + 1, field.size()))));
  }
  return error;
}

}  // namespace choreo::authoring
