#include "model/flow/flow_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/flow/flow_field.h"
#include "model/flow/window/window_energy.h"
#include "model/flow/window/window_features.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/pose/body_limits.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

// The most standard deviations from the usual height and tilt (UsualPose::Deviation) at which a
// window without a key may end, unless it began farther off. One in 200 of the training clips'
// frames is farther. A dance that goes there knows no way back: it falls or floats.
constexpr double kMaxDeviation = 7;
constexpr int kRounds = 3;  // of requesting energy, if spare frames are left

// The random numbers of a window, [.., w]: of the motion's dimensions, then of the energy's levels
// (the first frame's count) and curves.
Eigen::MatrixXf Normals(const FlowModelParts& model, const TransitionNoise& noise, int frames) {
  Eigen::MatrixXf normals(model.prior.dimensions() + 2 * kBodyParts, frames);
  for (int i = 0; i < frames; ++i)
    noise.FillNoise(i, {normals.col(i).data(), static_cast<size_t>(normals.rows())});
  return normals;
}

// What a frame's random numbers after Normals' are for.
enum Decision { kFreeTurn, kWayToKey, kDecisions };

double NumberFor(Decision decision, const FlowModelParts& model, const TransitionNoise& noise) {
  const auto first = static_cast<size_t>(model.prior.dimensions() + 2 * kBodyParts);
  std::vector<float> normal(first + kDecisions);
  noise.FillNoise(0, normal);
  return normal[first + decision];
}

// The root path of the controls: which axes it fixes, and where, as residuals x and as white
// coordinates z, both [3, w].
struct FixedPath {
  FixedPath(const WindowRequest& request, const FlowWindow& window) {
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

  std::vector<int> axes;
  Eigen::MatrixXd x, z;
};

// The window's features as labelled and, if the model is guided by the labels, without them.
std::vector<WindowFeatures> Describe(const FlowModelParts& model, WindowRequest request,
                                     const FlowWindow& window) {
  const auto describe = [&] {
    return DescribeWindow(model.skeleton, model.config, model.prior, request, window);
  };
  std::vector<WindowFeatures> features = {describe()};
  const bool labelled = !request.beats.empty() || request.style >= 0;
  if (!labelled || model.config.guidance == 1) return features;
  request.beats.clear();
  request.style = -1;
  features.push_back(describe());
  return features;
}

// One pass from noise to motion.
Slices<std::vector<Pose>> SamplePass(const FlowModelParts& model, const FlowNetwork& network,
                                     WindowRequest request, TransitionNoise noise) {
  FlowWindow window(model.prior, request);
  const Eigen::MatrixXf normals = Normals(model, noise, window.frames());
  const double temperature = std::min(noise.temperature, kMaxFlowTemperature);
  const double energy_temperature = std::min(noise.temperature, 1.0);
  FillInEnergy(model, normals.col(0).segment<kBodyParts>(model.prior.dimensions()).cast<double>(),
               normals.bottomRows<kBodyParts>().cast<double>(), energy_temperature, window,
               &request);
  CorrectLevels(model, energy_temperature, &request);
  window.SetEnergy(model.prior, request);
  const FixedPath path(request, window);
  const Eigen::MatrixXd still = Eigen::MatrixXd::Zero(model.prior.dimensions(), window.frames());
  // Noise is correlated over dimensions like motion.
  Eigen::MatrixXd start = still;
  if (temperature > 0)
    start =
        model.mixing.triangularView<Eigen::Lower>() * normals.topRows(still.rows()).cast<double>();
  FlowField field(model, network, window, request.history, Describe(model, request, window),
                  /*keeps_effect=*/request.style < 0);

  Eigen::MatrixXd w = start, mean, before;
  if (temperature != 1) mean = co_await field.Evaluate(still, 0);
  for (int step = 0; temperature > 0 && step < field.steps(); ++step) {
    // Moves coordinates that a path fixes from their noise to their fixed values, step by step.
    const double angle = field.Angle(step);
    for (const int axis : path.axes)
      w.row(axis) = std::cos(angle) * start.row(axis) + std::sin(angle) * path.z.row(axis);
    const Eigen::MatrixXd f = co_await field.Evaluate(w, step);
    w += field.Angle(1) * (step == 0 ? f : Eigen::MatrixXd(1.5 * f - 0.5 * before));
    w = w.cwiseMax(-MotionPrior::kMaxWhite).cwiseMin(MotionPrior::kMaxWhite);
    before = f;
  }
  if (temperature != 1) w = mean + temperature * (w - mean);
  Eigen::MatrixXd x = window.Colour(w);
  for (const int axis : path.axes) x.row(axis) = path.x.row(axis);
  co_return window.Decode(x);
}

// The window of a transition from its frame `from` on, in the canonical frame `ground`.
WindowRequest PartOf(const WindowRequest& request, int from, int frames,
                     const std::vector<Pose>& danced, const GroundFrame& ground) {
  WindowRequest part =
      request.Part(from, frames, std::span(danced).last(request.history.size()), ground);
  if (part.target && part.to_key > kSightFrames) {  // training shows none so far away
    part.target.reset();
    part.turn_to_key.reset();
  }
  return part;
}

WindowRequest ToWindowRequest(const TransitionSpec& spec, const std::vector<std::string>& styles) {
  WindowRequest request{spec, spec.frames};
  if (!spec.target && spec.later) {
    request.target = spec.later->target;
    request.to_key += spec.later->frames;
  }
  if (request.target && request.target->height)
    request.target->pose.root_position.y() = *request.target->height;
  if (!request.stage) request.stage = GroundFrame();
  if (const auto style = std::ranges::find(styles, spec.style); style != styles.end())
    request.style = static_cast<int>(style - styles.begin());
  return request;
}

}  // namespace

Slices<std::vector<Pose>> SampleWindow(const FlowModelParts& model, const FlowNetwork& network,
                                       WindowRequest request, TransitionNoise noise) {
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
                                           WindowRequest request, TransitionNoise noise,
                                           SpareFrames* spare) {
  if (!request.turn_to_key)
    request.turn_to_key = model.turns.Sample(model.skeleton, request,
                                             NumberFor(kWayToKey, model, noise), noise.temperature);
  const auto tau = std::ssize(request.history);
  const UsualPose& usual = model.prior.usual();
  const int windows =
      (request.frames + model.config.window_frames - 1) / model.config.window_frames;
  std::vector<Pose> danced = request.history;
  for (int window = 0, from = 0; window < windows; ++window) {
    const int frames = request.frames * (window + 1) / windows - from;
    const GroundFrame ground = GroundFrame::Of(danced.back());
    const WindowRequest part = PartOf(request, from, frames, danced, ground);
    const bool may_stray = !(part.target && part.to_key == part.frames) &&
                           !request.controls[kRootPath].IsRequested(kPathHeight);
    const double most = std::max(kMaxDeviation, usual.Deviation(danced.back()));
    BestTake<std::vector<Pose>> best;
    while (best.WantsAnother() && spare->SpendUnlessFirst(best.takes(), frames)) {
      TransitionNoise own = noise;
      own.first_frame += from;
      own.candidate = CandidateOfTake(noise.candidate, best.takes());
      if (!own.noise_like.empty())
        own.noise_like.erase(own.noise_like.begin(), own.noise_like.begin() + from);
      WindowRequest own_part = part;
      if (part.FrontCounts())
        own_part.free_turn = FreeTurn(
            model.prior, part, std::min(own.temperature, 1.0) * NumberFor(kFreeTurn, model, own));
      std::vector<Pose> poses = co_await SampleWindow(model, network, own_part, own);
      double excess = 0;
      if (noise.temperature > 0) {
        excess = SpeedExcess(model.skeleton, part.history.back(), poses, kModelFps);
        if (may_stray)
          excess = std::max(excess, usual.Deviation(ground.ToWorld(poses.back())) / most);
      }
      best.Add(std::move(poses), excess);
    }
    for (const Pose& pose : best.motion()) {
      danced.push_back(ground.ToWorld(pose));
      MakeContinuous(danced.back(), danced[danced.size() - 2]);
    }
    from += frames;
  }
  danced.erase(danced.begin(), danced.begin() + tau);
  co_return danced;
}

ContinuousFlowSampler::ContinuousFlowSampler(ModelInfo info, std::string device,
                                             std::shared_ptr<const FlowModelParts> parts,
                                             std::shared_ptr<const FlowNetwork> network)
    : Sampler(std::move(info), std::move(device)),
      parts_(std::move(parts)),
      network_(std::move(network)) {}

Slices<Plan> ContinuousFlowSampler::Sample(const ValidSpec& valid) {
  const TransitionSpec& spec = *valid;
  WindowRequest request = ToWindowRequest(spec, model_.styles);
  ControlCurve& energy = request.controls[kVelocityFactors];
  const Eigen::MatrixXd wanted = energy.values;
  // The mean way's energy cannot be changed.
  const bool in_rounds =
      spec.temperature > 0 && energy.IsGiven() && std::ranges::count(energy.requested, true) > 0;
  std::array<double, kBodyParts> more = {};
  Plan plan;
  SpareFrames spare(spec.spare_frames);
  double least = std::numeric_limits<double>::infinity();  // the error of the nearest result
  for (int round = 0; round < (in_rounds ? kRounds : 1); ++round) {
    if (!spare.SpendUnlessFirst(round, spec.frames)) break;
    std::vector<Pose> poses = co_await SampleTransition(*parts_, *network_, request, spec, &spare);
    const double error = in_rounds ? CorrectEnergy(parts_->skeleton, spec.history.back(), poses,
                                                   wanted, more, energy)
                                   : 0;
    // The first one counts even with an infinite error: ProcessPlan says which frame it is.
    if (plan.poses.empty() || error < least) {
      least = error;
      plan.poses = std::move(poses);
    }
  }
  plan.resampled = spec.spare_frames - spare.left();
  co_return plan;
}

}  // namespace choreo
