#include "model/flow/flow_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "model/core/random.h"
#include "model/motion/canonical.h"
#include "model/motion/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

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
void FillInEnergy(const FlowModelParts& model, const FlowNoise& noise, const FlowWindow& window,
                  WindowRequest* request) {
  if (request->energy.cols() == 0) {
    request->energy = Eigen::MatrixXd::Zero(kBodyParts, request->frames);
    request->asked.fill(false);
  }
  // Behind the numbers that the window's first frame is made of.
  std::vector<float> normal(static_cast<size_t>(model.prior.dimensions() + kBodyParts));
  FillNormal(noise.seed, noise.candidate, noise.first_frame, normal);
  EnergyPrior::Levels levels;
  std::copy(normal.end() - kBodyParts, normal.end(), levels.begin());
  levels = model.energy.Sample(KnownOfEnergy(model, *request, window),
                               std::min(noise.temperature, 1.0) * levels);
  for (size_t part = 0; part < request->asked.size(); ++part) {
    if (request->asked[part]) continue;
    const auto row = static_cast<Eigen::Index>(part);
    request->energy.row(row).setConstant(
        EnergyFactor(levels[row], model.config.median_factors[part]));
    request->asked[part] = true;
  }
}

// Where the root is asked to be: of which axes, [3, w] as residuals x, and those white.
struct KnownPath {
  KnownPath(const WindowRequest& request, const FlowWindow& window) {
    if (request.path.cols() == 0) return;
    axes = {0, 2};
    if (request.path_heights) axes.push_back(1);
    x = request.path.colwise() - request.history.back().root_position;
    x -= window.mean().topRows<3>();
    z.resize(3, x.cols());
    for (int axis = 0; axis < 3; ++axis)
      z.row(axis) = window.Whiten(axis, x.row(axis).transpose()).transpose();
  }

  std::vector<int> axes;
  Eigen::MatrixXd x, z;
};

// F of one window at each step from noise to motion, with guidance by its labels.
class Field {
 public:
  Field(const FlowModelParts& model, const FlowNetwork& network, WindowRequest request,
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
    const double guidance = labelled ? model.config.guidance : 1;
    Look(request, guidance);
    request.beats.clear();
    request.style = -1;
    if (guidance != 1) Look(request, 1 - guidance);
  }

  int steps() const { return model_.config.steps; }
  double Angle(int step) const { return step * (std::numbers::pi / 2 / steps()); }

  // Where the flow stands at w: z = size (cos noise + sin motion), size = 1 / (cos + sin).
  Eigen::MatrixXd At(const Eigen::MatrixXd& w, int step) {
    const Eigen::MatrixXd z = SizeAt(step) * w;
    const Eigen::MatrixXd x = window_.Colour(z);
    poses_.rightCols(x.cols()) = (window_.mean() + x).cast<float>();
    joints_.rightCols(x.cols()) = window_.PlaceJoints(model_.skeleton, x);
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(z.rows(), z.cols());
    for (const View& view : views_) {
      f += view.weight * network_
                             .Evaluate(z.cast<float>(), poses_, joints_, mean_, view.frames,
                                       view.conditions.col(step))
                             .cast<double>();
    }
    return f;
  }

 private:
  // What the network is told, and what its answer counts.
  struct View {
    Eigen::MatrixXf frames, conditions;
    double weight;
  };
  void Look(const WindowRequest& request, double weight) {
    WindowFeatures seen =
        DescribeWindow(model_.skeleton, model_.config, model_.prior, request, window_);
    views_.push_back({std::move(seen.frames), network_.Condition(seen.whole, times_), weight});
  }
  double SizeAt(int step) const { return 1 / (std::cos(Angle(step)) + std::sin(Angle(step))); }

  const FlowModelParts& model_;
  const FlowNetwork& network_;
  const FlowWindow& window_;
  std::vector<float> times_;  // of each step
  Eigen::MatrixXf mean_, poses_, joints_;
  std::vector<View> views_;
};

// Whether a key says where limbs are: all but hands and feet, whose joints carry one other at most.
bool TellsLimbs(const Skeleton& skeleton, const PoseMask& mask) {
  std::vector<int> carried(static_cast<size_t>(skeleton.joints()));
  for (int joint = skeleton.joints() - 1; joint >= 0; --joint) {
    const auto at = static_cast<size_t>(joint);
    if (carried[at] > 1 && !mask.Asks(joint)) return false;
    if (joint > 0) carried[static_cast<size_t>(skeleton.parents[at])] += carried[at] + 1;
  }
  return true;
}

// From noise to motion; what is known fades into its noise.
Eigen::MatrixXd Solve(Field* field, const KnownPath& known, const Eigen::MatrixXd& start) {
  Eigen::MatrixXd w = start, before;
  for (int k = 0; k < field->steps(); ++k) {
    const double angle = field->Angle(k), step = field->Angle(1);
    for (const int axis : known.axes)
      w.row(axis) = std::cos(angle) * start.row(axis) + std::sin(angle) * known.z.row(axis);
    const Eigen::MatrixXd f = field->At(w, k);
    w += step * (k == 0 ? f : Eigen::MatrixXd(1.5 * f - 0.5 * before));
    w = w.cwiseMax(-MotionPrior::kMostWhite).cwiseMin(MotionPrior::kMostWhite);
    before = f;
  }
  return w;
}

}  // namespace

EnergyPrior::Known KnownOfEnergy(const FlowModelParts& model, const WindowRequest& request,
                                 const FlowWindow& window) {
  const auto level = [&](size_t part, double factor) {
    return EnergyLevel(factor, model.config.median_factors[part]);
  };
  EnergyPrior::Known known{.key = request.key.has_value(),
                           .surprise = window.surprise(),
                           .frames = request.frames,
                           .style = request.style};
  const auto factors = MeanVelocityFactors(model.skeleton, request.history);
  for (size_t part = 0; part < factors.size(); ++part) {
    if (factors[part] > 0) known.history[static_cast<int>(part)] = level(part, factors[part]);
  }
  if (!request.key || !TellsLimbs(model.skeleton, request.mask)) return known;
  const BodyPartWeights weights = WeighBodyParts(model.skeleton);
  const Eigen::Matrix3Xd from = JointPositions(model.skeleton, request.history.back());
  const Pose key = Masked(*request.key, request.mask, request.history.back());
  const Eigen::Matrix3Xd to = JointPositions(model.skeleton, key);
  const auto way = VelocityFactors(weights, from, to);
  const Eigen::VectorXd in_world = weights * (to - from).colwise().norm().transpose();
  known.way.emplace();
  if (request.mask.root_position) known.way_in_world.emplace();
  for (size_t part = 0; part < way.size(); ++part) {
    const auto row = static_cast<Eigen::Index>(part);
    (*known.way)[row] = level(part, way[part] / request.to_key);
    if (known.way_in_world)
      (*known.way_in_world)[row] = level(part, in_world[row] / request.to_key);
  }
  return known;
}

namespace {

// A way through the window, as the network sees it from one side.
std::vector<Pose> Sample(const FlowModelParts& model, const FlowNetwork& network,
                         WindowRequest request, const FlowNoise& noise) {
  FlowWindow window(model.prior, request);
  FillInEnergy(model, noise, window, &request);
  window.SetEnergy(model.prior, request);
  const KnownPath known(request, window);
  const double temperature = std::min(noise.temperature, kMaxFlowTemperature);
  const Eigen::MatrixXd still = Eigen::MatrixXd::Zero(model.prior.dimensions(), window.frames());
  const Eigen::MatrixXd start = temperature > 0 ? Noise(model, noise, window.frames()) : still;
  Field field(model, network, std::move(request), window);
  Eigen::MatrixXd mean_way;
  if (temperature != 1) mean_way = field.At(still, 0);
  Eigen::MatrixXd w = temperature > 0 ? Solve(&field, known, start) : start;
  if (temperature != 1) w = mean_way + temperature * (w - mean_way);
  Eigen::MatrixXd x = window.Colour(w);
  for (const int axis : known.axes) x.row(axis) = known.x.row(axis);
  return window.Decode(x);
}

}  // namespace

std::vector<Pose> SampleWindow(const FlowModelParts& model, const FlowNetwork& network,
                               WindowRequest request, const FlowNoise& noise) {
  if (noise.temperature > 0) return Sample(model, network, std::move(request), noise);
  // The mean way is the mirror image of the mirrored request's. A network is not quite as
  // symmetric: both of its answers are nearer together to the truth than each alone.
  const std::vector<int> pairs = MirrorPairs(model.skeleton);
  const std::vector<Pose> other = Sample(model, network, Mirror(pairs, request), noise);
  std::vector<Pose> way = Sample(model, network, std::move(request), noise);
  for (size_t i = 0; i < way.size(); ++i)
    way[i] = InterpolatePoses(way[i], Mirror(pairs, other[i]), 0.5);
  return way;
}

TransitionSampler::TransitionSampler(WindowRequest request, const FlowNoise& noise)
    : request_(std::move(request)), noise_(noise), emitted_(request_.history) {}

bool TransitionSampler::Continue(const FlowModelParts& model, const FlowNetwork& network) {
  const int most = model.config.window_frames;
  const int windows = (request_.frames + most - 1) / most;
  const int frames = request_.frames * (windows_ + 1) / windows - frames_;
  const GroundFrame ground = GroundFrame::Of(emitted_.back());
  FlowNoise noise = noise_;
  noise.first_frame += frames_;
  WindowRequest window = request_.Part(
      frames_, frames, std::span(emitted_).last(request_.history.size()), ground);
  for (const Pose& pose : SampleWindow(model, network, std::move(window), noise)) {
    emitted_.push_back(ground.ToWorld(pose));
    MakeContinuous(emitted_.back(), emitted_[emitted_.size() - 2]);
  }
  frames_ += frames;
  return ++windows_ < windows;
}

std::vector<Pose> TransitionSampler::TakePoses() {
  std::vector<Pose> poses = std::exchange(emitted_, {});
  poses.erase(poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(request_.history.size()));
  return poses;
}

std::vector<Pose> SampleTransition(const FlowModelParts& model, const FlowNetwork& network,
                                   const WindowRequest& request, const FlowNoise& noise) {
  TransitionSampler sampler(request, noise);
  while (sampler.Continue(model, network)) {
  }
  return sampler.TakePoses();
}

}  // namespace choreo
