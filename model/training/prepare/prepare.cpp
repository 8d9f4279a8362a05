#include "model/training/prepare/prepare.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>
#include <utility>

#include "model/audio/decode/decode.h"
#include "model/audio/music/feature_stream.h"
#include "model/audio/signal/mfcc.h"
#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/core/grid.h"
#include "model/core/running/progress.h"
#include "model/fit/solver/fit_clip.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/resample.h"
#include "model/training/clips/prepared_clip.h"
#include "model/training/prepare/jolts.h"
#include "model/training/prepare/recorded_floor.h"
#include "model/training/prepare/recordings.h"

namespace choreo {
namespace {

using nlohmann::json;

constexpr double kTopSpeed = 15;  // m/s: a faster joint means a defective recording
constexpr int kMinFrames = 60;
constexpr int kMaxCalibrationFrames = 6;  // frames
constexpr double kMusicSlack = 0.5;       // s by which music may be shorter than its dance

// The frames in which a joint is too far from its position in the frame before.
std::vector<int> FindJumps(const PositionClip& clip) {
  std::vector<int> jumps;
  for (int f = 1; f < std::ssize(clip.frames); ++f) {
    const double step = (clip.frames[f] - clip.frames[f - 1]).colwise().norm().maxCoeff();
    if (step * clip.fps > kTopSpeed) jumps.push_back(f);
  }
  return jumps;
}

// The longest run of `frames` frames cut at `ends`: its first frame, and the one after its last.
std::pair<int, int> LongestRun(std::vector<int> ends, int frames) {
  ends.push_back(frames);
  std::pair<int, int> longest;
  int begin = 0;
  for (const int end : ends) {
    if (end - begin > longest.second - longest.first) longest = {begin, end};
    begin = end;
  }
  return longest;
}

// The first frame of dance. Many recordings begin with a frame or two of a calibration pose, from
// which the dancer jumps into the dance.
int SkipCalibration(const PositionClip& clip) {
  int begin = 0;
  for (const int jump : FindJumps(clip)) {
    if (jump <= kMaxCalibrationFrames) begin = jump;
  }
  return begin;
}

// Cuts a fitted motion where the body snaps and keeps the longest run. Returns the number of frames
// removed.
int KeepLongestRun(const Skeleton& skeleton, Motion& motion, double& skipped_s, json& warnings) {
  const std::vector<int> breaks = FindBreaks(skeleton, motion);
  if (breaks.empty()) return 0;
  const auto all = static_cast<int>(motion.frames.size());
  const auto [begin, end] = LongestRun(breaks, all);
  motion.frames = {motion.frames.begin() + begin, motion.frames.begin() + end};
  skipped_s += begin / motion.fps;
  warnings.push_back("the body snaps: kept frames " + std::to_string(begin) + " to " +
                     std::to_string(end - 1) + " of " + std::to_string(all));
  return all - (end - begin);
}

// MFCC rows for the motion's frames; the recording's first frame is at music_start_s.
Eigen::MatrixXf MusicRows(const Recording& recording, size_t frames, double skipped_s,
                          json& warnings) {
  const DecodedAudio audio = DecodeAudioFile(recording.music);
  FeatureStream stream(audio.sample_rate, audio.channels);
  stream.Push(audio.interleaved);
  stream.Finish();
  const int64_t first = std::lround((recording.music_start_s + skipped_s) * kModelFps);
  const double missing_s =
      (static_cast<double>(first) + static_cast<double>(frames)) / kModelFps - audio.seconds();
  if (missing_s > kMusicSlack) {
    char text[80];
    std::snprintf(text, sizeof(text), "the music ends %.1f s before the dance", missing_s);
    warnings.push_back(text);
  }
  Eigen::MatrixXf rows(kMfccCount, frames);
  for (size_t f = 0; f < frames; ++f) {
    MfccOfMelDb(stream.Bands(first + static_cast<int64_t>(f)),
                std::span<float, kMfccCount>(rows.col(f).data(), kMfccCount));
  }
  return rows;
}

// Levels a tilted or drifting floor.
PositionClip OnLevelFloor(const PositionClip& clip, const SourceMapping& mapping, json& report) {
  std::vector<int> feet;
  for (const std::string& joint : mapping.feet) feet.push_back(IndexOf(clip.joint_names, joint));
  const FloorPlane plane = FitFloorPlane(clip, feet);
  report["floor_slope"] = std::hypot(plane.slope_x, plane.slope_z);
  return RemoveHeightDrift(LevelFloor(clip, plane), feet);
}

// Corrects a recording's positions and fits rotations to them. Adds to the report. `skipped_s`
// becomes the seconds cut from the beginning.
Motion FitPositions(const Recording& recording, json& report, double& skipped_s) {
  json& warnings = report["warnings"];
  PositionClip clip = recording.positions;
  CheckClip(clip);
  const int calibration = SkipCalibration(clip);
  clip.frames.erase(clip.frames.begin(), clip.frames.begin() + calibration);
  report["spikes_repaired"] = RemoveSpikes(kTopSpeed, 6, clip);
  // Keeps the longest run in which no joint jumps.
  const auto all = static_cast<int>(clip.frames.size());
  const auto [begin, end] = LongestRun(FindJumps(clip), all);
  int cut = calibration + all - (end - begin);
  if (cut > calibration) {
    warnings.push_back("a joint jumps: kept frames " + std::to_string(calibration + begin) +
                       " to " + std::to_string(calibration + end - 1));
  }
  clip.frames = {clip.frames.begin() + begin, clip.frames.begin() + end};
  skipped_s = static_cast<double>(calibration + begin) / clip.fps * recording.time_scale;
  if (recording.cutoff_hz > 0) clip = LowPass(clip, recording.cutoff_hz);
  if (recording.tilted_floor) clip = OnLevelFloor(clip, recording.mapping, report);
  clip = ResamplePositions(clip, kModelFps, recording.time_scale);
  FitResult fit = FitClip(clip, recording.mapping, recording.skeleton);
  cut += KeepLongestRun(recording.skeleton, fit.motion, skipped_s, warnings);
  const LimbRepair limbs = RepairLimbs(recording.skeleton, fit.motion);
  report["limb_frames_repaired"] = limbs.frames;
  if (limbs.left > 0) warnings.push_back(std::to_string(limbs.left) + " snapping limbs left");
  report["fit_error_m"] = fit.mean_error_m;
  report["fit_p95_m"] = fit.p95_error_m;
  report["scale"] = fit.scale;
  report["ground_shift_m"] = fit.ground_shift_m;
  report["frames_cut"] = cut;
  return std::move(fit.motion);
}

// The clip and its report.
std::pair<PreparedClip, json> PrepareOne(const RecordingSource& source,
                                         const PrepareOptions& options) {
  const Recording recording = source.read();
  const Skeleton& skeleton = recording.skeleton;
  json report = {{"name", source.name}, {"skeleton", skeleton.name}, {"warnings", recording.notes}};
  json& warnings = report["warnings"];
  double skipped_s = 0;
  Motion motion;
  if (recording.motion) {
    motion = Resample(*recording.motion, kModelFps);
    report["fit_error_m"] = 0.0;
    if (recording.ground) report["ground_shift_m"] = Ground(skeleton, motion);
  } else {
    motion = FitPositions(recording, report, skipped_s);
  }
  if (motion.frames.size() < kMinFrames) {
    throw InvalidArgument(source.name, std::to_string(motion.frames.size()) +
                                           " usable frames, but at least " +
                                           std::to_string(kMinFrames) + " are needed");
  }
  report["frames"] = motion.frames.size();
  report["time_scale"] = recording.time_scale;

  PreparedClip clip;
  clip.name = source.name;
  clip.source = options.layout;
  clip.skeleton = skeleton;
  const std::vector<Contacts> contacts = DetectContacts(skeleton, motion);
  clip.contacts.resize(4, contacts.size());
  for (size_t f = 0; f < contacts.size(); ++f)
    clip.contacts.col(f) = Eigen::Map<const Eigen::Vector4f>(contacts[f].data());
  report["contact_share"] = clip.contacts.mean();
  if (!recording.music.empty()) {
    clip.audio = MusicRows(recording, motion.frames.size(), skipped_s, warnings);
  } else if (recording.expects_music) {
    warnings.push_back("no music");
  }
  report["music"] = !recording.music.empty();
  report["music_start_s"] = recording.music_start_s + skipped_s;
  clip.motion = std::move(motion);
  clip.notes = {{"terms", options.terms}, {"preparation", report.dump()}};
  if (!recording.genre.empty()) clip.notes["genre"] = recording.genre;
  if (recording.beats) {
    const BeatGrid grid = Skip(*recording.beats, skipped_s);
    clip.notes["beat_period_s"] = json(grid.period_s).dump();
    clip.notes["beat_offset_s"] = json(grid.offset_s).dump();
    clip.notes["beats_per_bar"] = json(grid.per_bar).dump();
  }
  return {std::move(clip), std::move(report)};
}

}  // namespace

int Prepare(const PrepareOptions& options) {
  const std::vector<RecordingSource> sources = ListRecordings(options);
  std::filesystem::create_directories(options.output);
  if (const auto splits = SplitsOf(options); !splits.is_null()) {
    const nlohmann::ordered_json file = {{options.layout, splits}};
    WriteFile(options.output / "splits.json", file.dump(1) + "\n");
  }
  std::vector<json> reports(sources.size());
  std::atomic<size_t> next = 0;
  ProgressBar progress("prepare " + options.layout, static_cast<int64_t>(sources.size()));
  const auto work = [&] {
    for (size_t i = next++; i < sources.size(); i = next++) {
      try {
        auto [clip, report] = PrepareOne(sources[i], options);
        WritePreparedClip(options.output, clip);
        reports[i] = std::move(report);
      } catch (const std::exception& error) {
        reports[i] = {{"name", sources[i].name}, {"skipped", error.what()}};
      }
      progress.Advance(1, sources[i].name);
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < options.jobs; ++i) workers.emplace_back(work);
  }
  progress.Finish();

  int prepared = 0;
  double frames = 0, error = 0;
  std::printf("%-28s %8s %7s %7s %8s %8s %5s %9s %6s  %s\n", "clip", "frames", "fit cm", "p95 cm",
              "floor cm", "contact", "cut", "repaired", "music", "warnings");
  for (const json& report : reports) {
    const std::string name = report.at("name");
    if (report.contains("skipped")) {
      std::printf("%-28s skipped: %s\n", name.c_str(),
                  report.at("skipped").get<std::string>().c_str());
      continue;
    }
    const auto number = [&](const char* key) { return report.value(key, 0.0); };
    ++prepared;
    frames += number("frames");
    error += number("fit_error_m") * number("frames");
    std::string warnings;
    for (const auto& warning : report.at("warnings"))
      warnings += (warnings.empty() ? "" : "; ") + warning.get<std::string>();
    std::printf("%-28s %8.0f %7.2f %7.2f %8.1f %8.2f %5.0f %9.0f %6s  %s\n", name.c_str(),
                number("frames"), 100 * number("fit_error_m"), 100 * number("fit_p95_m"),
                100 * number("ground_shift_m"), number("contact_share"), number("frames_cut"),
                number("limb_frames_repaired"), report.at("music").get<bool>() ? "yes" : "no",
                warnings.c_str());
  }
  if (prepared > 0) {
    std::printf("%d of %zu clips, %.0f frames (%.1f min), mean fit error %.2f cm\n", prepared,
                sources.size(), frames, frames / kModelFps / 60, 100 * error / frames);
  }
  WriteFile(options.output / "report.json", json(reports).dump(1) + "\n");
  return prepared;
}

void AddPrepareCommand(CLI::App& app) {
  auto options = std::make_shared<PrepareOptions>();
  CLI::App* command = app.add_subcommand("prepare", "Turn recordings into training clips");
  command->add_option("layout", options->layout, "tang2018 | tang61 | bvh | amass | aist | lafan1")
      ->required()
      ->check(CLI::IsMember({"tang2018", "tang61", "bvh", "amass", "aist", "lafan1"}));
  command->add_option("input", options->input, "Folder of recordings")->required();
  command->add_option("output", options->output, "Folder for the clips")->required();
  command->add_option(
      "--frame-rate", options->frame_rates,
      "PREFIX FPS: the true rate of clips whose header is wrong (cmu_dance: salsa 60)");
  command->add_option("--time-scale", options->time_scales,
                      "PREFIX FACTOR: stretch these clips in time");
  command->add_flag("--native-skeleton", options->native_skeleton,
                    "tang2018: fit a skeleton of the data's own 23 joints instead of SMPL's 24");
  command->add_option("--terms", options->terms, "Terms of use, stored with every clip")
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "Concurrent clips")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->callback([options] {
    if (Prepare(*options) == 0)
      throw Error(ErrorCode::kInvalidArgument, options->input.string(),
                  "no clip could be prepared");
  });
}

}  // namespace choreo
