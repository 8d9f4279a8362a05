#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "client/authoring/fields/control_json.h"
#include "client/authoring/fields/counts.h"
#include "client/authoring/fields/json_fields.h"
#include "client/authoring/keys/dance_keys.h"
#include "client/choreo_client.h"
#include "model/motion/controls/controls.h"

/// The controls of a dance as people write them, in options, files and projects.
namespace choreo::authoring {

/// Parses a path file, JSON, as described in docs/song.md, with times up to an hour. A smooth curve
/// leads through its points. `fps`: the model's. `counts`: the music's, for times in counts.
///
/// Throws Error(kInvalidArgument) whose field is NAME:points[i].MEMBER, naming value and limit.
ControlRequest::RootPath ParsePathFile(std::string_view text, const std::string& name, double fps,
                                       const Counts& counts = {});

/// One control, as written in its option or else in a project.
struct WrittenControl {
  std::vector<std::string> sources = {};  ///< a file; for velocities: sources of ReadVelocities
  std::string reference = {};             ///< of ReadVelocities
  nlohmann::ordered_json project = {};    ///< from ControlJson, or the content of a path file
  std::string project_name = {};          ///< the name of `project` in errors

  bool IsGiven() const { return !sources.empty() || !project.is_null() || !reference.empty(); }
};

/// Reads a written control. Each control may have a form that is easier to write than its fields.
void ReadWritten(const WrittenControl& written, double fps, const Counts& counts,
                 ControlRequest::RootPath* path);
void ReadWritten(const WrittenControl& written, double fps, const Counts& counts,
                 ControlRequest::VelocityFactors* velocity);
template <typename Control>
void ReadWritten(const WrittenControl& written, double /*fps*/, const Counts& /*counts*/,
                 Control* control) {
  if (written.sources.empty())
    return ReadControlJson(written.project, written.project_name, control);
  const std::string& file = written.sources.front();
  ReadControlJson(ParseJson(ReadText(file, "control's file"), file), file, control);
}

/// All controls of a dance, as written. Errors name the place in a file, or the control by its API
/// name.
class WrittenControls {
 public:
  /// The written control, by its name in kControls.
  WrittenControl& operator[](std::string_view control) { return controls_[std::string(control)]; }

  /// The project's JSON for the control of this row of kControls, or null.
  const nlohmann::ordered_json& InProject(size_t row) const;
  /// Adds the project's controls that are not written here.
  void Follow(const WrittenControls& project);
  /// The values of the option of this row of kControls.
  const std::vector<std::string>& SourcesOf(size_t row) const;
  bool IsOption(size_t row) const { return !SourcesOf(row).empty(); }
  /// Reads the controls. Throws as ParsePathFile and ReadVelocities do, Error(kNotFound) for a
  /// missing file, and Error(kInvalidArgument) for a control that the model lacks, naming the
  /// server's models that have it.
  template <typename Request = ControlRequest>
  Request Read(const client::ModelDescription& model, const client::ServerDescription& server,
               const Counts& counts = {}, std::span<const ControlRow> rows = kControls) const {
    Request request;
    Request::VisitControls(
        [&](size_t row, auto& control) {
          const auto written = controls_.find(rows[row].name);
          if (written == controls_.end() || !written->second.IsGiven()) return;
          RequireControl(written->first, model, server);
          ReadWritten(written->second, model.fps, counts, &control.emplace());
        },
        request);
    return request;
  }
  /// Throws Error(kInvalidArgument) for a control that begins after the dance's end, naming its
  /// first point: it was written for another dance. Checks only the controls written here.
  void RequireBegun(const ControlRequest& controls, const DanceLength& length) const;
  /// Translates an error about sent controls to the places where they were written. Returns other
  /// errors unchanged.
  Error InTermsOf(const Error& error) const;
  /// The name, in errors, of a control's field such as "points[3]"; an empty field is the control
  /// itself.
  std::string PlaceOf(const std::string& control, std::string_view field) const;

 private:
  void RequireControl(const std::string& control, const client::ModelDescription& model,
                      const client::ServerDescription& server) const;

  std::map<std::string, WrittenControl, std::less<>> controls_;
};

}  // namespace choreo::authoring
