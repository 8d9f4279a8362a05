#pragma once

#include "model/papers/training/paper_options.h"
#include "model/training/trainer/training_run.h"

namespace choreo {

/// A training run of one of the papers' networks.
class PaperRun : public TrainingRun {
 protected:
  PaperRun(const PaperOptions& options, const TrainingClips& clips)
      : TrainingRun(options, clips), options_(options) {}

  const PaperOptions& options() const { return options_; }

 private:
  const PaperOptions& options_;
};

}  // namespace choreo
