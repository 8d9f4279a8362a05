#include "model/training/train_options.h"

#include <sstream>

#include "model/core/error.h"

namespace choreo {

std::string TrainOptions::Command() const {
  std::ostringstream command;
  command << "choreo-lab train";
  for (const auto& folder : data) command << " --data " << folder.filename().string();
  command << " --splits " << splits.filename().string() << ' ' << Fixed();
  if (!name.empty()) command << " --name " << name;
  return command.str();
}

std::string TrainOptions::Fixed() const {
  std::ostringstream text;
  text << "--preset " << preset << " --steps " << steps << " --batch " << batch << " --rate "
       << rate << " --shortest " << shortest << " --longest " << longest << " --rollout-frames "
       << rollout_frames << " --tempo " << tempo << " --seed " << seed
       << (from.empty() ? "" : " --from " + from.filename().string())
       << (with_validation ? " --with-validation" : "");
  for (const Ablation& ablation : kAblations) {
    if (this->*ablation.on) text << ' ' << ablation.option;
  }
  return text.str();
}

void TrainOptions::Validate() const {
  const auto require = [](bool good, const char* option, const std::string& value,
                          const char* limit) {
    if (!good) throw InvalidArgument(option, value + ", but it must be " + limit);
  };
  require(name.size() <= 64, "--name", name, "at most 64 bytes");
  require(!data.empty(), "--data", "nothing", "at least one folder of prepared clips");
  require(steps >= 1, "--steps", std::to_string(steps), "at least 1");
  require(batch >= 4 && batch <= 4096, "--batch", std::to_string(batch), "4 to 4096");
  require(shortest >= 2 && shortest <= longest && longest <= 600, "--longest",
          std::to_string(longest), "from --shortest (at least 2) to 600");
  require(rollout_frames >= 2 && rollout_frames <= 300, "--rollout-frames",
          std::to_string(rollout_frames), "2 to 300");
  require(tempo >= 0 && tempo <= 1, "--tempo", std::to_string(tempo), "0 to 1");
  require(report_every >= 1, "--report-every", std::to_string(report_every), "at least 1");
}

}  // namespace choreo
