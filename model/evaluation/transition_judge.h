#pragma once

#include <cstdint>
#include <vector>

#include "model/evaluation/evaluation.h"
#include "model/evaluation/window_figures.h"

namespace choreo {

using Figures = std::vector<WindowFigures>;  ///< one a window, in their order

/// Lets methods dance the windows of a set at one length, and measures them. What it is made of
/// must outlive it.
class TransitionJudge {
 public:
  TransitionJudge(const Evaluation& evaluation, const ModelInfo& model, int frames);

  int frames() const { return frames_; }
  const std::vector<EvalWindow>& windows() const { return windows_; }

  /// `candidate` numbers the samples of an engine.
  Figures Run(const Method& method, float temperature, uint32_t candidate = 0) const;
  /// Linear for the root, spherical for the joints.
  Figures Interpolation() const { return Run({"", Method::Kind::kInterpolation}, 0); }

  /// Fills in the raw key figures of an engine: the same noise, no arrival, no foot lock.
  void AddRawKeys(Method method, float temperature, Figures* figures) const;

 private:
  std::vector<std::vector<Pose>> Dance(const Method& method, float temperature,
                                       uint32_t candidate) const;

  const Evaluation& evaluation_;
  const ModelInfo& model_;
  int frames_;
  std::vector<EvalWindow> windows_;
};

}  // namespace choreo
