#include "model/engine/packed_transformer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "model/engine/time_embedding.h"

namespace choreo {
namespace {

// As model/flow/planner.cpp has them; the parity test holds both together.
constexpr int kMaxDistance = 96;
constexpr int kEmbeddingWidth = 32;
constexpr float kVelocityScale = 8;

}  // namespace

PackedTransformer::PackedTransformer(const PackedTensors& tensors, int joints,
                                     const FlowConfig& config, const PackedKernels& kernels,
                                     const PackedKernels& products)
    : pose_mean(tensors.Get("planner.pose_mean", 3 + 6 * joints)),
      pose_std(tensors.Get("planner.pose_std", 3 + 6 * joints)),
      kernels_(kernels),
      width_(config.planner.width),
      heads_(config.planner.heads),
      tau_(config.history_frames),
      most_(config.history_frames + config.max_transition_frames),
      final_gain_(tensors.Get("planner.norm.weight", width_)),
      final_bias_(tensors.Get("planner.norm.bias", width_)),
      nothing_(Eigen::VectorXf::Zero(width_ + kernels.panel)) {
  const int pose = pose_width(), head_width = width_ / heads_;
  // A token: the pose, its step, the step that leaves the history, the key's mask, is-history,
  // is-key, frames since the start, frames left. The first two differ from frame to frame; the
  // counts are looked up.
  const long kinds = 3 * pose + joints + 1, counts = kinds + 2;
  const RowMajorMatrix token =
      tensors.Get("planner.embed.weight", width_, counts + 2 * kEmbeddingWidth).transpose();
  embed_ = {products, token.topRows(2 * pose), Eigen::VectorXf::Zero(width_)};
  embed_fixed_ = {products, token.middleRows(2 * pose, pose + joints + 1),
                  tensors.Get("planner.embed.bias", width_)};
  is_key_ = token.row(kinds + 1);
  since_ =
      TimeEmbeddings(-tau_, most_, kEmbeddingWidth) * token.middleRows(counts, kEmbeddingWidth);
  since_.topRows(tau_).rowwise() += token.row(kinds);
  left_ = TimeEmbeddings(0, most_, kEmbeddingWidth) * token.bottomRows(kEmbeddingWidth);

  for (int i = 0; i < config.planner.layers; ++i) {
    const std::string name = "planner.blocks." + std::to_string(i) + ".";
    const auto vector = [&](const char* part) { return tensors.Get(name + part, width_); };
    Block& block = blocks_.emplace_back();
    block.attention_gain = vector("attention_norm.weight");
    block.attention_bias = vector("attention_norm.bias");
    block.mlp_gain = vector("mlp_norm.weight");
    block.mlp_bias = vector("mlp_norm.bias");
    // The scale of attention's logits stands in the queries' weights.
    RowMajorMatrix qkv = tensors.Get(name + "qkv.weight", 3 * width_, width_).transpose();
    Eigen::VectorXf qkv_bias = tensors.Get(name + "qkv.bias", 3 * width_);
    const float scale = 1 / std::sqrt(static_cast<float>(head_width));
    qkv.leftCols(width_) *= scale;
    qkv_bias.head(width_) *= scale;
    block.qkv = {products, qkv, qkv_bias};
    block.out = tensors.Linear(products, name + "out", width_, width_);
    block.up = tensors.Linear(products, name + "up", width_, 2 * width_);
    block.down = tensors.Linear(products, name + "down", 2 * width_, width_);
    const auto table = tensors.Get(name + "distance_bias", 2 * kMaxDistance + 1, heads_);
    block.distance_bias.resize(heads_, 2 * most_ + kernels.panel);
    for (long at = 0; at < block.distance_bias.cols(); ++at) {
      const long distance = std::clamp<long>(at - most_, -kMaxDistance, kMaxDistance);
      block.distance_bias.col(at) = table.row(distance + kMaxDistance);
    }
  }
  head_ = tensors.Linear(kernels, "planner.head", width_, pose);
}

void PackedTransformer::Normalise(const Eigen::VectorXf& gain, const Eigen::VectorXf& bias,
                                  const RowBuffer& x, long from, long rows, float* out) const {
  for (long row = from; row < from + rows; ++row, out += width_) {
    kernels_.layer_norm(x.Row(row), gain.data(), bias.data(), width_, out);
  }
}

// Writes x: tokens behind their first layer.
void PackedTransformer::Embed(int frames, Scratch* s) const {
  const int time = tau_ + frames, pose = pose_width();
  const long asked = s->masks.stride();
  s->input.Resize(kSides * time, 2 * pose);
  s->fixed_input.Resize(kSides, pose + asked);
  for (int side = 0; side < kSides; ++side) {
    const long begin = static_cast<long>(side) * time;
    for (long row = begin; row < begin + time; ++row) {
      auto standard = s->input.Part(row, 0, pose), step = s->input.Part(row, pose, pose);
      standard =
          (s->poses.Part(row, 0, pose) - pose_mean.transpose()).cwiseQuotient(pose_std.transpose());
      if (row == begin) {
        step.setZero();
      } else {
        step = kVelocityScale * (standard - s->input.Part(row - 1, 0, pose));
      }
    }
    s->fixed_input.Part(side, 0, pose) = s->input.Part(begin + tau_ - 1, pose, pose);
    s->fixed_input.Part(side, pose, asked) = s->masks.Part(side, 0, asked);
  }
  s->fixed.Resize(kSides, embed_.padded());
  embed_fixed_.Run(s->fixed_input.Row(0), s->fixed_input.stride(), s->fixed.Row(0),
                   s->fixed.stride(), kSides);
  s->x.Resize(kSides * time, embed_.padded());
  for (int side = 0; side < kSides; ++side) {
    // Without a key nothing is awaited: the frames left must not matter.
    const float present = s->masks.Part(side, 0, asked).maxCoeff();
    const auto fixed = s->fixed.Part(side, 0, width_);
    const auto token = [&](int t) { return s->x.Part(side * time + t, 0, width_); };
    for (int t = 0; t < time; ++t) {
      token(t) = fixed + since_.row(t) + present * left_.row(time - 1 - t);
    }
    token(time - 1) += present * is_key_;
  }
  embed_.Add(s->input.Row(0), s->input.stride(), s->x.Row(0), s->x.stride(), kSides * time);
}

// From wide (queries, keys, values) to mixed, for the queries from `first` on of each side.
void PackedTransformer::Attend(const Block& block, int time, int first, Scratch* s) const {
  const long stride = block.qkv.padded(), panel = kernels_.panel, head_width = width_ / heads_;
  const long key_panels = (time + panel - 1) / panel;
  const long value_panels = (head_width + panel - 1) / panel;
  s->keys.Resize(key_panels * head_width, panel);
  s->values.Resize(value_panels * time, panel);
  s->scores.Resize(time, key_panels * panel);
  for (int side = 0; side < kSides; ++side) {
    for (int head = 0; head < heads_; ++head) {
      const float* query = s->wide.Row(side * time) + head * head_width;
      const float* key = query + width_;
      const float* value = key + width_;
      for (long at = 0; at < key_panels; ++at) {
        const long count = std::min(panel, time - at * panel);
        for (long i = 0; i < head_width; ++i) {
          float* out = s->keys.Row(at * head_width + i);
          for (long t = 0; t < count; ++t) out[t] = key[(at * panel + t) * stride + i];
          std::fill(out + count, out + panel, 0.0F);
        }
      }
      for (long at = 0; at < value_panels; ++at) {
        const long count = std::min(panel, head_width - at * panel);
        for (long t = 0; t < time; ++t) {
          float* out = s->values.Row(at * time + t);
          std::copy_n(value + t * stride + at * panel, count, out);
          std::fill(out + count, out + panel, 0.0F);
        }
      }
      kernels_.multiply({.a = query + first * stride,
                         .a_stride = stride,
                         .b = s->keys.Row(0),
                         .depth = head_width,
                         .panels = key_panels,
                         .init = block.distance_bias.row(head).data() + most_ - first,
                         .init_stride = -1,
                         .c = s->scores.Row(0),
                         .c_stride = s->scores.stride(),
                         .rows = time - first});
      for (int t = 0; t < time - first; ++t) kernels_.softmax(s->scores.Row(t), time);
      // What a head writes beyond its width, the next one overwrites.
      kernels_.multiply({.a = s->scores.Row(0),
                         .a_stride = s->scores.stride(),
                         .b = s->values.Row(0),
                         .depth = time,
                         .panels = value_panels,
                         .init = nothing_.data(),
                         .init_stride = 0,
                         .c = s->mixed.Row(side * time + first) + head * head_width,
                         .c_stride = s->mixed.stride(),
                         .rows = time - first});
    }
  }
}

void PackedTransformer::Run(int frames, Scratch* s) const {
  const int time = tau_ + frames;
  const long rows = static_cast<long>(kSides) * time;
  Embed(frames, s);
  s->normal.Resize(rows, width_);
  s->mixed.Resize(rows, width_ + kernels_.panel);
  for (const Block& block : blocks_) {
    Normalise(block.attention_gain, block.attention_bias, s->x, 0, rows, s->normal.Row(0));
    s->wide.Resize(rows, block.qkv.padded());
    block.qkv.Run(s->normal.Row(0), width_, s->wide.Row(0), s->wide.stride(), rows);
    // Behind the last block the history's tokens are of no use.
    const int first = &block == &blocks_.back() ? tau_ : 0;
    Attend(block, time, first, s);
    s->wide.Resize(time, block.up.padded());
    for (int side = 0; side < kSides; ++side) {
      const long from = static_cast<long>(side) * time + first, count = time - first;
      block.out.Accumulate(s->mixed.Row(from), s->mixed.stride(), s->x.Row(from), s->x.stride(),
                           count);
      Normalise(block.mlp_gain, block.mlp_bias, s->x, from, count, s->normal.Row(0));
      block.up.Run(s->normal.Row(0), width_, s->wide.Row(0), s->wide.stride(), count);
      kernels_.gelu(s->wide.Row(0), count * s->wide.stride());
      block.down.Accumulate(s->wide.Row(0), s->wide.stride(), s->x.Row(from), s->x.stride(), count);
    }
  }
  s->hidden.Resize(static_cast<long>(kSides) * frames, width_);
  s->residual.Resize(static_cast<long>(kSides) * frames, head_.padded());
  for (int side = 0; side < kSides; ++side) {
    Normalise(final_gain_, final_bias_, s->x, side * time + tau_, frames,
              s->hidden.Row(side * frames));
  }
  head_.Run(s->hidden.Row(0), width_, s->residual.Row(0), s->residual.stride(), kSides * frames);
}

}  // namespace choreo
