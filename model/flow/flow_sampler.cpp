#include "model/flow/flow_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/core/random.h"
#include "model/motion/canonical.h"
#include "model/motion/kinematics.h"
#include "model/motion/motion.h"

namespace choreo {
namespace {

constexpr double kHottest = 1.25;  // farther beyond the sampled way nobody dances

// [dimensions, w], standard normal, correlated over dimensions as motion is.
Eigen::MatrixXd Noise(const FlowModelParts& model, const FlowNoise& noise, int frames) {
  Eigen::MatrixXd z(model.prior.dimensions(), frames);
  std::vector<float> normal(static_cast<size_t>(z.rows()));
  for (int i = 0; i < frames; ++i) {
    FillNormal(noise.seed, noise.candidate, noise.first_frame + i, normal);
    z.col(i) = Eigen::Map<const Eigen::VectorXf>(normal.data(), z.rows()).cast<double>();
  }
  return model.mixing.triangularView<Eigen::Lower>() * z;
}

// Says how lively the parts are that nobody asks for: as dancers may be there, all along.
void FillInEnergy(const FlowModelParts& model, const FlowNoise& noise, WindowRequest* request) {
  if (request->energy.cols() == 0) {
    request->energy = Eigen::MatrixXd::Zero(kBodyParts, request->frames);
    request->asked.fill(false);
  }
  // Behind the numbers that the window's first frame is made of.
  std::vector<float> normal(static_cast<size_t>(model.prior.dimensions() + kBodyParts));
  FillNormal(noise.seed, noise.candidate, noise.first_frame, normal);
  EnergyPrior::Levels levels;
  std::copy(normal.end() - kBodyParts, normal.end(), levels.begin());
  levels = model.energy.Sample(KnownOfEnergy(model, *request),
                               std::min(noise.temperature, 1.0) * levels);
  for (size_t part = 0; part < request->asked.size(); ++part) {
    if (request->asked[part]) continue;
    const auto row = static_cast<Eigen::Index>(part);
    request->energy.row(row).setConstant(
        EnergyFactor(levels[row], model.config.median_factors[part]));
    request->asked[part] = true;
  }
}

// Joint positions of each pose, by column.
void PlaceJoints(const Skeleton& skeleton, std::span<const Pose> poses,
                 Eigen::Ref<Eigen::MatrixXf> joints) {
  JointPlacement placement;
  for (size_t i = 0; i < poses.size(); ++i) {
    ForwardKinematics(skeleton, poses[i], placement);
    joints.col(static_cast<int>(i)) = placement.positions.reshaped().cast<float>();
  }
}

}  // namespace

EnergyPrior::Known KnownOfEnergy(const FlowModelParts& model, const WindowRequest& request) {
  EnergyPrior::Known known{.key = request.key.has_value(),
                           .surprise = FlowWindow(model.prior, request).surprise(),
                           .frames = request.frames,
                           .style = request.style};
  const auto factors = MeanVelocityFactors(model.skeleton, request.history);
  for (size_t part = 0; part < factors.size(); ++part) {
    if (factors[part] > 0)
      known.history[static_cast<int>(part)] =
          EnergyLevel(factors[part], model.config.median_factors[part]);
  }
  return known;
}

std::vector<Pose> SampleWindow(const FlowModelParts& model, const FlowNetwork& network,
                               WindowRequest request, const FlowNoise& noise) {
  FillInEnergy(model, noise, &request);
  const FlowWindow window(model.prior, request);
  const auto describe = [&] {
    return DescribeWindow(model.skeleton, model.config, model.prior, request, window);
  };
  const WindowFeatures features = describe();
  // What the network says without beats, for guidance: nothing else reads them.
  const double guidance = request.beats.empty() ? 1 : model.config.beat_guidance;
  request.beats.clear();
  const std::optional<WindowFeatures> unheard =
      guidance == 1 ? std::nullopt : std::optional(describe());
  const int frames = window.frames(), tau = static_cast<int>(request.history.size());
  std::vector<int> led;  // axes of the root's position that are known
  if (request.path.cols() > 0) led = {0, 2};
  if (request.path.cols() > 0 && request.path_heights) led.push_back(1);

  Eigen::MatrixXd start = Eigen::MatrixXd::Zero(model.prior.dimensions(), frames);
  const double temperature = std::min(noise.temperature, kHottest);
  if (temperature > 0) start = Noise(model, noise, frames);
  // Where the root is asked to be is known: its noise fades into that.
  Eigen::MatrixXd path_x, path_z;
  if (!led.empty()) {
    path_x = request.path.colwise() - request.history.back().root_position;
    path_x -= window.mean().topRows<3>();
    path_z.resize(3, frames);
    for (int axis = 0; axis < 3; ++axis)
      path_z.row(axis) = window.Whiten(axis, path_x.row(axis).transpose()).transpose();
  }
  Eigen::MatrixXf mean(start.rows(), tau + frames), poses;
  mean << window.history().cast<float>(), window.mean().cast<float>();
  poses = mean;
  Eigen::MatrixXf joints(3 * model.skeleton.joints(), tau + frames);
  PlaceJoints(model.skeleton, request.history, joints.leftCols(tau));
  // F where the flow stands at `angle`: z = size (cos noise + sin motion), size = 1 / (cos + sin).
  const auto evaluate = [&](const Eigen::MatrixXd& w, double angle) {
    const double size = 1 / (std::cos(angle) + std::sin(angle));
    const Eigen::MatrixXd z = size * w;
    const Eigen::MatrixXd x = window.Colour(z);
    poses.rightCols(frames) = (window.mean() + x).cast<float>();
    PlaceJoints(model.skeleton, window.Decode(x), joints.rightCols(frames));
    const auto f = [&](const WindowFeatures& of) {
      return Eigen::MatrixXd(network
                                 .Evaluate(z.cast<float>(), poses, joints, mean, of,
                                           static_cast<float>(size * std::sin(angle)))
                                 .cast<double>());
    };
    if (!unheard) return f(features);
    return Eigen::MatrixXd(guidance * f(features) - (guidance - 1) * f(*unheard));
  };

  Eigen::MatrixXd mean_way;
  if (temperature != 1) mean_way = evaluate(Eigen::MatrixXd::Zero(start.rows(), frames), 0);
  Eigen::MatrixXd w = start;
  if (temperature > 0) {
    const double step = std::numbers::pi / 2 / model.config.steps;
    Eigen::MatrixXd before;
    for (int k = 0; k < model.config.steps; ++k) {
      const double angle = k * step;
      for (const int axis : led)
        w.row(axis) = std::cos(angle) * start.row(axis) + std::sin(angle) * path_z.row(axis);
      const Eigen::MatrixXd f = evaluate(w, angle);
      w += step * (k == 0 ? f : Eigen::MatrixXd(1.5 * f - 0.5 * before));
      w = w.cwiseMax(-MotionPrior::kMostWhite).cwiseMin(MotionPrior::kMostWhite);
      before = f;
    }
  }
  if (temperature != 1) w = mean_way + temperature * (w - mean_way);
  Eigen::MatrixXd x = window.Colour(w);
  for (const int axis : led) x.row(axis) = path_x.row(axis);
  return window.Decode(x);
}

std::vector<Pose> SampleTransition(const FlowModelParts& model, const FlowNetwork& network,
                                   const WindowRequest& request, const FlowNoise& noise) {
  const int blocks = (request.frames + model.config.window_frames - 1) / model.config.window_frames;
  std::vector<Pose> emitted = request.history;  // in the transition's frame
  const size_t tau = request.history.size();
  for (int block = 0, from = 0; block < blocks; ++block) {
    const int frames = request.frames * (block + 1) / blocks - from;
    const GroundFrame ground = GroundFrame::Of(emitted.back());
    WindowRequest here{.frames = frames, .mask = request.mask, .height = request.height};
    for (size_t i = emitted.size() - tau; i < emitted.size(); ++i)
      here.history.push_back(ground.ToLocal(emitted[i]));
    if (request.key) {
      here.key = ground.ToLocal(*request.key);
      here.to_key = request.to_key - from;
    }
    if (request.path.cols() > 0) {
      here.path.resize(3, frames);
      for (int i = 0; i < frames; ++i)
        here.path.col(i) = ground.ToLocal(Eigen::Vector3d(request.path.col(from + i)));
    }
    here.path_heights = request.path_heights;
    for (const double beat : request.beats) here.beats.push_back(beat - from);
    if (request.energy.cols() > 0) here.energy = request.energy.middleCols(from, frames);
    here.asked = request.asked;
    here.style = request.style;
    if (request.stage) here.stage = ground.ToLocal(*request.stage);
    FlowNoise from_here = noise;
    from_here.first_frame += from;
    for (const Pose& pose : SampleWindow(model, network, here, from_here)) {
      emitted.push_back(ground.ToWorld(pose));
      MakeContinuous(emitted.back(), emitted[emitted.size() - 2]);
    }
    from += frames;
  }
  return {emitted.begin() + static_cast<std::ptrdiff_t>(tau), emitted.end()};
}

}  // namespace choreo
