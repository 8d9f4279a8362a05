#include "model/training/window_clips.h"

#include <torch/torch.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "model/core/error.h"
#include "model/dance/quality_report.h"
#include "model/motion/canonical.h"
#include "model/motion/kinematics.h"
#include "model/motion/mirror.h"
#include "model/motion/resample.h"
#include "model/motion/rotation.h"
#include "model/training/style.h"

namespace choreo {
namespace {

constexpr double kTempi[] = {1.0, 0.8, 0.9, 1.12, 1.25};
constexpr double kEnergySigma = 6;       // frames: energy is asked for, not every swing
constexpr double kDrawnSigma = 6;        // frames: what a path drawn by hand leaves out
constexpr double kCovarianceSigma = 30;  // frames, of the taper that keeps covariances definite
constexpr double kFastBeat = 11, kSlowBeat = 24;  // frames, of beats that are read into a dance
constexpr double kUneven = 0.3;                   // that such beats may be apart from even ones
constexpr int kBeatTries = 12;
constexpr double kFarAstray = 3;      // times a velocity's spread
constexpr double kLeastSpeed = 1e-4;  // radians a frame

double Note(const PreparedClip& clip, const std::string& key) {
  const auto found = clip.notes.find(key);
  return found == clip.notes.end() ? 0 : std::atof(found->second.c_str());
}

Eigen::MatrixXd Smooth(const Eigen::MatrixXd& rows, double sigma) {
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

Eigen::VectorXd Velocity(const Pose& before, const Pose& now) {
  Eigen::VectorXd velocity(3 + now.rotations.size());
  velocity.head<3>() = now.root_position - before.root_position;
  for (Eigen::Index j = 0; j < now.rotations.cols(); ++j)
    velocity.segment<3>(3 + 3 * j) =
        RotationDifference(before.rotations.col(j), now.rotations.col(j));
  return velocity;
}

template <typename Matrix>
torch::Tensor Columns(const Matrix& matrix) {  // [rows, columns] → [columns, rows]
  const Eigen::MatrixXf floats = matrix.template cast<float>();
  return torch::from_blob(const_cast<float*>(floats.data()), {floats.cols(), floats.rows()})
      .clone();
}

// Moves the first `tau` poses to where no dancer stands, all alike, and leads the others back to
// where they are, within a second or so and before the last. `spread`: of velocities.
void LeadAstray(const Eigen::VectorXd& spread, int tau, Random* random, std::vector<Pose>* poses) {
  const int64_t most = static_cast<int64_t>(poses->size()) - tau;
  const auto back = static_cast<double>(std::min(most, random->Integer(12, 40)));
  const double far = random->Uniform(0, kFarAstray);
  Eigen::VectorXd offset(spread.size());
  for (Eigen::Index d = 0; d < offset.size(); ++d) offset[d] = far * spread[d] * random->Normal();
  offset[0] = offset[2] = 0;  // any place on the floor is as good
  for (size_t i = 0; i < poses->size(); ++i) {
    const double way = std::clamp((static_cast<double>(i) - tau + 1) / back, 0.0, 1.0);
    const double left = 1 - way * way * (3 - 2 * way);
    Pose& pose = (*poses)[i];
    pose.root_position += left * offset.head<3>();
    for (Eigen::Index j = 0; j < pose.rotations.cols(); ++j)
      pose.rotations.col(j) =
          RotationCompose(pose.rotations.col(j), left * offset.segment<3>(3 + 3 * j));
  }
}

Eigen::MatrixXd PlacesOf(const Skeleton& skeleton, std::span<const Pose> poses) {
  Eigen::MatrixXd places(3 * skeleton.joints(), static_cast<int>(poses.size()));
  for (size_t i = 0; i < poses.size(); ++i)
    places.col(static_cast<int>(i)) = JointPositions(skeleton, poses[i]).reshaped();
  return places;
}

Eigen::MatrixXd RootsOf(std::span<const Pose> poses) {
  Eigen::MatrixXd roots(3, static_cast<int>(poses.size()));
  for (size_t i = 0; i < poses.size(); ++i) roots.col(static_cast<int>(i)) = poses[i].root_position;
  return roots;
}

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;  // as torch has matrices

// Local rotations, [9 joints, frames].
Eigen::MatrixXd TurnsOf(std::span<const Pose> poses) {
  const Eigen::Index joints = poses.front().rotations.cols();
  Eigen::MatrixXd turns(9 * joints, static_cast<int>(poses.size()));
  for (size_t i = 0; i < poses.size(); ++i) {
    for (Eigen::Index j = 0; j < joints; ++j) {
      const RowMajor3d turn = ExpMap(poses[i].rotations.col(j));
      turns.col(static_cast<int>(i)).segment<9>(9 * j) = turn.reshaped<Eigen::RowMajor>();
    }
  }
  return turns;
}

// How the joints of real motion move with the flow's coordinates, which are rotation vectors `x`
// behind those of the mean: as WindowBatch has axes and bones.
struct Lever {
  Eigen::MatrixXd axes, bones;

  Lever(const Skeleton& skeleton, std::span<const Pose> truth, const Eigen::MatrixXd& x) {
    const int joints = skeleton.joints(), frames = static_cast<int>(truth.size());
    axes.resize(9 * joints, frames);
    bones = Eigen::MatrixXd::Zero(3 * joints, frames);
    JointPlacement placement;
    for (int i = 0; i < frames; ++i) {
      ForwardKinematics(skeleton, truth[static_cast<size_t>(i)], placement);
      for (int j = 0; j < joints; ++j) {
        const RowMajor3d axis = placement.rotations[static_cast<size_t>(j)] *
                                RightJacobian(x.col(i).segment<3>(3 + 3 * j));
        axes.col(i).segment<9>(9 * j) = axis.reshaped<Eigen::RowMajor>();
        const int parent = skeleton.parents[static_cast<size_t>(j)];
        if (j > 0)
          bones.col(i).segment<3>(3 * j) =
              placement.positions.col(j) - placement.positions.col(parent);
      }
    }
  }
};

}  // namespace

WindowClips::WindowClips(const std::vector<PreparedClip>& clips)
    : skeleton_(clips.front().skeleton), clips_(clips.size()) {
  for (const PreparedClip& clip : clips) {
    if (const std::string style = StyleOf(clip.name); !style.empty()) styles_.push_back(style);
  }
  std::ranges::sort(styles_);
  styles_.erase(std::ranges::unique(styles_).begin(), styles_.end());
  for (const double tempo : kTempi) {
    for (const PreparedClip& clip : clips) tracks_.push_back(MakeTrack(clip, tempo));
  }
}

WindowClips::Track WindowClips::MakeTrack(const PreparedClip& clip, double tempo) const {
  const auto& frames = clip.motion.frames;
  Track track{.tempo = tempo};
  for (double at = 0; at + 1 < static_cast<double>(frames.size()); at += tempo) {
    const auto first = static_cast<size_t>(at);
    const double part = at - static_cast<double>(first);
    track.poses.push_back(part > 0 ? InterpolatePoses(frames[first], frames[first + 1], part)
                                   : frames[first]);
  }
  const BodyPartWeights weights = WeighBodyParts(skeleton_);
  Eigen::MatrixXd energy = Eigen::MatrixXd::Zero(kBodyParts, static_cast<int>(track.poses.size()));
  std::vector<float> speed;
  Eigen::Matrix3Xd before;
  for (size_t i = 0; i < track.poses.size(); ++i) {
    const Eigen::Matrix3Xd positions = JointPositions(skeleton_, track.poses[i]);
    if (i > 0) {
      const auto factors = VelocityFactors(weights, before, positions);
      energy.col(static_cast<int>(i)) =
          Eigen::Map<const Eigen::VectorXd>(factors.data(), kBodyParts);
      speed.push_back(static_cast<float>((positions - before).colwise().norm().mean()));
    }
    before = positions;
  }
  if (energy.cols() > 1) energy.col(0) = energy.col(1);
  track.energy = Smooth(energy, kEnergySigma);
  for (const int64_t beat : KinematicBeats(speed, clip.motion.fps))
    track.kinematic.push_back(static_cast<double>(beat));
  const double period = Note(clip, "beat_period_s"), fps = clip.motion.fps;
  if (period > 0) {
    const double last = static_cast<double>(track.poses.size()) + fps;
    // A grid's beats are where steps land; a kinematic beat (paper F, Section 4.2), which is what
    // dances are judged by, is where they are fastest: half way between.
    for (double at = Note(clip, "beat_offset_s") + period / 2; at * fps / tempo < last;
         at += period)
      track.beats.push_back(at * fps / tempo);
  }
  const auto style = std::ranges::find(styles_, StyleOf(clip.name));
  if (style != styles_.end()) track.style = static_cast<int>(style - styles_.begin());
  return track;
}

// Beats of a song that the frames from `from` to `to` would be danced to, from `from` on; none
// where the dance's pauses are too uneven for one.
std::vector<double> WindowClips::Beats(const Track& track, int64_t from, int64_t to,
                                       Random* random) const {
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

WindowBatch WindowClips::Draw(const FlowModelParts& model, int batch, int frames, int to_key,
                              const Variation& variation, Random* random) const {
  const int tau = model.config.history_frames, joints = skeleton_.joints();
  const std::vector<int> pairs = MirrorPairs(skeleton_);
  const int64_t needed = tau + to_key;
  const auto offered = [&](size_t track) {
    return std::max<int64_t>(0, static_cast<int64_t>(tracks_[track].poses.size()) - needed);
  };
  std::vector<int64_t> ends;
  int64_t windows = 0;
  for (size_t clip = 0; clip < clips_; ++clip) ends.push_back(windows += offered(clip));
  if (windows == 0) {
    throw InvalidArgument(
        "frames", "no clip has the " + std::to_string(needed) + " frames that a window needs");
  }
  WindowBatch result{.frames = frames, .to_key = to_key};
  std::vector<torch::Tensor> z, scales, keyed, mean, features, whole, history_joints, base_root,
      base_turns, axes, bones;
  while (static_cast<int>(z.size()) < batch) {
    const int64_t pick = random->Integer(0, windows);
    const size_t clip =
        static_cast<size_t>(std::upper_bound(ends.begin(), ends.end(), pick) - ends.begin());
    size_t index = clip;
    if (random->Uniform() < variation.tempo) {
      const size_t other =
          clip + clips_ * static_cast<size_t>(random->Integer(1, std::size(kTempi)));
      if (offered(other) > 0) index = other;
    }
    const Track& track = tracks_[index];
    const int64_t from = random->Integer(0, offered(index));
    const bool mirrored = random->Uniform() < variation.mirror;
    std::vector<Pose> poses(track.poses.begin() + from, track.poses.begin() + from + needed);
    if (mirrored) {
      for (Pose& pose : poses) pose = Mirror(pairs, pose);
    }
    if (random->Uniform() < variation.astray)
      LeadAstray(model.prior.covariance().col(0).cwiseSqrt(), tau, random, &poses);
    Eigen::Vector3d turning = Eigen::Vector3d::Zero();
    for (size_t i = static_cast<size_t>(tau); i < poses.size(); ++i)
      turning += RotationDifference(poses[i - 1].rotations.col(0), poses[i].rotations.col(0));
    if (random->Uniform() < variation.hold_history) {
      const int64_t known = random->Integer(1, tau);
      std::fill(poses.begin(), poses.begin() + (tau - known),
                poses[static_cast<size_t>(tau - known)]);
    }
    const GroundFrame ground = GroundFrame::Of(poses[static_cast<size_t>(tau) - 1]);
    for (Pose& pose : poses) pose = ground.ToLocal(pose);
    const std::span<const Pose> truth(poses.data() + tau, static_cast<size_t>(frames));

    WindowRequest request{.frames = frames, .to_key = to_key, .turning = turning};
    request.history.assign(poses.begin(), poses.begin() + tau);
    if (!(random->Uniform() < variation.no_key)) request.key = poses.back();
    if (random->Uniform() < variation.partial_key) {
      const double keep = random->Uniform(0.3, 1.0);
      for (int j = 0; j < joints; ++j) request.mask.joints.push_back(random->Uniform() < keep);
      request.mask.root_position = random->Uniform() < keep;
      request.height = random->Uniform() < 0.5;
    }
    const int64_t first = from + tau;
    if (random->Uniform() < variation.beats)
      request.beats = Beats(track, first, first + frames, random);
    if (random->Uniform() < variation.energy) {
      request.energy = track.energy.middleCols(first, frames);
      if (mirrored) {
        request.energy.row(1).swap(request.energy.row(2));
        request.energy.row(3).swap(request.energy.row(4));
      }
      if (random->Uniform() < 0.7) {  // as constants
        const Eigen::VectorXd constant = request.energy.rowwise().mean();
        request.energy = constant.replicate(1, frames);
      }
      const double known = random->Uniform() < 0.7 ? 1 : random->Uniform();
      for (bool& asked : request.asked) asked = random->Uniform() < known;
    }
    if (random->Uniform() < variation.path) {
      request.path.resize(3, frames);
      for (int i = 0; i < frames; ++i)
        request.path.col(i) = truth[static_cast<size_t>(i)].root_position;
      if (random->Uniform() < 0.4) request.path = Smooth(request.path, kDrawnSigma);
      request.path_heights = random->Uniform() < 0.3;
    }
    if (random->Uniform() < variation.style) request.style = track.style;

    const FlowWindow window(model.prior, request);
    const auto x = window.Encode(truth);
    if (!x) continue;  // she strays from any line to the key
    Eigen::MatrixXd white(x->rows(), x->cols());
    for (int d = 0; d < white.rows(); ++d)
      white.row(d) = window.Whiten(d, x->row(d).transpose()).transpose();
    white = white.cwiseMax(-MotionPrior::kMostWhite).cwiseMin(MotionPrior::kMostWhite);
    Eigen::MatrixXd lines(x->rows(), tau + frames);
    lines << window.history(), window.mean();
    const WindowFeatures described =
        DescribeWindow(skeleton_, model.config, model.prior, request, window);
    Eigen::VectorXd fixed(white.rows());
    for (int d = 0; d < fixed.size(); ++d)
      fixed[d] = window.keyed()[static_cast<size_t>(d)] ? 1 : 0;
    z.push_back(Columns(white));
    mean.push_back(Columns(lines));
    result.surprise.push_back(window.surprise());
    scales.push_back(Columns(window.scales()).squeeze(0));
    keyed.push_back(Columns(fixed).squeeze(0));
    features.push_back(Columns(described.frames));
    whole.push_back(Columns(described.whole).squeeze(0));
    history_joints.push_back(Columns(PlacesOf(skeleton_, request.history)));
    const std::vector<Pose> base = window.Decode(Eigen::MatrixXd::Zero(x->rows(), frames));
    base_root.push_back(Columns(RootsOf(base)));
    base_turns.push_back(Columns(TurnsOf(base)).view({frames, joints, 3, 3}));
    const Lever lever(skeleton_, truth, *x);
    axes.push_back(Columns(lever.axes).view({frames, joints, 3, 3}));
    bones.push_back(Columns(lever.bones).view({frames, joints, 3}));
    result.truth.emplace_back(truth.begin(), truth.end());
    result.requests.push_back(std::move(request));
  }
  result.z = torch::stack(z);
  result.mean = torch::stack(mean);
  result.scales = torch::stack(scales);
  result.keyed = torch::stack(keyed);
  result.features = torch::stack(features);
  result.whole = torch::stack(whole);
  result.history_joints = torch::stack(history_joints);
  result.base_root = torch::stack(base_root);
  result.base_turns = torch::stack(base_turns);
  result.axes = torch::stack(axes);
  result.bones = torch::stack(bones);
  return result;
}

int WindowClips::Longest(int history) const {
  size_t longest = 0;
  for (size_t clip = 0; clip < clips_; ++clip)
    longest = std::max(longest, tracks_[clip].poses.size());
  return static_cast<int>(longest) - history - 1;
}

std::array<double, kBodyParts> WindowClips::MedianFactors() const {
  std::array<double, kBodyParts> medians;
  for (int part = 0; part < kBodyParts; ++part) {
    std::vector<double> values;
    for (size_t clip = 0; clip < clips_; ++clip) {
      const auto row = tracks_[clip].energy.row(part);
      values.insert(values.end(), row.begin(), row.end());
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    medians[static_cast<size_t>(part)] = *middle;
  }
  return medians;
}

Eigen::MatrixXd WindowClips::VelocityCovariance(int lags) const {
  const std::vector<int> pairs = MirrorPairs(skeleton_);
  const int dimensions = 3 + 3 * skeleton_.joints();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(dimensions, lags);
  double frames = 0;
  for (size_t clip = 0; clip < clips_; ++clip) {
    const auto& poses = tracks_[clip].poses;
    if (poses.size() < 2) continue;
    Eigen::MatrixXd velocity(dimensions, static_cast<int>(poses.size()) - 1);
    for (int i = 0; i < velocity.cols(); ++i)
      velocity.col(i) = Velocity(poses[static_cast<size_t>(i)], poses[static_cast<size_t>(i) + 1]);
    for (int lag = 0; lag < std::min<int>(lags, static_cast<int>(velocity.cols())); ++lag) {
      const int count = static_cast<int>(velocity.cols()) - lag;
      sum.col(lag) +=
          velocity.leftCols(count).cwiseProduct(velocity.rightCols(count)).rowwise().sum();
    }
    frames += static_cast<double>(velocity.cols());
  }
  sum /= frames;
  for (int lag = 0; lag < lags; ++lag)
    sum.col(lag) *= std::exp(-0.5 * std::pow(lag / kCovarianceSigma, 2));
  // Sideways is as forwards: positions stand in no frame of the dancer's. And sides are alike.
  const Eigen::RowVectorXd floor = 0.5 * (sum.row(0) + sum.row(2));
  sum.row(0) = sum.row(2) = floor;
  Eigen::MatrixXd covariance = sum;
  for (int j = 0; j < skeleton_.joints(); ++j) {
    covariance.middleRows<3>(3 + 3 * j) =
        0.5 *
        (sum.middleRows<3>(3 + 3 * j) + sum.middleRows<3>(3 + 3 * pairs[static_cast<size_t>(j)]));
  }
  // Joints that recordings lack never move.
  covariance.col(0) = covariance.col(0).cwiseMax(kLeastSpeed * kLeastSpeed);
  return covariance;
}

}  // namespace choreo
