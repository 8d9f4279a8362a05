#include "model/papers/tables/study_dances.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "model/core/error.h"
#include "model/core/running/progress.h"
#include "model/draw/video.h"
#include "model/evaluation/judges/long_plans.h"

namespace choreo {
namespace {

constexpr int kWidth = 480, kHeight = 360;

std::filesystem::path SongOf(const PreparedClip& clip, const std::filesystem::path& songs) {
  if (songs.empty()) return {};
  for (const char* extension : {".ogg", ".wav", ".mp3"})
    if (const auto song = songs / (clip.name + extension); std::filesystem::exists(song))
      return song;
  throw Error(ErrorCode::kNotFound, "--songs",
              "no " + clip.name + ".ogg, .wav or .mp3 in " + songs.string());
}

// Where the clip's music begins in its song.
double MusicStart(const PreparedClip& clip) {
  const auto preparation = clip.notes.find("preparation");
  if (preparation == clip.notes.end()) return 0;
  return nlohmann::json::parse(preparation->second).value("music_start_s", 0.0);
}

// A dance in the middle of each clip, because dancers stand at its ends.
std::vector<LongPlan> MiddlePlans(const ModelInfo& model, const ClipSet& set, int frames) {
  const auto clips = static_cast<int>(set.clips.size());
  EvalOptions options;
  options.long_frames = frames;
  std::vector<LongPlan> plans = PlanLongDances(model, set, KeyTimes::kEqual, 3 * clips, options);
  std::erase_if(plans, [&](const LongPlan& plan) { return plan.seed / clips != 1; });
  return plans;
}

std::vector<Pose> DanceOf(const Method& method, LongPlan plan, const ClipSet& set) {
  if (method.kind == Method::Kind::kReal) return RealMotionBeside(plan, set);
  if (!method.keys) plan.keys.clear();
  plan.temperature = static_cast<float>(method.sampler->model().default_temperature);
  return Runner().DanceLong(*method.sampler, {&plan, 1}).front().poses;
}

}  // namespace

std::vector<StudyMethod> FilmDances(const ClipSet& set, std::span<const Method> methods, int frames,
                                    const std::filesystem::path& songs,
                                    const std::filesystem::path& folder) {
  const ModelInfo& model = methods.back().sampler->model();
  const std::vector<LongPlan> plans = MiddlePlans(model, set, frames);
  for (const LongPlan& plan : plans) SongOf(set.clips[plan.clip], songs);  // fails early
  std::vector<StudyMethod> films;
  const auto filmed = [](const Method& method) {
    return method.kind != Method::Kind::kInterpolation;
  };
  ProgressBar progress("filming", std::ssize(plans) * std::ranges::count_if(methods, filmed));
  for (const Method& method : methods) {
    if (!filmed(method)) continue;
    films.push_back({method.name, folder / method.name});
    std::filesystem::create_directories(films.back().folder);
    for (const LongPlan& plan : plans) {
      const PreparedClip& clip = set.clips[plan.clip];
      VideoOptions film;
      film.format = {.width = kWidth,
                     .height = kHeight,
                     .fps = model.fps,
                     .song = SongOf(clip, songs),
                     .song_start_s = MusicStart(clip) + plan.start / model.fps};
      const Motion motion{.fps = model.fps, .frames = DanceOf(method, plan, set)};
      DrawVideo({{model.skeleton, motion}}, film, films.back().folder / (clip.name + ".mp4"));
      progress.Advance(1, method.name + ", " + clip.name);
    }
  }
  progress.Finish();
  return films;
}

}  // namespace choreo
