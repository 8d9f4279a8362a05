#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "client/choreo_client.h"
#include "model/core/running/progress.h"

namespace choreo::cli {

/// Shows a dance's progress: a bar, and deviations from the request.
class DanceDisplay {
 public:
  /// `frames`: of the dance, at the model's rate. `who`: names of its dancers, or empty.
  DanceDisplay(int64_t frames, double model_fps, std::string who)
      : frames_(frames), model_fps_(model_fps), who_(std::move(who)) {}

  void operator()(const client::Message& message);

 private:
  void Print(const std::string& line);

  int64_t frames_;
  double model_fps_;
  std::string who_;
  std::unique_ptr<ProgressBar> bar_;
};

}  // namespace choreo::cli
