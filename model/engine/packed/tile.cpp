#include "model/engine/packed/tile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "model/flow/flow_config.h"

namespace choreo {

PackedTile::PackedTile(std::shared_ptr<const PackedFlow> flow, int slots)
    : flow_(std::move(flow)), slots_(static_cast<size_t>(slots)) {
  const PackedFlow::Coupling& coupling = flow_->couplings.front();
  live_.Resize(kRows, std::max<long>(flow_->live, flow_->encode.padded()));
  encoding_.Resize(kRows, flow_->encode.padded());
  input_.Resize(kRows, flow_->input_width());
  wide_.Resize(kRows, coupling.first.padded());
  hidden_.Resize(kRows, 2 * flow_->hidden);
  ab_.Resize(kRows, coupling.last.padded());
  z_.Resize(kRows, coupling.unmix.padded());
  mixed_.Resize(kRows, coupling.unmix.padded());
}

void PackedTile::Begin(int slot_index, Eigen::MatrixXf conditions) {
  Slot& slot = slots_[static_cast<size_t>(slot_index)];
  const PackedFlow& flow = *flow_;
  if (flow.encoded) {
    Eigen::MatrixXf encoded(flow.encode_static.padded(), conditions.cols());
    flow.encode_static.Run(conditions.data(), conditions.rows(), encoded.data(), encoded.rows(),
                           conditions.cols());
    conditions = encoded.topRows(flow.static_width);
  }
  slot.static_condition.assign(conditions.data(), conditions.data() + conditions.size());
  slot.state.assign(static_cast<size_t>(flow_->state_width()), 0.0F);
  if (flow_->encoded) return;
  const long frames = static_cast<long>(slot.static_condition.size()) / flow_->static_width;
  slot.hoisted.resize(static_cast<size_t>(std::min(kAhead, frames) * flow_->hoisted_width()));
  Hoist(&slot, 0);
}

void PackedTile::Hoist(Slot* slot, long frame) {
  const long frames = static_cast<long>(slot->static_condition.size()) / flow_->static_width;
  slot->hoisted_from = frame;
  flow_->Hoist(slot->static_condition.data() + frame * flow_->static_width,
               std::min(kAhead, frames - frame), slot->hoisted.data());
}

// Writes `input_`'s condition columns. `z_` holds the noise.
void PackedTile::Condition(std::span<const FlowRow> rows) {
  const PackedFlow& flow = *flow_;
  const auto count = static_cast<long>(rows.size());
  const long past = flow.tau * flow.width;
  for (long i = 0; i < count; ++i) {
    const FlowRow& row = rows[static_cast<size_t>(i)];
    Slot& slot = slots_[static_cast<size_t>(row.slot)];
    if (!flow.encoded && row.frame >= slot.hoisted_from + kAhead) Hoist(&slot, row.frame);
    float* live = flow.encoded ? live_.Row(i) : input_.Row(i);
    flow.kernels.standardise(row.past.data(), flow.feature_mean.data(), flow.feature_scale.data(),
                             flow.width, flow.tau, kFeatureClamp, live);
    if (row.has_audio) {
      flow.kernels.standardise(row.audio.data(), flow.audio_mean.data(), flow.audio_scale.data(),
                               flow.audio_features, flow.tau + 1, kFeatureClamp, live + past);
    } else {
      std::fill(live + past, live + flow.live, 0.0F);
    }
    live[flow.live - 1] = row.has_audio ? 1.0F : 0.0F;
  }
  if (!flow.encoded) return;
  flow.encode_live.Run(live_, &encoding_, count);
  for (long i = 0; i < count; ++i) {
    const FlowRow& row = rows[static_cast<size_t>(i)];
    const Slot& slot = slots_[static_cast<size_t>(row.slot)];
    Eigen::Map<Eigen::VectorXf>(encoding_.Row(i), flow.condition) +=
        Eigen::Map<const Eigen::VectorXf>(
            slot.static_condition.data() + row.frame * flow.static_width, flow.static_width);
  }
  flow.kernels.silu(encoding_.Row(0), count * encoding_.stride());
  // live_ has done its part, and is wider.
  flow.encode.Run(encoding_, &live_, count);
  for (long i = 0; i < count; ++i) {
    flow.kernels.silu(live_.Row(i), flow.condition);
    std::copy_n(live_.Row(i), flow.condition, input_.Row(i));
  }
}

// From `input_` to `hidden_`, what the last layer sees.
void PackedTile::Hidden(std::span<const FlowRow> rows, int step) {
  const PackedFlow& flow = *flow_;
  const PackedFlow::Coupling& coupling = flow.couplings[static_cast<size_t>(step)];
  const auto count = static_cast<long>(rows.size());
  const long hidden = flow.hidden;
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
    rows[static_cast<size_t>(i)].log_likelihood += static_cast<float>(std::log(deltas));
  }
  coupling.unmix.Run(z_, &mixed_, count);
  std::swap(z_, mixed_);
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
  for (int step = flow.flow_steps - 1; step >= 0; --step) Couple(rows, step);
  for (size_t i = 0; i < rows.size(); ++i) {
    flow.kernels.bend(z_.Row(static_cast<long>(i)), flow.feature_mean.data(),
                      flow.feature_std.data(), flow.width, kSampleBound, rows[i].features.data());
  }
}

}  // namespace choreo
