#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "model/engine/engine_choice.h"
#include "model/engine/packed/kernels.h"
#include "model/engine/sampler.h"

/// What every kind of model is made into samplers with, whatever network it is. Free of torch.
namespace choreo {

/// What this program was built from, as in "GNU 12.2.0 Release 0123456789abcdef": compiler, build
/// type, and a hash of its flags, of Eigen's version, of whether sources were compiled together,
/// and of every source that can change a bit of a dance. Builds of the same sources have the same,
/// wherever they were made. cmake/write_build_identity.cmake makes it.
const char* BuildIdentity();

/// Makes samplers that share one device's weights.
using SamplerFactory = std::function<std::unique_ptr<Sampler>()>;

/// Where and by which code a model is to be computed.
struct EngineRequest {
  Device device;
  EngineKind kind = EngineKind::kAuto;
  std::string kernels;  ///< a PackedKernels::name; empty: the fastest here
};

/// Of the kernels in a fingerprint, where they are our own.
inline constexpr const char* kPackedPrefix = "packed ";

struct KernelSet {
  const PackedKernels* exact;
  /// Of the networks: the exact ones, or those of bfloat16, whose dances have the same figures
  /// (docs/decisions.md, 32).
  const PackedKernels* products;

  std::string Name() const { return kPackedPrefix + std::string(products->name); }
};

/// What a flow is computed with: the fastest that keep rows apart, or those that are asked for by
/// name. None: LibTorch does it. Throws Error(kInvalidArgument) for a kind or kernels that the
/// device or this machine does not have.
std::optional<KernelSet> ChooseKernels(const EngineRequest& request);

/// What names model, weights, build and kernels: the same where every bit is.
std::string FingerprintOf(const std::string& name, const std::string& hash,
                          const std::string& kernels);
/// What a model card states; empty: nothing.
std::string LicenceOf(const std::string& card);

/// What is the same of every checkpoint (CheckpointOf, model/flow/checkpoint.h).
template <typename Checkpoint>
ModelInfo InfoOf(const Checkpoint& checkpoint, const std::string& kernels) {
  const auto& config = checkpoint.model->config();
  return {.name = config.name,
          .fingerprint = FingerprintOf(config.name, checkpoint.hash, kernels),
          .licence = LicenceOf(checkpoint.card),
          .card = checkpoint.card,
          .skeleton = checkpoint.model->skeleton(),
          .history_frames = config.history_frames,
          .max_transition_frames = config.max_transition_frames,
          .velocity_references = {}};
}

/// The velocity reference that every model has that takes factors.
VelocityReference MedianReference(const std::array<double, kBodyParts>& factors);

}  // namespace choreo
