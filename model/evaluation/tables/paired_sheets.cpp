#include "model/evaluation/tables/paired_sheets.h"

#include <cmath>
#include <fstream>

#include "model/core/numbers/random.h"
#include "model/draw/contact_sheet.h"
#include "model/evaluation/eval_report.h"
#include "model/evaluation/judges/long_plans.h"

namespace choreo {
namespace {

constexpr uint64_t kSeed = 12;
constexpr int kPairedSeconds = 8;
constexpr int kPairedFrames = 12;  // per second

}  // namespace

void DrawPairedSheets(const ClipSet& set, const Method& method, float temperature,
                      const std::filesystem::path& json) {
  const ModelInfo& model = method.sampler->model();
  std::vector<LongPlan> plans = PlanKeyedDances(model, set, temperature);
  const auto frames = static_cast<int>(std::lround(kPairedSeconds * model.fps));
  for (LongPlan& plan : plans) {
    plan.frames = frames;
    plan.keys.erase(plan.keys.lower_bound(frames), plan.keys.end());
  }
  const std::vector<LongDance> chains = Runner().DanceLong(*method.sampler, plans);
  ContactSheetOptions sheet;
  sheet.frames = 2 * kPairedSeconds * kPairedFrames;
  sheet.columns = kPairedFrames;
  sheet.rows_apart = true;
  sheet.tile_width = 120;
  sheet.tile_height = 140;
  const std::string name = "pair_" + set.name;
  std::string answers;
  for (size_t i = 0; i < plans.size(); ++i) {
    const std::string& clip = set.clips[plans[i].clip].name;
    const bool real_first = Random(kSeed, static_cast<uint32_t>(plans[i].clip)).Next() % 2 == 0;
    const std::vector<Pose> real = RealMotionBeside(plans[i], set);
    Motion rows{.fps = kPairedFrames, .frames = {}};
    for (int row = 0; row < 2 * kPairedSeconds; ++row) {
      const std::vector<Pose>& poses = (row % 2 == 0) == real_first ? real : chains[i].poses;
      for (int column = 0; column < kPairedFrames; ++column) {
        const double seconds = row / 2 + static_cast<double>(column) / kPairedFrames;
        rows.frames.push_back(poses[static_cast<size_t>(seconds * model.fps)]);
      }
    }
    sheet.title = clip + ": A, B, A, B, ..., a row a second";
    DrawContactSheet({{model.skeleton, rows}}, sheet, PictureBeside(json, name + "_" + clip));
    answers += clip + (real_first ? " A\n" : " B\n");
  }
  std::ofstream(PictureBeside(json, name).replace_extension(".txt")) << answers;
}

}  // namespace choreo
