#pragma once

#include <Eigen/Core>

#include "model/engine/packed_matrix.h"
#include "model/engine/packed_tensors.h"
#include "model/engine/step_engine.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// What plans leave open (model/flow/variety.h), sampled for one transition at a time without
/// LibTorch. Read only, thread-safe.
class PackedVariety {
 public:
  struct Scratch {
    RowBuffer noise, waves;
    RowBuffer difference;  ///< out: [frames, 3 + 3 joints] metres, radians; log(R_plan^T R)
  };

  /// Throws as PackedTensors does.
  PackedVariety(const PackedTensors& tensors, const Skeleton& skeleton, int components);

  /// False: nothing varies, there is no difference. `skipped`: noise of the first frame's own
  /// features, behind which the plan's lies.
  bool Sample(const TransitionSpec& spec, int skipped, Scratch* scratch) const;

 private:
  float Factor(const TransitionSpec& spec) const;

  Skeleton skeleton_;
  RowMajorMatrix basis_;      // [components, 3 + 3 joints]
  RowMajorMatrix spread_[2];  // [free, keyed][frequency bins, components] logarithms
  Eigen::Vector3f activity_[2];
};

}  // namespace choreo
