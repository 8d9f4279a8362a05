#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/engine/engine_choice.h"
#include "model/engine/packed/kernels.h"
#include "model/plan/sampler.h"

/// Makes samplers for any kind of model. Independent of torch.
namespace choreo {

/// The build's identity, such as "GNU 12.2.0 Release 0123456789abcdef": compiler, build type, and a
/// hash over flags, Eigen's version, the unity setting, and every source that can change a dance's
/// bits. Builds of the same sources have the same identity, wherever they were made.
/// cmake/write_build_identity.cmake generates it.
const char* BuildIdentity();

/// Makes samplers that share their weights on one device.
using SamplerFactory = std::function<std::unique_ptr<Sampler>()>;

/// The device and code that compute a model.
struct EngineRequest {
  Device device;
  EngineKind kind = EngineKind::kAuto;
  std::string kernels;                        ///< a PackedKernels::name; empty: the fastest here
  std::vector<std::string>* notes = nullptr;  ///< of FirstIndependent
};

struct KernelSet {
  const PackedKernels* exact;
  /// The kernels for the networks' products: float32, or bfloat16, whose dances have the same
  /// quality figures (docs/decisions.md, 32).
  const PackedKernels* products;
};

/// The first of these kernel sets that keeps rows independent. `notes`, if given, receives a line
/// for each set that does not.
KernelSet FirstIndependent(const std::vector<KernelSet>& sets,
                           std::vector<std::string>* notes = nullptr);

/// The code that computes a model; exactly one field is set.
struct UsedKernels {
  std::string packed = {};  ///< PackedKernels::name
  std::string torch = {};   ///< TorchKernels (model/flow/network/torch_kernels.h)
};

/// The kernels for a flow: the fastest that keep rows independent, or the requested ones. None:
/// LibTorch computes the flow. Throws Error(kInvalidArgument) for a kind or kernels that the device
/// or machine lacks.
std::optional<KernelSet> ChooseKernels(const EngineRequest& request);

/// The fingerprint of model, weights, build and kernels. Equal exactly if every bit is.
std::string FingerprintOf(const std::string& name, const std::string& hash,
                          const UsedKernels& kernels);
/// The licence stated in a model card, or "".
std::string LicenceOf(const std::string& card);

/// The common part of all checkpoints (CheckpointOf, model/flow/checkpoint/checkpoint.h).
template <typename Checkpoint>
ModelInfo InfoOf(const Checkpoint& checkpoint, const UsedKernels& kernels) {
  const auto& config = checkpoint.model->config();
  ModelInfo info;
  info.name = config.name;
  info.fingerprint = FingerprintOf(config.name, checkpoint.hash, kernels);
  info.weights = checkpoint.hash;
  info.packed_kernels = kernels.packed;
  info.licence = LicenceOf(checkpoint.card);
  info.card = checkpoint.card;
  info.skeleton = checkpoint.model->skeleton();
  info.history_frames = config.history_frames;
  info.max_transition_frames = config.max_transition_frames;
  return info;
}

/// The velocity reference "median", which every model with velocity factors has.
VelocityReference MedianReference(const std::array<double, kBodyParts>& speeds);

}  // namespace choreo
