#include "model/training/windows/window_clips.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "model/core/numbers/smooth_step.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/mirror.h"
#include "model/motion/resample.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kTempi[] = {1.0, 0.8, 0.9, 1.12, 1.25};
constexpr double kDrawnSigma = 6;  // frames: smooths a path as if drawn by hand
constexpr double kConstant = 0.3;  // share of energies that are given as their mean
// The distance from usual poses at which astray windows begin: with a key, in spreads of
// velocities; without one, in spreads of poses, because nothing bounds a free dance.
constexpr double kAstray = 3, kFreeAstray = 1;

// Displaces the first `tau` poses by one offset, to poses that no dancer takes, and leads the
// following ones back within about a second and before the last. `most_far`: the largest spread of
// the offset.
void MoveAstray(const Eigen::VectorXd& most_far, int tau, Random* random,
                std::vector<Pose>* poses) {
  const int64_t most = static_cast<int64_t>(poses->size()) - tau;
  const auto back = static_cast<double>(std::min(most, random->Integer(12, 40)));
  const double far = random->Uniform();
  Eigen::VectorXd offset(most_far.size());
  for (Eigen::Index d = 0; d < offset.size(); ++d) offset[d] = far * most_far[d] * random->Normal();
  offset[0] = offset[2] = offset[MotionPrior::kTurn] = 0;  // all places and facings are equivalent
  for (size_t i = 0; i < poses->size(); ++i) {
    const double way = std::clamp((static_cast<double>(i) - tau + 1) / back, 0.0, 1.0);
    const double left = 1 - SmoothStep(way);
    Pose& pose = (*poses)[i];
    pose.root_position += left * offset.head<3>();
    for (Eigen::Index j = 0; j < pose.rotations.cols(); ++j)
      pose.rotations.col(j) =
          RotationCompose(pose.rotations.col(j), left * offset.segment<3>(3 + 3 * j));
  }
}

// Leads from `before`, at least tau + turn poses of another motion, into the first poses after the
// history, at their place and heading.
void LeadOver(std::span<const Pose> before, int tau, int64_t turn, std::vector<Pose>* poses) {
  const GroundFrame theirs = GroundFrame::Of(before[tau - 1]),
                    ours = GroundFrame::Of((*poses)[tau - 1]);
  for (int64_t i = 0; i < tau + turn; ++i) {
    Pose& pose = (*poses)[i];
    const double way = static_cast<double>(i - tau + 1) / static_cast<double>(turn + 1);
    pose = InterpolatePoses(ours.ToWorld(theirs.ToLocal(before[i])), pose,
                            SmoothStep(std::clamp(way, 0.0, 1.0)));
  }
}

// Puts a history in another style first, from which the dance changes to its own. From a dancer's
// own history alone, the network would know the style and ignore the label.
void BeginOtherwise(const ClipTrack& other, int style, int tau, Random* random,
                    std::vector<Pose>* poses) {
  const int64_t turn = std::min<int64_t>(random->Integer(12, 25), std::ssize(*poses) - tau);
  const int64_t room = std::ssize(other.poses) - tau - turn;
  if (other.style < 0 || other.style == style || room <= 0) return;
  LeadOver(std::span(other.poses).subspan(random->Integer(0, room)), tau, turn, poses);
}

// Puts standing still first, as dances begin.
void BeginStanding(const Skeleton& skeleton, int tau, Random* random, std::vector<Pose>* poses) {
  const int64_t turn = std::min<int64_t>(random->Integer(12, 40), std::ssize(*poses) - tau);
  LeadOver(std::vector<Pose>(tau + turn, StandingPose(skeleton)), tau, turn, poses);
}

// The request for a window of `frames` frames of the track from `first` on. `history`, `stage`, and
// `way`, which ends in the key, are in the canonical frame.
WindowRequest MakeRequest(std::span<const Pose> history, std::span<const Pose> way,
                          const GroundFrame& stage, const ClipTrack& track, int64_t first,
                          const WindowClips::Variation& variation, int frames, Random* random) {
  WindowRequest request{{.frames = frames, .history = {history.begin(), history.end()}},
                        static_cast<int>(way.size())};
  const bool keyed = !(random->Uniform() < variation.no_key);
  Target key{way.back(), {}};
  if (random->Uniform() < variation.partial_key) {
    const double keep = random->Uniform(0.3, 1.0);
    for (Eigen::Index j = 0; j < way.front().rotations.cols(); ++j)
      key.mask.joints.push_back(random->Uniform() < keep);
    key.mask.root_position = random->Uniform() < keep;
    if (random->Uniform() < 0.5) key.height = key.pose.root_position.y();
  }
  if (keyed) request.target = std::move(key);
  if (random->Uniform() < variation.beats)
    request.beats = BeatsFor(track, first, first + frames, random);
  if (random->Uniform() < variation.energy) {
    ControlCurve& energy = request.controls[kVelocityFactors];
    energy.values = track.energy.middleCols(first, frames);
    if (random->Uniform() < kConstant) {
      const Eigen::VectorXd constant = energy.values.rowwise().mean();
      energy.values = constant.replicate(1, frames);
    }
    const double known = random->Uniform() < 0.7 ? 1 : random->Uniform();
    for (auto&& requested : energy.requested) requested = random->Uniform() < known;
  }
  if (random->Uniform() < variation.path) {
    ControlCurve& path = request.controls[kRootPath];
    path.values.resize(3, frames);
    for (int i = 0; i < frames; ++i) path.values.col(i) = way[i].root_position;
    if (random->Uniform() < 0.4) path.values = SmoothRows(path.values, kDrawnSigma);
    path.requested[kPathHeight] = random->Uniform() < 0.3;
  }
  if (random->Uniform() >= variation.stage) return request;
  request.stage = stage;
  request.free_turn = TurnOver(history.back(), way.first(static_cast<size_t>(frames)));
  return request;
}

}  // namespace

WindowClips::WindowClips(const std::vector<PreparedClip>& clips)
    : skeleton_(clips.front().skeleton), clips_(clips.size()) {
  for (const PreparedClip& clip : clips) {
    if (const std::string style = StyleOf(clip.name); !style.empty()) styles_.push_back(style);
  }
  std::ranges::sort(styles_);
  styles_.erase(std::unique(styles_.begin(), styles_.end()), styles_.end());
  for (const double tempo : kTempi) {
    for (const PreparedClip& clip : clips) tracks_.push_back(MakeTrack(clip, tempo, styles_));
  }
}

std::vector<WindowPicker> WindowClips::PickersByStyle(int64_t window) const {
  std::vector<WindowPicker> pickers;
  for (int style = 0; style < std::ssize(styles_); ++style) {
    std::vector<int64_t> own;
    for (const ClipTrack& track : tracks())
      own.push_back(track.style == style ? std::ssize(track.poses) : 0);
    if (std::ranges::max(own) > window) pickers.emplace_back(own, window);
  }
  return pickers;
}

WindowBatch WindowClips::Draw(const FlowModelParts& model, int batch, int frames, int to_key,
                              const Variation& variation, Random* random) const {
  const int tau = model.config.history_frames;
  const std::vector<int> pairs = MirrorPairs(skeleton_);
  const int64_t needed = tau + to_key;
  const auto offered = [&](size_t track) { return std::ssize(tracks_[track].poses) - needed; };
  std::vector<int64_t> of_clips;
  for (const ClipTrack& track : tracks()) of_clips.push_back(std::ssize(track.poses));
  const WindowPicker of_all(of_clips, needed);
  std::vector<WindowPicker> of_style;
  if (variation.even_styles > 0) of_style = PickersByStyle(needed);
  const MotionPrior& prior = model.prior;
  Eigen::VectorXd astray = kAstray * prior.covariance().col(0).cwiseSqrt();
  if (variation.no_key > 0) astray = kFreeAstray * prior.usual().variance.cwiseSqrt();
  std::vector<WindowBatch> windows;
  while (std::ssize(windows) < batch) {
    const bool even = !of_style.empty() && random->Uniform() < variation.even_styles;
    const WindowPicker& picker = even ? of_style[random->Integer(0, std::ssize(of_style))] : of_all;
    const size_t clip = picker.Draw(random).clip;
    size_t index = clip;
    if (random->Uniform() < variation.tempo) {
      const size_t other = clip + clips_ * random->Integer(1, std::size(kTempi));
      if (offered(other) > 0) index = other;
    }
    const ClipTrack& track = tracks_[index];
    const int64_t from = random->Integer(0, offered(index));
    const bool mirrored = random->Uniform() < variation.mirror;
    std::vector<Pose> poses(track.poses.begin() + from, track.poses.begin() + from + needed);
    const bool styled = random->Uniform() < variation.style;
    if (styled && random->Uniform() < variation.other_style) {
      const ClipTrack& other = tracks_[random->Integer(0, std::ssize(tracks_))];
      BeginOtherwise(other, track.style, tau, random, &poses);
    }
    if (random->Uniform() < variation.standing) BeginStanding(skeleton_, tau, random, &poses);
    if (random->Uniform() < variation.astray) MoveAstray(astray, tau, random, &poses);
    Eigen::Vector3d turning = Eigen::Vector3d::Zero();
    for (size_t i = tau; i < poses.size(); ++i)
      turning += RotationDifference(poses[i - 1].rotations.col(0), poses[i].rotations.col(0));
    if (random->Uniform() < variation.hold_history) {
      const int64_t known = random->Integer(1, tau);
      std::fill(poses.begin(), poses.begin() + (tau - known), poses[tau - known]);
    }
    const GroundFrame ground = GroundFrame::Of(poses[tau - 1]);
    for (Pose& pose : poses) pose = ground.ToLocal(pose);
    const auto way = std::span<const Pose>(poses).subspan(tau);
    WindowRequest request =
        MakeRequest(std::span(poses).first(tau), way, ground.ToLocal(track.stage), track,
                    from + tau, variation, frames, random);
    request.turn_to_key = turning;
    if (styled) request.style = track.style;
    if (mirrored) {
      request = Mirror(pairs, request);
      for (Pose& pose : poses) pose = Mirror(pairs, pose);
    }
    if (auto window = MakeWindow(model, std::move(request), way.first(frames)))
      windows.push_back(std::move(*window));
  }
  return Stack(std::move(windows));
}

int WindowClips::Longest(int history) const {
  size_t longest = 0;
  for (const ClipTrack& track : tracks()) longest = std::max(longest, track.poses.size());
  return static_cast<int>(longest) - history - 1;
}

}  // namespace choreo
