#include "model/engine/packed/flow.h"

#include <Eigen/LU>
#include <algorithm>
#include <string>

#include "model/flow/key_condition.h"
#include "model/motion/pose_codec.h"

namespace choreo {
namespace {

using Matrix = RowMajorMatrix;

// Rows of what comes in and of its own hidden state on top of each other, biases summed: one
// product.
PackedLinear SecondLayer(const PackedKernels& kernels, const PackedTensors& tensors,
                         const std::string& lstm, long hidden) {
  Matrix weight(2 * hidden, 4 * hidden);
  weight << tensors.Get(lstm + "weight_ih_l1", 4 * hidden, hidden).transpose(),
      tensors.Get(lstm + "weight_hh_l1", 4 * hidden, hidden).transpose();
  return {
      kernels, weight,
      tensors.Get(lstm + "bias_ih_l1", 4 * hidden) + tensors.Get(lstm + "bias_hh_l1", 4 * hidden)};
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

// The condition's columns come behind z_lo in checkpoints, the static ones last. Here the live ones
// come first and the static ones leave.
struct FirstLayer {
  Matrix live_and_low;  // [live + low, out]
  Matrix fixed;         // [static, out]
};
FirstLayer Split(const Eigen::Map<const Matrix>& weight, long low, long live) {
  const long fixed = weight.cols() - low - live;
  FirstLayer parts{Matrix(live + low, weight.rows()), weight.rightCols(fixed).transpose()};
  parts.live_and_low << weight.middleCols(low, live).transpose(), weight.leftCols(low).transpose();
  return parts;
}

}  // namespace

PackedFlow::PackedFlow(const Safetensors& content, const FlowConfig& config,
                       const Skeleton& skeleton, const PackedKernels& with,
                       const PackedKernels& products)
    : kernels(with),
      width(PoseCodec(skeleton).width()),
      tau(config.history_frames),
      audio_features(config.audio_features),
      flow_steps(config.flow_steps),
      hidden(config.hidden),
      encoded(config.condition_width > 0),
      live(tau * width + config.HeardWidth() + 1),
      condition(encoded ? config.condition_width : live),
      key_width(KeyConditionWidth(skeleton.joints(), width)) {
  const PackedTensors tensors(content);
  feature_mean = tensors.Get("feature_mean", width);
  feature_std = tensors.Get("feature_std", width);
  feature_scale = feature_std.cwiseInverse();
  audio_mean = tensors.Get("audio_mean", audio_features);
  audio_scale = tensors.Get("audio_std", audio_features).cwiseInverse();

  if (encoded) {
    static_width = condition;
    encode_static = tensors.Linear(kernels, "encode_static", key_width, condition);
    const long past = tau * width, audio = live - past;
    Matrix weight(live, condition);
    weight << tensors.Get("encode_past.weight", condition, past).transpose(),
        tensors.Get("encode_audio.weight", condition, audio).transpose();
    encode_live = PackedLinear(
        products, weight,
        tensors.Get("encode_past.bias", condition) + tensors.Get("encode_audio.bias", condition));
    encode = tensors.Linear(products, "encode", condition, condition);
  } else {
    static_width = key_width;
  }

  double log_det_sum = 0;
  for (int k = 0; k < flow_steps; ++k) {
    const std::string name = "flow.steps." + std::to_string(k) + ".";
    const std::string network = name + "network.lstm.";
    const int seen = low() + condition + (encoded ? 0 : static_width);
    const FirstLayer parts =
        Split(tensors.Get(network + "weight_ih_l0", gates(), seen), low(), condition);
    Coupling& coupling = couplings.emplace_back();
    Matrix weight(input_width(), gates());
    weight << parts.live_and_low,
        tensors.Get(network + "weight_hh_l0", gates(), hidden).transpose();
    const Eigen::VectorXf bias =
        tensors.Get(network + "bias_ih_l0", gates()) + tensors.Get(network + "bias_hh_l0", gates());
    coupling.first = PackedLinear(products, weight, bias);
    coupling.second = SecondLayer(products, tensors, network, hidden);
    if (!encoded) hoisted_.emplace_back(products, parts.fixed, bias);
    coupling.last = tensors.Linear(products, name + "network.last", hidden, 2 * high());
    coupling.unmix = Unmix(kernels, tensors, name, width);
    log_det_sum += tensors.Get(name + "norm_log_scale", width).cast<double>().sum() +
                   tensors.Get(name + "log_diagonal", width).cast<double>().sum();
  }
  log_det = static_cast<float>(log_det_sum);
}

void PackedFlow::Hoist(const float* static_condition, long rows, float* hoisted) const {
  const long stride = hoisted_width();
  for (const PackedLinear& fixed : hoisted_) {
    fixed.Run(static_condition, static_width, hoisted, stride, rows);
    hoisted += fixed.padded();
  }
}

}  // namespace choreo
