#include "studio/project_document.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "client/authoring/dance_keys.h"
#include "client/authoring/dancers.h"
#include "client/authoring/json_fields.h"
#include "client/authoring/key_faults.h"
#include "client/authoring/key_file.h"
#include "client/authoring/project_file.h"
#include "client/convert.h"
#include "model/core/field.h"
#include "model/core/limits.h"
#include "model/motion/pose_limits.h"
#include "proto/wire/control_messages.h"
#include "studio/from_page.h"
#include "studio/scratch_folder.h"

namespace choreo::studio {
namespace {

using google::protobuf::RepeatedPtrField;

/// Throws unless the keys fit any dance.
void CheckKeys(const authoring::DanceKeys& keys, double fps, const Skeleton& skeleton) {
  int64_t before = -kMinKeyDistance;
  for (size_t i = 0; i < keys.poses.size(); ++i) {
    const int64_t frame = authoring::FrameOf(keys.poses[i], fps);
    const std::string when = authoring::FieldOf(keys.places[i], ".time");
    authoring::CheckInADance(static_cast<double>(frame) / fps, when);
    CheckPoseLimits(keys.poses[i].pose, kMaxRotation, "2π", keys.places[i]);
    if (frame - before < kMinKeyDistance) {
      throw InvalidArgument(when, "key \"" + keys.poses[i].id + "\" stands closer than " +
                                      std::to_string(kMinKeyDistance) + " frames to \"" +
                                      keys.poses[i - 1].id + "\"");
    }
    before = frame;
  }
  authoring::RefuseHeldInAir(keys, fps, skeleton);
}

void AddKeys(authoring::DanceKeys keys, const StudioContext& context,
             RepeatedPtrField<ProjectKey>* out) {
  const double fps = context.model().fps;
  keys = authoring::ByTime(std::move(keys), fps);
  CheckKeys(keys, fps, context.model().skeleton);
  for (size_t i = 0; i < keys.poses.size(); ++i) {
    const int64_t frame = authoring::FrameOf(keys.poses[i], fps);
    if (authoring::IsHeld(keys.places[i])) {
      ProjectKey& held = out->at(out->size() - 1);
      held.set_hold(frame - held.key().frame());
      continue;
    }
    ProjectKey* key = out->Add();
    *key->mutable_key() = client::ToProto(keys.poses[i]);
    key->mutable_key()->set_frame(frame);
  }
}

/// Stores files in a temporary folder for reading, by name, because the page has no paths.
void Keep(const RepeatedPtrField<File>& files, const ScratchFolder& folder) {
  for (const File& file : files) {
    const std::filesystem::path name = std::filesystem::path(file.name()).filename();
    std::ofstream(folder.path() / name, std::ios::binary) << file.data();
  }
}

/// A dancer's own keys, from these files or the dancer's own text.
void AddOwnKeys(const authoring::Dancer& dancer, const ScratchFolder& folder,
                const StudioContext& context, const authoring::Counts& counts, StageDancer* out) {
  out->set_has_keys(!dancer.keyframes.empty());
  for (const std::string& source : authoring::KeySources(dancer.keyframes)) {
    const bool is_text = source.starts_with('{');
    const std::string kept =
        is_text ? source : (folder.path() / std::filesystem::path(source).filename()).string();
    if (!is_text && !std::filesystem::exists(authoring::FileOf(kept))) {
      throw Error(ErrorCode::kNotFound, std::filesystem::path(source).filename().string(),
                  "has keys of " + dancer.id + ": open it together with the project");
    }
    try {
      authoring::DanceKeys keys;
      keys.poses = authoring::ReadKeys(kept, context.model().skeleton, &keys.places, counts);
      AddKeys(std::move(keys), context, out->mutable_keys());
    } catch (const Error& error) {
      const std::string path = folder.path().string() + "/";
      throw error.field().starts_with(path) ? error.Of(error.field().substr(path.size())) : error;
    }
  }
}

/// A seed that the page can represent, because its numbers are doubles.
uint64_t ForPage(uint64_t seed, const std::string& field) {
  constexpr uint64_t kMost = (uint64_t{1} << 53) - 1;
  if (seed <= kMost) return seed;
  throw InvalidArgument(field, std::to_string(seed) + " is beyond " + std::to_string(kMost) +
                                   ", the largest that the studio knows");
}

void AddDancers(const ProjectFile& request, const nlohmann::json& file,
                const StudioContext& context, const authoring::Counts& counts, Project* out) {
  const ScratchFolder folder;
  Keep(request.key_files(), folder);
  const authoring::Dancers stage = authoring::ParseDancers(file, request.file().name(), "");
  out->set_apart(stage.apart);
  for (const authoring::Dancer& dancer : stage.dancers) {
    const std::string field = At(request.file().name() + ":dancers", out->dancers_size());
    StageDancer* added = out->add_dancers();
    added->set_id(dancer.id);
    added->set_x(dancer.place.x());
    added->set_z(dancer.place.y());
    added->set_facing(dancer.facing);
    added->set_mirrored(dancer.mirrored);
    added->set_after(dancer.after ? dancer.after->amount : 0);
    added->set_in_counts(dancer.after && dancer.after->counts);
    if (dancer.seed) added->set_seed(ForPage(*dancer.seed, field + ".seed"));
    added->set_style(dancer.style);
    AddOwnKeys(dancer, folder, context, counts, added);
  }
}

/// Reads a project, except for keys and dancers.
void AddSettings(const authoring::Project& read, const std::string& name,
                 const StudioContext& context, const authoring::Counts& counts, Project* out) {
  out->set_song(read.song);
  if (read.seconds) out->set_seconds(*read.seconds);
  if (read.seed) out->set_seed(ForPage(*read.seed, name + ":seed"));
  wire::Write(read, out);
  if (!read.beats.empty()) {
    out->mutable_beats()->set_bar(static_cast<uint32_t>(read.bar));
    out->mutable_beats()->mutable_times()->Add(read.beats.begin(), read.beats.end());
    out->mutable_beats()->mutable_counts()->Add(read.counts.begin(), read.counts.end());
  }
  const ControlRequest controls = read.controls.Read(context.model(), context.server(), counts);
  if (controls.root_path && !controls.root_path->heights.empty()) {
    throw InvalidArgument(read.controls.PlaceOf("root_path", "heights[0]"),
                          "is a height: the studio's paths lie on the floor");
  }
  const auto& velocity = controls.velocity_factors;
  if (velocity && !(velocity->frames.empty() && velocity->speeds.empty())) {
    throw InvalidArgument(
        read.controls.PlaceOf("velocity_factors", ""),
        "changes, or is in metres: in the studio a factor is for the whole dance");
  }
  *out->mutable_controls() = wire::ToProto(controls);
  for (const authoring::Marker& marker : read.markers) {
    Marker* added = out->add_markers();
    added->set_frame(std::llround(marker.time_s * context.model().fps));
    added->set_name(marker.name);
  }
}

}  // namespace

Response ReadProject(const StudioContext& context, const ProjectFile& request) {
  const std::string& name = request.file().name();
  const nlohmann::json file = authoring::ParseJson(request.file().data(), name);
  const bool is_project = file.is_object() && file.contains("studio");
  authoring::Counts counts = CountsIn(request);
  Response response;
  Project* out = response.mutable_project();
  authoring::Project read;
  if (is_project) {
    read = authoring::ParseProject(file, name);
    if (!read.beats.empty()) counts = authoring::CountsFrom(read.beats, read.ones);
    AddSettings(read, name, context, counts, out);
  }
  if (read.has_keys || !is_project) {
    authoring::DanceKeys keys;
    keys.poses = authoring::KeysIn(file, name, context.model().skeleton, &keys.places, counts);
    AddKeys(std::move(keys), context, out->mutable_keys());
  }
  if (read.has_dancers) AddDancers(request, file, context, counts, out);
  return response;
}

}  // namespace choreo::studio
