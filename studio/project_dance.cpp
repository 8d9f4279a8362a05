#include "studio/project_dance.h"

#include <algorithm>
#include <cmath>

#include "client/arrange.h"
#include "client/authoring/keys/key_faults.h"
#include "client/authoring/keys/key_file.h"
#include "client/convert.h"
#include "client/edit.h"
#include "model/core/error.h"
#include "studio/from_page.h"
#include "studio/page_project.h"

namespace choreo::studio {
namespace {

client::EditOptions EditOptionsFor(const StudioContext& context, const Song* song,
                                   const client::DanceConfig& config) {
  client::EditOptions options;
  options.manner = config.manner;
  options.known = config.known;
  options.model = context.model();
  options.seed = config.seed.value_or(0);
  options.controls = config.controls;
  if (song) options.audio = song->audio;
  return options;
}

client::Gap GapOf(const Retake& request, const ProjectDance& dance, double fps) {
  client::Gap gap{.from = request.from(), .to = request.to()};
  for (const client::KeyPose& key : dance.keys.poses) {
    const int64_t frame = authoring::FrameOf(key, fps);
    if (frame > gap.from && frame < gap.to) gap.keys.push_back(key);
  }
  for (const ProjectKey& key : request.project().keys()) {
    if (key.key().frame() != gap.to) continue;
    gap.to_id = key.key().id();
    if (key.key().has_hit()) gap.to_hit = key.key().hit();
  }
  return gap;
}

}  // namespace

authoring::Counts CountsOf(const authoring::Project& project, const Song* song) {
  if (!project.beats.empty()) return authoring::CountsFrom(project.beats, project.ones);
  return song ? authoring::CountsOf(song->music) : authoring::Counts();
}

Error ProjectDance::InTermsOf(const Error& error) const {
  if (error.field() == "config.style") return error.Of(std::string(kUnnamed) + ":style");
  return authoring::InTermsOf(keys, controls.InTermsOf(error));
}

ProjectDance DanceOf(const StudioContext& context, const authoring::Project& project,
                     double seconds, const Song* song) {
  const client::ModelDescription& model = context.model();
  ProjectDance dance{.keys = project.keys, .controls = project.controls};
  client::DanceConfig& config = dance.config;
  config.seed = project.seed.value_or(0);
  config.manner = project;
  config.frames = std::max<int64_t>(1, std::llround(seconds * model.fps));
  config.controls = project.controls.Read(model, context.server(), CountsOf(project, song));
  if (song) {
    authoring::NoteBehind(std::string(kUnnamed) + ":beats", project.beats, 0,
                          authoring::HeardSeconds(song->music));
    config.known.music_beats = project.beats;
    config.known.music_downbeats = project.downbeats;
    authoring::FillInMusic(song->music, seconds, &config.known);
  }
  authoring::FitIntoDance({*config.frames, model.fps}, &dance.keys);
  dance.keys = authoring::ByTime(std::move(dance.keys), model.fps);
  return dance;
}

ProjectDance DanceOf(const StudioContext& context, const Project& project, const Song* song) {
  const authoring::Project read = FromPage(project, context.model());
  if (!song && !read.seconds)
    throw InvalidArgument(std::string(kUnnamed) + ":seconds", "is missing, and there is no song");
  const double most = song ? song->heard.seconds() : *read.seconds;
  return DanceOf(context, read, std::min(most, read.seconds.value_or(most)), song);
}

Response MakeTakes(const StudioContext& context, const Song* song, const Retake& request) {
  const client::ModelDescription& model = context.model();
  const ProjectDance dance = DanceOf(context, request.project(), song);
  const client::Gap gap = GapOf(request, dance, model.fps);
  const int takes =
      std::clamp(static_cast<int>(request.takes()), 1, context.server().limits.max_candidates);
  std::vector<client::EditedDance> made;
  try {
    made = client::DanceTakes(context.client(), FromProto(request.dance(), model.skeleton),
                              EditOptionsFor(context, song, dance.config), gap, takes);
  } catch (const Error& error) {
    throw dance.InTermsOf(error);
  }
  Response response;
  Takes& answer = *response.mutable_takes();
  const auto warn = [&](const client::Warning& warning) {
    *answer.add_warnings() = wire::ToProto(warning, model.fps);
  };
  for (const client::EditedDance& take : made) {
    const auto [motion, contacts] = client::PartOf(take.dance, gap.from + 1, gap.to);
    *answer.add_frames() = wire::ToProto(0, motion.frames, contacts);
    std::ranges::for_each(take.warnings, warn);
  }
  // Ways into the gap and out of it count, too.
  for (const client::Warning& fault :
       authoring::KeyFaults(dance.keys.poses, model.fps, model.skeleton))
    if (fault.frame > gap.from && fault.frame <= gap.to) warn(fault);
  return response;
}

}  // namespace choreo::studio
