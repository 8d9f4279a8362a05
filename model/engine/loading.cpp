#include "model/engine/loading.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "model/core/error.h"
#include "model/core/numbers/math_library.h"
#include "model/engine/packed/matrix.h"

namespace choreo {
namespace {

// The kernel sets of this machine and this engine, fastest first.
std::vector<KernelSet> KernelSetsHere(EngineKind kind) {
  std::vector<KernelSet> sets;
  if (kind != EngineKind::kPacked) {
    for (const PackedKernels* bf16 : Bf16KernelsHere())
      sets.push_back({PackedKernelsHere().front(), bf16});
  }
  if (kind == EngineKind::kPackedBf16) return sets;
  for (const PackedKernels* kernels : PackedKernelsHere()) sets.push_back({kernels, kernels});
  return sets;
}

}  // namespace

KernelSet FirstIndependent(const std::vector<KernelSet>& sets, std::vector<std::string>* notes) {
  for (const KernelSet& set : sets) {
    if (RowsAreIndependent(*set.exact) && RowsAreIndependent(*set.products)) return set;
    if (notes) {
      notes->push_back("with " + std::string(set.products->name) +
                       " a row's bits depend on its batch; slower kernels replace them");
    }
  }
  throw Error(ErrorCode::kInternal, "", "no kernel of the packed engine keeps rows apart here");
}

std::optional<KernelSet> ChooseKernels(const EngineRequest& request) {
  const Device& device = request.device;
  const EngineKind kind = request.kind;
  const std::string& name = request.kernels;
  const bool on_cpu = device.kind == Device::Kind::kCpu;
  if (kind == EngineKind::kTorch || (kind == EngineKind::kAuto && !on_cpu)) return std::nullopt;
  if (!on_cpu)
    throw InvalidArgument("engine", "packed computes on the CPU, not on " + device.name());
  const std::vector<KernelSet> here = KernelSetsHere(kind);
  if (here.empty()) {
    throw InvalidArgument("engine", "packed-bf16 needs a CPU with AVX512-BF16, which this is not");
  }
  std::string known;
  std::vector<KernelSet> named;
  for (const KernelSet& set : here) {
    known += (known.empty() ? "" : ", ") + std::string(set.products->name);
    if (name.empty() || name == set.products->name) named.push_back(set);
  }
  if (named.empty()) throw InvalidArgument("kernels", '"' + name + "\" is none of " + known);
  return FirstIndependent(named, request.notes);
}

std::string FingerprintOf(const std::string& name, const std::string& hash,
                          const UsedKernels& kernels) {
  return name + "/" + hash + "/choreo " CHOREO_VERSION + ", " + BuildIdentity() + ", " +
         MathLibrary() + "/" +
         (kernels.packed.empty() ? kernels.torch : "packed " + kernels.packed);
}

std::string LicenceOf(const std::string& card) {
  const auto json = nlohmann::json::parse(card, nullptr, /*allow_exceptions=*/false);
  return json.is_object() ? json.value("licence", "") : "";
}

VelocityReference MedianReference(const std::array<double, kBodyParts>& speeds) {
  VelocityReference median{.name = "median"};
  std::ranges::copy(speeds, median.speeds.begin());
  return median;
}

}  // namespace choreo
