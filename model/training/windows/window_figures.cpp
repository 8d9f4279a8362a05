#include "model/training/windows/window_figures.h"

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "model/flow/flow_sampler.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/resample.h"
#include "model/training/trainer/trainer.h"
#include "model/training/trainer/training_run.h"

namespace choreo {
namespace {

// Mean joint distance between two sequences of poses, metres.
double Distance(const Skeleton& skeleton, std::span<const Pose> a, std::span<const Pose> b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    sum +=
        (JointPositions(skeleton, a[i]) - JointPositions(skeleton, b[i])).colwise().norm().mean();
  }
  return sum / static_cast<double>(a.size());
}

// Sums of the joints' speeds and third differences.
struct Liveness {
  double speed = 0, jerk = 0;
  void Add(const Skeleton& skeleton, std::span<const Pose> poses) {
    std::vector<Eigen::Matrix3Xd> at;
    for (const Pose& pose : poses) at.push_back(JointPositions(skeleton, pose));
    for (size_t i = 3; i < at.size(); ++i) {
      speed += (at[i] - at[i - 1]).colwise().norm().sum();
      jerk += (at[i] - 3 * at[i - 1] + 3 * at[i - 2] - at[i - 3]).colwise().norm().sum();
    }
  }
};

}  // namespace

NamedFigures CompareWindows(const FlowNetwork& network, const FlowModelParts& parts,
                            const WindowClips& clips, int windows) {
  const Skeleton& skeleton = clips.skeleton();
  NamedFigures figures;
  for (const int frames : kComparedFrames) {
    if (frames > clips.Longest(parts.config.history_frames)) continue;
    Random random(kValidationSeed, static_cast<uint32_t>(frames));
    const WindowBatch batch = clips.Draw(parts, windows, frames, frames, {}, &random);
    double line = 0, mean = 0, seeds = 0;
    Liveness real, danced, planned;
    for (size_t i = 0; i < batch.truth.size(); ++i) {
      const WindowRequest& request = batch.requests[i];
      const auto sample = [&](uint32_t candidate, double temperature) {
        return SampleWindow(parts, network, request,
                            {.seed = i, .candidate = candidate, .temperature = temperature})
            .Finish();
      };
      std::vector<Pose> interpolated;
      for (int k = 1; k <= frames; ++k) {
        interpolated.push_back(InterpolatePoses(request.history.back(), request.target->pose,
                                                static_cast<double>(k) / frames));
      }
      const std::vector<Pose> plan = sample(0, 0), one = sample(0, parts.config.temperature),
                              other = sample(1, parts.config.temperature);
      line += Distance(skeleton, interpolated, batch.truth[i]);
      mean += Distance(skeleton, plan, batch.truth[i]);
      seeds += Distance(skeleton, one, other);
      real.Add(skeleton, batch.truth[i]);
      danced.Add(skeleton, one);
      planned.Add(skeleton, plan);
    }
    const std::string n = std::to_string(frames);
    figures.insert(figures.end(),
                   {{"l2p_ratio_" + n, mean / line},
                    {"seeds_cm_" + n, 100 * seeds / static_cast<double>(batch.truth.size())},
                    {"speed_ratio_" + n, danced.speed / real.speed},
                    {"jerk_ratio_" + n, danced.jerk / real.jerk},
                    {"mean_jerk_ratio_" + n, planned.jerk / real.jerk}});
  }
  return figures;
}

}  // namespace choreo
