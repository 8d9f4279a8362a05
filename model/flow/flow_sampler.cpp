#include "model/flow/flow_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/core/random.h"
#include "model/flow/window_energy.h"
#include "model/flow/window_features.h"
#include "model/motion/body_limits.h"
#include "model/motion/canonical.h"
#include "model/motion/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

// The most standard deviations from the usual height and tilt (UsualPose::Deviation) at which a
// window without a key may end, unless it began farther off. One in 200 of the training clips'
// frames is farther. A dance that goes there knows no way back: it falls or floats.
constexpr double kMaxDeviation = 7;
constexpr int kMaxRetakes = 4;

// The random numbers of a window, [.., w]: of the motion's dimensions, then of the energy's levels
// (the first frame's count) and curves.
Eigen::MatrixXf Normals(const FlowModelParts& model, const FlowNoise& noise, int frames) {
  Eigen::MatrixXf normals(model.prior.dimensions() + 2 * kBodyParts, frames);
  for (int i = 0; i < frames; ++i)
    noise.Fill(i, {normals.col(i).data(), static_cast<size_t>(normals.rows())});
  return normals;
}

// The uses of a frame's random numbers after those of Normals.
enum Decision { kFreeTurn, kWayToKey, kDecisions };

double NumberFor(Decision decision, const FlowModelParts& model, const FlowNoise& noise) {
  const auto first = static_cast<size_t>(model.prior.dimensions() + 2 * kBodyParts);
  std::vector<float> normal(first + kDecisions);
  noise.Fill(0, normal);
  return normal[first + decision];
}

}  // namespace

// The root path of the controls: which axes it fixes, and where, as residuals x and as white
// coordinates z, both [3, w].
struct KnownPath {
  KnownPath(const WindowRequest& request, const FlowWindow& window);

  std::vector<int> axes;
  Eigen::MatrixXd x, z;
};

// F of one window at each step from noise to motion, with guidance by its labels. Model, network
// and window must outlive it.
class FlowField {
 public:
  FlowField(const FlowModelParts& model, const FlowNetwork& network, WindowRequest request,
            const FlowWindow& window);

  int steps() const { return model_.config.steps; }
  double Angle(int step) const { return step * (std::numbers::pi / 2 / steps()); }

  // F of the flow at w: z = size (cos noise + sin motion), size = 1 / (cos + sin). A slice is one
  // evaluation of the network.
  Slices<Eigen::MatrixXd> Evaluate(const Eigen::MatrixXd& w, int step);

 private:
  // One input for the network.
  struct View {
    Eigen::MatrixXf frames, conditions;
  };
  void AddView(const WindowRequest& request);
  Eigen::MatrixXd See(const View& view, const Eigen::MatrixXd& z, int step) const;
  double SizeAt(int step) const;

  const FlowModelParts& model_;
  const FlowNetwork& network_;
  const FlowWindow& window_;
  std::vector<float> times_;  // per step
  Eigen::MatrixXf mean_, poses_, joints_;
  std::vector<View> views_;  // as labelled and, for guidance, without labels
  double guidance_;
  // Beats affect neighbouring steps alike, so the last step takes their effect from the one before.
  bool keeps_effect_;
  Eigen::MatrixXd effect_;
};

KnownPath::KnownPath(const WindowRequest& request, const FlowWindow& window) {
  const ControlCurve& path = request.controls[kRootPath];
  if (!path.IsGiven()) return;
  axes = {0, 2};
  if (path.IsRequested(kPathHeight)) axes.push_back(kPathHeight);
  x = path.values.colwise() - request.history.back().root_position;
  x -= window.mean().topRows<3>();
  z.resize(3, x.cols());
  for (int axis = 0; axis < 3; ++axis)
    z.row(axis) = window.Whiten(axis, x.row(axis).transpose()).transpose();
}

FlowField::FlowField(const FlowModelParts& model, const FlowNetwork& network, WindowRequest request,
                     const FlowWindow& window)
    : model_(model), network_(network), window_(window) {
  for (int step = 0; step < model.config.steps; ++step)
    times_.push_back(static_cast<float>(SizeAt(step) * std::sin(Angle(step))));
  const auto tau = static_cast<Eigen::Index>(request.history.size());
  mean_.resize(model.prior.dimensions(), tau + window.frames());
  mean_ << window.history().cast<float>(), window.mean().cast<float>();
  poses_ = mean_;
  joints_.resize(3 * model.skeleton.joints(), mean_.cols());
  for (Eigen::Index i = 0; i < tau; ++i) {
    const Pose& pose = request.history[static_cast<size_t>(i)];
    joints_.col(i) = JointPositions(model.skeleton, pose).reshaped().cast<float>();
  }
  const bool labelled = !request.beats.empty() || request.style >= 0;
  keeps_effect_ = request.style < 0;
  guidance_ = labelled ? model.config.guidance : 1;
  AddView(request);
  request.beats.clear();
  request.style = -1;
  if (guidance_ != 1) AddView(request);
}

Slices<Eigen::MatrixXd> FlowField::Evaluate(const Eigen::MatrixXd& w, int step) {
  const Eigen::MatrixXd z = SizeAt(step) * w;
  const Eigen::MatrixXd x = window_.Colour(z);
  poses_.rightCols(x.cols()) = (window_.mean() + x).cast<float>();
  joints_.rightCols(x.cols()) = window_.PlaceJoints(model_.skeleton, x);
  const Eigen::MatrixXd f = See(views_.front(), z, step);
  co_await Pause();
  if (views_.size() == 1) co_return f;
  if (keeps_effect_ && step > 0 && step + 1 == steps()) co_return f + (guidance_ - 1) * effect_;
  const Eigen::MatrixXd plain = See(views_.back(), z, step);
  co_await Pause();
  effect_ = f - plain;
  const Eigen::MatrixXd guided = guidance_ * f + (1 - guidance_) * plain;
  co_return guided;
}

Eigen::MatrixXd FlowField::See(const View& view, const Eigen::MatrixXd& z, int step) const {
  return network_
      .Evaluate(z.cast<float>(), poses_, joints_, mean_, view.frames, view.conditions.col(step))
      .cast<double>();
}

void FlowField::AddView(const WindowRequest& request) {
  WindowFeatures seen =
      DescribeWindow(model_.skeleton, model_.config, model_.prior, request, window_);
  views_.push_back({std::move(seen.frames), network_.Condition(seen.whole, times_)});
}

double FlowField::SizeAt(int step) const {
  return 1 / (std::cos(Angle(step)) + std::sin(Angle(step)));
}

namespace {

// One pass from noise to motion.
Slices<std::vector<Pose>> SamplePass(const FlowModelParts& model, const FlowNetwork& network,
                                     WindowRequest request, FlowNoise noise) {
  FlowWindow window(model.prior, request);
  const Eigen::MatrixXf normals = Normals(model, noise, window.frames());
  const double temperature = std::min(noise.temperature, kMaxFlowTemperature);
  const double energy_temperature = std::min(noise.temperature, 1.0);
  FillInEnergy(model, normals.col(0).segment<kBodyParts>(model.prior.dimensions()).cast<double>(),
               normals.bottomRows<kBodyParts>().cast<double>(), energy_temperature, window,
               &request);
  CorrectLevels(model, energy_temperature, &request);
  window.SetEnergy(model.prior, request);
  const KnownPath known(request, window);
  const Eigen::MatrixXd still = Eigen::MatrixXd::Zero(model.prior.dimensions(), window.frames());
  // Noise is correlated over dimensions like motion.
  Eigen::MatrixXd start = still;
  if (temperature > 0)
    start =
        model.mixing.triangularView<Eigen::Lower>() * normals.topRows(still.rows()).cast<double>();
  FlowField field(model, network, std::move(request), window);

  Eigen::MatrixXd w = start, mean, before;
  if (temperature != 1) mean = co_await field.Evaluate(still, 0);
  for (int step = 0; temperature > 0 && step < field.steps(); ++step) {
    // Moves coordinates that a path fixes from their noise to their known values, step by step.
    const double angle = field.Angle(step);
    for (const int axis : known.axes)
      w.row(axis) = std::cos(angle) * start.row(axis) + std::sin(angle) * known.z.row(axis);
    const Eigen::MatrixXd f = co_await field.Evaluate(w, step);
    w += field.Angle(1) * (step == 0 ? f : Eigen::MatrixXd(1.5 * f - 0.5 * before));
    w = w.cwiseMax(-MotionPrior::kMaxWhite).cwiseMin(MotionPrior::kMaxWhite);
    before = f;
  }
  if (temperature != 1) w = mean + temperature * (w - mean);
  Eigen::MatrixXd x = window.Colour(w);
  for (const int axis : known.axes) x.row(axis) = known.x.row(axis);
  co_return window.Decode(x);
}

// The window of a transition from its frame `from` on, in the canonical frame `ground`.
WindowRequest PartOf(const WindowRequest& request, int from, int frames,
                     const std::vector<Pose>& danced, const GroundFrame& ground) {
  WindowRequest part =
      request.Part(from, frames, std::span(danced).last(request.history.size()), ground);
  if (part.key && part.to_key > kSightFrames) {  // training shows none so far away
    part.key.reset();
    part.turning.reset();
  }
  return part;
}

}  // namespace

void FlowNoise::Fill(int frame, std::span<float> out) const {
  const int64_t own = first_frame + frame;
  FillNormalLike(seed, candidate, own, like.empty() ? own : like[static_cast<size_t>(frame)],
                 variation, out);
}

Slices<std::vector<Pose>> SampleWindow(const FlowModelParts& model, const FlowNetwork& network,
                                       WindowRequest request, FlowNoise noise) {
  const std::vector<int> pairs = MirrorPairs(model.skeleton);
  if (noise.temperature > 0) co_return co_await SamplePass(model, network, request, noise);
  // The mean motion is the mirror image of the mirrored request's. The network is not fully
  // symmetric, and the average of both answers is nearer to the truth than either.
  const std::vector<Pose> mirrored =
      co_await SamplePass(model, network, Mirror(pairs, request), noise);
  std::vector<Pose> poses = co_await SamplePass(model, network, request, noise);
  for (size_t i = 0; i < poses.size(); ++i)
    poses[i] = InterpolatePoses(poses[i], Mirror(pairs, mirrored[i]), 0.5);
  co_return poses;
}

Slices<std::vector<Pose>> SampleTransition(const FlowModelParts& model, const FlowNetwork& network,
                                           WindowRequest request, FlowNoise noise) {
  if (!request.turning)
    request.turning = model.turns.Sample(model.skeleton, request,
                                         NumberFor(kWayToKey, model, noise), noise.temperature);
  const auto tau = std::ssize(request.history);
  const UsualPose& usual = model.prior.usual();
  const int windows =
      (request.frames + model.config.window_frames - 1) / model.config.window_frames;
  std::vector<Pose> danced = request.history;
  for (int window = 0, from = 0; window < windows; ++window) {
    const int frames = request.frames * (window + 1) / windows - from;
    const GroundFrame ground = GroundFrame::Of(danced.back());
    const WindowRequest asked = PartOf(request, from, frames, danced, ground);
    const bool may_stray = !(asked.key && asked.to_key == asked.frames) &&
                           !request.controls[kRootPath].IsRequested(kPathHeight);
    const double most = std::max(kMaxDeviation, usual.Deviation(danced.back()));
    std::vector<Pose> nearest;
    double least = 0;  // how far it is beyond what dancers do: at most 1 if it is not
    for (int take = 0; take <= kMaxRetakes; ++take) {
      FlowNoise own = noise;
      own.first_frame += from;
      own.candidate += static_cast<uint32_t>(kMaxCandidates * take);
      if (!own.like.empty()) own.like.erase(own.like.begin(), own.like.begin() + from);
      WindowRequest part = asked;
      if (part.FrontCounts())
        part.turn = FreeTurn(model.prior, part,
                             std::min(own.temperature, 1.0) * NumberFor(kFreeTurn, model, own));
      std::vector<Pose> poses = co_await SampleWindow(model, network, part, own);
      double beyond = 0;
      if (noise.temperature > 0) {
        beyond = FindFastestStep(model.skeleton, asked.history.back(), poses, kModelFps).m_per_s /
                 kFastestJoint;
        if (may_stray)
          beyond = std::max(beyond, usual.Deviation(ground.ToWorld(poses.back())) / most);
      }
      if (take == 0 || beyond < least) {
        nearest = std::move(poses);
        least = beyond;
      }
      if (!(beyond > 1)) break;
    }
    for (const Pose& pose : nearest) {
      danced.push_back(ground.ToWorld(pose));
      MakeContinuous(danced.back(), danced[danced.size() - 2]);
    }
    from += frames;
  }
  danced.erase(danced.begin(), danced.begin() + tau);
  co_return danced;
}

}  // namespace choreo
