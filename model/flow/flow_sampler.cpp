#include "model/flow/flow_sampler.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "model/core/random.h"
#include "model/flow/flow_field.h"
#include "model/flow/window_energy.h"
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

}  // namespace

void FlowNoise::Fill(int frame, std::span<float> out) const {
  const int64_t own = first_frame + frame;
  FillNormalLike(seed, candidate, own, like.empty() ? own : like[static_cast<size_t>(frame)],
                 variation, out);
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
    FillInEnergy(model, normals.col(0).segment<kBodyParts>(model.prior.dimensions()).cast<double>(),
                 normals.bottomRows<kBodyParts>().cast<double>(), temperature, window_, &request);
    CorrectLevels(model, temperature, &request);
    window_.SetEnergy(model.prior, request);
    known_.emplace(request, window_);
    const Eigen::MatrixXd still = Eigen::MatrixXd::Zero(model.prior.dimensions(), window_.frames());
    // Noise is correlated over dimensions like motion.
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
  std::optional<FlowField> field_;
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
