#include "studio/project_calls.h"

#include <openssl/evp.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <cmath>
#include <fstream>
#include <string_view>
#include <utility>
#include <vector>

#include "client/authoring/fields/json_fields.h"
#include "client/authoring/keys/key_faults.h"
#include "client/authoring/keys/key_file.h"
#include "client/authoring/notes/notes.h"
#include "client/authoring/project/project_file.h"
#include "model/core/files/small_extension.h"
#include "model/core/rounded.h"
#include "model/formats/bvh/bvh.h"
#include "studio/page_project.h"
#include "studio/project_dance.h"
#include "studio/scratch_folder.h"

namespace choreo::studio {
namespace {

using nlohmann::json;

constexpr int kAtOnce = 2;
constexpr int kMaxRequests = 4;  // requests running or waiting

std::string FromBase64(const std::string& text, const std::string& field) {
  std::string out(text.size(), '\0');
  const int size = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(out.data()),
                                   reinterpret_cast<const unsigned char*>(text.data()),
                                   static_cast<int>(text.size()));
  if (size < 0) throw InvalidArgument(field, "is not base64");
  const size_t padding = text.size() - std::min(text.size(), text.find_last_not_of('=') + 1);
  out.resize(static_cast<size_t>(size) - std::min<size_t>(padding, static_cast<size_t>(size)));
  return out;
}

/// Moves a project's song, if any, out of `file`.
std::optional<Song> ExtractSong(json* file, const std::string& name, double most_seconds) {
  const std::string field = std::string(kUnnamed) + ":song_data";
  if (!file->contains("song_data")) {
    if (name.empty()) return std::nullopt;
    throw InvalidArgument(field, "is missing beside song: the file's bytes in base64");
  }
  const json data = std::exchange((*file)["song_data"], nullptr);
  if (!data.is_string()) throw InvalidArgument(field, "is not a text");
  if (name.empty())
    throw InvalidArgument(std::string(kUnnamed) + ":song", "is missing beside song_data");
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / ("song" + SmallExtension(name));
  std::ofstream(path, std::ios::binary) << FromBase64(data.get_ref<const std::string&>(), field);
  return HearSong(path, name, most_seconds);
}

/// Six decimals are enough for bodies.
double Short(double value) { return std::round(value * 1e6) / 1e6; }

json Vectors(const Eigen::Matrix3Xd& columns) {
  json out = json::array();
  for (const auto& column : columns.colwise())
    out.push_back({Short(column.x()), Short(column.y()), Short(column.z())});
  return out;
}

/// What is noted about a project's beats, and about its song.
std::vector<std::string> NotesOn(const authoring::Project& project, const Song* song,
                                 const std::vector<std::string>& lines) {
  constexpr std::string_view kMark = "note: ";
  std::vector<std::string> notes;
  for (const std::string& line : lines)
    notes.push_back(line.starts_with(kMark) ? line.substr(kMark.size()) : line);
  if (!song) return notes;
  for (const std::string& note : song->heard.notes()) notes.push_back(project.song + ": " + note);
  return notes;
}

std::string DanceJson(const client::DanceResult& dance, const std::vector<std::string>& notes) {
  json out = {{"frame_rate", dance.motion.fps}, {"joints", dance.header.skeleton.joint_names}};
  json& roots = out["root_positions"] = json::array();
  json& rotations = out["rotations"] = json::array();
  json& warnings = out["warnings"] = json::array();
  for (const Pose& pose : dance.motion.frames) {
    roots.push_back(Vectors(pose.root_position)[0]);
    rotations.push_back(Vectors(pose.rotations));
  }
  for (const client::Warning& warning : dance.warnings)
    warnings.push_back({{"frame", warning.frame}, {"message", warning.message}});
  out["notes"] = notes;
  return out.dump();
}

unsigned StatusOf(ErrorCode code) {
  switch (code) {
    case ErrorCode::kResourceExhausted:
    case ErrorCode::kUnavailable:
    case ErrorCode::kCancelled:
    case ErrorCode::kDeadlineExceeded:
      return 503;
    case ErrorCode::kInternal:
      return 500;
    default:
      return 400;
  }
}

}  // namespace

ProjectCalls::ProjectCalls(const StudioContext& context) : context_(context), threads_(kAtOnce) {}

ProjectCalls::~ProjectCalls() {
  ends_ = true;
  threads_.join();
}

ProjectCalls::Reply ProjectCalls::Refuse(unsigned status, const std::string& message) {
  // The client's text may be invalid UTF-8.
  const json body = {{"error", message}};
  return {.status = status, .body = body.dump(-1, ' ', false, json::error_handler_t::replace)};
}

ProjectCalls::Reply ProjectCalls::Model() const {
  const client::ModelDescription& model = context_.model();
  const json out = {{"name", model.name},
                    {"frame_rate", model.fps},
                    {"joints", model.skeleton.joint_names},
                    {"parents", model.skeleton.parents},
                    {"offsets", Vectors(model.skeleton.offsets)},
                    {"pelvis_height", Short(model.skeleton.pelvis_height)},
                    {"styles", model.styles},
                    {"most_seconds", context_.most_seconds()}};
  return {.body = out.dump()};
}

void ProjectCalls::Dance(std::string project, bool as_bvh, Answer answer) {
  if (requests_ >= kMaxRequests) {
    return answer(Refuse(503, std::to_string(kMaxRequests) +
                                  " dances are in progress or waiting, the most; try again later"));
  }
  ++requests_;
  boost::asio::post(threads_,
                    [this, project = std::move(project), as_bvh, answer = std::move(answer)] {
                      Reply reply;
                      try {
                        reply = Danced(project, as_bvh);
                      } catch (const Error& error) {
                        reply = Refuse(StatusOf(error.code()), error.what());
                      } catch (const std::exception& error) {
                        reply = Refuse(500, error.what());
                      }
                      --requests_;
                      answer(std::move(reply));
                    });
}

ProjectCalls::Reply ProjectCalls::Danced(const std::string& text, bool as_bvh) const {
  const client::ModelDescription& model = context_.model();
  json file = authoring::ParseJson(text, kUnnamed);
  authoring::Project project = authoring::ParseProject(file, kUnnamed);
  const std::optional<Song> song = ExtractSong(&file, project.song, context_.most_seconds());
  authoring::RequireSong(project, project.song, kUnnamed);
  if (!song && !project.seconds)
    throw InvalidArgument(std::string(kUnnamed) + ":seconds", "is missing, and there is no song");
  // An answer must fit into memory.
  if (project.seconds && *project.seconds > context_.most_seconds()) {
    throw InvalidArgument(std::string(kUnnamed) + ":seconds",
                          Rounded(*project.seconds) + " is beyond " +
                              Rounded(context_.most_seconds()) + ", the longest allowed");
  }
  double seconds = project.seconds.value_or(context_.most_seconds());
  if (song) seconds = std::min(seconds, song->heard.seconds());

  const Song* heard = song ? &*song : nullptr;
  if (project.has_keys)
    project.keys.poses = authoring::KeysIn(file, kUnnamed, model.skeleton, &project.keys.places,
                                           CountsOf(project, heard));
  authoring::NotesApart noted;
  const ProjectDance requested = DanceOf(context_, project, seconds, heard);
  project.controls.RequireBegun(requested.config.controls, {*requested.config.frames, model.fps});
  authoring::RefuseHeldInAir(requested.keys, model.fps, model.skeleton);
  client::Audio audio;
  if (song && model.takes_music) audio = authoring::AudioFor(song->music.audio, seconds);
  client::DanceResult dance;
  try {
    dance = context_.client().Dance(
        requested.config, requested.keys.poses, audio, [this](const client::Message&) {
          if (ends_) throw Error(ErrorCode::kCancelled, "", "the studio is closing");
        });
  } catch (const Error& error) {
    throw requested.InTermsOf(error);
  }
  for (client::Warning& fault : authoring::KeyFaults(requested.keys, model.fps, model.skeleton))
    dance.warnings.push_back(std::move(fault));
  if (project.has_dancers)
    dance.warnings.push_back({.message = "dancers: this is the dance that they share"});
  if (!as_bvh) return {.body = DanceJson(dance, NotesOn(project, heard, noted.lines()))};
  return {.type = "text/plain", .body = BvhText(MotionToBvh(dance.header.skeleton, dance.motion))};
}

}  // namespace choreo::studio
