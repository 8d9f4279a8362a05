#include <utility>

#include "model/evaluation/control_course.h"
#include "model/metrics/control_figures.h"
#include "model/metrics/joint_track.h"
#include "model/metrics/repetition.h"
#include "model/motion/facing_pose.h"

namespace choreo {
namespace {

constexpr int kLengths[] = {10, 50, 100, 150};
constexpr int kLongLengths[] = {100, 150, 200, 250};
constexpr int kFactorFrames = 90;
constexpr std::pair<double, const char*> kScales[] = {{0.5, "0.5"}, {1.0, "1.0"}, {1.5, "1.5"}};
constexpr double kEnding = 0.2;       // share of a dance that is its ending
constexpr size_t kInterpolation = 1;  // of WaysOf

// Postures that face +Z, as paper C's p^b (Section 3.1).
JointTrack FacingTrack(const Skeleton& skeleton, const std::vector<Pose>& poses) {
  JointTrack track;
  for (const Pose& pose : poses) {
    FacingPose facing = FacingOf(skeleton, pose);
    facing.heading = 0;
    track.push_back(PositionsOf(facing));
  }
  return track;
}

Table LengthTable(const Evaluation& evaluation, const char* name, const std::string& title,
                  const std::string& note, int digits) {
  Table table = evaluation.NewTable(name, title, {"method"});
  table.note = note;
  for (const int length : kLengths) table.columns.push_back({std::to_string(length), digits});
  return table;
}

// Who is not told what is asked.
std::string WithoutControls(const std::vector<Method>& ways) {
  std::string names;
  for (const Method& way : ways) {
    if (!way.TakesPath() && way.finished) names += (names.empty() ? "; " : ", ") + way.name;
  }
  return names.empty() ? names : names + " takes neither";
}

// What the dances of one way came to, length by length.
using Lengths = std::vector<std::vector<ClipFigure>>;

Table FactorTable(Table table, const std::string& note, const Evaluation& evaluation,
                  const ControlCourse& course) {
  table.note = note;
  for (const Method& way : WaysOf(evaluation.methods)) {
    for (const auto& [scale, times] : kScales) {
      if (scale != 1 && !way.TakesVelocityFactors()) continue;
      const Dances dances = course.Dance(way, scale);
      table.Begin({way.name, times});
      for (int part = 0; part < kBodyParts; ++part) {
        const auto danced = course.FiguresOf(dances, [&](const ControlledWindow& window,
                                                         const std::vector<Pose>& poses) {
          return FactorTrackOf(evaluation.model().skeleton, window.before, poses).row(part).mean();
        });
        const auto unit =
            course.FiguresOf(dances, [&](const ControlledWindow& window, const std::vector<Pose>&) {
              return window.factors.row(part).mean();
            });
        table.Put(std::string(kBodyPartNames[part]), 2, Ratio(danced, unit));
      }
    }
  }
  return table;
}

}  // namespace

std::vector<Table> EvaluateControls(const Evaluation& evaluation) {
  const ModelInfo& model = evaluation.model();
  if (!model.root_path) return {};
  const std::vector<Method> ways = WaysOf(evaluation.methods);
  const std::string asked =
      "Transitions between real poses, with the real dance's root path and velocity factors" +
      WithoutControls(ways) + ". ";
  const Skeleton& skeleton = model.skeleton;
  struct Figured {
    Table table;
    ControlCourse::Figure figure;
    bool averaged;
    std::vector<Lengths> ways = {};
  };
  std::vector<Figured> all = {
      {LengthTable(evaluation, "lrp", "LRP, cm",
                   asked + "Paper C, Table 2: distance of root-relative positions of postures that "
                           "face +Z.",
                   1),
       [&](const ControlledWindow& window, const std::vector<Pose>& danced) {
         return 100 * RootRelativeDistance(FacingTrack(skeleton, danced),
                                           FacingTrack(skeleton, window.real));
       },
       true},
      {LengthTable(evaluation, "lrp_turned", "LRP in the scene's axes, cm",
                   asked + "As LRP, but a wrong heading counts too.", 1),
       [&](const ControlledWindow& window, const std::vector<Pose>& danced) {
         return 100 * RootRelativeDistance(TrackJoints(skeleton, danced),
                                           TrackJoints(skeleton, window.real));
       },
       false},
      {LengthTable(evaluation, "avf", "AVF",
                   asked + "Paper C, Table 3: share that keeps within 1 cm/frame.", 2),
       [&](const ControlledWindow& window, const std::vector<Pose>& danced) {
         const auto factors = FactorTrackOf(skeleton, window.before, danced);
         return VelocityDeviation(factors, window.factors) < kVelocityTolerance ? 1.0 : 0.0;
       },
       true},
      {LengthTable(evaluation, "art", "ART",
                   asked + "Paper C, Table 4: share whose root keeps within 7 cm.", 2),
       [&](const ControlledWindow& window, const std::vector<Pose>& danced) {
         const double off = RootDeviation(TrackJoints(skeleton, danced), window.path);
         return off < kRootTolerance ? 1.0 : 0.0;
       },
       true},
      {LengthTable(evaluation, "control_skate", "Skating ratio",
                   asked + "Share of the steps in which a foot skates.", 3),
       [&](const ControlledWindow& window, const std::vector<Pose>& danced) {
         return SkateRatioOf(skeleton, model.fps, window.before, danced);
       },
       false},
      {LengthTable(evaluation, "tremor", "Trembling",
                   asked + "Share of the joints' movement from the root above 4 Hz.", 2),
       [&](const ControlledWindow&, const std::vector<Pose>& danced) {
         return TremorShare(TrackJoints(skeleton, danced), model.fps);
       },
       false}};
  for (Figured& one : all) one.ways.resize(ways.size());
  for (const int frames : kLengths) {
    const ControlCourse course(evaluation, frames);
    for (size_t w = 0; w < ways.size(); ++w) {
      const Dances dances = course.Dance(ways[w]);
      for (Figured& one : all) one.ways[w].push_back(course.FiguresOf(dances, one.figure));
    }
  }
  Table ratio = LengthTable(evaluation, "lrp_ratio", "LRP over interpolation's",
                            asked + "Interpolation: slerp, its root on the path.", 2);
  std::vector<Table> tables;
  for (Figured& one : all) {
    if (one.averaged) one.table.columns.push_back({"mean", one.table.columns.front().digits});
    for (size_t w = 0; w < ways.size(); ++w) {
      TableRow row{{ways[w].name}, {}};
      for (const auto& figures : one.ways[w]) row.cells.push_back(Mean(figures));
      if (one.averaged) row.cells.push_back(MeanOfMeans(one.ways[w]));
      one.table.rows.push_back(std::move(row));
    }
    tables.push_back(std::move(one.table));
  }
  const std::vector<Lengths>& lrp = all.front().ways;
  for (size_t w = 0; w < ways.size(); ++w) {
    ratio.rows.push_back({{ways[w].name}, {}});
    for (size_t i = 0; i < lrp[w].size(); ++i)
      ratio.rows.back().cells.push_back(Ratio(lrp[w][i], lrp[kInterpolation][i]));
  }
  tables.insert(tables.begin() + 1, std::move(ratio));
  return tables;
}

std::vector<Table> EvaluateMultipliers(const Evaluation& evaluation) {
  const ModelInfo& model = evaluation.model();
  if (!model.root_path) return {};
  ControlCourse course(evaluation, kFactorFrames);
  const std::string asked = std::to_string(kFactorFrames) + " frames on the real path";
  std::vector<Table> tables;
  tables.push_back(FactorTable(
      evaluation.NewTable("multipliers", "Velocity factors times a number", {"method", "times"}),
      asked + ": mean speed of each part over the real dance's.", evaluation, course));
  if (model.velocity_references.empty()) return tables;
  const VelocityReference& reference = model.velocity_references.front();
  course.AskConstant(reference.factors);
  tables.push_back(
      FactorTable(evaluation.NewTable("constant", "Constant velocity factors", {"method", "times"}),
                  asked + ", the same asked of every frame: " + "a number times the reference \"" +
                      reference.name + "\". Mean speed of each part over that reference.",
                  evaluation, course));
  return tables;
}

std::vector<Table> EvaluateRepetition(const Evaluation& evaluation) {
  const ModelInfo& model = evaluation.model();
  if (!model.root_path) return {};
  const std::vector<Method> ways = WaysOf(evaluation.methods);
  Table table = evaluation.NewTable("repetition", "Repetition and endings", {"method"});
  table.note =
      "Shares of half seconds: that repeat one before them, and that hold still in the last fifth "
      "(repetition.h).";
  for (const char* what : {"repeated", "still at the end"}) {
    for (const int frames : kLongLengths)
      table.columns.push_back({std::string(what) + ", " + std::to_string(frames), 3});
  }
  std::vector<std::vector<Cell>> endings(ways.size());
  for (const Method& way : ways) table.rows.push_back({{way.name}, {}});
  for (const int frames : kLongLengths) {
    const ControlCourse course(evaluation, frames);
    for (size_t w = 0; w < ways.size(); ++w) {
      const Dances dances = course.Dance(ways[w]);
      const auto last_part = static_cast<int>((1 - kEnding) * frames);
      table.rows[w].cells.push_back(
          course.MeanOf(dances, [&](const ControlledWindow&, const std::vector<Pose>& danced) {
            return MeasureRepetition(model.skeleton, danced, model.fps).repeated;
          }));
      endings[w].push_back(
          course.MeanOf(dances, [&](const ControlledWindow&, const std::vector<Pose>& danced) {
            return MeasureRepetition(model.skeleton, danced, model.fps, last_part).frozen;
          }));
    }
  }
  for (size_t w = 0; w < ways.size(); ++w)
    table.rows[w].cells.insert(table.rows[w].cells.end(), endings[w].begin(), endings[w].end());
  return {table};
}

}  // namespace choreo
