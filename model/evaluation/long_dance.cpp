#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/dance/transition.h"
#include "model/evaluation/long_dance.h"
#include "model/motion/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kBeyondStraight = 15 * M_PI / 180;
constexpr int kFreeTransition = 60;  // frames of a transition without a key

double Percentile(std::vector<double>* values, double share) {
  if (values->empty()) return 0;
  const auto place = values->begin() +
                     static_cast<std::ptrdiff_t>(share * static_cast<double>(values->size() - 1));
  std::nth_element(values->begin(), place, values->end());
  return *place;
}

// Joint speeds and bends, gathered frame by frame.
class Gatherer {
 public:
  Gatherer(const Skeleton& skeleton, double fps)
      : skeleton_(skeleton),
        joint_hinges_(Hinges(skeleton)),
        fps_(fps),
        speeds_(static_cast<size_t>(skeleton.joints())) {}

  void Add(const Pose& pose, bool first) {
    const Eigen::Matrix3Xd positions = JointPositions(skeleton_, pose);
    if (!first) {
      const Eigen::RowVectorXd speed = (positions - last_).colwise().norm() * fps_;
      for (Eigen::Index j = 0; j < speed.size(); ++j)
        speeds_[static_cast<size_t>(j)].push_back(speed[j]);
      means_.push_back(speed.mean());
    }
    last_ = positions;
    for (const Hinge& hinge : joint_hinges_) {
      ++hinges_;
      if (hinge.axis.dot(pose.rotations.col(hinge.joint)) < -kBeyondStraight) ++backwards_;
    }
  }

  std::vector<std::vector<double>>& speeds() { return speeds_; }
  std::vector<double>& means() { return means_; }
  double bent_backwards() const {
    return static_cast<double>(backwards_) / static_cast<double>(std::max<int64_t>(1, hinges_));
  }

 private:
  Skeleton skeleton_;
  std::vector<Hinge> joint_hinges_;
  double fps_;
  std::vector<std::vector<double>> speeds_;
  std::vector<double> means_;
  Eigen::Matrix3Xd last_;
  int64_t hinges_ = 0, backwards_ = 0;
};

}  // namespace

SpeedRange MeasureRealSpeeds(const std::vector<PreparedClip>& clips) {
  Gatherer gatherer(clips.at(0).skeleton, clips.at(0).motion.fps);
  for (const PreparedClip& clip : clips) {
    bool first = true;
    for (const Pose& pose : clip.motion.frames) {
      gatherer.Add(pose, first);
      first = false;
    }
  }
  SpeedRange range;
  for (auto& speeds : gatherer.speeds()) {
    range.low.push_back(Percentile(&speeds, 0.05));
    range.high.push_back(Percentile(&speeds, 0.95));
  }
  range.median = Percentile(&gatherer.means(), 0.5);
  range.bent_backwards = gatherer.bent_backwards();
  return range;
}

LongDanceRow EvaluateLongDance(StepEngine& engine, const PreparedClip& clip, int frames,
                               int key_interval, float temperature, uint64_t seed,
                               const SpeedRange& real) {
  const ModelInfo& model = engine.model();
  const auto tau = static_cast<size_t>(model.history_frames);
  const std::vector<Pose>& poses = clip.motion.frames;
  if (poses.size() < tau + static_cast<size_t>(std::max(key_interval, 1))) {
    throw InvalidArgument(clip.name,
                          std::to_string(poses.size()) + " frames are too few for a long dance");
  }
  LongDanceRow row;
  row.frames = frames;
  Gatherer gatherer(model.skeleton, model.fps);
  std::vector<Pose> dance(poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(tau));
  const Eigen::Vector3d start = dance.back().root_position;
  row.lowest_m = row.highest_m = start.y();
  while (dance.size() - tau < static_cast<size_t>(frames)) {
    TransitionRequest request;
    request.frames = std::min<int>(key_interval > 0 ? key_interval : kFreeTransition,
                                   frames - static_cast<int>(dance.size() - tau));
    request.history.assign(dance.end() - static_cast<std::ptrdiff_t>(tau), dance.end());
    if (key_interval > 0) {
      // The clip is walked through again and again where it is shorter than the dance.
      const size_t at = (dance.size() + static_cast<size_t>(request.frames) - 1) % poses.size();
      request.target = WorldTarget{poses[at], {}};
    }
    request.seed = seed;
    request.first_frame = static_cast<int64_t>(dance.size() - tau);
    request.temperature = temperature;
    std::optional<ArrivalResult> arrival;
    for (const DanceFrame& frame : RunTransition(engine, request, {}, &arrival)) {
      row.finite =
          row.finite && frame.pose.rotations.allFinite() && frame.pose.root_position.allFinite();
      gatherer.Add(frame.pose, dance.size() == tau);
      const Eigen::Vector3d& root = frame.pose.root_position;
      row.lowest_m = std::min(row.lowest_m, root.y());
      row.highest_m = std::max(row.highest_m, root.y());
      row.root_reach_m =
          std::max(row.root_reach_m, std::hypot(root.x() - start.x(), root.z() - start.z()));
      dance.push_back(frame.pose);
    }
    if (arrival) row.worst_key_m = std::max(row.worst_key_m, arrival->final_error_m);
  }
  std::vector<double> late(
      gatherer.means().end() - static_cast<std::ptrdiff_t>(gatherer.means().size() / 5),
      gatherer.means().end());
  row.late_speed = Percentile(&late, 0.5);
  row.median_speed = Percentile(&gatherer.means(), 0.5);
  row.bent_backwards = gatherer.bent_backwards();
  int within = 0;
  for (size_t j = 0; j < real.low.size(); ++j) {
    const double median = Percentile(&gatherer.speeds()[j], 0.5);
    if (median >= real.low[j] && median <= real.high[j]) ++within;
  }
  row.joints_in_real_speed = static_cast<double>(within) / static_cast<double>(real.low.size());
  return row;
}

}  // namespace choreo
