#include "model/training/flow_matching/flow_matching.h"

#include <torch/types.h>

#include "model/motion/kinematics/kinematics.h"

namespace choreo {

using torch::Tensor;

namespace {

constexpr double kAtNoise = 0.2;  // share of samples at t = 0, half of them without noise
constexpr double kStands = 1e-3;  // metres: metres: points that move less are standing
// Weights of errors in joint positions and in the travel of standing feet per frame, in squares of
// a window's joint spread. White coordinates have weight 1. The weights are small, because with
// equal weights the pelvis would compensate for the limbs' unpredictable movement and stand still.
constexpr double kPlaces = 0.06, kSlips = 12;
// White coordinates give each frame's change the same weight, so errors that add up over a window
// hardly count. A key bounds them. Without a key, these two weights apply to where a window leads:
// joints relative to the pelvis, and each coordinate.
constexpr double kPosture = 0.5, kDrift = 0.5;
constexpr double kUnmoved = 1e-12;      // square metres or radians: no coordinate moves less
constexpr double kStandingStep = 0.01;  // metres that a standing foot may move in a frame

Tensor SpreadsOf(const std::vector<MotionPrior::Bridge>& bridges) {
  std::vector<Tensor> spreads;
  for (const auto& bridge : bridges) spreads.push_back(Columns(bridge.spread).t());
  return torch::stack(spreads);
}

// The mean square movement of all joints, m^2, if one joint turns by a radian about any axis.
Tensor ReachOf(const Skeleton& skeleton) {
  const Eigen::Matrix3Xd rest = JointPositions(skeleton, RestPose(skeleton));
  const int joints = skeleton.joints();
  const Tensor reach = torch::ones({3 + 3 * joints});
  for (int j = 0; j < joints; ++j) {
    double sum = 0;
    for (int k = j + 1; k < joints; ++k) {
      if (IsBelow(k, j, skeleton.parents)) sum += (rest.col(k) - rest.col(j)).squaredNorm();
    }
    reach.narrow(0, 3 + 3 * j, 3).fill_(2.0 / 3 * sum / joints);
  }
  return reach;
}

// Converts white coordinates [batch, w, dimensions] to displacements. `spreads`: [dimensions, w,
// w].
Tensor Colour(const Tensor& spreads, const Tensor& z) {
  return torch::matmul(spreads, z.permute({2, 1, 0})).permute({2, 1, 0});
}

}  // namespace

FlowMatching::FlowMatching(const ContinuousFlow& model)
    : parts_(model->Parts()),
      device_(model->parameters().front().device()),
      body_(parts_.skeleton, device_),
      mixing_(Columns(parts_.mixing).to(device_)),
      reach_(ReachOf(parts_.skeleton).to(device_)) {}

const FlowMatching::Spreads& FlowMatching::Of(int frames, int to_key) {
  const auto [place, is_new] = spreads_.try_emplace({frames, to_key});
  if (is_new) {
    place->second = {SpreadsOf(*parts_.prior.Bridges(frames, to_key)).to(device_),
                     SpreadsOf(*parts_.prior.Bridges(frames, 0)).to(device_),
                     SpreadsOf(*parts_.prior.StageBridges(frames)).to(device_)};
  }
  return place->second;
}

LossTerms FlowMatching::Losses(ContinuousFlow& model, const WindowBatch& batch) {
  const int64_t count = batch.z.size(0), window = batch.z.size(1);
  const int64_t tau = batch.mean.size(1) - window;
  const Spreads& spreads = Of(batch.frames, batch.to_key);
  const auto colour = [&](const Tensor& z) {
    const Tensor staged = batch.staged.view({-1, 1, 1}) > 0, free = Colour(spreads.free, z);
    const Tensor root =
        torch::where(staged, Colour(spreads.stage, z.narrow(2, 0, 3)), free.narrow(2, 0, 3));
    return torch::where(batch.keyed.unsqueeze(1) > 0, Colour(spreads.to_key, z),
                        torch::cat({root, free.narrow(2, 3, free.size(2) - 3)}, 2));
  };
  const auto uniform = [&] { return torch::rand({count, 1, 1}, device_); };
  const Tensor at_noise = uniform() < kAtNoise;
  const Tensor t = torch::where(at_noise, torch::zeros({count, 1, 1}, device_), uniform());
  const Tensor silent = at_noise & (uniform() < 0.5);
  const Tensor noise = torch::matmul(torch::randn(batch.z.sizes(), device_), mixing_) *
                       (1 - silent.to(torch::kFloat32));
  const Tensor a = t.square() + (1 - t).square();
  const Tensor z = (1 - t) * noise + t * batch.z;
  const Tensor target = ((1 - t) * batch.z - t * noise) / a.sqrt();
  const auto motion = [&](const Tensor& white) { return colour(batch.scales * white); };
  const Tensor x = motion(z);
  const Tensor poses =
      torch::cat({batch.mean.narrow(1, 0, tau), batch.mean.narrow(1, tau, window) + x}, 1);
  const Tensor joints = torch::cat({batch.history_joints, body_.Place(batch, x)}, 1);
  const Tensor miss =
      model->forward(z, poses, joints, batch.mean, batch.features, batch.whole, t.flatten()) -
      target;
  // Variance of real windows' displacements by dimension.
  const Tensor variance =
      torch::where(batch.keyed > 0, spreads.to_key.square().sum(torch::IntArrayRef{1, 2}),
                   spreads.free.square().sum(torch::IntArrayRef{1, 2}));
  // The expected movement of joints by each coordinate of the window, metres. It is half of the
  // coordinate's weight, so that the body's rotation counts more than a wrist's.
  const Tensor expected = variance * batch.scales.square().mean(1);
  const Tensor importance = (expected * reach_).sqrt();
  const Tensor weights = 0.5 + 0.5 * importance / importance.mean(1, true);
  const Tensor strays = importance.square().sum(1).view({-1, 1, 1}) / window + kStands * kStands;
  // Measures the motion in which the flow ends according to F, because F itself says little near
  // the end.
  const Tensor way = motion(miss);
  const Tensor moved = ((1 - t) / a.sqrt()).unsqueeze(-1) * body_.Move(batch, way);
  const Tensor drift = way.square() * window / (expected + kUnmoved).unsqueeze(1);
  const auto squares = [&](const Tensor& metres) { return metres.square().sum(-1) / strays; };
  const auto feet_steps = [&](const Tensor& places) {
    return places.index_select(2, body_.feet()).diff(1, 1);
  };
  const Tensor real = body_.Place(batch, motion(batch.z)).reshape(moved.sizes());
  const Tensor stands = feet_steps(real).norm(2, -1) < kStandingStep;
  const Tensor free = (1 - batch.keyed.amax(1)).view({-1, 1, 1});
  return {{"white_mse", 1.0, (weights.unsqueeze(1) * miss.square()).mean()},
          {"drift_mse", kDrift, (free * weights.unsqueeze(1) * drift).mean()},
          {"posture_mse", kPosture, (free * squares(moved - moved.narrow(2, 0, 1))).mean()},
          {"places_mse", kPlaces, squares(moved).mean()},
          {"slips_mse", kSlips, (stands * squares(feet_steps(moved))).mean()}};
}

}  // namespace choreo
