#include "model/papers/samplers/packed_flow.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "model/core/error.h"
#include "model/motion/pose/pose_codec.h"
#include "model/papers/networks/key_condition.h"

namespace choreo {
namespace {

using Matrix = RowMajorMatrix;

// Joins two of LibTorch's linear maps, [out, in], into one map of their concatenated inputs.
Matrix Stacked(const Eigen::Map<const Matrix>& left, const Eigen::Map<const Matrix>& right) {
  Matrix weight(left.cols() + right.cols(), left.rows());
  weight << left.transpose(), right.transpose();
  return weight;
}

// Inverse of y = (x + bias) exp(log_scale) W^T.
PackedLinear Unmix(const PackedKernels& kernels, const PackedTensors& tensors,
                   const std::string& name, long width) {
  const auto square = [&](const char* part) -> Eigen::MatrixXd {
    return tensors.Get(name + part, width, width).cast<double>();
  };
  const auto vector = [&](const char* part) -> Eigen::VectorXd {
    return tensors.Get(name + part, width).cast<double>();
  };
  const Eigen::MatrixXd lower = square("lower").triangularView<Eigen::UnitLower>();
  Eigen::MatrixXd upper = square("upper").triangularView<Eigen::StrictlyUpper>();
  upper.diagonal() = vector("sign").array() * vector("log_diagonal").array().exp();
  const Eigen::MatrixXd inverse = (square("permutation") * lower * upper).inverse();
  const Eigen::VectorXd scale = (-vector("norm_log_scale")).array().exp();
  return {kernels, (scale.asDiagonal() * inverse).transpose().cast<float>(),
          -tensors.Get(name + "norm_bias", width)};
}

// The gain in log-likelihood by limiting outliers: the sum of 2 log cosh of the excess over the
// bound.
float BendSurprise(std::span<const float> x) {
  double sum = 0;
  for (const float value : x) {
    const double beyond = std::abs(static_cast<double>(value)) - kSampleBound;
    if (beyond > 0) sum += beyond + std::log1p(std::exp(-2 * beyond)) - std::numbers::ln2;
  }
  return static_cast<float>(2 * sum);
}

// Reads the coupling whose tensors' names begin with `name`.
PackedFlow::Coupling ReadCoupling(const PackedFlow& flow, const PackedTensors& tensors,
                                  const std::string& name, const PackedKernels& products) {
  const int hidden = flow.config.hidden, gates = 4 * hidden;  // of one LSTM layer
  const std::string lstm = name + "network.lstm.";
  const auto bias_of = [&](const std::string& layer) -> Eigen::VectorXf {
    return tensors.Get(lstm + "bias_ih_" + layer, gates) +
           tensors.Get(lstm + "bias_hh_" + layer, gates);
  };
  PackedFlow::Coupling coupling;
  // In checkpoints z_lo comes first, then the live part of the condition, then the static one.
  const int fixed = flow.encoded ? 0 : flow.static_width;
  const auto seen = tensors.Get(lstm + "weight_ih_l0", gates, flow.low() + flow.condition + fixed);
  Matrix weight(flow.input_width(), gates);
  weight << seen.middleCols(flow.low(), flow.condition).transpose(),
      seen.leftCols(flow.low()).transpose(),
      tensors.Get(lstm + "weight_hh_l0", gates, hidden).transpose();
  coupling.first = PackedLinear(products, weight, bias_of("l0"));
  if (!flow.encoded)
    coupling.hoisted = PackedLinear(products, seen.rightCols(fixed).transpose(), bias_of("l0"));
  coupling.second = PackedLinear(products,
                                 Stacked(tensors.Get(lstm + "weight_ih_l1", gates, hidden),
                                         tensors.Get(lstm + "weight_hh_l1", gates, hidden)),
                                 bias_of("l1"));
  coupling.last = tensors.Linear(products, name + "network.last", hidden, 2 * flow.high());
  coupling.unmix = Unmix(flow.kernels, tensors, name, flow.width);
  return coupling;
}

}  // namespace

PackedFlow::PackedFlow(const Safetensors& content, const FlowConfig& flow_config,
                       const Skeleton& skeleton, const PackedKernels& with,
                       const PackedKernels& products)
    : kernels(with),
      config(flow_config),
      width(PoseCodec(skeleton).width()),
      encoded(config.condition_width > 0),
      live(config.history_frames * width + config.HeardWidth() + 1),
      encoding(encoded ? config.condition_width : live),
      aimed(config.innovations ? 3 + 3 * skeleton.joints() : 0),
      condition(encoding + aimed),
      key_width(KeyConditionWidth(config, skeleton.joints(), width)),
      static_width(encoded ? encoding + (aimed > 0 ? 2 * aimed + 1 : 0) : key_width) {
  if (config.innovations && !encoded)
    throw InvalidArgument("condition_width", "0, but innovations need a shared encoding");
  const PackedTensors tensors(content);
  feature_mean = tensors.Get("feature_mean", width);
  feature_std = tensors.Get("feature_std", width);
  feature_scale = feature_std.cwiseInverse();
  if (config.innovations) {
    predict = tensors.Get("predict", config.history_frames, width).transpose();
    drawn_spread = tensors.Get("drawn_spread", width);
  }
  audio_mean = tensors.Get("audio_mean", config.audio_features);
  audio_scale = tensors.Get("audio_std", config.audio_features).cwiseInverse();

  if (encoded) {
    encode_static =
        tensors.Linear(kernels, "encode_static", key_width - (aimed > 0 ? 1 : 0), encoding);
    const long past = config.history_frames * width;
    encode_live = PackedLinear(
        products,
        Stacked(tensors.Get("encode_past.weight", encoding, past),
                tensors.Get("encode_audio.weight", encoding, live - past)),
        tensors.Get("encode_past.bias", encoding) + tensors.Get("encode_audio.bias", encoding));
    encode = tensors.Linear(products, "encode", encoding, encoding);
  }

  double log_det_sum = 0;
  for (int k = 0; k < config.flow_steps; ++k) {
    const std::string name = "flow.steps." + std::to_string(k) + ".";
    couplings.push_back(ReadCoupling(*this, tensors, name, products));
    log_det_sum += tensors.Get(name + "norm_log_scale", width).cast<double>().sum() +
                   tensors.Get(name + "log_diagonal", width).cast<double>().sum();
  }
  if (config.innovations) log_det_sum -= drawn_spread.cast<double>().array().log().sum();
  log_det = static_cast<float>(log_det_sum);
}

Eigen::MatrixXf PackedFlow::WithAims(const Eigen::MatrixXf& encodings,
                                     const Eigen::MatrixXf& conditions) const {
  const long joints = aimed / 3 - 1;
  Eigen::MatrixXf all(static_width, conditions.cols());
  all.topRows(encoding) = encodings.topRows(encoding);
  for (int i = 0; i < aimed; ++i) {
    all.row(encoding + i) = (conditions.row(i).array() - feature_mean[i]) * feature_scale[i];
    // The mask has one row per joint, then one for the root's position.
    all.row(encoding + aimed + i) = conditions.row(aimed + (i < 3 ? joints : i / 3 - 1));
  }
  all.bottomRows(1) = conditions.bottomRows(1);
  return all;
}

PackedStepper::PackedStepper(std::shared_ptr<const PackedFlow> flow) : flow_(std::move(flow)) {
  const PackedFlow::Coupling& coupling = flow_->couplings.front();
  live_.Resize(1, std::max<long>(flow_->live, flow_->encode.padded()));
  encoding_.Resize(1, flow_->encode.padded());
  input_.Resize(1, flow_->input_width());
  wide_.Resize(1, coupling.first.padded());
  hidden_.Resize(1, 2 * flow_->config.hidden);
  ab_.Resize(1, coupling.last.padded());
  z_.Resize(1, coupling.unmix.padded());
  mixed_.Resize(1, coupling.unmix.padded());
}

void PackedStepper::StartTransition(Eigen::MatrixXf conditions) {
  const PackedFlow& flow = *flow_;
  if (flow.encoded) {
    Eigen::MatrixXf encoded(flow.encode_static.padded(), conditions.cols());
    flow.encode_static.Run(conditions.data(), conditions.rows(), encoded.data(), encoded.rows(),
                           conditions.cols());
    if (flow.aimed > 0) {
      conditions = flow.WithAims(encoded, conditions);
    } else {
      conditions = encoded.topRows(flow.encoding);
    }
  }
  static_condition_.assign(conditions.data(), conditions.data() + conditions.size());
  state_.assign(static_cast<size_t>(flow.state_width()), 0.0F);
  if (!flow.encoded) Hoist(0);
}

void PackedStepper::Hoist(long frame) {
  const long static_width = flow_->static_width, hoisted_width = flow_->hoisted_width();
  const long frames = static_cast<long>(static_condition_.size()) / static_width;
  const long ahead = std::min(kAhead, frames - frame);
  hoisted_from_ = frame;
  hoisted_.resize(static_cast<size_t>(ahead * hoisted_width));
  float* out = hoisted_.data();
  for (const PackedFlow::Coupling& coupling : flow_->couplings) {
    coupling.hoisted.Run(static_condition_.data() + frame * static_width, static_width, out,
                         hoisted_width, ahead);
    out += coupling.hoisted.padded();
  }
}

// Writes `input_`'s condition columns.
void PackedStepper::Condition(const FlowFrame& frame) {
  const PackedFlow& flow = *flow_;
  const long past = flow.config.history_frames * flow.width;
  if (!flow.encoded && frame.frame >= hoisted_from_ + kAhead) Hoist(frame.frame);
  float* live = flow.encoded ? live_.Row(0) : input_.Row(0);
  flow.kernels.standardise(frame.past.data(), flow.feature_mean.data(), flow.feature_scale.data(),
                           flow.width, flow.config.history_frames, kFeatureClamp, live);
  if (frame.has_audio) {
    flow.kernels.standardise(frame.audio.data(), flow.audio_mean.data(), flow.audio_scale.data(),
                             flow.config.audio_features, flow.config.history_frames + 1,
                             kFeatureClamp, live + past);
  } else {
    std::fill(live + past, live + flow.live, 0.0F);
  }
  live[flow.live - 1] = frame.has_audio ? 1.0F : 0.0F;
  if (!flow.encoded) return;
  flow.encode_live.Run(live_, &encoding_, 1);
  const float* fixed =
      static_condition_.data() + static_cast<long>(frame.frame) * flow.static_width;
  Eigen::Map<Eigen::VectorXf>(encoding_.Row(0), flow.encoding) +=
      Eigen::Map<const Eigen::VectorXf>(fixed, flow.encoding);
  flow.kernels.silu(encoding_.Row(0), encoding_.stride());
  // live_ is free again, and wide enough for the second layer.
  flow.encode.Run(encoding_, &live_, 1);
  flow.kernels.silu(live_.Row(0), flow.encoding);
  std::copy_n(live_.Row(0), flow.encoding, input_.Row(0));
  if (flow.aimed > 0) Aim(frame, fixed + flow.encoding, input_.Row(0) + flow.encoding);
}

// Computes `hidden_`, the input of the last layer, from `input_`.
void PackedStepper::Hidden(int frame, int step) {
  const PackedFlow& flow = *flow_;
  const PackedFlow::Coupling& coupling = flow.couplings[static_cast<size_t>(step)];
  const long hidden = flow.config.hidden;
  float* h0 = state_.data() + step * 4 * hidden;
  float* h1 = h0 + hidden;
  std::copy_n(h0, hidden, input_.Row(0) + flow.condition + flow.low());
  if (flow.encoded) {
    coupling.first.Run(input_, &wide_, 1);
  } else {
    std::copy_n(
        hoisted_.data() + (frame - hoisted_from_) * flow.hoisted_width() + step * wide_.stride(),
        wide_.stride(), wide_.Row(0));
    coupling.first.Add(input_.Row(0), input_.stride(), wide_.Row(0), wide_.stride(), 1);
  }
  flow.kernels.lstm(wide_.Row(0), h0, h0 + 2 * hidden, hidden);
  std::copy_n(h0, 2 * hidden, hidden_.Row(0));
  coupling.second.Run(hidden_, &wide_, 1);
  flow.kernels.lstm(wide_.Row(0), h1, h1 + 2 * hidden, hidden);
  std::copy_n(h1, hidden, hidden_.Row(0));
}

// The inverse of one step, z_ -> z_. Returns the product of the deltas.
double PackedStepper::Couple(int frame, int step) {
  const PackedFlow& flow = *flow_;
  const PackedFlow::Coupling& coupling = flow.couplings[static_cast<size_t>(step)];
  std::copy_n(z_.Row(0), flow.low(), input_.Row(0) + flow.condition);
  Hidden(frame, step);
  coupling.last.Run(hidden_, &ab_, 1);
  const double deltas = flow.kernels.coupling({.ab = ab_.Row(0),
                                               .high = z_.Row(0) + flow.low(),
                                               .width = flow.high(),
                                               .delta_bias = kDeltaBias,
                                               .delta_floor = kDeltaFloor});
  coupling.unmix.Run(z_, &mixed_, 1);
  std::swap(z_, mixed_);
  return deltas;
}

void PackedStepper::Aim(const FlowFrame& frame, const float* fixed, float* aim) const {
  const PackedFlow& flow = *flow_;
  const float* last = frame.past.last(static_cast<size_t>(flow.width)).data();
  const float *key = fixed, *mask = fixed + flow.aimed;
  const float left = fixed[2 * flow.aimed];
  for (int i = 0; i < flow.aimed; ++i) {
    const float now = flow.Standard(last, i), before = flow.Standard(last - flow.width, i);
    const float way = key[i] - now;
    const float value =
        left > 0 ? AccelerationTo(way, now - before, left) / flow.drawn_spread[i] : way;
    aim[i] = mask[i] * std::clamp(value, static_cast<float>(-kFeatureClamp),
                                  static_cast<float>(kFeatureClamp));
  }
}

void PackedStepper::AddPrediction(std::span<const float> past, float* x) const {
  const PackedFlow& flow = *flow_;
  for (int i = 0; i < flow.width; ++i) {
    float sum = x[i] * flow.drawn_spread[i];
    for (int t = 0; t < flow.config.history_frames; ++t)
      sum += flow.predict(i, t) * flow.Standard(past.data() + static_cast<long>(t) * flow.width, i);
    x[i] = sum;
  }
}

void PackedStepper::Step(FlowFrame* frame) {
  const PackedFlow& flow = *flow_;
  const std::span<float> noise(z_.Row(0), static_cast<size_t>(flow.width));
  frame->FillNoise(noise);
  double squares = 0;
  for (const float value : noise) squares += static_cast<double>(value) * value;
  const double base = squares + std::log(2 * std::numbers::pi) * flow.width;
  float log_likelihood = static_cast<float>(-0.5 * base) + flow.log_det;
  Condition(*frame);
  for (int step = flow.config.flow_steps - 1; step >= 0; --step)
    log_likelihood += static_cast<float>(std::log(Couple(frame->frame, step)));
  float* x = z_.Row(0);
  if (flow.config.innovations) AddPrediction(frame->past, x);
  frame->log_likelihood = log_likelihood + BendSurprise({x, static_cast<size_t>(flow.width)});
  flow.kernels.bend(x, flow.feature_mean.data(), flow.feature_std.data(), flow.width, kSampleBound,
                    frame->features.data());
}

}  // namespace choreo
