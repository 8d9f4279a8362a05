#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/core/error.h"
#include "model/engine/step_engine.h"

namespace choreo {

/// An engine that keeps in each slot a `Transition`, made when its admission begins and gone when
/// it is released; its `SlotProgress progress() const` says how far it is. Here stands who has
/// which slot and what is refused; subclasses begin transitions and step them.
template <typename Transition>
class SlotEngine : public StepEngine {
 public:
  const ModelInfo& model() const final { return info_; }
  std::string device() const final { return device_; }
  int slots() const final { return static_cast<int>(slots_.size()); }
  int free_slots() const final {
    return static_cast<int>(std::ranges::count(slots_, false, kTaken));
  }

  int BeginAdmission(const TransitionSpec& spec) final {
    ValidateSpec(spec, info_);
    const auto free = std::ranges::find(slots_, false, kTaken);
    if (free == slots_.end()) {
      throw Error(ErrorCode::kResourceExhausted, "",
                  "all " + std::to_string(slots_.size()) + " slots are taken");
    }
    const int slot = static_cast<int>(free - slots_.begin());
    free->emplace(Begin(spec, slot));
    return slot;
  }

  bool ContinueAdmission(int slot) final { return Continue(*slots_[static_cast<size_t>(slot)]); }

  void Step(std::span<const StepInput> in, std::span<StepOutput> out) final {
    if (in.size() != out.size()) {
      throw InvalidArgument("out", std::to_string(out.size()) + " outputs for " +
                                       std::to_string(in.size()) + " inputs");
    }
    for (const StepInput& input : in) ValidateStep(input, ProgressOf(input.slot), info_);
    StepSlots(in, out);
  }

  void Release(int slot) noexcept final { slots_[static_cast<size_t>(slot)].reset(); }

 protected:
  SlotEngine(ModelInfo info, std::string device, int slots)
      : info_(std::move(info)), device_(std::move(device)), slots_(static_cast<size_t>(slots)) {}

  /// The spec is valid.
  virtual Transition Begin(const TransitionSpec& spec, int slot) = 0;
  /// As ContinueAdmission: of those who begin a transition at once, nothing is left.
  virtual bool Continue(Transition& /*transition*/) { return false; }
  /// So are the inputs, as many as outputs.
  virtual void StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) = 0;

  Transition& At(const StepInput& input) { return *slots_[static_cast<size_t>(input.slot)]; }

 private:
  static constexpr auto kTaken = &std::optional<Transition>::has_value;

  std::optional<SlotProgress> ProgressOf(int slot) const {
    if (slot < 0 || slot >= slots() || !slots_[static_cast<size_t>(slot)]) return std::nullopt;
    return slots_[static_cast<size_t>(slot)]->progress();
  }

  ModelInfo info_;
  std::string device_;
  std::vector<std::optional<Transition>> slots_;
};

}  // namespace choreo
