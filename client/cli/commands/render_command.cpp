#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "client/authoring/fields/counts.h"
#include "client/authoring/keys/motion_input.h"
#include "client/cli/commands/commands.h"
#include "client/cli/options/interruption.h"
#include "client/cli/options/options.h"
#include "client/cli/options/output_file.h"
#include "client/cli/report/dance_faults.h"
#include "client/cli/report/dance_settings.h"
#include "client/cli/report/report.h"
#include "model/core/error.h"
#include "model/core/joined.h"
#include "model/core/rounded.h"
#include "model/core/running/progress.h"
#include "model/draw/contact_sheet.h"
#include "model/draw/video.h"
#include "model/formats/motion_file.h"
#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

constexpr double kMinSheetRate = 0.1, kMaxSheetRate = 240;  // frames a second

std::string SizeText(const VideoFormat& format) {
  return std::to_string(format.width) + "x" + std::to_string(format.height);
}

struct RenderOptions {
  std::vector<std::string> motions;
  std::string out;
  std::string report;
  ContactSheetOptions sheet;
  std::optional<double> rate;  ///< frames a second of the sheet
  std::string video;
  std::string song;         ///< "none": no song, not even the report's
  std::string from, until;  ///< TIMEs; empty: from the first frame to the last
  std::string size = SizeText({});
  std::string camera;
  VideoOptions film;
};

/// A key in a dance's report.
struct DrawnKey {
  double seconds = 0;
  bool holds = false;  ///< whether it only holds the pose of an earlier key
};

/// Fills in the song and its start from the report, and prints a note. `says_start`: whether the
/// command line gives the song's start.
void FillSong(bool says_start, const DanceSettings& settings, RenderOptions* options) {
  double& start_s = options->film.format.song_start_s;
  const double said_s = start_s;
  const bool takes = settings.FillSong(options->report, says_start, "the film is silent",
                                       &options->song, &start_s);
  if (takes || start_s != said_s) {
    std::cerr << "note: as " << options->report << " says: song " << options->song << " from "
              << InFull(start_s) << " s\n";
  }
}

/// The counts of the report, of its song, or of the named song; none if no time is in counts.
authoring::Counts CountsFor(const RenderOptions& options, const DanceSettings& settings) {
  const auto in_counts = [](const std::string& time) {
    return !time.empty() && authoring::ParseTime(time, "time").counts;
  };
  if (!in_counts(options.from) && !in_counts(options.until)) return {};
  return CountsOf(settings, options.report, options.song, options.film.format.song_start_s);
}

/// Keeps only the part between --from and --until, with its keys and its part of the song.
void Cut(const DanceSettings& settings, RenderOptions* options, Scene* scene,
         std::vector<DrawnKey>* keys) {
  if (options->from.empty() && options->until.empty()) return;
  const authoring::Counts counts = CountsFor(*options, settings);
  const auto second = [&](const char* option, const std::string& time) {
    return authoring::ParseTime(time, option).In(counts, option);
  };
  if (!options->from.empty() && !options->until.empty())
    RequireBefore(second("--from", options->from), second("--until", options->until));
  const double fps = scene->front().motion.fps;
  const int64_t total = CountFrames(*scene);
  const double ends_s = static_cast<double>(total) / fps;
  const int64_t first =
      options->from.empty() ? 0 : FirstFrameFrom(second("--from", options->from), fps);
  const int64_t end = options->until.empty()
                          ? total
                          : std::min(total, FirstFrameFrom(second("--until", options->until), fps));
  if (first >= end) {
    throw InvalidArgument(options->from.empty() ? "--until" : "--from",
                          "nothing is left to draw: the motion ends at " + Rounded(ends_s) + " s");
  }
  if (!options->until.empty() && second("--until", options->until) > ends_s + 1 / fps) {
    std::cerr << "note: the motion ends at " << Rounded(ends_s) << " s, before --until "
              << options->until << '\n';
  }
  for (auto& dancer : *scene) {
    auto& frames = dancer.motion.frames;
    // A dancer whose motion ends earlier stands still, as in the whole film.
    frames.resize(static_cast<size_t>(std::max(std::ssize(frames), end)), frames.back());
    frames.erase(frames.begin() + end, frames.end());
    frames.erase(frames.begin(), frames.begin() + first);
  }
  const double first_s = static_cast<double>(first) / fps;
  const double end_s = static_cast<double>(end) / fps;
  std::erase_if(*keys, [&](const DrawnKey& key) {
    return key.seconds < first_s - kOnFrame || key.seconds >= end_s;
  });
  for (DrawnKey& key : *keys) key.seconds -= first_s;
  options->sheet.first_s = first_s;
  if (!options->song.empty()) options->film.format.song_start_s += first_s;
}

/// Resamples all motions to the first one's rate.
Scene ReadScene(const std::vector<std::string>& paths) {
  Scene scene;
  for (const std::string& path : paths) {
    Motion& motion = scene.emplace_back(authoring::ReadMotionNoting(path)).motion;
    if (motion.fps != scene.front().motion.fps) motion = Resample(motion, scene.front().motion.fps);
  }
  return scene;
}

void DrawSheet(const RenderOptions& options, const Scene& scene,
               const std::vector<DrawnKey>& keys) {
  ContactSheetOptions sheet = options.sheet;
  for (const auto& [seconds, holds] : keys) {
    if (holds) continue;  // one pose is one key
    const int64_t frame = std::llround(seconds * scene.front().motion.fps);
    if (frame < CountFrames(scene)) sheet.key_frames.push_back(frame);
  }
  if (options.rate) {
    const double fps = scene.front().motion.fps;
    sheet.step = std::max(1.0, fps / *options.rate);
    const double shown = static_cast<double>(CountFrames(scene)) / sheet.step;
    if (shown > kMaxSheetFrames) {
      throw InvalidArgument("--rate", InFull(*options.rate) + " a second make " +
                                          std::to_string(std::lround(shown)) +
                                          " pictures, must be at most " +
                                          std::to_string(kMaxSheetFrames) + " on a sheet");
    }
  }
  if (sheet.title.empty()) {
    sheet.title = Joined(options.motions, [](const std::filesystem::path& motion) {
      return motion.filename().string();
    });
  }
  if (scene.size() > 1) sheet.tile_width *= 2;
  DrawContactSheet(scene, sheet, options.out);
}

void DrawFilm(const RenderOptions& options, const Scene& scene, const std::vector<DrawnKey>& keys) {
  VideoOptions film = options.film;
  film.format.song = options.song;
  for (const DrawnKey& key : keys) film.keys.push_back(key.seconds);
  char end = 0;
  if (std::sscanf(options.size.c_str(), "%5dx%5d%c", &film.format.width, &film.format.height,
                  &end) != 2) {
    throw InvalidArgument("--size", options.size + ", must be WIDTHxHEIGHT, as in " + SizeText({}));
  }
  // Fails if the song ends before the film.
  if (film.format.song_start_s > 0)
    authoring::ReadSong(film.format.song, 1, film.format.song_start_s);
  std::unique_ptr<ProgressBar> bar;
  film.on_frame = [&](int64_t frames) {
    Interruption::Check();
    if (!bar) bar = std::make_unique<ProgressBar>("rendering", frames);
    bar->Advance();
  };
  DrawVideo(scene, film, options.video);
  bar->Finish();
}

void Run(RenderOptions options, const ReportFile& report) {
  if (options.out.empty() && options.video.empty())
    throw InvalidArgument("--out", "is missing, and so is --video: nothing to draw");
  if (options.video.empty() && !options.song.empty())
    throw InvalidArgument("--song", "pictures have no sound; it goes with --video");
  if (!options.out.empty()) RequireExtension("--out", options.out, {".png"});
  if (!options.video.empty())
    RequireExtension("--video", options.video, {kVideoExtensions.begin(), kVideoExtensions.end()});
  if (!options.camera.empty()) options.sheet.side = options.film.side = FindCamera(options.camera);
  const Interruption interruption;  // from here on there may be an incomplete file to remove
  std::vector<NamedFile> inputs = {{"--report", options.report}, {"--song", options.song}};
  for (const std::string& motion : options.motions) inputs.push_back({"motion", motion});
  RequireOutputs({{"--out", options.out}, {"--video", options.video}}, inputs);
  Scene scene = ReadScene(options.motions);
  // With several motions, the report belongs to only one of them.
  if (!options.report.empty() && scene.size() == 1)
    CheckSketch(options.report, report, scene.front().motion);
  std::vector<DrawnKey> keys;
  for (const auto& [frame, key] : report.keys)
    keys.push_back({static_cast<double>(frame) / report.fps, !key.holds.empty()});
  Cut(report.settings, &options, &scene, &keys);
  if (!options.out.empty()) DrawSheet(options, scene, keys);
  Interruption::Check();
  if (!options.video.empty()) DrawFilm(options, scene, keys);
}

}  // namespace

void AddRenderCommand(CLI::App& program) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = program.add_subcommand("render",
                                             "Draw motions on one stage, as a contact sheet "
                                             "(--out) or as a video with its song (--video).");
  command
      ->add_option("motion", options->motions,
                   MotionFileExtensions() + " file. Several are drawn together.")
      ->required()
      ->check(CLI::ExistingFile);
  CLI::Option* out =
      command->add_option("-o,--out", options->out, "Contact sheet to write, a PNG file.");
  command
      ->add_option("--report", options->report,
                   "Report of the dance: marks its key poses, and names the song of the video.")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--from", options->from,
                   "TIME at which the drawing begins: a second (2.5) of the motion, or a count "
                   "(9c) of its song.")
      ->check(TimeOrCount());
  command->add_option("--until", options->until, "TIME before which the drawing ends.")
      ->check(TimeOrCount());
  CLI::Option* frames =
      command->add_option("--frames", options->sheet.frames, "Frames to show, evenly spaced.")
          ->check(WholeNumberFrom(1, kMaxSheetFrames))
          ->capture_default_str();
  command
      ->add_option(
          "--rate", options->rate,
          "Frames a second to show on the contact sheet, in place of --frames; at most all "
          "of them.")
      ->check(NumberFrom(kMinSheetRate, kMaxSheetRate))
      ->excludes(frames)
      ->needs(out);
  command
      ->add_option("--camera", options->camera,
                   "Where the camera stands: front, three-quarter (to the left of front), side "
                   "(her left) or back, of one dancer as she faces at the start, of several as the "
                   "stage does; or follow: three-quarter, turning with one dancer. Default: "
                   "three-quarter, of several front.")
      ->check(OneOf({kCameraNames.begin(), kCameraNames.end()}));
  command->add_option("--columns", options->sheet.columns, "Frames in a row.")
      ->check(WholeNumberFrom(1, kMaxSheetColumns))
      ->capture_default_str();
  command->add_option("--title", options->sheet.title, "Heading; default: the file's name.");
  CLI::Option* video = command->add_option(
      "--video", options->video, "MP4 or WebM file to write, FILE.mp4 or FILE.webm; needs ffmpeg.");
  command
      ->add_option(
          "--song", options->song,
          "Music of the video, from the motion's first frame to the last one drawn. Default: the "
          "song that --report names, from where its dance begins. none: silence.")
      ->check(SongOrNone());
  AddSongStart(*command, options->film.format.song_start_s);
  command->add_option("--fps", options->film.format.fps, "Frames a second of the video.")
      ->needs(video)
      ->check(NumberFrom(kMinVideoFps, kMaxVideoFps))
      ->capture_default_str();
  command->add_option("--size", options->size, "Size of the video, pixels.")
      ->needs(video)
      ->capture_default_str();
  command->callback([options, command] {
    const ReportFile report = options->report.empty() ? ReportFile() : ReadReport(options->report);
    if (!options->video.empty())
      FillSong(command->count("--song-start") > 0, report.settings, options.get());
    CheckSongStart(*command, options->song);
    Run(*options, report);
  });
}

}  // namespace choreo::cli
