#include "model/papers/samplers/packed_flow.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "model/core/error.h"
#include "model/motion/pose_codec.h"
#include "model/papers/networks/key_condition.h"

namespace choreo {
namespace {

using Matrix = RowMajorMatrix;

// One product of what two maps of LibTorch's, [out, in], make of inputs that lie side by side.
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

// How much likelier a frame becomes where outliers are bent: 2 log cosh of what is beyond the
// bound.
float BendSurprise(std::span<const float> x) {
  double sum = 0;
  for (const float value : x) {
    const double beyond = std::abs(static_cast<double>(value)) - kSampleBound;
    if (beyond > 0) sum += beyond + std::log1p(std::exp(-2 * beyond)) - std::numbers::ln2;
  }
  return static_cast<float>(2 * sum);
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
    throw InvalidArgument("condition_width", "0, but innovations want a shared encoding");
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

  const int hidden = config.hidden, gates = 4 * hidden;  // of one LSTM layer
  double log_det_sum = 0;
  for (int k = 0; k < config.flow_steps; ++k) {
    const std::string name = "flow.steps." + std::to_string(k) + ".";
    const std::string lstm = name + "network.lstm.";
    const auto bias_of = [&](const std::string& layer) -> Eigen::VectorXf {
      return tensors.Get(lstm + "bias_ih_" + layer, gates) +
             tensors.Get(lstm + "bias_hh_" + layer, gates);
    };
    Coupling& coupling = couplings.emplace_back();
    // In checkpoints z_lo comes first, then what of the condition is live, then what is static.
    const int fixed = encoded ? 0 : static_width;
    const auto seen = tensors.Get(lstm + "weight_ih_l0", gates, low() + condition + fixed);
    Matrix weight(input_width(), gates);
    weight << seen.middleCols(low(), condition).transpose(), seen.leftCols(low()).transpose(),
        tensors.Get(lstm + "weight_hh_l0", gates, hidden).transpose();
    coupling.first = PackedLinear(products, weight, bias_of("l0"));
    if (!encoded)
      coupling.hoisted = PackedLinear(products, seen.rightCols(fixed).transpose(), bias_of("l0"));
    coupling.second = PackedLinear(products,
                                   Stacked(tensors.Get(lstm + "weight_ih_l1", gates, hidden),
                                           tensors.Get(lstm + "weight_hh_l1", gates, hidden)),
                                   bias_of("l1"));
    coupling.last = tensors.Linear(products, name + "network.last", hidden, 2 * high());
    coupling.unmix = Unmix(kernels, tensors, name, width);
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
    // Told joint by joint, the root's place last.
    all.row(encoding + aimed + i) = conditions.row(aimed + (i < 3 ? joints : i / 3 - 1));
  }
  all.bottomRows(1) = conditions.bottomRows(1);
  return all;
}

PackedTile::PackedTile(std::shared_ptr<const PackedFlow> flow, int slots)
    : flow_(std::move(flow)), slots_(static_cast<size_t>(slots)) {
  const PackedFlow::Coupling& coupling = flow_->couplings.front();
  live_.Resize(slots, std::max<long>(flow_->live, flow_->encode.padded()));
  encoding_.Resize(slots, flow_->encode.padded());
  input_.Resize(slots, flow_->input_width());
  wide_.Resize(slots, coupling.first.padded());
  hidden_.Resize(slots, 2 * flow_->config.hidden);
  ab_.Resize(slots, coupling.last.padded());
  z_.Resize(slots, coupling.unmix.padded());
  mixed_.Resize(slots, coupling.unmix.padded());
}

void PackedTile::Begin(int slot_index, Eigen::MatrixXf conditions) {
  Slot& slot = slots_[static_cast<size_t>(slot_index)];
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
  slot.static_condition.assign(conditions.data(), conditions.data() + conditions.size());
  slot.state.assign(static_cast<size_t>(flow.state_width()), 0.0F);
  if (!flow.encoded) Hoist(&slot, 0);
}

void PackedTile::Hoist(Slot* slot, long frame) {
  const long static_width = flow_->static_width, hoisted_width = flow_->hoisted_width();
  const long frames = static_cast<long>(slot->static_condition.size()) / static_width;
  const long ahead = std::min(kAhead, frames - frame);
  slot->hoisted_from = frame;
  slot->hoisted.resize(static_cast<size_t>(ahead * hoisted_width));
  float* out = slot->hoisted.data();
  for (const PackedFlow::Coupling& coupling : flow_->couplings) {
    coupling.hoisted.Run(slot->static_condition.data() + frame * static_width, static_width, out,
                         hoisted_width, ahead);
    out += coupling.hoisted.padded();
  }
}

// Writes `input_`'s condition columns. `z_` holds the noise.
void PackedTile::Condition(std::span<const FlowRow> rows) {
  const PackedFlow& flow = *flow_;
  const auto count = static_cast<long>(rows.size());
  const long past = flow.config.history_frames * flow.width;
  for (long i = 0; i < count; ++i) {
    const FlowRow& row = rows[static_cast<size_t>(i)];
    Slot& slot = slots_[static_cast<size_t>(row.slot)];
    if (!flow.encoded && row.frame >= slot.hoisted_from + kAhead) Hoist(&slot, row.frame);
    float* live = flow.encoded ? live_.Row(i) : input_.Row(i);
    flow.kernels.standardise(row.past.data(), flow.feature_mean.data(), flow.feature_scale.data(),
                             flow.width, flow.config.history_frames, kFeatureClamp, live);
    if (row.has_audio) {
      flow.kernels.standardise(row.audio.data(), flow.audio_mean.data(), flow.audio_scale.data(),
                               flow.config.audio_features, flow.config.history_frames + 1,
                               kFeatureClamp, live + past);
    } else {
      std::fill(live + past, live + flow.live, 0.0F);
    }
    live[flow.live - 1] = row.has_audio ? 1.0F : 0.0F;
  }
  if (!flow.encoded) return;
  flow.encode_live.Run(live_, &encoding_, count);
  const auto fixed = [&](long i) {
    const FlowRow& row = rows[static_cast<size_t>(i)];
    const Slot& slot = slots_[static_cast<size_t>(row.slot)];
    return slot.static_condition.data() + row.frame * flow.static_width;
  };
  for (long i = 0; i < count; ++i)
    Eigen::Map<Eigen::VectorXf>(encoding_.Row(i), flow.encoding) +=
        Eigen::Map<const Eigen::VectorXf>(fixed(i), flow.encoding);
  flow.kernels.silu(encoding_.Row(0), count * encoding_.stride());
  // live_ has done its part, and is wider.
  flow.encode.Run(encoding_, &live_, count);
  for (long i = 0; i < count; ++i) {
    flow.kernels.silu(live_.Row(i), flow.encoding);
    std::copy_n(live_.Row(i), flow.encoding, input_.Row(i));
    if (flow.aimed > 0)
      Aim(rows[static_cast<size_t>(i)], fixed(i) + flow.encoding, input_.Row(i) + flow.encoding);
  }
}

// From `input_` to `hidden_`, what the last layer sees.
void PackedTile::Hidden(std::span<const FlowRow> rows, int step) {
  const PackedFlow& flow = *flow_;
  const PackedFlow::Coupling& coupling = flow.couplings[static_cast<size_t>(step)];
  const auto count = static_cast<long>(rows.size());
  const long hidden = flow.config.hidden;
  const auto state = [&](long i) {
    return slots_[static_cast<size_t>(rows[static_cast<size_t>(i)].slot)].state.data() +
           step * 4 * hidden;
  };
  for (long i = 0; i < count; ++i)
    std::copy_n(state(i), hidden, input_.Row(i) + flow.condition + flow.low());
  if (flow.encoded) {
    coupling.first.Run(input_, &wide_, count);
  } else {
    for (long i = 0; i < count; ++i) {
      const FlowRow& row = rows[static_cast<size_t>(i)];
      const Slot& slot = slots_[static_cast<size_t>(row.slot)];
      std::copy_n(slot.hoisted.data() + (row.frame - slot.hoisted_from) * flow.hoisted_width() +
                      step * wide_.stride(),
                  wide_.stride(), wide_.Row(i));
    }
    coupling.first.Add(input_.Row(0), input_.stride(), wide_.Row(0), wide_.stride(), count);
  }
  for (long i = 0; i < count; ++i) {
    float* h = state(i);
    flow.kernels.lstm(wide_.Row(i), h, h + 2 * hidden, hidden);
    std::copy_n(h, 2 * hidden, hidden_.Row(i));
  }
  coupling.second.Run(hidden_, &wide_, count);
  for (long i = 0; i < count; ++i) {
    float* h = state(i) + hidden;
    flow.kernels.lstm(wide_.Row(i), h, h + 2 * hidden, hidden);
    std::copy_n(h, hidden, hidden_.Row(i));
  }
}

// The inverse of one step, z_ -> z_.
void PackedTile::Couple(std::span<FlowRow> rows, int step) {
  const PackedFlow& flow = *flow_;
  const PackedFlow::Coupling& coupling = flow.couplings[static_cast<size_t>(step)];
  const auto count = static_cast<long>(rows.size());
  for (long i = 0; i < count; ++i) {
    std::copy_n(z_.Row(i), flow.low(), input_.Row(i) + flow.condition);
  }
  Hidden(rows, step);
  coupling.last.Run(hidden_, &ab_, count);
  for (long i = 0; i < count; ++i) {
    const double deltas = flow.kernels.coupling({.ab = ab_.Row(i),
                                                 .high = z_.Row(i) + flow.low(),
                                                 .width = flow.high(),
                                                 .delta_bias = kDeltaBias,
                                                 .delta_floor = kDeltaFloor});
    *rows[static_cast<size_t>(i)].log_likelihood += static_cast<float>(std::log(deltas));
  }
  coupling.unmix.Run(z_, &mixed_, count);
  std::swap(z_, mixed_);
}

void PackedTile::Aim(const FlowRow& row, const float* fixed, float* aim) const {
  const PackedFlow& flow = *flow_;
  const float* last = row.past.last(static_cast<size_t>(flow.width)).data();
  const float *key = fixed, *asked = fixed + flow.aimed;
  const float left = fixed[2 * flow.aimed];
  for (int i = 0; i < flow.aimed; ++i) {
    const float now = flow.Standard(last, i), before = flow.Standard(last - flow.width, i);
    const float way = key[i] - now;
    const float wanted =
        left > 0 ? AccelerationTo(way, now - before, left) / flow.drawn_spread[i] : way;
    aim[i] = asked[i] * std::clamp(wanted, static_cast<float>(-kFeatureClamp),
                                   static_cast<float>(kFeatureClamp));
  }
}

void PackedTile::AddPrediction(std::span<const float> past, float* x) const {
  const PackedFlow& flow = *flow_;
  for (int i = 0; i < flow.width; ++i) {
    float sum = x[i] * flow.drawn_spread[i];
    for (int t = 0; t < flow.config.history_frames; ++t)
      sum += flow.predict(i, t) * flow.Standard(past.data() + static_cast<long>(t) * flow.width, i);
    x[i] = sum;
  }
}

void PackedTile::Run(std::span<FlowRow> rows) {
  const PackedFlow& flow = *flow_;
  for (size_t i = 0; i < rows.size(); ++i) {
    FlowRow& row = rows[i];
    const std::span<float> noise(z_.Row(static_cast<long>(i)), static_cast<size_t>(flow.width));
    row.noise.Fill(noise);
    double squares = 0;
    for (const float value : noise) squares += static_cast<double>(value) * value;
    const double base = squares + std::log(2 * std::numbers::pi) * flow.width;
    row.log_likelihood = static_cast<float>(-0.5 * base) + flow.log_det;
  }
  Condition(rows);
  for (int step = flow.config.flow_steps - 1; step >= 0; --step) Couple(rows, step);
  for (size_t i = 0; i < rows.size(); ++i) {
    float* x = z_.Row(static_cast<long>(i));
    if (flow.config.innovations) AddPrediction(rows[i].past, x);
    *rows[i].log_likelihood += BendSurprise({x, static_cast<size_t>(flow.width)});
    flow.kernels.bend(x, flow.feature_mean.data(), flow.feature_std.data(), flow.width,
                      kSampleBound, rows[i].features.data());
  }
}

}  // namespace choreo
