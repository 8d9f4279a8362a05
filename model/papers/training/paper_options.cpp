#include "model/papers/training/paper_options.h"

#include <algorithm>

namespace choreo {

LengthRange CurriculumAt(int64_t step, int64_t steps, int shortest, int longest) {
  constexpr int kRaisedEvery = 5, kRaise = 4;
  const auto epoch = static_cast<int>(step * (longest - shortest + 1) / steps);
  const int most = shortest + epoch;
  return {std::min(most, shortest + epoch / kRaisedEvery * kRaise), most};
}

std::string PaperOptions::Command() const {
  std::ostringstream command;
  command << TrainOptions::Command();
  if (flow.temperature != 1) command << " --served-temperature " << flow.temperature;
  return command.str();
}

std::string PaperOptions::Fixed() const {
  OptionText text;
  VisitFixed(*this, text);
  VisitFixedOfPapers(*this,
                     [&](const char* option, const auto& value, bool is_used, const char* what) {
                       if (is_used) text(option, value, what);
                     });
  return "--preset " + preset + text.Text();
}

void PaperOptions::Check() const {
  TrainOptions::Check();
  Require(shortest >= 2 && shortest <= longest && longest <= 600, "--longest",
          std::to_string(longest), "from --shortest (at least 2) to 600");
  Require(flow.flow_steps >= 0 && flow.flow_steps <= 64, "--flow-steps",
          std::to_string(flow.flow_steps), "0 to 64");
  Require(flow.hidden >= 0 && flow.hidden <= 4096, "--hidden", std::to_string(flow.hidden),
          "0 to 4096");
  Require(flow.condition_width >= -1 && flow.condition_width <= 4096, "--condition-width",
          std::to_string(flow.condition_width), "-1 to 4096");
  Require(flow.rollout_share > 0 && flow.rollout_share <= 1, "--rollout-share",
          std::to_string(flow.rollout_share), "above 0, to 1");
  Require(flow.rollout_from >= 0, "--rollout-from", std::to_string(flow.rollout_from),
          "at least 0");
  Require(flow.rollout_loss >= 0 && flow.rollout_loss <= 100, "--rollout-loss",
          std::to_string(flow.rollout_loss), "0 to 100");
  Require(flow.dequantise >= 0 && flow.dequantise <= 1, "--dequantise",
          std::to_string(flow.dequantise), "0 to 1");
  Require(controllers.truth_decay >= 0 && controllers.truth_decay <= 1, "--truth-decay",
          std::to_string(controllers.truth_decay), "0 to 1");
  Require(!IsControllers() || controllers.residual || !controllers.no_absolute_position ||
              !controllers.no_relative_position,
          "--no-relative-position", "with --no-absolute-position", "alone");
}

}  // namespace choreo
