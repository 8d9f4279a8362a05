#pragma once

#include <cstdint>
#include <memory>

#include "client/choreo_client.h"
#include "model/core/progress.h"

namespace choreo::cli {

/// Shows a dance's progress: a bar, and deviations from the request.
class DanceDisplay {
 public:
  /// `frames`: of the dance, at the model's rate.
  DanceDisplay(int64_t frames, double model_fps) : frames_(frames), model_fps_(model_fps) {}

  void operator()(const client::Message& message);

 private:
  int64_t frames_;
  double model_fps_;
  std::unique_ptr<ProgressBar> bar_;
};

}  // namespace choreo::cli
