#include "model/flow/network/continuous_flow.h"

#include <ATen/autocast_mode.h>
#include <torch/nn/init.h>
#include <torch/utils.h>

#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/flow/network/time_attention.h"
#include "model/flow/window/flow_tokens.h"

namespace choreo {

using torch::Tensor;

namespace {

// A transformer block; conditioning on the whole window scales and shifts its norms and weights its
// two halves (adaptive layer norm, Peebles & Xie 2023).
class FlowBlockImpl : public torch::nn::Module {
 public:
  FlowBlockImpl(int width, int heads, int condition) {
    using torch::nn::LayerNormOptions;
    const auto norm = [&] {
      return torch::nn::LayerNorm(LayerNormOptions({width}).elementwise_affine(false));
    };
    attention_norm_ = register_module("attention_norm", norm());
    mlp_norm_ = register_module("mlp_norm", norm());
    qkv_ = register_module("qkv", torch::nn::Linear(width, 3 * width));
    out_ = register_module("out", torch::nn::Linear(width, width));
    up_ = register_module("up", torch::nn::Linear(width, kMlpRatio * width));
    down_ = register_module("down", torch::nn::Linear(kMlpRatio * width, width));
    modulation_ = register_module("modulation", torch::nn::Linear(condition, 6 * width));
    torch::nn::init::zeros_(modulation_->weight);
    torch::nn::init::zeros_(modulation_->bias);
    distance_bias_ =
        register_parameter("distance_bias", torch::zeros({kMaxTokensApart * 2 + 1, heads}));
  }

  Tensor forward(const Tensor& x, const Tensor& condition, const Tensor& distance) {
    const std::vector<Tensor> m = modulation_(condition).unsqueeze(1).chunk(6, -1);
    const Tensor mixed =
        AttendInTime(qkv_(attention_norm_(x) * (1 + m[0]) + m[1]), distance_bias_, distance);
    const Tensor attended = x + (1 + m[2]) * out_(mixed);
    return attended + (1 + m[5]) * down_(torch::gelu(up_(mlp_norm_(attended) * (1 + m[3]) + m[4])));
  }

 private:
  torch::nn::LayerNorm attention_norm_{nullptr}, mlp_norm_{nullptr};
  torch::nn::Linear qkv_{nullptr}, out_{nullptr}, up_{nullptr}, down_{nullptr},
      modulation_{nullptr};
  Tensor distance_bias_;
};
TORCH_MODULE(FlowBlock);

Tensor EmbedTime(const Tensor& t) {
  const Tensor times = t.cpu().contiguous();
  const Tensor embedded = torch::empty({t.size(0), kFlowTimeWidth});
  for (int64_t i = 0; i < t.size(0); ++i) {
    EmbedFlowTime(times.data_ptr<float>()[i],
                  {embedded.data_ptr<float>() + i * kFlowTimeWidth, size_t{kFlowTimeWidth}});
  }
  return embedded.to(t.device());
}

// Whether the CPU multiplies bfloat16. Others take thirty times as long as with float32.
bool MultipliesBfloat16() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512bf16") != 0;
#else
  return false;
#endif
}

// While it exists and `on`, matrix products use bfloat16, which makes training twice as fast.
class Bfloat16Products {
 public:
  explicit Bfloat16Products(bool on) : before_(at::autocast::is_cpu_enabled()) {
    at::autocast::set_autocast_cpu_dtype(torch::kBFloat16);
    at::autocast::set_cpu_enabled(on);
    at::autocast::increment_nesting();
  }
  ~Bfloat16Products() {
    if (at::autocast::decrement_nesting() == 0) at::autocast::clear_cache();
    at::autocast::set_cpu_enabled(before_);
  }
  Bfloat16Products(const Bfloat16Products&) = delete;
  Bfloat16Products& operator=(const Bfloat16Products&) = delete;

 private:
  bool before_;
};

// One window of [batch, w, features] → [features, w].
Eigen::MatrixXf RowOf(const Tensor& batch, int64_t row) {
  const Tensor one = batch[row].detach().cpu().contiguous();
  return Eigen::Map<const Eigen::MatrixXf>(one.data_ptr<float>(), one.size(-1),
                                           one.numel() / one.size(-1));
}

Eigen::MatrixXd ToEigen(const Tensor& tensor) {
  const Tensor dense = tensor.detach().to(torch::kCPU, torch::kFloat64).contiguous();
  return Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(
      dense.data_ptr<double>(), dense.size(0), dense.numel() / dense.size(0));
}

// [rows, columns] in any layout → [columns, rows]: time first, as in networks.
template <typename Matrix>
Tensor TimeFirst(const Matrix& matrix) {
  return torch::from_blob(const_cast<float*>(matrix.data()), {1, matrix.cols(), matrix.rows()});
}

class TorchFlowNetwork : public FlowNetwork {
 public:
  TorchFlowNetwork(ContinuousFlow model, torch::Device device)
      : model_(std::move(model)), device_(device) {
    model_->to(device_);
  }
  Eigen::MatrixXf Condition(const Eigen::VectorXf& whole,
                            std::span<const float> times) const override {
    Eigen::MatrixXf condition(whole.size() + 1, std::ssize(times));
    condition.topRows(whole.size()).colwise() = whole;
    std::ranges::copy(times, condition.bottomRows<1>().begin());
    return condition;
  }
  Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                           const Eigen::MatrixXf& joints, const Eigen::MatrixXf& mean,
                           const Eigen::MatrixXf& frames,
                           const Eigen::VectorXf& condition) const override {
    const c10::InferenceMode inference;
    auto& model = const_cast<ContinuousFlow&>(model_);
    const auto there = [this](const auto& matrix) { return TimeFirst(matrix).to(device_); };
    const Tensor known = there(condition).squeeze(1);
    const int64_t whole = known.size(1) - 1;
    const Tensor f = model
                         ->forward(there(z), there(poses), there(joints), there(mean),
                                   there(frames), known.narrow(1, 0, whole), known.select(1, whole))
                         .cpu()
                         .contiguous();
    return Eigen::Map<const Eigen::MatrixXf>(f.data_ptr<float>(), z.rows(), z.cols());
  }

 private:
  ContinuousFlow model_;
  torch::Device device_;
};

constexpr const char* kFormat = "choreo-continuous-flow-8";
constexpr const char *kTurns = "turn_prior", *kCurve = "energy_curve", *kPowers = "variance_powers",
                     *kResponse = "energy_response", *kFacing = "usual_facing";
constexpr int kPowerNumbers = 7;

}  // namespace

ContinuousFlowImpl::ContinuousFlowImpl(const ContinuousFlowConfig& config, const Skeleton& skeleton)
    : config_(config), skeleton_(skeleton) {
  const int64_t dimensions = 3 + 3 * skeleton.joints(), width = config.width;
  const Tensor walk = torch::zeros({dimensions, MotionPrior::kLags});
  walk.select(1, 0).fill_(1e-4);
  covariance_ = register_buffer("velocity_covariance", walk);
  powers_ = register_buffer(kPowers, torch::zeros({kPowerNumbers}));
  SetPowers({});
  usual_ = register_buffer("usual_pose", torch::zeros({dimensions}));
  usual_variance_ = register_buffer("usual_variance", torch::zeros({dimensions}));
  mixing_ = register_buffer("mixing", torch::eye(dimensions));
  spread_ = register_buffer("spread", torch::ones({dimensions}));
  velocity_ = register_buffer("velocity_spread", torch::ones({dimensions}));
  energy_ = register_buffer(
      "energy_prior", torch::zeros({std::ssize(EnergyPrior(config.styles.size()).ToNumbers())}));
  turns_ = register_buffer(kTurns, torch::zeros({TurnPrior::kInputs}));
  curve_ = register_buffer(kCurve, torch::zeros({EnergyCurve::kNumbers}));
  response_ = register_buffer(kResponse, torch::zeros({2, kBodyParts}));
  facing_ = register_buffer(kFacing, torch::zeros({1}));
  const int64_t features =
      kFramesAToken * TokenFrameWidth(static_cast<int>(dimensions), FrameFeatures());
  embed_ = register_module("embed", torch::nn::Linear(features, width));
  condition_in_ = register_module(
      "condition_in", torch::nn::Linear(WholeFeatures(skeleton, config) + kFlowTimeWidth, width));
  condition_out_ = register_module("condition_out", torch::nn::Linear(width, config.condition));
  blocks_ = register_module("blocks", torch::nn::ModuleList());
  for (int i = 0; i < config.layers; ++i)
    blocks_->push_back(FlowBlock(config.width, config.heads, config.condition));
  inject_ = register_module("inject", torch::nn::Linear(config.condition, width));
  head_modulation_ =
      register_module("head_modulation", torch::nn::Linear(config.condition, 2 * width));
  head_ = register_module("head", torch::nn::Linear(width, 2 * kFramesAToken * dimensions));
  for (const auto& linear : {head_modulation_, head_}) {
    torch::nn::init::zeros_(linear->weight);
    torch::nn::init::zeros_(linear->bias);
  }
}

Tensor ContinuousFlowImpl::forward(const Tensor& z, const Tensor& poses, const Tensor& joints,
                                   const Tensor& mean, const Tensor& frames, const Tensor& whole,
                                   const Tensor& t) {
  const int64_t batch = z.size(0), window = z.size(1), dimensions = z.size(2);
  const Eigen::VectorXf spread = RowOf(spread_.unsqueeze(0), 0),
                        velocity = RowOf(velocity_.unsqueeze(0), 0);
  // The network's inputs are data, so no gradient needs to flow through FlowTokens.
  const Tensor here[] = {z.cpu(), poses.cpu(), joints.cpu(), mean.cpu(), frames.cpu()};
  std::vector<Tensor> windows;
  for (int64_t row = 0; row < batch; ++row) {
    const auto of = [&](int i) { return RowOf(here[i], row); };
    const Eigen::MatrixXf seen = FlowTokens(of(0), of(1), of(2), of(3), of(4), spread, velocity);
    windows.push_back(TimeFirst(seen).clone());
  }
  Tensor x = torch::cat(windows).to(z.device());
  const int64_t tokens = x.size(1) / kFramesAToken;

  const Tensor condition = torch::silu(
      condition_out_(torch::silu(condition_in_(torch::cat({whole, EmbedTime(t)}, -1)))));
  x = embed_(x.reshape({batch, tokens, -1})) + inject_(condition).unsqueeze(1);
  const Tensor distance = TimeDistances(tokens, z.device(), kMaxTokensApart);
  {
    const Bfloat16Products fast(is_training() && MultipliesBfloat16());
    for (const auto& block : *blocks_) x = block->as<FlowBlock>()->forward(x, condition, distance);
  }
  const std::vector<Tensor> m = head_modulation_(condition).unsqueeze(1).chunk(2, -1);
  x = torch::layer_norm(x, {x.size(-1)}) * (1 + m[0]) + m[1];
  const std::vector<Tensor> f = head_(x)
                                    .reshape({batch, tokens * kFramesAToken, 2 * dimensions})
                                    .narrow(1, tokens * kFramesAToken - window, window)
                                    .chunk(2, -1);
  // The second half scales z: a calm window is mainly a smaller z than an energetic one.
  return f[0] + f[1] * z;
}

void ContinuousFlowImpl::SetPrior(const Eigen::MatrixXd& covariance, const VariancePowers& powers,
                                  const Eigen::MatrixXd& mixing, const Eigen::VectorXd& spread,
                                  const UsualPose& usual) {
  torch::NoGradGuard no_grad;
  const auto set = [](Tensor to, const Eigen::MatrixXd& from) {
    const Eigen::Matrix<double, -1, -1, Eigen::RowMajor> rows = from;
    to.copy_(torch::from_blob(const_cast<double*>(rows.data()), to.sizes(), torch::kFloat64));
  };
  set(covariance_, covariance);
  SetPowers(powers);
  Eigen::VectorXd pose(covariance.rows());
  pose << usual.pose.root_position, usual.pose.rotations.reshaped();
  set(usual_, pose);
  set(usual_variance_, usual.variance);
  SetFacing(usual.facing);
  set(mixing_, mixing);
  set(spread_, spread);
  set(velocity_, MotionPrior(covariance).VelocitySpread());
}

void ContinuousFlowImpl::SetPowers(const VariancePowers& powers) {
  torch::NoGradGuard no_grad;
  powers_.copy_(torch::tensor({powers.surprise, powers.least, powers.most, powers.offset,
                               powers.known_surprise, powers.level, powers.least_scale}));
}

void ContinuousFlowImpl::SetEnergy(const EnergyPrior& energy) {
  torch::NoGradGuard no_grad;
  energy_.copy_(torch::tensor(energy.ToNumbers()));
}

void ContinuousFlowImpl::SetTurns(const TurnPrior& turns) {
  torch::NoGradGuard no_grad;
  turns_.copy_(torch::tensor(std::vector<double>(turns.weights.begin(), turns.weights.end())));
}

void ContinuousFlowImpl::SetFacing(double variance) {
  torch::NoGradGuard no_grad;
  facing_.fill_(variance);
}

void ContinuousFlowImpl::SetCurve(const EnergyCurve& curve) {
  torch::NoGradGuard no_grad;
  curve_.copy_(torch::tensor(curve.ToNumbers()));
}

void ContinuousFlowImpl::SetResponse(const EnergyResponse& response) {
  torch::NoGradGuard no_grad;
  for (int part = 0; part < kBodyParts; ++part) {
    response_[0][part] = response.offset[part];
    response_[1][part] = response.slope[part];
  }
}

FlowModelParts ContinuousFlowImpl::Parts() const {
  const Eigen::MatrixXd numbers = ToEigen(powers_);
  VariancePowers powers{.surprise = numbers(0),
                        .least = numbers(1),
                        .most = numbers(2),
                        .offset = numbers(3),
                        .known_surprise = numbers(4),
                        .level = numbers(5),
                        .least_scale = numbers(6),
                        .parts = std::vector<int>(3, static_cast<int>(BodyPart::kTrunk)),
                        .medians = config_.median_factors};
  const BodyPartWeights weights = WeighBodyParts(skeleton_);
  for (int joint = 0; joint < skeleton_.joints(); ++joint) {
    int part = 0;
    weights.col(joint).maxCoeff(&part);
    powers.parts.insert(powers.parts.end(), 3, part);
  }
  const Eigen::VectorXd pose = ToEigen(usual_);
  UsualPose usual{
      .pose = {pose.head<3>(), pose.tail(pose.size() - 3).reshaped(3, pose.size() / 3 - 1)},
      .variance = ToEigen(usual_variance_),
      .facing = facing_.item<double>()};
  EnergyPrior energy(config_.styles.size());
  const Eigen::MatrixXd measured = ToEigen(energy_), curve = ToEigen(curve_),
                        response = ToEigen(response_);
  energy.SetNumbers({measured.data(), static_cast<size_t>(measured.size())});
  return {skeleton_,
          config_,
          MotionPrior(ToEigen(covariance_), std::move(powers), std::move(usual)),
          ToEigen(mixing_),
          energy,
          TurnPrior{ToEigen(turns_)},
          EnergyCurve::FromNumbers({curve.data(), static_cast<size_t>(curve.size())}),
          EnergyResponse{response.row(0), response.row(1)}};
}

std::unique_ptr<FlowNetwork> MakeTorchFlowNetwork(ContinuousFlow model, torch::Device device) {
  return std::make_unique<TorchFlowNetwork>(std::move(model), device);
}

bool HoldsContinuousFlow(const Safetensors& content) {
  const auto format = content.metadata.find("format");
  return format != content.metadata.end() && format->second.starts_with("choreo-continuous-flow-");
}

ContinuousFlowCheckpoint ParseContinuousFlow(const Safetensors& content, const std::string& name) {
  // Checkpoints from before these tensors existed get zeros, which mean "unknown".
  Safetensors whole = content;
  whole.tensors.try_emplace(
      kTurns, NamedTensor{{TurnPrior::kInputs}, std::vector<float>(TurnPrior::kInputs)});
  whole.tensors.try_emplace(
      kCurve, NamedTensor{{EnergyCurve::kNumbers}, std::vector<float>(EnergyCurve::kNumbers)});
  whole.tensors.try_emplace(kFacing, NamedTensor{{1}, {0}});
  whole.tensors.try_emplace(kResponse,
                            NamedTensor{{2, kBodyParts}, std::vector<float>(2 * kBodyParts)});
  if (const auto powers = whole.tensors.find(kPowers);
      powers != whole.tensors.end() && powers->second.data.size() == kPowerNumbers - 1) {
    powers->second.data.push_back(VariancePowers::kDefaultMinScale);
    powers->second.shape = {kPowerNumbers};
  }
  auto checkpoint = BuildCheckpoint<ContinuousFlow, ContinuousFlowConfig>(
      CheckpointFile(content, name, kFormat), whole);
  checkpoint.model->config().Check(name + ": config");
  if (!checkpoint.model->Parts().curve.IsValid())
    throw InvalidArgument(name + ": " + kCurve, "is not a correlation: it leaves [-1, 1]");
  return checkpoint;
}

std::string SaveContinuousFlow(const std::filesystem::path& path, const ContinuousFlow& model,
                               Safetensors weights, const nlohmann::json& card) {
  return WriteCheckpointFile(path, std::move(weights), kFormat, model->config(), model->skeleton(),
                             card);
}

}  // namespace choreo
