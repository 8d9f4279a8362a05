#include "model/flow/flow_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "model/core/random.h"
#include "model/motion/canonical.h"
#include "model/motion/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

// The random numbers of a window, [.., w]: of the motion's dimensions, then of the energy's levels
// (the first frame's count) and curves.
Eigen::MatrixXf Normals(const FlowModelParts& model, const FlowNoise& noise, int frames) {
  Eigen::MatrixXf normals(model.prior.dimensions() + 2 * kBodyParts, frames);
  for (int i = 0; i < frames; ++i)
    noise.Fill(i, {normals.col(i).data(), static_cast<size_t>(normals.rows())});
  return normals;
}

// Gives body parts without velocity factors an energy, sampled from the prior.
void FillInEnergy(const FlowModelParts& model, double temperature, const Eigen::MatrixXf& normals,
                  const FlowWindow& window, WindowRequest* request) {
  ControlCurve& energy_control = request->controls[kVelocityFactors];
  if (!energy_control.IsGiven()) {
    energy_control.values = Eigen::MatrixXd::Zero(kBodyParts, request->frames);
    energy_control.requested.assign(kBodyParts, false);
  }
  EnergyPrior::Levels levels =
      temperature * normals.col(0).segment<kBodyParts>(model.prior.dimensions()).cast<double>();
  Eigen::MatrixXd ways = temperature * normals.bottomRows<kBodyParts>().cast<double>();
  // The history already contains the shift; do not add it again.
  EnergyPrior::Known known = KnownOfEnergy(model, *request, window);
  known.history.array() -= request->energy_shift.before;
  levels = model.energy.Sample(known, levels);
  const bool lingers = model.curve.known();
  ways = lingers ? model.curve.Sample(temperature * (known.history - levels), ways)
                 : Eigen::MatrixXd::Zero(kBodyParts, request->frames);
  ways.colwise() += levels;
  if (lingers) ways = model.energy.Bound(ways);
  levels.array() += request->energy_shift.now;
  ways.array() += request->energy_shift.now;
  const EnergyPrior::Levels most = model.energy.MostLively();
  levels = levels.cwiseMin(most);
  for (int part = 0; part < kBodyParts; ++part) {
    if (energy_control.IsRequested(part)) continue;
    const double median = model.config.median_factors[static_cast<size_t>(part)];
    auto energy = energy_control.values.row(part);
    for (int i = 0; i < request->frames; ++i) energy[i] = EnergyFactor(ways(part, i), median);
    // Scales the curve so that its mean has the window's level.
    if (const double mean = energy.mean(); lingers && mean > 0)
      energy *= EnergyFactor(levels[part], median) / mean;
    energy = energy.cwiseMin(EnergyFactor(most[part], median));
    energy_control.requested[static_cast<size_t>(part)] = true;
  }
}

// Replaces requested levels by those that make the network dance them (EnergyResponse). The mean
// motion, at temperature 0, needs no correction.
void CorrectLevels(const FlowModelParts& model, double temperature, WindowRequest* request) {
  if (!model.response.known()) return;
  Eigen::MatrixXd& factors = request->controls[kVelocityFactors].values;
  for (int part = 0; part < kBodyParts; ++part) {
    const double median = model.config.median_factors[static_cast<size_t>(part)];
    const double wanted = factors.row(part).mean();
    if (wanted <= 0) continue;
    const double level = EnergyLevel(wanted, median);
    const double input = level + temperature * (model.response.InputFor(part, level) - level);
    // Stays within the range of training, unless the request itself leaves it.
    const double most = EnergyFactor(model.energy.MostLively()[part], median);
    for (double& energy : factors.row(part))
      energy = std::min(energy * (EnergyFactor(input, median) / wanted), std::max(energy, most));
  }
}

// The root path of the controls: which axes it fixes, and where, as residuals x and as white
// coordinates z, both [3, w].
struct KnownPath {
  KnownPath(const WindowRequest& request, const FlowWindow& window) {
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
    keeps_effect_ = request.style < 0;
    guidance_ = labelled ? model.config.guidance : 1;
    AddView(request);
    request.beats.clear();
    request.style = -1;
    if (guidance_ != 1) AddView(request);
  }

  int steps() const { return model_.config.steps; }
  double Angle(int step) const { return step * (std::numbers::pi / 2 / steps()); }

  // Moves the flow to w: z = size (cos noise + sin motion), size = 1 / (cos + sin).
  void MoveTo(const Eigen::MatrixXd& w, int step) {
    z_ = SizeAt(step) * w;
    const Eigen::MatrixXd x = window_.Colour(z_);
    poses_.rightCols(x.cols()) = (window_.mean() + x).cast<float>();
    joints_.rightCols(x.cols()) = window_.PlaceJoints(model_.skeleton, x);
    step_ = step;
    seen_ = 0;
  }
  // Evaluates the network for the next view; true while more views are left.
  bool EvaluateNext() {
    const View& view = views_[seen_];
    Eigen::MatrixXd f = network_
                            .Evaluate(z_.cast<float>(), poses_, joints_, mean_, view.frames,
                                      view.conditions.col(step_))
                            .cast<double>();
    if (views_.size() == 1) {
      f_ = std::move(f);
    } else if (seen_ == 0 && keeps_effect_ && step_ > 0 && step_ + 1 == steps()) {
      f_ = f + (guidance_ - 1) * effect_;
    } else if (seen_ == 0) {
      f_ = std::move(f);
      ++seen_;
      return true;
    } else {
      effect_ = f_ - f;
      f_ = guidance_ * f_ + (1 - guidance_) * f;
    }
    return false;
  }
  const Eigen::MatrixXd& f() const { return f_; }

 private:
  // One input for the network.
  struct View {
    Eigen::MatrixXf frames, conditions;
  };
  void AddView(const WindowRequest& request) {
    WindowFeatures seen =
        DescribeWindow(model_.skeleton, model_.config, model_.prior, request, window_);
    views_.push_back({std::move(seen.frames), network_.Condition(seen.whole, times_)});
  }
  double SizeAt(int step) const { return 1 / (std::cos(Angle(step)) + std::sin(Angle(step))); }

  const FlowModelParts& model_;
  const FlowNetwork& network_;
  const FlowWindow& window_;
  std::vector<float> times_;  // per step
  Eigen::MatrixXf mean_, poses_, joints_;
  std::vector<View> views_;  // as labelled and, for guidance, without labels
  double guidance_;
  // Beats act alike on neighbouring steps, so the last one takes their effect from the step before.
  bool keeps_effect_;
  Eigen::MatrixXd z_, f_, effect_;
  int step_ = 0;
  size_t seen_ = 0;  // evaluated views
};

// Whether a key fixes limbs: all joints except hands and feet, which carry at most one other joint.
bool TellsLimbs(const Skeleton& skeleton, const PoseMask& mask) {
  std::vector<int> carried(static_cast<size_t>(skeleton.joints()));
  for (int joint = skeleton.joints() - 1; joint >= 0; --joint) {
    const auto at = static_cast<size_t>(joint);
    if (carried[at] > 1 && !mask.Constrains(joint)) return false;
    if (joint > 0) carried[static_cast<size_t>(skeleton.parents[at])] += carried[at] + 1;
  }
  return true;
}

}  // namespace

void FlowNoise::Fill(int frame, std::span<float> out) const {
  const int64_t own = first_frame + frame;
  FillNormalLike(seed, candidate, own, like.empty() ? own : like[static_cast<size_t>(frame)],
                 variation, out);
}

EnergyPrior::Known KnownOfEnergy(const FlowModelParts& model, const WindowRequest& request,
                                 const FlowWindow& window) {
  const auto level = [&](size_t part, double factor) {
    return EnergyLevel(factor, model.config.median_factors[part]);
  };
  // The way to a key beyond the window says nothing of the window's own energy.
  EnergyPrior::Known known{.key = request.key && request.to_key == request.frames,
                           .surprise = window.surprise(),
                           .frames = request.frames,
                           .style = request.style};
  const auto factors = MeanVelocityFactors(model.skeleton, request.history);
  for (size_t part = 0; part < factors.size(); ++part) {
    if (factors[part] > 0) known.history[static_cast<int>(part)] = level(part, factors[part]);
  }
  if (!known.key || !TellsLimbs(model.skeleton, request.mask)) return known;
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

/// One pass from noise to motion, for the request or for its mirror image.
class WindowSampler::Pass {
 public:
  Pass(const FlowModelParts& model, const FlowNetwork& network, WindowRequest request,
       const FlowNoise& noise)
      : window_(model.prior, request),
        temperature_(std::min(noise.temperature, kMaxFlowTemperature)) {
    const Eigen::MatrixXf normals = Normals(model, noise, window_.frames());
    const double temperature = std::min(noise.temperature, 1.0);
    FillInEnergy(model, temperature, normals, window_, &request);
    CorrectLevels(model, temperature, &request);
    window_.SetEnergy(model.prior, request);
    known_.emplace(request, window_);
    const Eigen::MatrixXd still = Eigen::MatrixXd::Zero(model.prior.dimensions(), window_.frames());
    // Correlated over dimensions like motion.
    start_ = still;
    if (temperature_ > 0)
      start_ = model.mixing.triangularView<Eigen::Lower>() *
               normals.topRows(still.rows()).cast<double>();
    w_ = start_;
    field_.emplace(model, network, std::move(request), window_);
    needs_mean_ = temperature_ != 1;
    if (needs_mean_) {
      field_->MoveTo(still, 0);
    } else {
      BeginStep();
    }
  }
  Pass(const Pass&) = delete;
  Pass& operator=(const Pass&) = delete;

  /// Makes the next evaluation; true while more are left.
  bool Continue() {
    if (field_->EvaluateNext()) return true;
    if (std::exchange(needs_mean_, false)) {
      mean_ = field_->f();
      if (temperature_ == 0) return false;
      BeginStep();
      return true;
    }
    EndStep();
    if (step_ == field_->steps()) return false;
    BeginStep();
    return true;
  }

  std::vector<Pose> Poses() const {
    Eigen::MatrixXd w = w_;
    if (temperature_ != 1) w = mean_ + temperature_ * (w - mean_);
    Eigen::MatrixXd x = window_.Colour(w);
    for (const int axis : known_->axes) x.row(axis) = known_->x.row(axis);
    return window_.Decode(x);
  }

 private:
  // Moves coordinates that a path fixes from their noise to their known values, step by step.
  void BeginStep() {
    const double angle = field_->Angle(step_);
    for (const int axis : known_->axes)
      w_.row(axis) = std::cos(angle) * start_.row(axis) + std::sin(angle) * known_->z.row(axis);
    field_->MoveTo(w_, step_);
  }
  void EndStep() {
    const Eigen::MatrixXd& f = field_->f();
    const double step = field_->Angle(1);
    w_ += step * (step_ == 0 ? f : Eigen::MatrixXd(1.5 * f - 0.5 * before_));
    w_ = w_.cwiseMax(-MotionPrior::kMaxWhite).cwiseMin(MotionPrior::kMaxWhite);
    before_ = f;
    ++step_;
  }

  FlowWindow window_;
  const double temperature_;
  std::optional<KnownPath> known_;
  Eigen::MatrixXd start_, w_, before_, mean_;
  std::optional<Field> field_;
  bool needs_mean_ = false;
  int step_ = 0;
};

WindowSampler::WindowSampler(const FlowModelParts& model, const FlowNetwork& network,
                             WindowRequest request, const FlowNoise& noise)
    : model_(&model), network_(&network), noise_(noise), request_(std::move(request)) {}
WindowSampler::~WindowSampler() = default;
WindowSampler::WindowSampler(WindowSampler&&) noexcept = default;
WindowSampler& WindowSampler::operator=(WindowSampler&&) noexcept = default;

bool WindowSampler::Continue() {
  // The mean motion is the mirror image of the mirrored request's. The network is not fully
  // symmetric, and the average of both answers is nearer to the truth than either.
  const bool is_mirrored = noise_.temperature <= 0 && mirrored_.empty();
  if (!pass_) {
    pass_ = std::make_unique<Pass>(
        *model_, *network_,
        is_mirrored ? Mirror(MirrorPairs(model_->skeleton), request_) : request_, noise_);
  }
  if (pass_->Continue()) return true;
  (is_mirrored ? mirrored_ : sampled_) = pass_->Poses();
  pass_.reset();
  return is_mirrored;
}

std::vector<Pose> WindowSampler::TakePoses() {
  const std::vector<int> pairs = MirrorPairs(model_->skeleton);
  for (size_t i = 0; i < mirrored_.size(); ++i)
    sampled_[i] = InterpolatePoses(sampled_[i], Mirror(pairs, mirrored_[i]), 0.5);
  return std::move(sampled_);
}

std::vector<Pose> SampleWindow(const FlowModelParts& model, const FlowNetwork& network,
                               WindowRequest request, const FlowNoise& noise) {
  WindowSampler sampler(model, network, std::move(request), noise);
  while (sampler.Continue()) {
  }
  return sampler.TakePoses();
}

}  // namespace choreo
