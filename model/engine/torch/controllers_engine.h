#pragma once

#include <optional>

#include "model/controllers/controllers_model.h"
#include "model/engine/slot_engine.h"
#include "model/fit/position_fitter.h"

namespace choreo {

/// A transition that the controllers network walks.
struct WalkedTransition {
  WalkedTransition(const ModelInfo& model, int frames);
  SlotProgress progress() const { return {frame, frames, false}; }

  int frames, frame = 0;
  ControlledGiven given;
  ControllersState state;
  FrameTensors walked;     ///< the lead frames before `frame`
  torch::Tensor contacts;  ///< that the network named for the last frame, [1, 1, 4]
  Pose before, last;       ///< the two emitted before `frame`
  std::optional<Pose> target;
  PositionFitter fitter;
};

/// The controllers network (model/controllers) in slots. Slots step one after another, so a row's
/// bits cannot depend on its neighbours. It is deterministic: seed, candidate and temperature
/// change nothing, and it hears no music. Made by engines.h.
class ControllersEngine : public SlotEngine<WalkedTransition> {
 public:
  ControllersEngine(ModelInfo info, int slots, ControllersModel network);

 protected:
  WalkedTransition Begin(const TransitionSpec& spec, int slot) override;
  void StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) override;

 private:
  void StepOne(WalkedTransition* transition, const Pose* previous, StepOutput* out);

  ControllersModel network_;
};

}  // namespace choreo
