#include "model/engine/continuous_flow_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

constexpr int kRounds = 3;       // rounds of requesting energy
constexpr double kAnswer = 0.6;  // share of additional energy that shows up in the motion
constexpr double kMaxLog = 1;    // bound of the logarithm of requested over wanted energy

WindowRequest ToWindowRequest(const TransitionSpec& spec, const std::vector<std::string>& styles) {
  WindowRequest request{.frames = spec.frames, .history = spec.history, .to_key = spec.frames};
  const Target* target = spec.target ? &*spec.target : spec.later ? &spec.later->target : nullptr;
  if (target != nullptr) {
    request.key = target->pose;
    request.mask = target->mask;
    if (target->height) {
      request.height = true;
      request.key->root_position.y() = *target->height;
    }
    if (!spec.target) request.to_key += spec.later->frames;
  }
  request.stage = spec.stage.value_or(GroundFrame());
  request.controls = spec.controls;
  request.beats = spec.beats;
  request.energy_shift = spec.energy;
  if (const auto style = std::ranges::find(styles, spec.style); style != styles.end())
    request.style = static_cast<int>(style - styles.begin());
  return request;
}

class PlanSampling : public Sampling {
 public:
  /// The spec must be valid. Model, parts and network must outlive it.
  PlanSampling(const ModelInfo& model, const FlowModelParts& parts, const FlowNetwork& network,
               const TransitionSpec& spec);

  bool Continue() override;

 private:
  /// Evaluates a round; true if another one follows.
  bool EndRound();
  void Finish();
  ControlCurve& Energy() { return request_.controls[kVelocityFactors]; }

  const ModelInfo* model_;
  const FlowModelParts* parts_;
  const FlowNetwork* network_;
  // From the spec:
  std::vector<Pose> history_;
  std::vector<double> beats_;
  bool keyed_, has_path_, has_heights_;

  WindowRequest request_;
  FlowNoise noise_;
  std::optional<TransitionSampler> sampler_;  // of this round; none after the last one

  // The network responds to requested energy, but too weakly. So each round measures the energy of
  // its result and corrects the request; the nearest result is danced.
  bool in_rounds_;
  int round_ = 0;
  Eigen::MatrixXd wanted_;                    // energy, as requested
  std::array<double, kBodyParts> more_ = {};  // logarithms of requested over wanted energy
  double least_;                              // the error of the nearest result
};

PlanSampling::PlanSampling(const ModelInfo& model, const FlowModelParts& parts,
                           const FlowNetwork& network, const TransitionSpec& spec)
    : model_(&model),
      parts_(&parts),
      network_(&network),
      history_(spec.history),
      beats_(spec.beats),
      keyed_(Keyed(spec)),
      has_path_(spec.controls[kRootPath].IsGiven()),
      has_heights_(spec.controls[kRootPath].requested[kPathHeight]),
      request_(ToWindowRequest(spec, model.styles)),
      noise_{.seed = spec.seed,
             .candidate = spec.candidate,
             .first_frame = spec.first_frame,
             .like = spec.noise_like,
             .variation = spec.variation,
             .temperature = spec.temperature},
      sampler_(std::in_place, parts, network, request_, noise_),
      // The mean way's energy cannot be changed.
      in_rounds_(noise_.temperature > 0 && Energy().IsGiven() &&
                 std::ranges::count(Energy().requested, true) > 0),
      wanted_(Energy().values),
      least_(std::numeric_limits<double>::infinity()) {}

bool PlanSampling::Continue() {
  if (!sampler_) {
    Finish();
    return false;
  }
  if (sampler_->Continue()) return true;
  if (EndRound()) {
    sampler_.emplace(*parts_, *network_, request_, noise_);
  } else {
    sampler_.reset();
  }
  return true;
}

bool PlanSampling::EndRound() {
  std::vector<Pose> poses = sampler_->TakePoses();
  if (!in_rounds_) {
    plan_.poses = std::move(poses);
    return false;
  }
  std::vector<Pose> seen = {history_.back()};
  seen.insert(seen.end(), poses.begin(), poses.end());
  const auto danced = MeanVelocityFactors(parts_->skeleton, seen);
  const Eigen::VectorXd asked = wanted_.rowwise().mean();
  double most = 0;
  for (int part = 0; part < asked.size(); ++part) {
    const auto at = static_cast<size_t>(part);
    if (!Energy().IsRequested(part)) continue;
    const double missing = EnergyLevel(asked[part], danced[at]);
    most = std::max(most, std::abs(missing));
    more_[at] = std::clamp(more_[at] + missing / kAnswer, -kMaxLog, kMaxLog);
    Energy().values.row(part) = std::exp(more_[at]) * wanted_.row(part);
  }
  if (most < least_) {
    least_ = most;
    plan_.poses = std::move(poses);
  }
  return ++round_ < kRounds;
}

void PlanSampling::Finish() {
  FinishPlan({.skeleton = model_->skeleton,
              .history = history_,
              .beats = beats_,
              .keyed = keyed_,
              .has_path = has_path_,
              .has_heights = has_heights_,
              .fps = model_->fps,
              .options = parts_->config.plan},
             &plan_.poses);
  Motion motion{.fps = model_->fps, .frames = {history_.back()}};
  motion.frames.insert(motion.frames.end(), plan_.poses.begin(), plan_.poses.end());
  plan_.contacts = DetectContacts(model_->skeleton, motion);
  plan_.contacts.erase(plan_.contacts.begin());  // the history's
}

}  // namespace

ContinuousFlowSampler::ContinuousFlowSampler(ModelInfo info, std::string device,
                                             std::shared_ptr<const FlowModelParts> parts,
                                             std::shared_ptr<const FlowNetwork> network)
    : Sampler(std::move(info), std::move(device)),
      parts_(std::move(parts)),
      network_(std::move(network)) {}

std::unique_ptr<Sampling> ContinuousFlowSampler::BeginValid(const TransitionSpec& spec) {
  return std::make_unique<PlanSampling>(model_, *parts_, *network_, spec);
}

}  // namespace choreo
