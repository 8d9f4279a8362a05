#include "studio/page_project.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "client/authoring/fields/json_fields.h"
#include "client/authoring/keys/key_faults.h"
#include "client/authoring/keys/key_file.h"
#include "client/convert.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"
#include "model/core/text/field.h"
#include "model/motion/pose/pose_limits.h"
#include "proto/wire/control_messages.h"
#include "proto/wire/convert.h"
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

void AddKeys(authoring::DanceKeys keys, const client::ModelDescription& model,
             RepeatedPtrField<ProjectKey>* out) {
  keys = authoring::ByTime(std::move(keys), model.fps);
  CheckKeys(keys, model.fps, model.skeleton);
  for (size_t i = 0; i < keys.poses.size(); ++i) {
    const int64_t frame = authoring::FrameOf(keys.poses[i], model.fps);
    if (authoring::IsHeld(keys.places[i])) {
      ProjectKey& held = out->at(out->size() - 1);
      held.set_hold(frame - held.key().frame());
      continue;
    }
    ProjectKey* key = out->Add();
    *key->mutable_key() = client::ToProto(keys.poses[i]);
    key->mutable_key()->set_frame(authoring::FrameForKey(frame));
  }
}

/// A seed that the page can represent, because its numbers are doubles.
uint64_t ForPage(uint64_t seed, const std::string& field) {
  constexpr uint64_t kMost = (uint64_t{1} << 53) - 1;
  if (seed <= kMost) return seed;
  throw InvalidArgument(field, std::to_string(seed) + " is beyond " + std::to_string(kMost) +
                                   ", the largest that the studio knows");
}

v1::Controls ForPage(const authoring::WrittenControls& written, const StudioContext& context,
                     const authoring::Counts& counts) {
  const ControlRequest controls = written.Read(context.model(), context.server(), counts);
  if (controls.root_path && !controls.root_path->heights.empty()) {
    throw InvalidArgument(written.PlaceOf("root_path", "heights[0]"),
                          "is a height: the studio's paths lie on the floor");
  }
  const auto& velocity = controls.velocity_factors;
  if (velocity && !(velocity->frames.empty() && velocity->speeds.empty())) {
    throw InvalidArgument(
        written.PlaceOf("velocity_factors", ""),
        "changes, or is in metres: in the studio a factor is for the whole dance");
  }
  return wire::ToProto(controls);
}

void AddDancers(const authoring::Dancers& stage, const std::string& name,
                const client::ModelDescription& model, Project* out) {
  out->set_apart(stage.apart);
  for (const authoring::Dancer& dancer : stage.dancers) {
    const std::string field = At(name + ":dancers", out->dancers_size());
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
    added->set_has_keys(dancer.own_keys.has_value());
    if (dancer.own_keys) AddKeys(*dancer.own_keys, model, added->mutable_keys());
  }
}

/// `name`: the file's. `counts`: the music's, for controls.
Project ToPage(const authoring::Project& project, const std::string& name,
               const StudioContext& context, const authoring::Counts& counts) {
  Project out;
  out.set_song(project.song);
  if (project.seconds) out.set_seconds(*project.seconds);
  if (project.seed) out.set_seed(ForPage(*project.seed, name + ":seed"));
  wire::Write(project, &out);
  if (!project.beats.empty()) {
    out.mutable_beats()->set_bar(static_cast<uint32_t>(project.bar));
    out.mutable_beats()->mutable_times()->Add(project.beats.begin(), project.beats.end());
    out.mutable_beats()->mutable_counts()->Add(project.counts.begin(), project.counts.end());
  }
  *out.mutable_controls() = ForPage(project.controls, context, counts);
  for (const authoring::Marker& marker : project.markers) {
    Marker* added = out.add_markers();
    added->set_frame(std::llround(marker.time_s * context.model().fps));
    added->set_name(marker.name);
  }
  AddKeys(project.keys, context.model(), out.mutable_keys());
  if (project.has_dancers) AddDancers(project.stage, name, context.model(), &out);
  return out;
}

/// Stores files in a temporary folder for reading, by name, because the page has no paths.
void Keep(const RepeatedPtrField<File>& files, const ScratchFolder& folder) {
  for (const File& file : files) {
    const std::filesystem::path name = std::filesystem::path(file.name()).filename();
    std::ofstream(folder.path() / name, std::ios::binary) << file.data();
  }
}

/// A dancer's own keys, from these files or the dancer's own text.
authoring::DanceKeys ReadOwnKeys(const authoring::Dancer& dancer, const ScratchFolder& folder,
                                 const Skeleton& skeleton, const authoring::Counts& counts) {
  const std::string ours = folder.path().string() + "/";
  const auto named = [&](const std::string& place) {
    return place.starts_with(ours) ? place.substr(ours.size()) : place;
  };
  authoring::DanceKeys own;
  for (const std::string& source : authoring::KeySources(dancer.keyframes)) {
    const bool is_text = source.starts_with('{');
    const std::string kept =
        is_text ? source : (folder.path() / std::filesystem::path(source).filename()).string();
    if (!is_text && !std::filesystem::exists(authoring::FileOf(kept))) {
      throw Error(ErrorCode::kNotFound, std::filesystem::path(source).filename().string(),
                  "has keys of " + dancer.id + ": open it together with the project");
    }
    try {
      std::vector<std::string> places;
      std::ranges::move(authoring::ReadKeys(kept, skeleton, &places, counts),
                        std::back_inserter(own.poses));
      std::ranges::transform(places, std::back_inserter(own.places), named);
    } catch (const Error& error) {
      throw error.Of(named(error.field()));
    }
  }
  return own;
}

authoring::DanceKeys KeysFrom(const RepeatedPtrField<ProjectKey>& messages, const std::string& name,
                              const client::ModelDescription& model) {
  authoring::DanceKeys keys;
  for (int i = 0; i < messages.size(); ++i) {
    const std::string place = At(name + ":keyframes", i);
    client::KeyPose key = FromProto(messages[i].key(), model.skeleton, place, place);
    // As a file says it, so that a held pose is held on the same frames.
    key.time_s = authoring::SecondsOf(authoring::FrameOf(key, model.fps), model.fps);
    key.frame.reset();
    std::vector<client::KeyPose> held;
    if (messages[i].hold() != 0) {
      const double until = key.time_s + authoring::SecondsOf(messages[i].hold(), model.fps);
      held = authoring::Holding(&key, until - key.time_s, authoring::HoldOf(place));
    }
    keys.poses.push_back(std::move(key));
    keys.places.push_back(place);
    std::ranges::move(held, std::back_inserter(keys.poses));
    keys.places.resize(keys.poses.size(), authoring::HoldOf(place));
  }
  authoring::RequireOwnIds(keys.poses, keys.places);
  return keys;
}

authoring::WrittenControls ControlsFrom(const v1::Controls& message, const std::string& name) {
  const ControlRequest controls = wire::FromProto(message, name + ".controls");
  authoring::WrittenControls written;
  ControlRequest::VisitControls(
      [&](size_t row, const auto& control) {
        if (!control) return;
        const std::string member(kControls[row].name);
        written[member].project = authoring::ControlJson(*control);
        written[member].project_name = name + ":controls." + member;
      },
      controls);
  return written;
}

}  // namespace

Response ReadProject(const StudioContext& context, const ProjectFile& request) {
  const std::string& name = request.file().name();
  const Skeleton& skeleton = context.model().skeleton;
  const nlohmann::json file = authoring::ParseJson(request.file().data(), name);
  const bool is_project = file.is_object() && file.contains("studio");
  authoring::Counts counts = CountsIn(request);
  authoring::Project read;
  if (is_project) read = authoring::ParseProject(file, name);
  if (!read.beats.empty()) counts = authoring::CountsFrom(read.beats, read.ones);
  if (read.has_keys || !is_project)
    read.keys.poses = authoring::KeysIn(file, name, skeleton, &read.keys.places, counts);
  if (read.has_dancers) {
    const ScratchFolder folder;
    Keep(request.key_files(), folder);
    read.stage = authoring::ParseDancers(file, name, "");
    for (authoring::Dancer& dancer : read.stage.dancers)
      if (!dancer.keyframes.empty())
        dancer.own_keys = ReadOwnKeys(dancer, folder, skeleton, counts);
  }
  Response response;
  *response.mutable_project() = ToPage(read, name, context, counts);
  return response;
}

Response WriteProject(const StudioContext& context, const Project& project) {
  const client::ModelDescription& model = context.model();
  authoring::Project read = FromPage(project, model);
  if (project.dancers_size() > 0) read.stage = StageOf(project);
  for (int i = 0; i < project.dancers_size(); ++i)
    if (project.dancers(i).has_keys())
      read.stage.dancers[static_cast<size_t>(i)].own_keys =
          KeysFrom(project.dancers(i).keys(), At(std::string(kUnnamed) + ":dancers", i), model);
  ProjectFile written;
  written.mutable_file()->set_name(kUnnamed);
  written.mutable_file()->set_data(
      authoring::ProjectText(authoring::ProjectJson(read, model.skeleton, model.fps)));
  ReadProject(context, written);
  Response response;
  *response.mutable_file() = std::move(*written.mutable_file());
  return response;
}

authoring::Project FromPage(const Project& message, const client::ModelDescription& model) {
  const std::string name = kUnnamed;
  authoring::Project project;
  project.song = message.song();
  static_cast<DanceManner&>(project) = wire::MannerOf(message);
  if (message.has_seconds()) project.seconds = message.seconds();
  if (message.has_seed()) project.seed = message.seed();
  if (const Beats& beats = message.beats(); message.has_beats())
    project.SetBeats({beats.times().begin(), beats.times().end()},
                     {beats.counts().begin(), beats.counts().end()}, static_cast<int>(beats.bar()),
                     name);
  project.controls = ControlsFrom(message.controls(), name);
  for (const Marker& marker : message.markers())
    project.markers.push_back({authoring::SecondsOf(marker.frame(), model.fps), marker.name()});
  authoring::CheckProject(project, name);
  project.has_keys = !message.keys().empty();
  project.keys = KeysFrom(message.keys(), name, model);
  return project;
}

authoring::Dancers StageOf(const Project& message) {
  authoring::Dancers stage{.dancers = {}, .apart = message.apart()};
  for (const StageDancer& item : message.dancers()) {
    const std::string field = At(std::string(kUnnamed) + ":dancers", std::ssize(stage.dancers));
    authoring::Dancer& dancer = stage.dancers.emplace_back();
    dancer.id = item.id();
    dancer.place = {item.x(), item.z()};
    dancer.facing = item.facing();
    dancer.mirrored = item.mirrored();
    if (item.after() != 0)
      dancer.after = authoring::ParseTime(InFull(item.after()) + (item.in_counts() ? "c" : ""),
                                          field + ".after");
    if (item.has_seed()) dancer.seed = item.seed();
    dancer.style = item.style();
  }
  authoring::CheckDancers(stage, kUnnamed);
  return stage;
}

}  // namespace choreo::studio
