#include "model/evaluation/stress_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/dance/quality_report.h"
#include "model/evaluation/long_figures.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr int kWindowsPerClip = 4;
constexpr double kLyingHeight = 0.12;  // of the root, m

struct Case {
  const char* name;
  int frames;
  bool lying;
  double shift_m;  // of the key's root, forwards
};

constexpr Case kCases[] = {
    {"standing to lying", 30, true, 0},        {"standing to lying", 10, true, 0},
    {"standing to lying", 3, true, 0},         {"standing to lying 6 m away", 30, true, 6},
    {"almost the same pose", 30, false, 0.02}, {"almost the same pose", 90, false, 0.02},
};

// On her back where she stood, her head where she came from.
Pose Lying(const Skeleton& skeleton, const Pose& standing) {
  Pose pose;
  pose.rotations = Eigen::Matrix3Xd::Zero(3, skeleton.joints());
  const double heading = Heading(ExpMap(standing.rotations.col(0)));
  pose.rotations.col(0) =
      LogMap(HeadingRotation(heading) * ExpMap(Eigen::Vector3d(-M_PI / 2, 0, 0)));
  pose.root_position = standing.root_position;
  pose.root_position.y() = kLyingHeight;
  return pose;
}

}  // namespace

Table EvaluateStress(const ClipSet& set, StepEngine& engine, const EvalOptions& options) {
  const ModelInfo& model = engine.model();
  std::vector<LongFigures> real;
  std::vector<JointTrack> tracks;
  for (const PreparedClip& clip : set.clips) {
    real.push_back(MeasureLong(model.skeleton, model.fps, clip.motion.frames, {}));
    tracks.push_back(TrackJoints(model.skeleton, clip.motion.frames));
  }
  const RealRange range = RangeOf(real, tracks, model.fps);
  Table table;
  table.name = "stress_" + set.name;
  table.title = "Keys that ask for too much or too little, " + set.name;
  char note[256];
  std::snprintf(note, sizeof(note),
                "Frozen: slower than a quarter of real motion's median (%.2f m/s). Warned: the "
                "stream says interval_too_short.",
                range.median_speed);
  table.note = note;
  table.label_headings = {"way", "frames"};
  table.columns = {{"transitions", 0},   {"root m/s asked", 1}, {"joint rad/s asked", 1},
                   {"warned %", 0},      {"frozen %", 0},       {"speed median m/s", 2},
                   {"acc. max m/s²", 0}, {"worst key mm", 4}};
  for (const Case& one : kCases) {
    std::vector<TransitionJob> jobs;
    for (const EvalWindow& window :
         ChooseWindows(set, model.history_frames, one.frames, kWindowsPerClip)) {
      jobs.push_back(JobOf(model, set, window, one.frames, options.temperature, jobs.size()));
      TransitionRequest& request = jobs.back().request;
      const Pose& from = request.history.back();
      Pose key = one.lying ? Lying(model.skeleton, from) : from;
      const double heading = Heading(ExpMap(from.rotations.col(0)));
      key.root_position += HeadingRotation(heading) * Eigen::Vector3d(0, 0, one.shift_m);
      request.target = WorldTarget{key, {}};
    }
    if (jobs.empty()) continue;
    double root = 0, joint = 0, worst = 0, hardest = 0;
    int warned = 0, frozen = 0;
    std::vector<float> speeds;
    const auto results = DanceTransitions(engine, jobs);
    for (size_t i = 0; i < results.size(); ++i) {
      const RequiredSpeed& asked = *results[i].required_speed;
      root += asked.root_m_per_s / static_cast<double>(jobs.size());
      joint += asked.joint_rad_per_s / static_cast<double>(jobs.size());
      warned += asked.TooFast() ? 1 : 0;
      worst = std::max(worst, results[i].arrival->final_error_m);
      Motion motion{.fps = model.fps,
                    .frames = {jobs[i].request.history.end() - 2, jobs[i].request.history.end()}};
      for (const DanceFrame& frame : results[i].frames) motion.frames.push_back(frame.pose);
      hardest = std::max(hardest, MeasureMotion(model.skeleton, motion).max_acceleration);
      const LongFigures figures = MeasureLong(model.skeleton, model.fps, motion.frames, {});
      frozen += figures.median_speed < 0.25 * range.median_speed ? 1 : 0;
      speeds.push_back(static_cast<float>(figures.median_speed));
    }
    const auto percent = [&](int count) {
      return Cell{100.0 * count / static_cast<double>(jobs.size()), {}};
    };
    table.rows.push_back(
        {{one.name, std::to_string(one.frames)},
         {Cell{static_cast<double>(jobs.size()), {}}, Cell{root, {}}, Cell{joint, {}},
          percent(warned), percent(frozen), Cell{Percentile(speeds, 0.5), {}}, Cell{hardest, {}},
          Cell{1000 * worst, {}}}});
  }
  return table;
}

}  // namespace choreo
