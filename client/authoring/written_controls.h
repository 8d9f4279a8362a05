#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "client/authoring/control_json.h"
#include "client/authoring/counts.h"
#include "client/authoring/dance_keys.h"
#include "client/authoring/json_fields.h"
#include "client/choreo_client.h"
#include "model/motion/controls.h"

/// The controls of a dance as people write them down.
namespace choreo::authoring {

/// A path file, JSON, as docs/song.md describes it; times up to an hour. A smooth curve leads
/// through its points. Models run at `fps`. `counts`: those of the music, for times in
/// counts.
///
/// Throws Error(kInvalidArgument) whose field is NAME:points[i].MEMBER, naming value and limit.
ControlRequest::RootPath ParsePathFile(std::string_view text, const std::string& name, double fps,
                                       const Counts& counts = {});

/// One control: what its option says, or else a project.
struct WrittenControl {
  std::vector<std::string> sources = {};  ///< a file; velocities: as ReadVelocities takes them
  std::string reference = {};             ///< of velocities, likewise
  nlohmann::json project = {};            ///< as ControlJson has it, or what a path file has
  std::string project_name = {};          ///< its name in errors

  bool IsGiven() const { return !sources.empty() || !project.is_null() || !reference.empty(); }
};

/// Read what is written of a control. Some have a form that is easier to write than their fields.
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

/// The controls of every dance. Errors name the place in a file, or a control as the API does.
class WrittenControls {
 public:
  /// By the control's name in kControls.
  WrittenControl& operator[](std::string_view control) { return controls_[std::string(control)]; }

  /// Adds a project's settings that these options do not give.
  void Follow(const WrittenControls& project);
  /// What the option of a row of kControls says.
  const std::vector<std::string>& SourcesOf(size_t row) const;
  bool IsOption(size_t row) const { return !SourcesOf(row).empty(); }
  /// Throws Error as ParsePathFile and ReadVelocities do, Error(kNotFound) for a file that is not
  /// there, and Error(kInvalidArgument) for a control that the model does not have, naming those of
  /// the server that do.
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
  /// Throws Error(kInvalidArgument) naming the first point of a control that begins after the end
  /// of a dance, which it is not meant for; of those given here alone.
  void RequireBegun(const ControlRequest& controls, const DanceLength& length) const;
  /// Translates an error about sent controls to the written ones; returns others unchanged.
  Error InTermsOf(const Error& error) const;
  /// How errors call a field of a control, such as "points[3]"; "": the control.
  std::string PlaceOf(const std::string& control, std::string_view field) const;

 private:
  void RequireControl(const std::string& control, const client::ModelDescription& model,
                      const client::ServerDescription& server) const;

  std::map<std::string, WrittenControl, std::less<>> controls_;
};

}  // namespace choreo::authoring
