#include "model/engine/continuous_flow_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

// The network responds to requested energy, but too weakly: finds how far a part's motion misses
// `wanted`, and asks for more or less of it. `more`: logarithms of requested over wanted energy.
// Returns the largest error of a part.
double CorrectEnergy(const Skeleton& skeleton, const Pose& before, const std::vector<Pose>& poses,
                     const Eigen::MatrixXd& wanted, std::array<double, kBodyParts>& more,
                     ControlCurve& energy) {
  std::vector<Pose> seen = {before};
  seen.insert(seen.end(), poses.begin(), poses.end());
  const auto danced = MeanVelocityFactors(skeleton, seen);
  const Eigen::VectorXd asked = wanted.rowwise().mean();
  double most = 0;
  for (int part = 0; part < asked.size(); ++part) {
    const auto at = static_cast<size_t>(part);
    if (!energy.IsRequested(part)) continue;
    const double missing = EnergyLevel(asked[part], danced[at]);
    most = std::max(most, std::abs(missing));
    more[at] = std::clamp(more[at] + missing / kAnswer, -kMaxLog, kMaxLog);
    energy.values.row(part) = std::exp(more[at]) * wanted.row(part);
  }
  return most;
}

}  // namespace

ContinuousFlowSampler::ContinuousFlowSampler(ModelInfo info, std::string device,
                                             std::shared_ptr<const FlowModelParts> parts,
                                             std::shared_ptr<const FlowNetwork> network)
    : Sampler(std::move(info), std::move(device)),
      parts_(std::move(parts)),
      network_(std::move(network)) {}

Slices<Plan> ContinuousFlowSampler::Begin(const ValidSpec& valid) {
  const TransitionSpec& spec = *valid;
  const FlowNoise noise{.seed = spec.seed,
                        .candidate = spec.candidate,
                        .first_frame = spec.first_frame,
                        .like = spec.noise_like,
                        .variation = spec.variation,
                        .temperature = spec.temperature};
  WindowRequest request = ToWindowRequest(spec, model_.styles);
  ControlCurve& energy = request.controls[kVelocityFactors];
  const Eigen::MatrixXd wanted = energy.values;
  // The mean way's energy cannot be changed.
  const bool in_rounds =
      noise.temperature > 0 && energy.IsGiven() && std::ranges::count(energy.requested, true) > 0;
  std::array<double, kBodyParts> more = {};
  Plan plan;
  double least = std::numeric_limits<double>::infinity();  // the error of the nearest result
  for (int round = 0; round < (in_rounds ? kRounds : 1); ++round) {
    std::vector<Pose> poses = co_await SampleTransition(*parts_, *network_, request, noise);
    const double error = in_rounds ? CorrectEnergy(parts_->skeleton, spec.history.back(), poses,
                                                   wanted, more, energy)
                                   : 0;
    if (error < least) {
      least = error;
      plan.poses = std::move(poses);
    }
  }

  const PlanContext context{.skeleton = model_.skeleton,
                            .history = spec.history,
                            .beats = spec.beats,
                            .keyed = Keyed(spec),
                            .has_path = spec.controls[kRootPath].IsGiven(),
                            .has_heights = spec.controls[kRootPath].requested[kPathHeight],
                            .fps = model_.fps,
                            .options = parts_->config.plan};
  for (const auto stage : kPlanStages) stage(context, &plan.poses);
  Motion motion{.fps = model_.fps, .frames = {spec.history.back()}};
  motion.frames.insert(motion.frames.end(), plan.poses.begin(), plan.poses.end());
  plan.contacts = DetectContacts(model_.skeleton, motion);
  plan.contacts.erase(plan.contacts.begin());  // the history's
  co_return plan;
}

}  // namespace choreo
