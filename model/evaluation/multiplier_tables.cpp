#include "model/evaluation/multiplier_tables.h"

#include <cstdio>
#include <functional>

namespace choreo {
namespace {

constexpr int kFrames = 90;
constexpr double kScales[] = {0.5, 1.0, 1.5};

std::string Fixed(const char* format, auto value) {
  char text[200];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

Table MultiplierTable(const std::string& name, const std::string& title, const std::string& note,
                      const ModelInfo& model, const std::vector<ControlledWay>& ways,
                      const ControlCourse& course) {
  Table table;
  table.name = name;
  table.title = title;
  table.note = note;
  table.label_headings = {"method", "times"};
  for (const std::string_view part : kBodyPartNames) table.columns.push_back({std::string(part)});
  for (const ControlledWay& way : ways) {
    for (const double scale : kScales) {
      if (scale != 1 && !way.TakesVelocityFactors()) continue;
      const Dances dances = course.Dance(way, scale);
      TableRow row{{way.name, Fixed("%.1f", scale)}, {}};
      for (int part = 0; part < kBodyParts; ++part) {
        const auto danced = course.FiguresOf(
            dances, [&](const ControlledWindow& window, const std::vector<Pose>& poses) {
              return FactorTrackOf(model.skeleton, window.before, poses).row(part).mean();
            });
        const auto unit =
            course.FiguresOf(dances, [&](const ControlledWindow& window, const std::vector<Pose>&) {
              return window.factors.row(part).mean();
            });
        row.cells.push_back(Ratio(danced, unit));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace

std::vector<Table> EvaluateMultipliers(const ClipSet& set, const ModelInfo& model,
                                       const std::vector<ControlledWay>& ways,
                                       const EvalOptions& options, ProgressBar* progress) {
  ControlCourse course(set, model, kFrames, options.windows_per_clip, progress);
  std::vector<Table> tables;
  tables.push_back(MultiplierTable(
      "multipliers_" + set.name, "Velocity factors times a number, " + set.name,
      Fixed("%d frames on the real path: mean speed of each part over the real dance's.", kFrames),
      model, ways, course));
  if (model.velocity_references.empty()) return tables;
  const VelocityReference& reference = model.velocity_references.front();
  course.AskConstant(reference.factors);
  tables.push_back(MultiplierTable(
      "constant_" + set.name, "Constant velocity factors, " + set.name,
      Fixed("%d frames on the real path, the same asked of every frame: ", kFrames) +
          "a number times the reference \"" + reference.name +
          "\". Mean speed of each part over that reference.",
      model, ways, course));
  return tables;
}

int64_t CountMultiplierFrames(const ClipSet& set, const ModelInfo& model,
                              const std::vector<ControlledWay>& ways, const EvalOptions& options) {
  const auto windows = static_cast<int64_t>(
      ChooseWindows(set, model.history_frames, kFrames, options.windows_per_clip).size());
  const int64_t tables = model.velocity_references.empty() ? 1 : 2;
  int64_t dances = 0;
  for (const ControlledWay& way : ways) {
    if (way.kind != ControlledWay::Kind::kEngine || !way.Lasts(kFrames)) continue;
    dances += way.TakesVelocityFactors() ? static_cast<int64_t>(std::size(kScales)) : 1;
  }
  return tables * dances * windows * kFrames;
}

}  // namespace choreo
