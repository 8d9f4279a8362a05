#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "model/dance/transition.h"

namespace choreo {

/// One transition to dance, and what it hears.
struct TransitionInput {
  TransitionRequest request;
  Eigen::MatrixXf audio_rows;  ///< [audio_features, frames]; unread without audio
  /// Of the request's frames those before it are danced, at least one; none: all.
  std::optional<int> stop = {};
};

/// How it came out.
struct TransitionResult {
  std::vector<DanceFrame> frames;
  std::optional<ArrivalResult> arrival;             ///< none without a target
  Eigen::Vector3d stage = Eigen::Vector3d::Zero();  ///< TransitionRun::stage at the end
};

/// Dances many transitions as the server does, all slots of the engine together, which costs a
/// fraction of one after the other and gives the same bits. Results come in the same order.
/// `danced` is told how many frames each step made. Throws Error(kInvalidArgument) for a request or
/// rows of the wrong shape; then every slot is free again.
std::vector<TransitionResult> DanceTransitions(StepEngine& engine,
                                               std::span<const TransitionInput> transitions,
                                               const std::function<void(int)>& danced = {});

}  // namespace choreo
