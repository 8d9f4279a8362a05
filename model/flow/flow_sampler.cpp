#include "model/flow/flow_sampler.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/core/limits.h"
#include "model/core/random.h"
#include "model/flow/flow_field.h"
#include "model/flow/window_energy.h"
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
    const bool may_stray = !(asked.key && asked.to_key == asked.frames) && noise.temperature > 0 &&
                           !request.controls[kRootPath].IsRequested(kPathHeight);
    const double most = std::max(kMaxDeviation, usual.Deviation(danced.back()));
    std::vector<Pose> nearest;
    double least = 0;  // its deviation
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
      const double deviation = may_stray ? usual.Deviation(ground.ToWorld(poses.back())) : 0;
      if (take == 0 || deviation < least) {
        nearest = std::move(poses);
        least = deviation;
      }
      if (!(deviation > most)) break;
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
