#pragma once

#include <memory>
#include <optional>

#include "model/engine/packed_transformer.h"
#include "model/engine/packed_variety.h"
#include "model/engine/plan_bender.h"
#include "model/engine/transition_planner.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// FlowModel::Begin on own kernels: interpolation, what the transformer adds to it and to its
/// mirror image, their mean, variety, and the hoisted condition. TorchPlanner is the reference that
/// it is held to. For every model but those with a recurrent planner.
///
/// A plan is a function of its spec: neither load nor thread changes a bit.
class PackedPlanner : public TransitionPlanner {
 public:
  static bool Serves(const FlowConfig& config) { return !config.planner.recurrent; }

  /// Throws as PackedTensors does. `products` as PackedTransformer has it.
  PackedPlanner(const Safetensors& content, const FlowConfig& config, const Skeleton& skeleton,
                const PackedKernels& kernels, const PackedKernels& products);

 private:
  TransitionPlan PlanTurning(const TransitionSpec& spec,
                             const Eigen::Vector3d& turn) const override;
  struct Scratch;
  void WritePoses(const TransitionSpec& spec, Scratch* s, std::vector<Pose>* poses) const;
  void WriteCondition(const TransitionSpec& spec, Scratch* s, std::vector<float>* condition) const;

  FlowConfig config_;
  int joints_, feature_width_;
  PlanBender bender_;
  std::optional<PackedTransformer> transformer_;
  std::optional<PackedVariety> variety_;
  RowMajorMatrix counts_;  // [frames, feature_width_] embeddings; encoded: behind encode_static
  PackedLinear encode_key_, encode_hidden_;
};

}  // namespace choreo
