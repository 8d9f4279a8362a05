#include "model/engine/continuous_flow_engine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

constexpr int kRounds = 3;       // in which energy is asked for
constexpr double kAnswer = 0.6;  // of what is missing comes of as much more
constexpr double kFarthest = 1;  // logarithm of what is asked for over what is wanted

WindowRequest ToWindowRequest(const TransitionSpec& spec, const std::vector<std::string>& styles) {
  WindowRequest request{.frames = spec.frames, .history = spec.history, .to_key = spec.frames};
  if (spec.target) {
    request.key = spec.target->pose;
    request.mask = spec.target->mask;
    if (spec.target->height) {
      request.height = true;
      request.key->root_position.y() = *spec.target->height;
    }
  }
  request.stage = spec.stage.value_or(Eigen::Vector3d::Zero());
  request.path = spec.controls.root_path;
  request.path_heights = spec.controls.path_heights;
  request.beats = spec.beats;
  request.energy = spec.controls.velocity_factors.cast<double>();
  request.asked = spec.controls.parts_asked;
  if (const auto style = std::ranges::find(styles, spec.style); style != styles.end())
    request.style = static_cast<int>(style - styles.begin());
  return request;
}

// The network answers energy that is asked for, but by less. So what came of it is measured and, as
// far as it missed, asked for again; the nearest is danced.
std::vector<Pose> SampleAsLively(const FlowModelParts& model, const FlowNetwork& network,
                                 WindowRequest request, const FlowNoise& noise) {
  std::vector<Pose> nearest;
  const Eigen::MatrixXd wanted = request.energy;
  const Eigen::VectorXd asked = wanted.rowwise().mean();
  std::array<double, kBodyParts> more = {};  // logarithms
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Pose> poses = SampleTransition(model, network, request, noise);
    std::vector<Pose> seen = {request.history.back()};
    seen.insert(seen.end(), poses.begin(), poses.end());
    const auto danced = MeanVelocityFactors(model.skeleton, seen);
    double most = 0;
    for (int part = 0; part < asked.size(); ++part) {
      const auto at = static_cast<size_t>(part);
      if (!request.asked[at]) continue;
      const double missing = EnergyLevel(asked[part], danced[at]);
      most = std::max(most, std::abs(missing));
      more[at] = std::clamp(more[at] + missing / kAnswer, -kFarthest, kFarthest);
      request.energy.row(part) = std::exp(more[at]) * wanted.row(part);
    }
    if (most < least) {
      least = most;
      nearest = std::move(poses);
    }
  }
  return nearest;
}

}  // namespace

ContinuousFlowEngine::ContinuousFlowEngine(ModelInfo info, std::string device, int slots,
                                           std::shared_ptr<const FlowModelParts> parts,
                                           std::shared_ptr<const FlowNetwork> network)
    : SlotEngine(std::move(info), std::move(device), slots),
      parts_(std::move(parts)),
      network_(std::move(network)) {}

SampledTransition ContinuousFlowEngine::Begin(const TransitionSpec& spec, int /*slot*/) {
  SampledTransition transition{.poses = Sample(spec), .contacts = {}};
  FinishPlan({.skeleton = model().skeleton,
              .history = spec.history,
              .beats = spec.beats,
              .keyed = Keyed(spec),
              .has_path = spec.controls.root_path.cols() > 0,
              .has_heights = spec.controls.path_heights,
              .fps = model().fps,
              .options = parts_->config.plan},
             &transition.poses);
  Motion motion{.fps = model().fps, .frames = {spec.history.back()}};
  motion.frames.insert(motion.frames.end(), transition.poses.begin(), transition.poses.end());
  transition.contacts = DetectContacts(model().skeleton, motion);
  return transition;
}

std::vector<Pose> ContinuousFlowEngine::Sample(const TransitionSpec& spec) const {
  const WindowRequest request = ToWindowRequest(spec, model().styles);
  const FlowNoise noise{.seed = spec.seed,
                        .candidate = spec.candidate,
                        .first_frame = spec.first_frame,
                        .temperature = spec.temperature};
  // The mean way is as lively as it is.
  const bool is_asked = noise.temperature > 0 && request.energy.cols() > 0 &&
                        std::ranges::count(request.asked, true) > 0;
  return is_asked ? SampleAsLively(*parts_, *network_, request, noise)
                  : SampleTransition(*parts_, *network_, request, noise);
}

void ContinuousFlowEngine::StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) {
  for (size_t i = 0; i < in.size(); ++i) {
    SampledTransition& transition = At(in[i]);
    const auto frame = static_cast<size_t>(transition.next++);
    out[i] = {.pose = transition.poses[frame],
              .contacts = transition.contacts[frame + 1],
              .log_likelihood = 0};
  }
}

}  // namespace choreo
