#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/engine/transition_spec.h"
#include "model/motion/velocity_factors.h"

namespace choreo {

/// How lively parts of the body should be, as a client says it.
struct VelocityRequest {
  /// Of each row, absolute, at the model's rate, ascending; between rows values are interpolated,
  /// outside the nearest holds. Empty: one row, which always holds.
  std::vector<int64_t> frames;
  std::vector<BodyPart> parts;  ///< of each column, none twice; empty: one column, for all parts
  /// [rows, columns], row by row: multipliers of the reference, 0 to kMaxVelocityFactor, or
  /// (absolute) velocity factors, metres a frame at the model's rate, 0 to kMaxVelocity.
  std::vector<float> values;
  bool absolute = false;
  std::string reference;  ///< one of the model's; empty: its first. Empty if absolute

  /// Throws Error(kInvalidArgument) below `field` for what is not as said above.
  void Validate(const ModelInfo& model, const std::string& field) const;

  bool Names(BodyPart part) const;
  /// The velocity factor that it asks of a part that it names, metres a frame. It must be valid.
  float At(int64_t frame, BodyPart part, const ModelInfo& model) const;
};

}  // namespace choreo
