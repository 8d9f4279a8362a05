#include "model/engine/packed/packed_flow_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "model/flow/window/flow_tokens.h"

namespace choreo {
namespace {

long RoundUp(long count, long unit) { return (count + unit - 1) / unit * unit; }

// Maps columns to columns.
Eigen::MatrixXf Run(const PackedLinear& linear, const Eigen::MatrixXf& x) {
  Eigen::MatrixXf y(linear.padded(), x.cols());
  linear.Run(x.data(), x.rows(), y.data(), y.rows(), x.cols());
  return y.topRows(linear.columns());
}

}  // namespace

struct PackedFlowNetwork::Workspace {
  RowBuffer x;             // [tokens, width], the residual stream
  RowBuffer normal;        // normalised, shifted and scaled
  RowBuffer qkv;           // [tokens, 3 width]
  RowBuffer keys, values;  // of one head, laid out for products
  RowBuffer shares;        // [tokens, tokens] of one head's attention
  RowBuffer mixed;         // [tokens, width] plus a panel for the last head to write into
  RowBuffer added;         // [tokens, width], the output of a half block
  RowBuffer wide;          // [tokens, kMlpRatio width]
};

PackedFlowNetwork::PackedFlowNetwork(const Safetensors& content, const ContinuousFlowConfig& config,
                                     const Skeleton& skeleton, const PackedKernels& kernels,
                                     const PackedKernels& products)
    : kernels_(kernels),
      width_(config.width),
      heads_(config.heads),
      most_tokens_((config.history_frames + config.window_frames + kFramesAToken - 1) /
                   kFramesAToken) {
  const PackedTensors tensors(content);
  const int dimensions = 3 + 3 * skeleton.joints(), condition = config.condition;
  spread_ = tensors.Get("spread", dimensions);
  velocity_ = tensors.Get("velocity_spread", dimensions);
  const auto linear = [&](const PackedKernels& by, const std::string& name, long in, long out) {
    return tensors.Linear(by, name, in, out);
  };
  embed_ = linear(kernels, "embed", kFramesAToken * TokenFrameWidth(dimensions, FrameFeatures()),
                  width_);
  inject_ = linear(kernels, "inject", condition, width_);
  condition_in_ =
      linear(kernels, "condition_in", WholeFeatures(skeleton, config) + kFlowTimeWidth, width_);
  condition_out_ = linear(kernels, "condition_out", width_, condition);
  head_ = linear(kernels, "head", width_, 2L * kFramesAToken * dimensions);
  head_modulation_ = linear(kernels, "head_modulation", condition, 2 * width_);
  for (int i = 0; i < config.layers; ++i) {
    const std::string name = "blocks." + std::to_string(i) + ".";
    Block block{.qkv = linear(products, name + "qkv", width_, 3 * width_),
                .out = linear(products, name + "out", width_, width_),
                .up = linear(products, name + "up", width_, kMlpRatio * width_),
                .down = linear(products, name + "down", kMlpRatio * width_, width_),
                .modulation = linear(products, name + "modulation", condition, 6 * width_),
                .bias = {}};
    const auto bias = tensors.Get(name + "distance_bias", 2 * kMaxTokensApart + 1, heads_);
    block.bias.resize(heads_, 2 * most_tokens_ + kernels.panel);
    for (long at = 0; at < block.bias.cols(); ++at) {
      const long ahead = std::clamp<long>(at - most_tokens_, -kMaxTokensApart, kMaxTokensApart);
      block.bias.col(at) = bias.row(ahead + kMaxTokensApart).transpose();
    }
    blocks_.push_back(std::move(block));
  }
}

// Computes for each time in turn the blocks' modulations, the head's, and the offset of embedded
// tokens. Computes all times together, so that weights are read once.
Eigen::MatrixXf PackedFlowNetwork::Condition(const Eigen::VectorXf& whole,
                                             std::span<const float> times) const {
  Eigen::MatrixXf known(whole.size() + kFlowTimeWidth, std::ssize(times));
  known.topRows(whole.size()).colwise() = whole;
  for (size_t i = 0; i < times.size(); ++i) {
    float* column = known.col(static_cast<Eigen::Index>(i)).data();
    EmbedFlowTime(times[i], {column + whole.size(), size_t{kFlowTimeWidth}});
  }
  Eigen::MatrixXf hidden = Run(condition_in_, known);
  kernels_.silu(hidden.data(), hidden.size());
  Eigen::MatrixXf condition = Run(condition_out_, hidden);
  kernels_.silu(condition.data(), condition.size());
  Eigen::MatrixXf all((6 * std::ssize(blocks_) + 3) * width_, std::ssize(times));
  Eigen::Index row = 0;
  const auto add = [&](const PackedLinear& linear) {
    all.middleRows(row, linear.columns()) = Run(linear, condition);
    row += linear.columns();
  };
  for (const Block& block : blocks_) add(block.modulation);
  add(head_modulation_);
  add(inject_);
  return all;
}

void PackedFlowNetwork::Normalise(const RowBuffer& x, const float* shift, const float* scale,
                                  Range rows, RowBuffer* out) const {
  const Eigen::VectorXf gain = Eigen::Map<const Eigen::VectorXf>(scale, width_).array() + 1;
  for (long i = rows.first; i < rows.end; ++i)
    kernels_.layer_norm(x.Row(i), gain.data(), shift, width_, out->Row(i));
}

void PackedFlowNetwork::Attend(const Block& block, Range read, Workspace* work) const {
  const long panel = kernels_.panel, head = width_ / heads_;
  const long first = read.first, tokens = read.end;
  const long key_panels = RoundUp(tokens, panel) / panel;
  const long value_panels = RoundUp(head, panel) / panel;
  const float scale = 1 / std::sqrt(static_cast<float>(head));
  work->keys.Resize(1, key_panels * panel * head);
  work->values.Resize(1, value_panels * panel * tokens);
  work->shares.Resize(tokens, key_panels * panel);
  for (long h = 0; h < heads_; ++h) {
    // Padding beyond tokens and heads is multiplied but never read.
    for (long i = 0; i < tokens; ++i) {
      const float* key = work->qkv.Row(i) + width_ + h * head;
      float* out = work->keys.Row(0) + i / panel * panel * head + i % panel;
      for (long d = 0; d < head; ++d) out[d * panel] = scale * key[d];
      const float* value = work->qkv.Row(i) + 2 * width_ + h * head;
      for (long v = 0; v < value_panels; ++v) {
        std::copy_n(value + v * panel, std::min(panel, head - v * panel),
                    work->values.Row(0) + (v * tokens + i) * panel);
      }
    }
    kernels_.multiply({.a = work->qkv.Row(first) + h * head,
                       .a_stride = work->qkv.stride(),
                       .b = work->keys.Row(0),
                       .depth = head,
                       .panels = key_panels,
                       // All others are i tokens further back relative to token i.
                       .init = block.bias.row(h).data() + most_tokens_ - first,
                       .init_stride = -1,
                       .c = work->shares.Row(first),
                       .c_stride = work->shares.stride(),
                       .rows = tokens - first});
    for (long i = first; i < tokens; ++i) kernels_.softmax(work->shares.Row(i), tokens);
    for (long i = first; i < tokens; ++i)
      std::fill_n(work->mixed.Row(i) + h * head, value_panels * panel, 0.0F);
    kernels_.multiply({.a = work->shares.Row(first),
                       .a_stride = work->shares.stride(),
                       .b = work->values.Row(0),
                       .depth = tokens,
                       .panels = value_panels,
                       .init = work->mixed.Row(first) + h * head,
                       .init_stride = work->mixed.stride(),
                       .c = work->mixed.Row(first) + h * head,
                       .c_stride = work->mixed.stride(),
                       .rows = tokens - first});
  }
}

void PackedFlowNetwork::Transform(const Block& block, const float* modulation, Range read,
                                  Workspace* work) const {
  const auto part = [&](int i) { return modulation + i * width_; };
  const auto add = [&](const float* weight) {
    const Eigen::Map<const Eigen::RowVectorXf> by(weight, width_);
    for (long i = read.first; i < read.end; ++i)
      work->x.Head(i, width_).array() += (1 + by.array()) * work->added.Head(i, width_).array();
  };
  Normalise(work->x, part(1), part(0), {0, read.end}, &work->normal);
  block.qkv.Run(work->normal, &work->qkv, read.end);
  Attend(block, read, work);
  block.out.Run(work->mixed, &work->added, read.first, read.end);
  add(part(2));
  Normalise(work->x, part(4), part(3), read, &work->normal);
  block.up.Run(work->normal, &work->wide, read.first, read.end);
  for (long i = read.first; i < read.end; ++i) kernels_.gelu(work->wide.Row(i), kMlpRatio * width_);
  block.down.Run(work->wide, &work->added, read.first, read.end);
  add(part(5));
}

Eigen::MatrixXf PackedFlowNetwork::Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                                            const Eigen::MatrixXf& joints,
                                            const Eigen::MatrixXf& mean,
                                            const Eigen::MatrixXf& frames,
                                            const Eigen::VectorXf& condition) const {
  thread_local Workspace work;
  const Eigen::MatrixXf seen = FlowTokens(z, poses, joints, mean, frames, spread_, velocity_);
  const long tokens = seen.cols() / kFramesAToken, token = kFramesAToken * seen.rows();
  const long panel = kernels_.panel, padded = RoundUp(width_, panel);
  for (RowBuffer* buffer : {&work.x, &work.normal, &work.added}) buffer->Resize(tokens, padded);
  work.qkv.Resize(tokens, RoundUp(3 * width_, panel));
  work.wide.Resize(tokens, RoundUp(kMlpRatio * width_, panel));
  work.mixed.Resize(tokens, width_ + panel);

  embed_.Run(seen.data(), token, work.x.Row(0), work.x.stride(), tokens);
  for (long i = 0; i < tokens; ++i) work.x.Head(i, width_) += condition.tail(width_).transpose();
  const float* modulation = condition.data();
  // Nothing reads the last block's output for the history.
  const Range window{(seen.cols() - z.cols()) / kFramesAToken, tokens};
  for (const Block& block : blocks_) {
    Transform(block, modulation, &block == &blocks_.back() ? window : Range{0, tokens}, &work);
    modulation += 6 * width_;
  }
  Normalise(work.x, modulation + width_, modulation, window, &work.normal);
  const long read = window.end - window.first;
  Eigen::MatrixXf out(head_.padded(), read);
  head_.Run(work.normal.Row(window.first), work.normal.stride(), out.data(), out.rows(), read);
  // A token has two frames; a frame has an offset and a factor for z.
  Eigen::MatrixXf f(z.rows(), z.cols());
  const long before = kFramesAToken * read - z.cols();
  for (long i = 0; i < z.cols(); ++i) {
    const long frame = before + i;
    const Eigen::Map<const Eigen::MatrixXf> pair(
        out.col(frame / kFramesAToken).data() + frame % kFramesAToken * 2 * z.rows(), z.rows(), 2);
    f.col(i) = pair.col(0) + pair.col(1).cwiseProduct(z.col(i));
  }
  return f;
}

}  // namespace choreo
