#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/engine/packed_transformer.h"
#include "model/engine/step_engine.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// What stands around the packed transformer (TransformerPlanner and Balanced of
/// model/flow/planner.cpp): the line that it bends, and how it is bent. Poses are 6D rotations
/// behind a root position; a transition and its mirror image are treated together. Read only,
/// thread-safe.
class PlanBender {
 public:
  struct Scratch {
    RowBuffer rotations;  ///< out: the first `frames` rows [6 joints], 6D and orthonormal
    RowBuffer positions;  ///< out: the first `frames` rows [3], metres
    RowBuffer smooth, along, bounded;
  };

  /// `root_turn` as in PlannerConfig.
  PlanBender(const Skeleton& skeleton, int history, double root_turn, const PackedKernels& kernels);

  /// Writes the network's poses: history, then the line from its last pose to the key, to which the
  /// root turns by `root_turn`; what the key does not name stays as it is. Reads the first row of
  /// the network's masks and writes the second, the mirror image's.
  void Interpolate(const TransitionSpec& spec, const Eigen::Vector3d& root_turn,
                   PackedTransformer::Scratch* network) const;
  /// Bends each side's line by the network's residual, in units of `pose_std`, and takes the mean
  /// of the two; where no root position is asked for, without its steady walk.
  void Bend(int frames, const PackedTransformer::Scratch& network, const Eigen::VectorXf& pose_std,
            Scratch* scratch) const;

 private:
  void Mirror(int rows, PackedTransformer::Scratch* network) const;

  int joints_, history_;
  float root_turn_;
  std::vector<int> pairs_;  // MirrorPairs
  const PackedKernels& kernels_;
};

}  // namespace choreo
