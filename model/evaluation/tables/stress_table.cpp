#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "model/dance/delivery/quality_meter.h"
#include "model/evaluation/evaluation.h"
#include "model/evaluation/judges/long_figures.h"
#include "model/evaluation/judges/transition_judge.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr int kWindowsPerClip = 4;
constexpr double kLyingHeight = 0.12;  // of the root, m

enum class KeyKind { kReal, kNoKey, kLying, kAlmostTheSame };

struct Case {
  const char* name;
  int frames;
  KeyKind kind;
  double shift_m = 0;  // metres that the key's root moves forwards
};

constexpr Case kCases[] = {
    {"real motion", 3, KeyKind::kReal},
    {"real motion", 10, KeyKind::kReal},
    {"real motion", 30, KeyKind::kReal},
    {"real motion", 90, KeyKind::kReal},
    {"no key", 30, KeyKind::kNoKey},
    {"no key", 90, KeyKind::kNoKey},
    {"standing to lying", 30, KeyKind::kLying},
    {"standing to lying", 10, KeyKind::kLying},
    {"standing to lying", 3, KeyKind::kLying},
    {"standing to lying 6 m away", 30, KeyKind::kLying, 6},
    {"almost the same pose", 30, KeyKind::kAlmostTheSame, 0.02},
    {"almost the same pose", 90, KeyKind::kAlmostTheSame, 0.02},
};

// A dancer who lies on the back at the position of `standing`, the head behind it.
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

// A case's key, derived from the real one. None for a case without a key.
std::optional<Target> KeyOf(const Case& one, const Skeleton& skeleton,
                            const TransitionSpec& request) {
  if (one.kind == KeyKind::kReal) return request.target;
  if (one.kind == KeyKind::kNoKey) return std::nullopt;
  const Pose& from = request.history.back();
  Pose key = one.kind == KeyKind::kLying ? Lying(skeleton, from) : from;
  const double heading = Heading(ExpMap(from.rotations.col(0)));
  key.root_position += HeadingRotation(heading) * Eigen::Vector3d(0, 0, one.shift_m);
  return Target{key, {}};
}

// The result of one window: two frames of its history, then the transition.
struct Danced {
  Motion motion;
  std::optional<Target> key;
  std::optional<RequiredSpeed> required;  // none without a key
};

std::vector<Danced> DanceCase(const Case& one, const Evaluation& evaluation) {
  const ModelInfo& model = evaluation.model();
  const ClipSet& set = evaluation.set;
  std::vector<TransitionSpec> requests;
  std::vector<Danced> all;
  for (const EvalWindow& window :
       ChooseWindows(set, model.history_frames, one.frames, kWindowsPerClip)) {
    TransitionSpec& request = requests.emplace_back(
        RequestOf(model, set, window, one.frames, evaluation.options.temperature, requests.size()));
    request.target = KeyOf(one, model.skeleton, request);
    all.push_back({{.fps = model.fps, .frames = RealPoses(set, window, one.frames, kFramesBefore)},
                   request.target,
                   TransitionRun(model, request).required_speed()});
  }
  if (one.kind == KeyKind::kReal) return all;
  const auto dances = evaluation.runner.Dance(*evaluation.judged().sampler, requests);
  for (size_t i = 0; i < dances.size(); ++i)
    std::ranges::copy(dances[i], all[i].motion.frames.begin() + kFramesBefore);
  return all;
}

}  // namespace

std::vector<Table> EvaluateStress(const Evaluation& evaluation) {
  const ModelInfo& model = evaluation.model();
  const RealRange range = MeasureReal(evaluation.set, model).range;
  Table table =
      evaluation.NewTable("stress", "Keys that ask for too much or too little", {"way", "frames"});
  char note[256];
  std::snprintf(note, sizeof(note),
                "Frozen: slower than a quarter of real motion's median (%.2f m/s). Warned: the "
                "stream says interval_too_short. Real motion's keys are its own poses.",
                range.median_speed);
  table.note = note;
  for (const Case& one : kCases) {
    const std::vector<Danced> all = DanceCase(one, evaluation);
    if (all.empty()) continue;
    const auto count = static_cast<double>(all.size());
    double root = 0, joint = 0, hardest = 0, worst = 0;
    int warned = 0;
    std::vector<float> speeds;
    for (const Danced& danced : all) {
      const std::vector<Pose>& poses = danced.motion.frames;
      hardest = std::max(hardest, MeasureMotion(model.skeleton, danced.motion).max_acceleration);
      speeds.push_back(static_cast<float>(
          Percentile(MeanSpeeds(TrackJoints(model.skeleton, poses), model.fps), 0.5)));
      if (!danced.key || !danced.required) continue;
      root += danced.required->root_m_per_s / count;
      joint += danced.required->joint_rad_per_s / count;
      warned += danced.required->TooFast() ? 1 : 0;
      const PoseError error = ComparePoses(model.skeleton, poses.back(), danced.key->pose);
      worst = std::max(worst, error.position_m);
    }
    const auto frozen =
        std::ranges::count_if(speeds, [&](float speed) { return range.Frozen(speed); });
    const auto of_keys = [&](double value) { return all[0].required ? value : NAN; };
    table.AddRow({one.name, std::to_string(one.frames)});
    table.Put("transitions", 0, count);
    table.Put("root m/s asked", 1, of_keys(root));
    table.Put("joint rad/s asked", 1, of_keys(joint));
    table.Put("warned %", 0, of_keys(100 * warned / count));
    table.Put("frozen %", 0, 100 * frozen / count);
    table.Put("speed median m/s", 2, Percentile(speeds, 0.5));
    table.Put("acc. max m/s²", 0, hardest);
    table.Put("worst key mm", 4, of_keys(1000 * worst));
  }
  return {table};
}

}  // namespace choreo
