#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "model/core/progress.h"
#include "model/evaluation/method.h"
#include "model/evaluation/window_figures.h"

namespace choreo {

using Figures = std::vector<WindowFigures>;  ///< one a window, in their order

/// Lets methods dance the windows of a set at one length, and measures them. What it is made of
/// must outlive it.
class TransitionJudge {
 public:
  /// `progress` may be null.
  TransitionJudge(const ClipSet& set, const ModelInfo& model, int frames, int windows_per_clip,
                  ProgressBar* progress);

  const std::vector<EvalWindow>& windows() const { return windows_; }

  /// `candidate` numbers the samples of an engine.
  Figures Run(const Method& method, float temperature, uint32_t candidate = 0) const;

  /// Fills in the raw key figures of an engine: the same noise, no arrival, no foot lock.
  void AddRawKeys(const Method& method, float temperature, Figures* figures) const;

 private:
  Figures Dance(const Method& method, float temperature, uint32_t candidate) const;
  std::vector<TransitionJob> Jobs(const Method& method, float temperature,
                                  uint32_t candidate) const;
  std::function<void(int)> Tick() const;

  const ClipSet& set_;
  const ModelInfo& model_;
  int frames_;
  std::vector<EvalWindow> windows_;
  ProgressBar* progress_;
};

}  // namespace choreo
