#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "model/engine/engine_choice.h"
#include "model/engine/packed/kernels.h"
#include "model/plan/sampler.h"

/// Makes samplers of any kind of model. Free of torch.
namespace choreo {

/// The build's identity, such as "GNU 12.2.0 Release 0123456789abcdef": compiler, build type, and a
/// hash of its flags, Eigen's version, the unity setting, and every source that can change a
/// dance's bits. Builds of the same sources agree, wherever they were made.
/// cmake/write_build_identity.cmake makes it.
const char* BuildIdentity();

/// Makes samplers that share one device's weights.
using SamplerFactory = std::function<std::unique_ptr<Sampler>()>;

/// The device and code that compute a model.
struct EngineRequest {
  Device device;
  EngineKind kind = EngineKind::kAuto;
  std::string kernels;  ///< a PackedKernels::name; empty: the fastest here
};

struct KernelSet {
  const PackedKernels* exact;
  /// The kernels for the networks' products: exact ones, or those of bfloat16, whose dances have
  /// the same figures (docs/decisions.md, 32).
  const PackedKernels* products;
};

/// The code that computes a model: one of the two.
struct UsedKernels {
  std::string packed = {};  ///< PackedKernels::name
  std::string torch = {};   ///< TorchKernels (model/flow/torch_kernels.h)
};

/// The kernels for a flow: the fastest that keep rows independent, or the requested ones. None:
/// LibTorch computes it. Throws Error(kInvalidArgument) for a kind or kernels that the device or
/// machine lacks.
std::optional<KernelSet> ChooseKernels(const EngineRequest& request);

/// Identifies model, weights, build and kernels: equal exactly if every bit is.
std::string FingerprintOf(const std::string& name, const std::string& hash,
                          const UsedKernels& kernels);
/// The licence in a model card, or "".
std::string LicenceOf(const std::string& card);

/// The common part of all checkpoints (CheckpointOf, model/flow/checkpoint.h).
template <typename Checkpoint>
ModelInfo InfoOf(const Checkpoint& checkpoint, const UsedKernels& kernels) {
  const auto& config = checkpoint.model->config();
  return {.name = config.name,
          .fingerprint = FingerprintOf(config.name, checkpoint.hash, kernels),
          .weights = checkpoint.hash,
          .packed_kernels = kernels.packed,
          .licence = LicenceOf(checkpoint.card),
          .card = checkpoint.card,
          .skeleton = checkpoint.model->skeleton(),
          .history_frames = config.history_frames,
          .max_transition_frames = config.max_transition_frames,
          .velocity_references = {}};
}

/// The velocity reference of every model that takes velocity factors.
VelocityReference MedianReference(const std::array<double, kBodyParts>& speeds);

}  // namespace choreo
