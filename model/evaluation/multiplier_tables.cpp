#include <cstdio>

#include "model/evaluation/control_course.h"

namespace choreo {
namespace {

constexpr int kFrames = 90;
constexpr double kScales[] = {0.5, 1.0, 1.5};

std::string Fixed(const char* format, auto value) {
  char text[200];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

Table FillTable(Table table, const std::string& note, const Evaluation& evaluation,
                const ControlCourse& course) {
  table.note = note;
  table.label_headings = {"method", "times"};
  for (const std::string_view part : kBodyPartNames) table.columns.push_back({std::string(part)});
  for (const Method& way : WaysOf(evaluation.methods)) {
    for (const double scale : kScales) {
      if (scale != 1 && !way.TakesVelocityFactors()) continue;
      const Dances dances = course.Dance(way, scale);
      TableRow row{{way.name, Fixed("%.1f", scale)}, {}};
      for (int part = 0; part < kBodyParts; ++part) {
        const auto danced = course.FiguresOf(dances, [&](const ControlledWindow& window,
                                                         const std::vector<Pose>& poses) {
          return FactorTrackOf(evaluation.model().skeleton, window.before, poses).row(part).mean();
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

std::vector<Table> EvaluateMultipliers(const Evaluation& evaluation) {
  const ModelInfo& model = evaluation.model();
  if (!model.root_path) return {};
  ControlCourse course(evaluation, kFrames);
  std::vector<Table> tables;
  tables.push_back(FillTable(
      evaluation.NewTable("multipliers", "Velocity factors times a number"),
      Fixed("%d frames on the real path: mean speed of each part over the real dance's.", kFrames),
      evaluation, course));
  if (model.velocity_references.empty()) return tables;
  const VelocityReference& reference = model.velocity_references.front();
  course.AskConstant(reference.factors);
  tables.push_back(
      FillTable(evaluation.NewTable("constant", "Constant velocity factors"),
                Fixed("%d frames on the real path, the same asked of every frame: ", kFrames) +
                    "a number times the reference \"" + reference.name +
                    "\". Mean speed of each part over that reference.",
                evaluation, course));
  return tables;
}

}  // namespace choreo
