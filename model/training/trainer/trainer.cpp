#include "model/training/trainer/trainer.h"

#include "model/core/error.h"
#include "model/core/limits.h"

namespace choreo {

void Require(bool good, const char* option, const std::string& value, const std::string& limit) {
  if (!good) throw InvalidArgument(option, value + ", but it must be " + limit);
}

std::string TrainOptions::Command() const {
  std::string command = "choreo-lab train";
  for (const auto& folder : data) command += " --data " + folder.filename().string();
  command += " --splits " + splits.filename().string() + ' ' + Fixed();
  if (!from.empty()) command += " --from " + from.filename().string();
  if (!name.empty()) command += " --name " + name;
  if (blend != 1) {
    OptionText text;
    text("--blend", blend, "");
    command += text.Text();
  }
  return command;
}

std::string TrainOptions::Fixed() const {
  OptionText text;
  VisitFixed(*this, text);
  VisitFixedOfDefault(*this, text);
  return "--preset " + preset + text.Text();
}

void TrainOptions::Check() const {
  Require(name.size() <= kMaxNameBytes, "--name", name,
          "at most " + std::to_string(kMaxNameBytes) + " bytes");
  Require(!data.empty(), "--data", "nothing", "at least one folder of prepared clips");
  Require(steps >= 1, "--steps", std::to_string(steps), "at least 1");
  Require(batch >= 4 && batch <= 4096, "--batch", std::to_string(batch), "4 to 4096");
  Require(clip >= 0, "--clip", std::to_string(clip), "at least 0");
  Require(tempo >= 0 && tempo <= 1, "--tempo", std::to_string(tempo), "0 to 1");
  Require(!keep_statistics || !from.empty(), "--keep-statistics", "alone", "given with --from");
  Require(blend > 0 && blend <= 1, "--blend", std::to_string(blend), "above 0, at most 1");
  Require(blend == 1 || !from.empty(), "--blend", "alone", "given with --from");
  Require(report_every >= 1, "--report-every", std::to_string(report_every), "at least 1");
  Require(stop_after >= 0, "--stop-after", std::to_string(stop_after), "at least 0");
  Require(rate >= 0 && rate <= 1, "--rate", std::to_string(rate), "0 to 1");
}

}  // namespace choreo
