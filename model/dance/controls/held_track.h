#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/core/field.h"
#include "model/dance/spec_poses.h"
#include "model/dance/validation.h"
#include "model/dance/warning.h"

namespace choreo {

/// A value that applies to transitions that begin at `from` or later. Copies share it.
template <typename What>
struct EffectiveFrom {
  int64_t from;
  std::shared_ptr<const What> what;
};

/// The frames that a control's request may change.
struct ChangedFrames {
  int64_t first = 0;
  int64_t last = std::numeric_limits<int64_t>::max();
};

/// A frame's place among a control's rows, which ascend: the row at or before it, and the share of
/// the way to the next row, 0 to 1. Before the first and after the last row, the nearest one
/// applies. Without frames there is one row for all.
struct RowPlace {
  size_t row = 0;
  float share = 0;
};
inline RowPlace PlaceAmong(const std::vector<int64_t>& frames, int64_t frame) {
  const auto after = static_cast<size_t>(std::ranges::upper_bound(frames, frame) - frames.begin());
  if (after == 0) return {};
  if (after == frames.size()) return {after - 1, 0};
  return {after - 1, static_cast<float>(frame - frames[after - 1]) /
                         static_cast<float>(frames[after] - frames[after - 1])};
}

/// Tracks a control whose request has `frames` and `values`. `values`, [rows, channels], are
/// interpolated between rows. Later requests override earlier ones.
template <typename Request>
class HeldTrack {
 public:
  /// Throws Error(kInvalidArgument) below `field` for frames that do not ascend, for values that
  /// are not finite, and for a wrong number of values. Controls::Check checks the lower limits.
  static void Validate(const Request& request, const ModelInfo& /*model*/,
                       const std::string& field) {
    ValidateFrames(request.frames, field + ".frames");
    if (!request.IsWhole()) throw InvalidArgument(field, "there must be a row of values per frame");
    for (size_t i = 0; i < request.values.size(); ++i) {
      if (!std::isfinite(request.values[i]))
        throw InvalidArgument(At(field + ".values", i), "is not finite");
    }
  }
  /// Changes all frames; before the first and after the last row, the nearest one applies.
  ChangedFrames Set(const Request& request, int64_t from) {
    requests_.push_back({from, std::make_shared<Request>(request)});
    return {};
  }

  /// Fills in the curve of the spec's controls.
  void Fill(const ModelInfo& /*model*/, const std::string& /*key_id*/, TransitionSpec* spec,
            ControlCurve* curve, std::vector<Warning>* /*warnings*/) const {
    const auto latest = std::find_if(requests_.rbegin(), requests_.rend(), [&](const auto& one) {
      return one.from <= spec->first_frame;
    });
    if (latest == requests_.rend()) return;
    const auto channels = static_cast<Eigen::Index>(curve->requested.size());
    const auto rows = Eigen::Map<const Eigen::MatrixXd>(
        latest->what->values.data(), channels, std::ssize(latest->what->values) / channels);
    curve->values.resize(channels, spec->frames);
    for (int i = 0; i < spec->frames; ++i) {
      const auto [row, share] = PlaceAmong(latest->what->frames, spec->first_frame + i);
      const auto at = static_cast<Eigen::Index>(row);
      curve->values.col(i) = rows.col(at);
      if (share > 0) curve->values.col(i) += double{share} * (rows.col(at + 1) - rows.col(at));
    }
  }

 private:
  std::vector<EffectiveFrom<Request>> requests_;
};

}  // namespace choreo
