#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>

#include "client/authoring/controls/written_controls.h"
#include "client/authoring/fields/counts.h"
#include "client/authoring/fields/json_fields.h"
#include "client/authoring/keys/motion_input.h"
#include "client/authoring/music/music.h"
#include "client/cli/commands/commands.h"
#include "client/cli/options/authoring_options.h"
#include "client/cli/options/options.h"
#include "client/cli/options/output_file.h"
#include "model/core/error.h"
#include "model/draw/plot.h"
#include "model/formats/motion_file.h"
#include "model/motion/controls/path_curve.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/motion/kinematics/kinematic_beats.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo::cli {
namespace {

constexpr double kCentimetre = 100;   // of a metre
constexpr double kSmoothing_s = 0.5;  // window for averaging speeds

struct PlotOptions {
  std::string of;
  std::string song;
  double song_start_s = 0;
  authoring::BeatOptions beats;
  std::vector<std::string> motions, labels, paths;
  std::vector<double> speeds;
  Plot plot;
  std::string out;
};

/// The mean of the values within half of `window` around each.
std::vector<double> MovingMean(const std::vector<double>& values, double window) {
  const auto half = static_cast<std::ptrdiff_t>(window / 2);
  const auto count = static_cast<std::ptrdiff_t>(values.size());
  std::vector<double> means;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, i - half),
                         to = std::min(count, i + half + 1);
    double sum = 0;
    for (std::ptrdiff_t k = from; k < to; ++k) sum += values[static_cast<size_t>(k)];
    means.push_back(sum / static_cast<double>(to - from));
  }
  return means;
}

PlotSeries SpeedOf(BodyPart part, const SkeletonMotion& dance) {
  const auto& [skeleton, motion] = dance;
  const BodyPartWeights weights = WeighBodyParts(skeleton);
  PlotSeries line;
  std::vector<double> speeds;
  Eigen::Matrix3Xd before;
  for (const Pose& pose : motion.frames) {
    Eigen::Matrix3Xd now = JointPositions(skeleton, pose);
    if (before.cols() > 0) {
      const auto factors = PartSpeeds(weights, before, now);
      speeds.push_back(kCentimetre * factors[static_cast<size_t>(part)]);
      line.x.push_back(static_cast<double>(speeds.size()) / motion.fps);
    }
    before = std::move(now);
  }
  line.y = MovingMean(speeds, kSmoothing_s * motion.fps);
  return line;
}

// Adds a place on the stage, seen from above with the audience at the right.
void AddPlace(const Eigen::Vector3d& place, PlotSeries* line) {
  line->x.push_back(place.z());
  line->y.push_back(place.x());
}

PlotSeries RootOf(const Motion& motion, bool height) {
  PlotSeries line;
  for (const Pose& pose : motion.frames) {
    if (height) {
      line.x.push_back(static_cast<double>(line.x.size()) / motion.fps);
      line.y.push_back(pose.root_position.y());
    } else {
      AddPlace(pose.root_position, &line);
    }
  }
  return line;
}

/// The song's counts, for paths that are written in them.
authoring::Counts CountsOf(const PlotOptions& options) {
  if (options.song.empty()) return {};
  return authoring::CountsOf(authoring::ReadMusic(
      options.song, std::numeric_limits<double>::infinity(), options.song_start_s, options.beats));
}

/// The curve that the dance is asked to follow through the points of a path file.
PlotSeries AskedOf(const std::string& path, const authoring::Counts& counts, double fps,
                   bool height) {
  const PathCurve asked(
      authoring::ParsePathFile(authoring::ReadText(path, "path file"), path, fps, counts));
  if (height && !asked.has_heights()) throw InvalidArgument("--path", path + " has no heights");
  PlotSeries line{.label = "asked", .x = {}, .y = {}, .asked = true};
  for (int64_t frame = asked.first(); frame <= asked.last(); ++frame) {
    const auto time = static_cast<double>(frame);
    const Eigen::Vector3d place = asked.At(time).position;
    if (height) {
      line.x.push_back(time / fps);
      line.y.push_back(place.y());
    } else {
      AddPlace(place, &line);
    }
  }
  return line;
}

// A dashed line from bottom to top at each second.
PlotSeries MarksAt(const std::vector<double>& seconds, double top) {
  PlotSeries marks{.label = {}, .x = {}, .y = {}, .asked = true};
  for (const double second : seconds) {
    for (const double height : {0.0, top / 3, 2 * top / 3, top, std::nan("")}) {
      marks.x.push_back(second);
      marks.y.push_back(height);
    }
  }
  return marks;
}

// The song's beats, the curve of the mean joint speed, and its maxima, the kinematic beats (paper
// F, Figure 4).
std::vector<PlotSeries> BeatsOf(const PlotOptions& options) {
  const SkeletonMotion dance = authoring::ReadMotionNoting(options.motions.front());
  const auto& [skeleton, motion] = dance;
  std::vector<float> speeds;
  Eigen::Matrix3Xd before;
  for (const Pose& pose : motion.frames) {
    Eigen::Matrix3Xd now = JointPositions(skeleton, pose);
    if (before.cols() > 0) {
      const double step = (now - before).colwise().norm().mean();
      speeds.push_back(static_cast<float>(motion.fps * step));
    }
    before = std::move(now);
  }
  PlotSeries line{.label = "mean joint speed", .x = {}, .y = SmoothSpeeds(speeds, motion.fps)};
  for (size_t i = 0; i < speeds.size(); ++i)
    line.x.push_back(static_cast<double>(i + 1) / motion.fps);
  const double top = line.y.empty() ? 1 : *std::ranges::max_element(line.y);
  const double seconds = static_cast<double>(speeds.size()) / motion.fps;
  std::vector<double> kinematic;
  for (const int64_t frame : KinematicBeats(speeds, motion.fps))
    kinematic.push_back(static_cast<double>(frame) / motion.fps);
  const authoring::Music music =
      authoring::ReadMusic(options.song, seconds, options.song_start_s, options.beats);
  std::vector<PlotSeries> series = {MarksAt(authoring::BeatsBefore(music, seconds), top),
                                    std::move(line), MarksAt(kinematic, top)};
  series.front().label = "beats of the song";
  series.back().label = "kinematic beats, its maxima";
  return series;
}

PlotSeries LevelOf(double speed, const PlotSeries& danced) {
  PlotSeries line{.label = "asked", .x = {}, .y = {}, .asked = true};
  if (!danced.x.empty()) line.x = {danced.x.front(), danced.x.back()};
  line.y.assign(line.x.size(), speed);
  return line;
}

void RequireOneEach(const std::string& option, size_t count, size_t motions) {
  if (count == 0 || count == motions || (count == 1 && option != "--label")) return;
  throw InvalidArgument(
      option, std::to_string(count) + " of them for " + std::to_string(motions) + " motions");
}

void Run(PlotOptions& options) {
  RequireExtension("--out", options.out, {".png"});
  std::vector<NamedFile> inputs;
  for (const std::string& motion : options.motions) inputs.push_back({"motion", motion});
  for (const std::string& path : options.paths) inputs.push_back({"--path", path});
  if (!options.song.empty()) inputs.push_back({"--song", options.song});
  const std::optional<BodyPart> part = FindBodyPart(options.of);
  const bool beats = options.of == "beats";
  const bool height = options.of == "height";
  if (!options.beats.FindsThem()) inputs.push_back({"--beats", *options.beats.beats});
  RequireOutputs({{"--out", options.out}}, inputs);
  if (beats && options.song.empty())
    throw InvalidArgument("--song", "beats need the song of the dance");
  if (!beats && !options.song.empty() && options.paths.empty())
    throw InvalidArgument("--song", "goes with beats, or with the counts of --path");
  authoring::RequireSong(options.beats, options.song);
  if (beats && options.motions.size() > 1) {
    throw InvalidArgument(
        "motions", std::to_string(options.motions.size()) + ", but beats are plotted of one");
  }
  if (beats && !options.labels.empty())
    throw InvalidArgument("--label", "plots of beats name their own lines");
  if ((part || beats) && !options.paths.empty()) {
    throw InvalidArgument("--path",
                          "says nothing of " + (beats ? "beats" : "the speed of a " + options.of));
  }
  if (!part && !options.speeds.empty())
    throw InvalidArgument("--asked", "goes with a part of the body, not with " + options.of);
  const size_t motions = options.motions.size(),
               asked = options.paths.size() + options.speeds.size();
  RequireOneEach("--label", options.labels.size(), motions);
  RequireOneEach(part ? "--asked" : "--path", asked, motions);

  Plot& plot = options.plot;
  if (beats) {
    plot.x_label = "s";
    plot.y_label = "m/s";
    plot.from_zero = true;
    plot.series = BeatsOf(options);
    DrawPlot(plot, options.out);
    return;
  }
  plot.map = !part && !height;
  plot.x_label = plot.map ? "towards the audience, m" : "s";
  plot.y_label = plot.map ? "to the dancer's left, m"
                 : height ? "height of the root, m"
                          : "cm a frame, mean of 0.5 s";
  const authoring::Counts counts = CountsOf(options);
  for (size_t i = 0; i < motions; ++i) {
    const SkeletonMotion dance = authoring::ReadMotionNoting(options.motions[i]);
    PlotSeries line = part ? SpeedOf(*part, dance) : RootOf(dance.motion, height);
    line.label = options.labels.empty() ? std::filesystem::path(options.motions[i]).stem().string()
                                        : options.labels[i];
    if (i < asked) {
      PlotSeries wanted = part ? LevelOf(options.speeds[i], line)
                               : AskedOf(options.paths[i], counts, dance.motion.fps, height);
      // Plots a request that all motions share first.
      if (asked < motions) plot.series.push_back(std::move(wanted));
      plot.series.push_back(std::move(line));
      if (asked == motions) plot.series.push_back(std::move(wanted));
    } else {
      plot.series.push_back(std::move(line));
    }
  }
  DrawPlot(plot, options.out);
}

}  // namespace

void AddPlotCommand(CLI::App& program) {
  auto options = std::make_shared<PlotOptions>();
  CLI::App* command = program.add_subcommand(
      "plot",
      "Compare motions in a line chart: their paths over the floor, heights, or speeds of parts. "
      "Or show the beats of one motion beside its song's.");
  command
      ->add_option("quantity", options->of,
                   "path (from above); height (of the root); trunk, left_arm, right_arm, left_leg "
                   "or right_leg (its speed); or beats (of the body and of --song).")
      ->required()
      ->check(OneOf(
          {"path", "height", "trunk", "left_arm", "right_arm", "left_leg", "right_leg", "beats"}));
  command->add_option("motions", options->motions, MotionFileExtensions() + " files.")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("-o,--out", options->out, "PNG file to write.")->required();
  AddRepeated(*command, "--label", options->labels,
              "Names of the motions in the legend, one each. Default: the files' names.");
  AddRepeated(*command, "--path", options->paths,
              "Requested path file: one for all motions, or one each.");
  AddRepeated(*command, "--asked", options->speeds,
              "Requested speed, cm a frame: one for all motions, or one each.")
      ->check(NumberFrom(0, 1000));
  command
      ->add_option("--song", options->song,
                   "Song of the dance: for beats, and for paths in counts.")
      ->check(CLI::ExistingFile);
  AddSongStart(*command, options->song_start_s);
  AddBeatOptions(*command, &options->beats);
  command->add_option("--title", options->plot.title, "Heading.");
  command->add_option("--width", options->plot.width, "Pixels.")
      ->check(WholeNumberFrom(kMinPlotPixels, kMaxPlotPixels))
      ->capture_default_str();
  command->add_option("--height", options->plot.height, "Pixels.")
      ->check(WholeNumberFrom(kMinPlotPixels, kMaxPlotPixels))
      ->capture_default_str();
  command->callback([options, command] {
    CheckSongStart(*command, options->song);
    Run(*options);
  });
}

}  // namespace choreo::cli
