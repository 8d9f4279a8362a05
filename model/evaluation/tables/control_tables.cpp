#include <utility>

#include "model/evaluation/judges/control_course.h"
#include "model/metrics/control_figures.h"
#include "model/metrics/joint_track.h"
#include "model/metrics/repetition.h"
#include "model/motion/pose/facing_pose.h"

namespace choreo {
namespace {

constexpr int kLongLengths[] = {100, 150, 200, 250};
constexpr int kFactorFrames = 90;
constexpr std::pair<double, const char*> kScales[] = {{0.5, "0.5"}, {1.0, "1.0"}, {1.5, "1.5"}};
constexpr double kEnding = 0.2;       // the last share of a dance
constexpr size_t kInterpolation = 1;  // index in WaysOf

// Postures that face +Z, like paper C's p^b (Section 3.1).
JointTrack FacingTrack(const Skeleton& skeleton, const std::vector<Pose>& poses) {
  JointTrack track;
  for (const Pose& pose : poses) {
    FacingPose facing = FacingOf(skeleton, pose);
    facing.heading = 0;
    track.push_back(PositionsOf(facing));
  }
  return track;
}

// Names the methods that take no controls.
std::string WithoutControls(const std::vector<Method>& ways) {
  std::string names;
  for (const Method& way : ways) {
    if (!way.FollowsPath() && way.finished) names += (names.empty() ? "; " : ", ") + way.name;
  }
  return names.empty() ? names : names + " takes neither";
}

// The figures of one method's dances, length by length.
using Lengths = std::vector<std::vector<ClipFigure>>;

Table FactorTable(Table table, const std::string& note, const Evaluation& evaluation,
                  const ControlCourse& course) {
  table.note = note;
  for (const Method& way : WaysOf(evaluation.methods)) {
    for (const auto& [scale, times] : kScales) {
      if (scale != 1 && !way.FollowsVelocityFactors()) continue;
      const Dances dances = course.Dance(way, scale);
      table.AddRow({way.name, times});
      for (int part = 0; part < kBodyParts; ++part) {
        const auto danced = course.FiguresOf(dances, [&](const auto& window, const auto& poses) {
          return SpeedTrackOf(evaluation.model().skeleton, window.before, poses).row(part).mean();
        });
        const auto unit = course.FiguresOf(dances, [&](const auto& window, const auto&) {
          return window.factors.row(part).mean();
        });
        table.Put(std::string(kBodyPartNames[part]), 2, Ratio(danced, unit));
      }
    }
  }
  return table;
}

// A table of one figure at each length.
struct ControlFigure {
  const char *name, *title, *note;
  int digits;
  bool averaged;  ///< whether it also has the mean over lengths
  ControlCourse::Figure figure;
};

// The figures of all tables; the first is LRP.
std::vector<ControlFigure> ControlFigures(const Skeleton& skeleton, double fps) {
  return {
      {"lrp", "LRP, cm",
       "Paper C, Table 2: distance of root-relative positions of postures that face +Z.", 1, true,
       [&skeleton](const auto& window, const auto& danced) {
         return 100 * RootRelativeDistance(FacingTrack(skeleton, danced),
                                           FacingTrack(skeleton, window.real));
       }},
      {"lrp_turned", "LRP in the scene's axes, cm", "As LRP, but a wrong heading counts too.", 1,
       false,
       [&skeleton](const auto& window, const auto& danced) {
         return 100 * RootRelativeDistance(TrackJoints(skeleton, danced),
                                           TrackJoints(skeleton, window.real));
       }},
      {"avf", "AVF", "Paper C, Table 3: share that keeps within 1 cm/frame.", 2, true,
       [&skeleton](const auto& window, const auto& danced) {
         const auto factors = SpeedTrackOf(skeleton, window.before, danced);
         return VelocityDeviation(factors, window.factors) < kVelocityTolerance ? 1.0 : 0.0;
       }},
      {"art", "ART", "Paper C, Table 4: share whose root keeps within 7 cm.", 2, true,
       [&skeleton](const auto& window, const auto& danced) {
         const double off = RootDeviation(TrackJoints(skeleton, danced), window.path);
         return off < kRootTolerance ? 1.0 : 0.0;
       }},
      {"control_skate", "Skating ratio", "Share of the steps in which a foot skates.", 3, false,
       [&skeleton, fps](const auto& window, const auto& danced) {
         return SkateRatioOf(skeleton, fps, window.before, danced);
       }},
      {"tremor", "Trembling", "Share of the joints' movement from the root above 4 Hz.", 2, false,
       [&skeleton, fps](const auto&, const auto& danced) {
         return TremorShare(TrackJoints(skeleton, danced), fps);
       }},
  };
}

}  // namespace

std::vector<Table> EvaluateControls(const Evaluation& evaluation) {
  const ModelInfo& model = evaluation.model();
  if (!model.Supports(kRootPath)) return {};
  const std::vector<Method> ways = WaysOf(evaluation.methods);
  const std::string setting =
      "Transitions between real poses, with the real dance's root path and velocity factors" +
      WithoutControls(ways) + ". ";
  std::vector<ControlCourse> courses;
  std::vector<std::vector<Dances>> dances(ways.size());  // by length
  for (const int frames : kControlledFrames) {
    courses.emplace_back(evaluation, frames);
    for (size_t w = 0; w < ways.size(); ++w) dances[w].push_back(courses.back().Dance(ways[w]));
  }
  std::vector<Table> tables;
  std::vector<Lengths> lrp;
  for (const ControlFigure& of : ControlFigures(model.skeleton, model.fps)) {
    Table& table = tables.emplace_back(evaluation.NewTable(of.name, of.title, {"method"}));
    table.note = setting + of.note;
    std::vector<Lengths> all;
    for (size_t w = 0; w < ways.size(); ++w) {
      Lengths& lengths = all.emplace_back();
      table.AddRow({ways[w].name});
      for (size_t i = 0; i < courses.size(); ++i) {
        lengths.push_back(courses[i].FiguresOf(dances[w][i], of.figure));
        table.Put(std::to_string(kControlledFrames[i]), of.digits, Mean(lengths.back()));
      }
      if (of.averaged) table.Put("mean", of.digits, MeanOfMeans(lengths));
    }
    if (lrp.empty()) lrp = std::move(all);
  }
  Table ratio = evaluation.NewTable("lrp_ratio", "LRP over interpolation's", {"method"});
  ratio.note = setting + "Interpolation: slerp, its root on the path.";
  for (size_t w = 0; w < ways.size(); ++w) {
    ratio.AddRow({ways[w].name});
    for (size_t i = 0; i < courses.size(); ++i)
      ratio.Put(std::to_string(kControlledFrames[i]), 2, Ratio(lrp[w][i], lrp[kInterpolation][i]));
  }
  tables.insert(tables.begin() + 1, std::move(ratio));
  return tables;
}

std::vector<Table> EvaluateMultipliers(const Evaluation& evaluation) {
  const ModelInfo& model = evaluation.model();
  if (!model.Supports(kRootPath)) return {};
  ControlCourse course(evaluation, kFactorFrames);
  const std::string setting = std::to_string(kFactorFrames) + " frames on the real path";
  std::vector<Table> tables;
  tables.push_back(FactorTable(
      evaluation.NewTable("multipliers", "Velocity factors times a number", {"method", "times"}),
      setting + ": mean speed of each part over the real dance's.", evaluation, course));
  if (model.velocity_references.empty()) return tables;
  const VelocityReference& reference = model.velocity_references.front();
  course.RequestConstant(reference.speeds);
  tables.push_back(FactorTable(
      evaluation.NewTable("constant", "Constant velocity factors", {"method", "times"}),
      setting + ", the same asked of every frame: " + "a number times the reference \"" +
          reference.name + "\". Mean speed of each part over that reference.",
      evaluation, course));
  return tables;
}

std::vector<Table> EvaluateRepetition(const Evaluation& evaluation) {
  const ModelInfo& model = evaluation.model();
  if (!model.Supports(kRootPath)) return {};
  Table table = evaluation.NewTable("repetition", "Repetition and endings", {"method"});
  table.note =
      "Shares of half seconds: that repeat one before them, and that hold still in the last fifth "
      "(repetition.h).";
  std::vector<ControlCourse> courses;
  for (const int frames : kLongLengths) courses.emplace_back(evaluation, frames);
  for (const Method& way : WaysOf(evaluation.methods)) {
    table.AddRow({way.name});
    for (size_t i = 0; i < courses.size(); ++i) {
      const int frames = kLongLengths[i], ending = static_cast<int>((1 - kEnding) * frames);
      const Dances dances = courses[i].Dance(way);
      const auto put = [&](const std::string& what, double Repetition::*figure, int from) {
        const auto shares = courses[i].FiguresOf(dances, [&](const auto&, const auto& danced) {
          return MeasureRepetition(model.skeleton, danced, model.fps, from).*figure;
        });
        table.Put(what + ", " + std::to_string(frames), 3, Mean(shares));
      };
      put("repeated", &Repetition::repeated, 0);
      put("still at the end", &Repetition::frozen, ending);
    }
  }
  return {table};
}

}  // namespace choreo
