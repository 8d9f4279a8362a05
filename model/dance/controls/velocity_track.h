#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/dance/controls/track_frames.h"
#include "model/dance/timeline/spec_poses.h"
#include "model/dance/timeline/warning.h"
#include "model/messages/quality_report.h"
#include "model/motion/controls/control_request.h"
#include "model/motion/controls/velocity_factors.h"

namespace choreo {

/// Tracks the requested speeds of body parts over one dance. Later requests override earlier ones
/// part by part. Parts and frames without a request use the model's first reference.
class VelocityTrack {
 public:
  /// Throws Error(kInvalidArgument) below `field` for wrong numbers of rows or columns, for factors
  /// outside [0, kMaxVelocityFactor] or speeds outside [0, kMaxVelocity], and for a reference that
  /// the model lacks.
  static void Check(const VelocityRequest& request, const ModelInfo& model,
                    const std::string& field);
  /// Changes all frames; before the first and after the last row, the nearest one applies.
  ChangedFrames Set(const VelocityRequest& request, int64_t from) {
    requests_.push_back({from, std::make_shared<VelocityRequest>(request)});
    return {};
  }

  /// Fills in the curve of the spec's controls.
  void Fill(const ModelInfo& model, const std::string& key_id, TransitionSpec* spec,
            ControlCurve* curve, std::vector<Warning>* warnings) const;
  /// A warning that names the body parts whose speed over the reported dance missed the requested
  /// one by more than 15 % and 1 mm per frame.
  std::optional<Warning> Missed(const QualityReport& report) const;

 private:
  std::vector<EffectiveFrom<VelocityRequest>> requests_;
};

}  // namespace choreo
