#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "model/core/random.h"

namespace choreo {

/// Which noise a frame has: whoever steps it draws it.
struct FrameNoise {
  uint64_t seed = 0;
  int64_t frame = 0;  ///< absolute
  uint32_t candidate = 0;
  float spread = 0;  ///< standard deviation: temperature applied
  int64_t like = 0;  ///< absolute: the frame that it comes back as, with so much `variation`
  double variation = 0;

  /// FillNormalLike's numbers times the spread.
  void Fill(std::span<float> out) const {
    if (spread == 0) {
      std::ranges::fill(out, 0.0F);
      return;
    }
    FillNormalLike(seed, candidate, frame, like, variation, out);
    for (float& value : out) value *= spread;
  }
};

/// One slot's share of a step of the flow: FlowModel::Step for one row.
struct FlowRow {
  int slot = 0;
  int frame = 0;                 ///< of the slot's transition
  std::span<const float> past;   ///< [tau, width] features in physical units, oldest first
  std::span<const float> audio;  ///< [tau + 1, audio_features] MFCC rows
  bool has_audio = false;        ///< false: `audio` is ignored
  FrameNoise noise;
  std::span<float> features;  ///< [width], written: physical units
  /// Written where there is an exact one: nats, standardised space.
  std::optional<float> log_likelihood = {};
};

/// The flow on one device, with recurrent state and condition of as many transitions as it has
/// slots. Not thread-safe.
class FlowTile {
 public:
  virtual ~FlowTile() = default;
  /// A transition starts in `slot`, with state zero. `conditions`: [width, frames] as KeyConditions
  /// has them.
  virtual void Begin(int slot, Eigen::MatrixXf conditions) = 0;
  /// Steps these rows together. What comes out for a row depends neither on its place nor on the
  /// other rows.
  virtual void Run(std::span<FlowRow> rows) = 0;
};

}  // namespace choreo
