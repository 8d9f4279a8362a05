#include "model/evaluation/control_tables.h"

#include <cstdio>

#include "model/dance/quality_report.h"
#include "model/evaluation/control_course.h"
#include "model/evaluation/control_figures.h"
#include "model/evaluation/joint_track.h"
#include "model/evaluation/repetition.h"
#include "model/motion/facing_pose.h"

namespace choreo {
namespace {

constexpr int kLengths[] = {10, 50, 100, 150};
constexpr int kLongLengths[] = {100, 150, 200, 250};
constexpr double kScales[] = {0.5, 1.0, 1.5};
constexpr int kScaledFrames = 90;
constexpr double kCentimetre = 100;
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

const ModelInfo* Judged(const std::vector<Method>& methods) {
  for (const Method& method : methods) {
    if (method.name == kServed && method.engine->model().root_path) return &method.engine->model();
  }
  return nullptr;
}

Table LengthTable(const char* name, const ClipSet& set, const std::string& title,
                  const std::string& note, int digits, std::span<const int> lengths) {
  Table table;
  table.name = std::string(name) + "_" + set.name;
  table.title = title + ", " + set.name;
  table.note = note;
  table.label_headings = {"method"};
  for (const int length : lengths) table.columns.push_back({std::to_string(length), digits});
  return table;
}

void AddAverages(Table* table) {
  table->columns.push_back({"mean", table->columns.front().digits});
  for (TableRow& row : table->rows) {
    double sum = 0;
    for (const Cell& cell : row.cells) sum += cell.value;
    row.cells.push_back({sum / static_cast<double>(row.cells.size()), {}});
  }
}

double SkateRatio(const Skeleton& skeleton, double fps, const ControlledWindow& window,
                  const std::vector<Pose>& danced) {
  std::vector<Pose> poses = {window.before};
  poses.insert(poses.end(), danced.begin(), danced.end());
  return MeasureMotion(skeleton, {.fps = fps, .frames = poses}).skate_ratio;
}

std::vector<Table> PaperTables(const ClipSet& set, const ModelInfo& model,
                               const std::vector<ControlledWay>& ways, const EvalOptions& options,
                               ProgressBar* progress) {
  const std::string asked =
      "Transitions between real poses, with the real dance's root path and velocity factors. ";
  Table lrp = LengthTable("lrp", set, "LRP, cm",
                          asked +
                              "Paper C, Table 2: distance of root-relative positions of "
                              "postures that face +Z.",
                          1, kLengths);
  Table ratio = LengthTable("lrp_ratio", set, "LRP over interpolation's",
                            asked + "Interpolation: slerp, its root on the path.", 2, kLengths);
  Table turned = LengthTable("lrp_turned", set, "LRP in the scene's axes, cm",
                             asked + "As LRP, but a wrong heading counts too.", 1, kLengths);
  Table avf =
      LengthTable("avf", set, "AVF",
                  asked + "Paper C, Table 3: share that keeps within 1 cm/frame.", 2, kLengths);
  Table art =
      LengthTable("art", set, "ART",
                  asked + "Paper C, Table 4: share whose root keeps within 7 cm.", 2, kLengths);
  Table skate = LengthTable("control_skate", set, "Skating ratio", asked, 3, kLengths);
  for (Table* table : {&lrp, &ratio, &turned, &avf, &art, &skate}) {
    for (const ControlledWay& way : ways) table->rows.push_back({{way.name}, {}});
  }
  const Skeleton& skeleton = model.skeleton;
  for (const int frames : kLengths) {
    const ControlCourse course(set, model, frames, options.windows_per_clip, progress);
    for (size_t w = 0; w < ways.size(); ++w) {
      const auto dances = course.Dance(ways[w]);
      const auto add = [&](Table* table, const ControlCourse::Figure& figure) {
        table->rows[w].cells.push_back(course.MeanOf(dances, figure));
      };
      add(&lrp, [&](const ControlledWindow& window, const std::vector<Pose>& danced) {
        return kCentimetre * RootRelativeDistance(FacingTrack(skeleton, danced),
                                                  FacingTrack(skeleton, window.real));
      });
      add(&turned, [&](const ControlledWindow& window, const std::vector<Pose>& danced) {
        return kCentimetre * RootRelativeDistance(TrackJoints(skeleton, danced),
                                                  TrackJoints(skeleton, window.real));
      });
      add(&avf, [&](const ControlledWindow& window, const std::vector<Pose>& danced) {
        const auto factors = FactorTrackOf(skeleton, window.before, danced);
        return VelocityDeviation(factors, window.factors) < kVelocityTolerance ? 1.0 : 0.0;
      });
      add(&art, [&](const ControlledWindow& window, const std::vector<Pose>& danced) {
        return RootDeviation(TrackJoints(skeleton, danced), window.path) < kRootTolerance ? 1.0
                                                                                          : 0.0;
      });
      add(&skate, [&](const ControlledWindow& window, const std::vector<Pose>& danced) {
        return SkateRatio(skeleton, model.fps, window, danced);
      });
    }
  }
  for (size_t w = 0; w < ways.size(); ++w) {
    for (size_t i = 0; i < lrp.columns.size(); ++i) {
      const double straight = lrp.rows[kInterpolation].cells[i].value;
      ratio.rows[w].cells.push_back({lrp.rows[w].cells[i].value / straight, {}});
    }
  }
  for (Table* table : {&lrp, &avf, &art}) AddAverages(table);
  return {lrp, ratio, turned, avf, art, skate};
}

// Means over windows and frames of the factors that came out over those of the real dance.
Table MultiplierTable(const ClipSet& set, const ModelInfo& model,
                      const std::vector<ControlledWay>& ways, const EvalOptions& options,
                      ProgressBar* progress) {
  Table table;
  table.name = "multipliers_" + set.name;
  table.title = "Velocity factors times a number, " + set.name;
  char note[160];
  std::snprintf(note, sizeof(note),
                "%d frames on the real path: mean speed of each part over the real dance's.",
                kScaledFrames);
  table.note = note;
  table.label_headings = {"method", "times"};
  for (const std::string_view part : kBodyPartNames) table.columns.push_back({std::string(part)});
  const ControlCourse course(set, model, kScaledFrames, options.windows_per_clip, progress);
  Eigen::Matrix<double, kBodyParts, 1> real = Eigen::Matrix<double, kBodyParts, 1>::Zero();
  for (const ControlledWindow& window : course.windows()) real += window.factors.rowwise().mean();
  for (const ControlledWay& way : ways) {
    for (const double scale : kScales) {
      if (scale != 1 && !way.TakesVelocityFactors()) continue;
      const auto dances = course.Dance(way, scale);
      Eigen::Matrix<double, kBodyParts, 1> danced = Eigen::Matrix<double, kBodyParts, 1>::Zero();
      for (size_t i = 0; i < dances.size(); ++i) {
        danced +=
            FactorTrackOf(model.skeleton, course.windows()[i].before, dances[i]).rowwise().mean();
      }
      char times[16];
      std::snprintf(times, sizeof(times), "%.1f", scale);
      TableRow row{{way.name, times}, {}};
      for (int part = 0; part < kBodyParts; ++part)
        row.cells.push_back({danced[part] / real[part], {}});
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table RepetitionTable(const ClipSet& set, const ModelInfo& model,
                      const std::vector<ControlledWay>& ways, const EvalOptions& options,
                      ProgressBar* progress) {
  Table table = LengthTable("repetition", set, "Repetition and endings",
                            "Shares of half seconds: that repeat one before them, and that hold "
                            "still in the last fifth (repetition.h).",
                            2, {});
  for (const char* what : {"repeated", "still at the end"}) {
    for (const int frames : kLongLengths)
      table.columns.push_back({std::string(what) + ", " + std::to_string(frames), 3});
  }
  std::vector<std::vector<Cell>> endings(ways.size());
  for (const ControlledWay& way : ways) table.rows.push_back({{way.name}, {}});
  for (const int frames : kLongLengths) {
    const ControlCourse course(set, model, frames, options.windows_per_clip, progress);
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
  return table;
}

}  // namespace

std::vector<Table> EvaluateControls(const ClipSet& set, const std::vector<Method>& methods,
                                    const EvalOptions& options, ProgressBar* progress) {
  const ModelInfo* model = Judged(methods);
  if (model == nullptr) return {};
  const std::vector<ControlledWay> ways = WaysOf(methods);
  std::vector<Table> tables = PaperTables(set, *model, ways, options, progress);
  tables.push_back(MultiplierTable(set, *model, ways, options, progress));
  tables.push_back(RepetitionTable(set, *model, ways, options, progress));
  return tables;
}

int64_t CountControlFrames(const ClipSet& set, const std::vector<Method>& methods,
                           const EvalOptions& options) {
  const ModelInfo* model = Judged(methods);
  if (model == nullptr) return 0;
  const auto count = [&](int frames) {
    return frames *
           static_cast<int64_t>(
               ChooseWindows(set, model->history_frames, frames, options.windows_per_clip).size());
  };
  int64_t once = 0;
  for (const int frames : kLengths) once += count(frames);
  for (const int frames : kLongLengths) once += count(frames);
  int64_t total = 0;
  for (const ControlledWay& way : WaysOf(methods)) {
    if (way.kind != ControlledWay::Kind::kEngine) continue;
    const auto scales = way.TakesVelocityFactors() ? std::size(kScales) : 1;
    total += once + static_cast<int64_t>(scales) * count(kScaledFrames);
  }
  return total;
}

}  // namespace choreo
