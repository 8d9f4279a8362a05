#include "model/training/prepare.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <map>
#include <thread>

#include "model/audio/decode.h"
#include "model/audio/feature_stream.h"
#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/core/progress.h"
#include "model/fit/fit_clip.h"
#include "model/fit/recorded_floor.h"
#include "model/motion/kinematics.h"
#include "model/motion/resample.h"
#include "model/training/jolts.h"
#include "model/training/prepared_clip.h"
#include "model/training/recordings.h"

namespace choreo {
namespace {

using nlohmann::json;

constexpr double kModelFps = 30;
constexpr double kTopSpeed = 15;  // m/s of any joint; faster is a defect of the recording
constexpr int kShortestFrames = 60;
constexpr size_t kLongestCalibration = 6;  // frames
constexpr double kMusicSlack = 0.5;        // s by which music may be shorter than its dance

// The longest run of frames in which no joint jumps. What lies outside is cut.
std::pair<size_t, size_t> LongestCleanRun(const PositionClip& clip) {
  size_t best_begin = 0, best_end = 0, begin = 0;
  for (size_t f = 1; f <= clip.frames.size(); ++f) {
    const bool breaks =
        f == clip.frames.size() ||
        (clip.frames[f] - clip.frames[f - 1]).colwise().norm().maxCoeff() * clip.fps > kTopSpeed;
    if (!breaks) continue;
    if (f - begin > best_end - best_begin) {
      best_begin = begin;
      best_end = f;
    }
    begin = f;
  }
  return {best_begin, best_end};
}

// Many recordings begin with a calibration pose, a frame or two from which the dancer jumps into
// the dance: the first frame that is dance.
size_t SkipCalibration(const PositionClip& clip) {
  size_t begin = 0;
  for (size_t f = 1; f <= kLongestCalibration && f < clip.frames.size(); ++f) {
    const double step = (clip.frames[f] - clip.frames[f - 1]).colwise().norm().maxCoeff();
    if (step * clip.fps > kTopSpeed) begin = f;
  }
  return begin;
}

// Cuts a fitted motion at the frames where the body snaps; returns how many frames that cost.
size_t KeepLongestRun(const Skeleton& skeleton, Motion& motion, double& skipped_s, json& warnings) {
  std::vector<int> ends = FindBreaks(skeleton, motion);
  if (ends.empty()) return 0;
  ends.push_back(static_cast<int>(motion.frames.size()));
  int begin = 0, best = 0, longest = 0;
  for (const int end : ends) {
    if (end - begin > longest) {
      best = begin;
      longest = end - begin;
    }
    begin = end;
  }
  const size_t all = motion.frames.size();
  motion.frames = {motion.frames.begin() + best, motion.frames.begin() + best + longest};
  skipped_s += best / motion.fps;
  warnings.push_back("the body snaps: kept frames " + std::to_string(best) + " to " +
                     std::to_string(best + longest - 1) + " of " + std::to_string(all));
  return all - motion.frames.size();
}

// MFCC rows of the motion's frames; the recording's first frame plays at music_start_s.
Eigen::MatrixXf MusicRows(const Recording& recording, size_t frames, double skipped_s,
                          json& warnings) {
  const DecodedAudio audio = DecodeAudioFile(recording.music);
  FeatureStream stream(audio.sample_rate, audio.channels);
  stream.Push(audio.interleaved);
  stream.Finish();
  const auto first =
      static_cast<int64_t>(std::lround((recording.music_start_s + skipped_s) * kModelFps));
  const double missing_s =
      (static_cast<double>(first) + static_cast<double>(frames)) / kModelFps - audio.seconds();
  if (missing_s > kMusicSlack) {
    char text[80];
    std::snprintf(text, sizeof(text), "the music ends %.1f s before the dance", missing_s);
    warnings.push_back(text);
  }
  Eigen::MatrixXf rows(stream.Row(0).size(), frames);
  for (size_t f = 0; f < frames; ++f)
    std::ranges::copy(stream.Row(first + static_cast<int64_t>(f)), rows.col(f).data());
  return rows;
}

void NoteBeats(const BeatGrid& grid, std::map<std::string, std::string>& notes) {
  notes["beat_period_s"] = json(grid.period_s).dump();
  notes["beat_offset_s"] = json(grid.offset_s).dump();
  notes["beats_per_bar"] = json(grid.per_bar).dump();
}

struct Prepared {
  PreparedClip clip;
  json report;
};

Prepared PrepareOne(const Recording& recording, const PrepareOptions& options) {
  const Skeleton& skeleton = recording.skeleton;
  Prepared result;
  json& report = result.report;
  report["name"] = recording.name;
  report["skeleton"] = skeleton.name;
  report["warnings"] = json::array();
  json& warnings = report["warnings"];
  double skipped_s = 0;
  Motion motion;
  if (recording.motion) {
    motion = Resample(*recording.motion, kModelFps);
    report["fit_error_m"] = 0.0;
    if (recording.ground) report["ground_shift_m"] = Ground(skeleton, motion);
  } else {
    PositionClip clip = recording.positions;
    ValidateClip(clip);
    const size_t calibration = SkipCalibration(clip);
    clip.frames.erase(clip.frames.begin(), clip.frames.begin() + calibration);
    int replaced = 0;
    clip = RemoveSpikes(clip, kTopSpeed, 6, &replaced);
    const auto [begin, end] = LongestCleanRun(clip);
    size_t cut = calibration + clip.frames.size() - (end - begin);
    if (cut > calibration) {
      warnings.push_back("a joint jumps: kept frames " + std::to_string(calibration + begin) +
                         " to " + std::to_string(calibration + end - 1));
    }
    clip.frames = {clip.frames.begin() + begin, clip.frames.begin() + end};
    skipped_s = static_cast<double>(calibration + begin) / clip.fps * recording.time_scale;
    if (recording.cutoff_hz > 0) clip = LowPass(clip, recording.cutoff_hz);
    if (recording.tilted_floor) {
      std::vector<int> feet;
      for (const std::string& joint : recording.mapping.feet)
        feet.push_back(FindJoint(clip, joint));
      const FloorPlane plane = FitFloorPlane(clip, feet);
      report["floor_slope"] = std::hypot(plane.slope_x, plane.slope_z);
      clip = RemoveHeightDrift(LevelFloor(clip, plane), feet);
    }
    clip = ResamplePositions(clip, kModelFps, recording.time_scale);
    FitResult fit = FitClip(clip, recording.mapping, skeleton);
    motion = std::move(fit.motion);
    cut += KeepLongestRun(skeleton, motion, skipped_s, warnings);
    const LimbRepair limbs = RepairLimbs(skeleton, motion);
    report["limb_frames_repaired"] = limbs.frames;
    if (limbs.left > 0) warnings.push_back(std::to_string(limbs.left) + " snapping limbs left");
    report["fit_error_m"] = fit.report.mean_error_m;
    report["fit_p95_m"] = fit.report.p95_error_m;
    report["scale"] = fit.report.scale;
    report["ground_shift_m"] = fit.report.ground_shift_m;
    report["spikes_repaired"] = replaced;
    report["frames_cut"] = cut;
  }
  if (motion.frames.size() < kShortestFrames) {
    throw InvalidArgument(recording.name, std::to_string(motion.frames.size()) +
                                              " usable frames, but at least " +
                                              std::to_string(kShortestFrames) + " are needed");
  }
  report["frames"] = motion.frames.size();
  report["time_scale"] = recording.time_scale;

  PreparedClip& clip = result.clip;
  clip.name = recording.name;
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
  clip.motion = std::move(motion);
  clip.notes = {{"terms", options.terms}, {"preparation", report.dump()}};
  if (!recording.genre.empty()) clip.notes["genre"] = recording.genre;
  if (recording.beats) NoteBeats(Skip(*recording.beats, skipped_s), clip.notes);
  return result;
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
  {
    ProgressBar progress("prepare " + options.layout, static_cast<int64_t>(sources.size()));
    const auto work = [&] {
      for (size_t i = next++; i < sources.size(); i = next++) {
        try {
          Prepared prepared = PrepareOne(sources[i].read(), options);
          WritePreparedClip(options.output, prepared.clip);
          reports[i] = std::move(prepared.report);
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
  }

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

}  // namespace choreo
