#include "model/training/clips/clip_track.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "model/motion/controls/velocity_factors.h"
#include "model/motion/kinematics/kinematic_beats.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

constexpr double kEnergySigma = 6;  // frames: energy is an average over swings
constexpr double kFastBeat = 11,
                 kSlowBeat = 24;  // frames between beats that are derived from a dance
constexpr double kUneven = 0.3;   // tolerated unevenness of such beats
constexpr int kBeatTries = 12;

double Note(const PreparedClip& clip, const std::string& key) {
  const auto found = clip.notes.find(key);
  return found == clip.notes.end() ? 0 : std::atof(found->second.c_str());
}

}  // namespace

Eigen::MatrixXd SmoothRows(const Eigen::MatrixXd& rows, double sigma) {
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  const int last = static_cast<int>(rows.cols()) - 1;
  Eigen::MatrixXd smooth = Eigen::MatrixXd::Zero(rows.rows(), rows.cols());
  for (int i = 0; i <= last; ++i) {
    double sum = 0;
    for (int k = -reach; k <= reach; ++k) {
      const double weight = std::exp(-0.5 * k * k / (sigma * sigma));
      smooth.col(i) += weight * rows.col(std::clamp(i + k, 0, last));
      sum += weight;
    }
    smooth.col(i) /= sum;
  }
  return smooth;
}

ClipTrack MakeTrack(const PreparedClip& clip, double tempo,
                    const std::vector<std::string>& styles) {
  const Skeleton& skeleton = clip.skeleton;
  const auto& frames = clip.motion.frames;
  ClipTrack track;
  for (double at = 0; at + 1 < static_cast<double>(frames.size()); at += tempo) {
    const auto first = static_cast<size_t>(at);
    const double part = at - static_cast<double>(first);
    track.poses.push_back(part > 0 ? InterpolatePoses(frames[first], frames[first + 1], part)
                                   : frames[first]);
  }
  for (const Pose& pose : track.poses)
    track.stage.origin += pose.root_position / static_cast<double>(track.poses.size());
  track.stage.heading = MeanFacing(track.poses);
  const BodyPartWeights weights = WeighBodyParts(skeleton);
  Eigen::MatrixXd energy = Eigen::MatrixXd::Zero(kBodyParts, static_cast<int>(track.poses.size()));
  std::vector<float> speed;
  Eigen::Matrix3Xd before;
  for (size_t i = 0; i < track.poses.size(); ++i) {
    const Eigen::Matrix3Xd positions = JointPositions(skeleton, track.poses[i]);
    if (i > 0) {
      const auto factors = PartSpeeds(weights, before, positions);
      energy.col(i) = Eigen::Map<const Eigen::VectorXd>(factors.data(), kBodyParts);
      speed.push_back(static_cast<float>((positions - before).colwise().norm().mean()));
    }
    before = positions;
  }
  if (energy.cols() > 1) energy.col(0) = energy.col(1);
  track.energy = SmoothRows(energy, kEnergySigma);
  for (const int64_t beat : KinematicBeats(speed, clip.motion.fps))
    track.kinematic.push_back(static_cast<double>(beat));
  const double period = Note(clip, "beat_period_s"), fps = clip.motion.fps;
  if (period > 0) {
    const double last = static_cast<double>(track.poses.size()) + fps;
    // Steps land on a grid's beats. Kinematic beats (paper F, Section 4.2), which evaluations
    // count, are where steps are fastest: halfway between.
    for (double at = Note(clip, "beat_offset_s") + period / 2; at * fps / tempo < last;
         at += period)
      track.beats.push_back(at * fps / tempo);
  }
  const auto style = std::ranges::find(styles, StyleOf(clip.name));
  if (style != styles.end()) track.style = static_cast<int>(style - styles.begin());
  return track;
}

std::vector<double> BeatsFor(const ClipTrack& track, int64_t from, int64_t to, Random* random) {
  std::vector<double> beats;
  const auto first = static_cast<double>(from), last = static_cast<double>(to);
  if (!track.beats.empty()) {
    for (const double beat : track.beats) {
      if (beat > first - 2 * kSlowBeat && beat < last + 2 * kSlowBeat)
        beats.push_back(beat - first);
    }
    return beats;
  }
  std::vector<double> pauses;
  for (const double pause : track.kinematic) {
    if (pause > first - kSlowBeat && pause < last + kSlowBeat) pauses.push_back(pause - first);
  }
  if (pauses.size() < 2) return {};
  for (int attempt = 0; attempt < kBeatTries; ++attempt) {
    const double period = random->Uniform(kFastBeat, kSlowBeat);
    beats.assign(1, pauses.front());
    bool even = true;
    for (size_t i = 1; i < pauses.size() && even; ++i) {
      const double gap = pauses[i] - beats.back();
      const int count = std::max(1, static_cast<int>(std::lround(gap / period)));
      if (gap < (1 - kUneven) * period) continue;  // a pause between two beats
      even = std::abs(gap / count / period - 1) < kUneven;
      const double begin = beats.back();
      for (int k = 1; k <= count; ++k) beats.push_back(begin + gap * k / count);
    }
    if (even && beats.size() >= 2) return beats;
  }
  return {};
}

}  // namespace choreo
