#include "model/evaluation/method_sheet.h"

#include <cmath>

#include "model/core/random.h"
#include "model/draw/contact_sheet.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

constexpr int kColumns = 8;
constexpr uint64_t kSeed = 10;

std::vector<EvalWindow> RandomWindows(const ClipSet& set, int history) {
  std::vector<EvalWindow> all = ChooseWindows(set, history, kSheetFrames, 1000);
  Random random(kSeed);
  std::vector<EvalWindow> drawn;
  while (!all.empty() && static_cast<int>(drawn.size()) < kSheetTransitions) {
    const auto at = random.Integer(0, static_cast<int64_t>(all.size()));
    drawn.push_back(all[static_cast<size_t>(at)]);
    all.erase(all.begin() + at);
  }
  return drawn;
}

}  // namespace

void DrawMethodSheet(const ClipSet& set, const Method& method, const ModelInfo& model,
                     float temperature, const std::filesystem::path& png) {
  const std::vector<EvalWindow> windows = RandomWindows(set, model.history_frames);
  if (windows.empty()) return;
  std::vector<TransitionJob> jobs;
  for (size_t i = 0; i < windows.size(); ++i) {
    jobs.push_back(JobOf(model, set, windows[i], kSheetFrames, temperature, i));
    if (!method.keys) jobs.back().request.target.reset();
  }
  std::vector<TransitionResult> results;
  if (method.kind == Method::Kind::kEngine) results = DanceTransitions(*method.engine, jobs);
  // At the columns' rate, so that the times under a row are right.
  Motion rows{.fps = model.fps * (kColumns - 1) / kSheetFrames, .frames = {}};
  ContactSheetOptions sheet;
  sheet.title = method.name + ", " + set.name + ": " + std::to_string(windows.size()) +
                " transitions of " + std::to_string(kSheetFrames) + " frames";
  for (size_t i = 0; i < windows.size(); ++i) {
    const std::vector<Pose> real = RealPoses(set, windows[i], kSheetFrames, 1);
    for (int column = 0; column < kColumns; ++column) {
      const auto at = std::lround(column * static_cast<double>(kSheetFrames) / (kColumns - 1));
      Pose pose = real[static_cast<size_t>(at)];
      if (method.kind == Method::Kind::kInterpolation)
        pose = InterpolatePoses(real.front(), real.back(), static_cast<double>(at) / kSheetFrames);
      if (method.kind == Method::Kind::kEngine && at > 0)
        pose = results[i].frames[static_cast<size_t>(at - 1)].pose;
      rows.frames.push_back(pose);
    }
    if (method.keys) sheet.key_frames.push_back(static_cast<int64_t>(rows.frames.size()) - 1);
  }
  sheet.frames = static_cast<int>(rows.frames.size());
  sheet.columns = kColumns;
  sheet.rows_apart = true;
  sheet.tile_width = 120;
  sheet.tile_height = 140;
  DrawContactSheet(model.skeleton, rows, sheet, png);
}

}  // namespace choreo
