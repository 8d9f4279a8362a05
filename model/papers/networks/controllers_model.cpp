#include "model/papers/networks/controllers_model.h"

#include <torch/nn/init.h>
#include <torch/utils.h>

#include <algorithm>

#include "model/core/error.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/papers/networks/lstm_layer.h"
#include "model/papers/networks/transition_tensors.h"

namespace choreo {

using torch::Tensor;

namespace {

constexpr int64_t kEmbedding = 32;  // width of an embedded frame count
constexpr double kRampFrames = 6;   // frames over which the residual grows from a fixed end
constexpr double kStep = 0.02;      // scale of steps, metres per frame
constexpr double kHeight = 0.2;     // scale of heights, metres
constexpr double kBeside = 0.1;     // scale of distances from the path, metres
constexpr double kTurnStep = 0.05;  // scale of heading changes, radians per frame
constexpr int64_t kContacts = 4;

torch::nn::Sequential Connected(int64_t in, std::initializer_list<int64_t> hidden, int64_t out,
                                bool activated) {
  torch::nn::Sequential layers;
  for (const int64_t width : hidden) {
    layers->push_back(torch::nn::Linear(in, width));
    layers->push_back(torch::nn::PReLU());
    in = width;
  }
  layers->push_back(torch::nn::Linear(in, out));
  if (activated) {
    layers->push_back(torch::nn::PReLU());
  } else {
    // Decoders start with zero output.
    auto last = layers[layers->size() - 1]->as<torch::nn::Linear>();
    torch::nn::init::zeros_(last->weight);
    torch::nn::init::zeros_(last->bias);
  }
  return layers;
}

// Windows of `size` frames around each of N frames, [batch, N, size, features]. `before` holds the
// frames before the first; the last frame is repeated.
Tensor Windows(const Tensor& before, const Tensor& given, int64_t size) {
  const int64_t half = size / 2;
  const Tensor last = given.narrow(1, given.size(1) - 1, 1);
  const Tensor all = torch::cat({before.narrow(1, before.size(1) - half, half), given,
                                 last.expand({last.size(0), half, last.size(2)})},
                                1);
  return all.unfold(1, size, 1).transpose(-1, -2);
}

// Runs an LSTM over [batch, time, in]. Reads and replaces `memory`; none means zeros.
Tensor RunLstm(torch::nn::LSTM& lstm, const Tensor& in,
               torch::optional<std::tuple<Tensor, Tensor>>* memory) {
  if (torch::GradMode::is_enabled() && in.is_cpu() && !*memory) {
    // Training runs the whole sequence at once and needs no final state.
    const std::vector<Tensor> weights = lstm->parameters();
    const Tensor none = torch::zeros({in.size(0), weights[1].size(1)}, in.options());
    LstmState start{none, none};
    return RunLstmLayer(in, {weights[0], weights[1], weights[2], weights[3]}, &start);
  }
  auto [out, next] = lstm->forward(in, *memory);
  *memory = next;
  return out;
}

}  // namespace

ControlledGiven ControlledGiven::Narrow(int64_t first, int64_t count) const {
  ControlledGiven part = *this;
  for (Tensor* tensor : {&part.root, &part.ahead, &part.ramp, &part.joints, &part.path_window,
                         &part.factor_window, &part.path_memory, &part.factor_memory, &part.code}) {
    if (tensor->defined()) *tensor = tensor->narrow(1, first, count);
  }
  return part;
}

ControllersModelImpl::ControllersModelImpl(const ControllersConfig& config,
                                           const Skeleton& skeleton)
    : config_(config),
      skeleton_(skeleton),
      others_(skeleton.joints() - 1),
      place_(config.residual ? kBeside : 1) {
  joint_mean_ = register_buffer("joint_mean", torch::zeros({others_, 3}));
  joint_std_ = register_buffer("joint_std", torch::ones({others_, 3}));
  factor_std_ = register_buffer("factor_std", torch::ones({kBodyParts}));
  shares_ = SharesOf(skeleton);

  const int64_t pose = 3 * others_;
  path_controller_ = register_module("path_controller", MakeWindowController(3, config));
  int64_t live = 2 * config.encoding + config.controller;
  if (config.velocity_factors) {
    factor_controller_ =
        register_module("factor_controller", MakeWindowController(kBodyParts, config));
    live += config.controller;
  }
  const auto encoder = [&](const char* name, int64_t features) {
    return register_module(
        name, Connected(features, {config.encoder_hidden}, config.encoding, /*activated=*/true));
  };
  state_encoder_ = encoder("state_encoder", pose + 1 + 3 + 2 + kContacts);
  velocity_encoder_ = encoder("velocity_encoder", pose + 3 + 1);
  target_controller_ = encoder("target_controller", pose + 2 + 3 + 1);
  const auto lstm = [&](const char* name, int64_t in) {
    return register_module(
        name, torch::nn::LSTM(torch::nn::LSTMOptions(in, config.lstm).batch_first(true)));
  };
  const int64_t into = (config.two_lstms ? config.lstm : live) + config.encoding;
  if (config.two_lstms) first_ = lstm("first_lstm", live);
  second_ = lstm("second_lstm", into);
  if (!config.residual && !config.absolute_position && !config.relative_position)
    throw InvalidArgument("relative_position", "without it, absolute_position is required");
  // AP and RP: the frame's position on the path and the progress of the transition.
  const int64_t code =
      config.residual ? 3 + 1 + 1 + kEmbedding
                      : (config.absolute_position ? 3 : 0) + (config.relative_position ? 1 : 0);
  position_code_ = register_module("position_code", torch::nn::Linear(code, into));
  const int64_t wide = config.decoder_hidden, state = 2 * pose + kContacts, root = 3 + 2 + 3;
  state_decoder_ = register_module(
      "state_decoder", Connected(config.lstm, {wide, wide / 2},
                                 state + (config.root_decoder ? 0 : root), /*activated=*/false));
  if (config.root_decoder)
    root_decoder_ = register_module(
        "root_decoder", Connected(config.lstm, {wide, wide / 2}, root, /*activated=*/false));
}

void ControllersModelImpl::SetNormalisation(const Tensor& joint_mean, const Tensor& joint_std,
                                            const Tensor& factor_std) {
  torch::NoGradGuard no_grad;
  joint_mean_.copy_(joint_mean);
  joint_std_.copy_(joint_std);
  factor_std_.copy_(factor_std);
}

ControlledGiven ControllersModelImpl::Prepare(const ControlledTransition& transition) {
  const FrameTensors& history = transition.history;
  const int64_t batch = transition.path.size(0), frames = transition.frames;
  const auto options = transition.path.options();
  const Tensor count = torch::arange(frames, options).view({1, frames, 1});
  const Tensor u = (count + 1) / static_cast<double>(frames);
  const Tensor has = transition.has_target.unsqueeze(1);  // [batch, 1, 1]

  ControlledGiven given;
  given.end = transition.path.narrow(1, frames - 1, 1);
  given.has_target = has;
  given.target_joints = transition.target_joints.unsqueeze(1);
  given.target_facing = HeadingOf(transition.target_turn).unsqueeze(1);
  const Tensor& path = transition.path;
  const Tensor so_far = u.expand({batch, frames, 1});
  if (config_.residual) {
    given.root = path;
    const Tensor share = u * has;
    const Tensor last = history.joints.narrow(1, history.size() - 1, 1);
    given.joints = last + share.unsqueeze(-1) * (given.target_joints - last);
    given.ahead = HeadingOf(share.squeeze(-1) * transition.target_turn.unsqueeze(1));
    const Tensor from_start = ((count + 1) / kRampFrames).clamp_max(1);
    const Tensor to_target = ((frames - 1 - count) / kRampFrames).clamp_max(1);
    given.ramp = from_start * (1 - has + has * to_target);
    const Tensor left = TimeEmbedding((frames - 1 - count).squeeze(-1), kEmbedding);
    given.code = position_code_(
        torch::cat({TurnBack(path - given.end, given.ahead) * has,
                    (path.narrow(2, 1, 1) - skeleton_.pelvis_height) / kHeight, so_far, left * has},
                   -1));
  } else {
    const double pelvis = skeleton_.pelvis_height;
    given.root = torch::tensor({0.0, pelvis, 0.0}, options).expand({batch, frames, 3});
    given.joints = joint_mean_.expand({batch, frames, others_, 3});
    given.ahead = HeadingOf(torch::zeros({batch, frames}, options));
    given.ramp = torch::ones({batch, frames, 1}, options);
    std::vector<Tensor> code;
    if (config_.absolute_position) code.push_back((path - given.root) / place_);
    if (config_.relative_position) code.push_back(so_far);
    given.code = position_code_(torch::cat(code, -1));
    given.target = EncodeTarget(given, nullptr);
  }

  const auto encode = [&](const WindowController& controller, const Tensor& windows) {
    return controller->Encode(windows.flatten(0, 1)).unflatten(0, {batch, frames});
  };
  given.path_window =
      TurnBack(Windows(history.root, path, config_.window) - given.root.unsqueeze(2),
               given.ahead.unsqueeze(2)) /
      place_;
  given.path_memory = encode(path_controller_, given.path_window);
  if (config_.velocity_factors) {
    given.factor_window =
        Windows(FactorsOf(Steps(history), shares_), transition.factors, config_.window) /
        factor_std_;
    given.factor_memory = encode(factor_controller_, given.factor_window);
  }
  return given;
}

FrameTensors ControllersModelImpl::Compose(const ControlledGiven& given, const Tensor& joints,
                                           const Tensor& turn, const Tensor& root) const {
  // The heading relative to `ahead`, as a vector: (0, 1) is none.
  const Tensor none = torch::tensor({0.0F, 1.0F}, turn.options());
  const Tensor away = none + given.ramp * turn;
  const Tensor unit = away / (away.square().sum(-1, true) + 1e-6).sqrt();
  return {given.root + given.ramp * Turn(root, given.ahead), AddHeadings(given.ahead, unit), joints,
          torch::zeros({joints.size(0), joints.size(1), kContacts}, joints.options())};
}

// The target's posture, heading and place; for a residual network, relative to `now`.
Tensor ControllersModelImpl::EncodeTarget(const ControlledGiven& given, const FrameTensors* now) {
  Tensor joints, facing, place;
  if (now != nullptr) {
    joints = given.target_joints - now->joints;
    facing = SubtractHeadings(given.target_facing.expand_as(now->facing), now->facing);
    place = TurnBack(given.end - now->root, given.ahead);
  } else {
    joints = given.target_joints - joint_mean_;
    facing = given.target_facing;
    place = (given.end - given.root.narrow(1, 0, 1)) / place_;
  }
  return target_controller_->forward(torch::cat({(joints / joint_std_).flatten(-2), facing, place,
                                                 torch::ones_like(place.narrow(-1, 0, 1))},
                                                -1) *
                                     given.has_target);
}

ControlledOutput ControllersModelImpl::Walk(const ControlledGiven& given,
                                            const FrameTensors& walked, ControllersState* state) {
  const int64_t batch = given.root.size(0), frames = given.root.size(1);
  const int64_t half = config_.window / 2;
  const FrameTensors now = walked.Narrow(half, frames), before = walked.Narrow(half - 1, frames);

  // The mixture segments: the past as computed, the future as given.
  const auto decode = [&](const WindowController& controller, const Tensor& memory,
                          const Tensor& past, const Tensor& window) {
    const Tensor mixture =
        torch::cat({past, window.narrow(2, half, config_.window - half)}, 2).flatten(0, 1);
    return controller->Decode(memory.flatten(0, 1), mixture).unflatten(0, {batch, frames});
  };
  const Tensor roots =
      walked.root.narrow(1, 1, frames + half - 1).unfold(1, half, 1).transpose(-1, -2);
  std::vector<Tensor> live = {
      decode(path_controller_, given.path_memory,
             TurnBack(roots - given.root.unsqueeze(2), given.ahead.unsqueeze(2)) / place_,
             given.path_window)};
  if (config_.velocity_factors) {
    const Tensor factors = FactorsOf(Steps(walked), shares_) / factor_std_;
    live.push_back(decode(factor_controller_, given.factor_memory,
                          factors.unfold(1, half, 1).transpose(-1, -2), given.factor_window));
  }

  const Tensor facing = SubtractHeadings(now.facing, given.ahead);
  live.push_back(state_encoder_->forward(
      torch::cat({((now.joints - joint_mean_) / joint_std_).flatten(-2),
                  (now.root.narrow(2, 1, 1) - skeleton_.pelvis_height) / kHeight,
                  TurnBack(given.root - now.root, given.ahead) / place_, facing, now.contacts},
                 -1)));
  live.push_back(velocity_encoder_->forward(
      torch::cat({(now.joints - before.joints).flatten(-2) / kStep,
                  TurnBack(now.root - before.root, given.ahead) / kStep,
                  SubtractHeadings(now.facing, before.facing).narrow(-1, 0, 1) / kTurnStep},
                 -1)));
  const Tensor target = config_.residual
                            ? EncodeTarget(given, &now)
                            : given.target.expand({batch, frames, given.target.size(2)});

  Tensor hidden = torch::cat(live, -1);
  if (config_.two_lstms) hidden = RunLstm(first_, hidden, &state->first);
  hidden = RunLstm(second_, torch::cat({hidden, target}, -1) + given.code, &state->second);

  const int64_t pose = 3 * others_, all = 2 * pose + kContacts;
  const Tensor decoded = state_decoder_->forward(hidden);
  const Tensor root = config_.root_decoder ? root_decoder_->forward(hidden)
                                           : decoded.narrow(2, all, decoded.size(2) - all);
  const Tensor joints = given.joints + given.ramp.unsqueeze(-1) * joint_std_ *
                                           decoded.narrow(2, 0, pose).unflatten(2, {others_, 3});
  ControlledOutput output;
  output.frames = Compose(given, joints, root.narrow(2, 3, 2), place_ * root.narrow(2, 0, 3));
  output.frames.contacts = torch::sigmoid(decoded.narrow(2, 2 * pose, kContacts));
  output.velocities =
      kStep * Turn(torch::cat({root.narrow(2, 5, 3).unsqueeze(2),
                               decoded.narrow(2, pose, pose).unflatten(2, {others_, 3})},
                              2),
                   given.ahead.unsqueeze(2));
  return output;
}

FrameTensors ControllersModelImpl::RollOut(const ControlledTransition& transition) {
  const ControlledGiven given = Prepare(transition);
  ControllersState state;
  FrameTensors walked = transition.history.Narrow(transition.history.size() - lead(), lead());
  FrameTensors result;
  for (int64_t t = 0; t < transition.frames; ++t) {
    const FrameTensors next = Walk(given.Narrow(t, 1), walked, &state).frames;
    result = t == 0 ? next : Join(result, next);
    walked = Join(walked.Narrow(1, lead() - 1), next);
  }
  return result;
}

}  // namespace choreo
