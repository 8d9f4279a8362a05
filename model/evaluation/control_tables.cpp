#include "model/evaluation/control_tables.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>

#include "model/dance/quality_report.h"
#include "model/evaluation/control_figures.h"
#include "model/evaluation/joint_track.h"
#include "model/evaluation/repetition.h"
#include "model/evaluation/window_figures.h"
#include "model/motion/facing_pose.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

constexpr int kLengths[] = {10, 50, 100, 150};
constexpr int kLongLengths[] = {100, 150, 200, 250};
constexpr double kScales[] = {0.5, 1.0, 1.5};
constexpr int kScaledFrames = 90;
constexpr double kCentimetre = 100;
constexpr double kEnding = 0.2;  // share of a dance that is its ending

// One way of answering the same requests.
struct Way {
  std::string name;
  StepEngine* engine = nullptr;  // null: interpolation along the path
  bool finished = true;          // with arrival and foot lock
};

using Factors = Eigen::Matrix<double, kBodyParts, Eigen::Dynamic>;

struct Window {
  Pose before;  // the last history pose
  std::vector<Pose> real;
  Eigen::Matrix3Xd path;
  Factors factors;
};

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

Factors FactorsOf(const Skeleton& skeleton, const Pose& before, const std::vector<Pose>& danced) {
  std::vector<Pose> poses = {before};
  poses.insert(poses.end(), danced.begin(), danced.end());
  return TrackVelocityFactors(WeighBodyParts(skeleton), TrackJoints(skeleton, poses));
}

// The windows of one length with their controls, and what answers them.
class Course {
 public:
  Course(const ClipSet& set, const ModelInfo& model, int frames, int per_clip,
         ProgressBar* progress)
      : set_(set), model_(model), frames_(frames), progress_(progress) {
    chosen_ = ChooseWindows(set, model.history_frames, frames, per_clip);
    for (const EvalWindow& window : chosen_) {
      std::vector<Pose> poses = RealPoses(set, window, frames, 1);
      Window one;
      one.before = poses.front();
      one.real.assign(poses.begin() + 1, poses.end());
      one.path.resize(3, frames);
      for (int t = 0; t < frames; ++t)
        one.path.col(t) = one.real[static_cast<size_t>(t)].root_position;
      one.factors = FactorsOf(model.skeleton, one.before, one.real);
      windows_.push_back(std::move(one));
    }
  }

  const std::vector<Window>& windows() const { return windows_; }

  std::vector<std::vector<Pose>> Dance(const Way& way, double scale = 1) const {
    std::vector<std::vector<Pose>> dances;
    if (way.engine == nullptr) {
      for (const Window& window : windows_) {
        std::vector<Pose> poses;
        for (int t = 0; t < frames_; ++t) {
          Pose pose = InterpolatePoses(window.before, window.real.back(), (t + 1.0) / frames_);
          pose.root_position = window.path.col(t);
          poses.push_back(pose);
        }
        dances.push_back(std::move(poses));
      }
      return dances;
    }
    std::vector<TransitionJob> jobs;
    for (size_t i = 0; i < windows_.size(); ++i) {
      TransitionJob job = JobOf(model_, set_, chosen_[i], frames_,
                                static_cast<float>(model_.default_temperature), i);
      if (way.engine->model().root_path) job.request.controls.root_path = windows_[i].path;
      if (way.engine->model().velocity_factors)
        job.request.controls.velocity_factors = (scale * windows_[i].factors).cast<float>();
      if (!way.finished) {
        job.request.arrival.frames = 0;
        job.request.foot_lock = false;
      }
      jobs.push_back(std::move(job));
    }
    for (const TransitionResult& result : DanceTransitions(*way.engine, jobs, [this](int danced) {
           if (progress_ != nullptr) progress_->Advance(danced);
         })) {
      std::vector<Pose> poses;
      for (const DanceFrame& frame : result.frames) poses.push_back(frame.pose);
      dances.push_back(std::move(poses));
    }
    return dances;
  }

  // One figure a window, with the interval over clips.
  Cell Mean(const std::vector<std::vector<Pose>>& dances,
            const std::function<double(const Window&, const std::vector<Pose>&)>& figure) const {
    std::vector<WindowFigures> figures(dances.size());
    for (size_t i = 0; i < dances.size(); ++i) {
      figures[i].clip = chosen_[i].clip;
      figures[i].l2p = figure(windows_[i], dances[i]);
    }
    return choreo::Mean(figures, &WindowFigures::l2p);
  }

 private:
  const ClipSet& set_;
  const ModelInfo& model_;
  int frames_;
  ProgressBar* progress_;
  std::vector<EvalWindow> chosen_;
  std::vector<Window> windows_;
};

std::vector<Way> WaysOf(const std::vector<Method>& methods) {
  std::vector<Way> ways = {{"interpolation"}};
  for (const Method& method : methods) {
    if (method.kind != Method::Kind::kEngine || !method.keys) continue;
    ways.push_back({method.name + ", network alone", method.engine, false});
    ways.push_back({method.name, method.engine, true});
  }
  return ways;
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

double SkateRatio(const Skeleton& skeleton, double fps, const Window& window,
                  const std::vector<Pose>& danced) {
  std::vector<Pose> poses = {window.before};
  poses.insert(poses.end(), danced.begin(), danced.end());
  std::vector<Pose> real = {window.before};
  real.insert(real.end(), window.real.begin(), window.real.end());
  return MeasureWindow(skeleton, fps, poses, real).skate_ratio;
}

std::vector<Table> PaperTables(const ClipSet& set, const ModelInfo& model,
                               const std::vector<Way>& ways, const EvalOptions& options,
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
    for (const Way& way : ways) table->rows.push_back({{way.name}, {}});
  }
  const Skeleton& skeleton = model.skeleton;
  for (const int frames : kLengths) {
    const Course course(set, model, frames, options.windows_per_clip, progress);
    double straight = 0;
    for (size_t w = 0; w < ways.size(); ++w) {
      const auto dances = course.Dance(ways[w]);
      const auto add = [&](Table* table, const auto& figure) -> const Cell& {
        table->rows[w].cells.push_back(course.Mean(dances, figure));
        return table->rows[w].cells.back();
      };
      const double distance =
          add(&lrp, [&](const Window& window, const std::vector<Pose>& danced) {
            return kCentimetre * RootRelativeDistance(FacingTrack(skeleton, danced),
                                                      FacingTrack(skeleton, window.real));
          }).value;
      if (w == 0) straight = distance;
      ratio.rows[w].cells.push_back({distance / straight, {}});
      add(&turned, [&](const Window& window, const std::vector<Pose>& danced) {
        return kCentimetre * RootRelativeDistance(TrackJoints(skeleton, danced),
                                                  TrackJoints(skeleton, window.real));
      });
      add(&avf, [&](const Window& window, const std::vector<Pose>& danced) {
        const auto factors = FactorsOf(skeleton, window.before, danced);
        return VelocityDeviation(factors, window.factors) < kVelocityTolerance ? 1.0 : 0.0;
      });
      add(&art, [&](const Window& window, const std::vector<Pose>& danced) {
        return RootDeviation(TrackJoints(skeleton, danced), window.path) < kRootTolerance ? 1.0
                                                                                          : 0.0;
      });
      add(&skate, [&](const Window& window, const std::vector<Pose>& danced) {
        return SkateRatio(skeleton, model.fps, window, danced);
      });
    }
  }
  for (Table* table : {&lrp, &avf, &art}) AddAverages(table);
  return {lrp, ratio, turned, avf, art, skate};
}

// Means over windows and frames of the factors that came out over those of the real dance.
Table MultiplierTable(const ClipSet& set, const ModelInfo& model, const std::vector<Way>& ways,
                      const EvalOptions& options, ProgressBar* progress) {
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
  const Course course(set, model, kScaledFrames, options.windows_per_clip, progress);
  Eigen::Matrix<double, kBodyParts, 1> real = Eigen::Matrix<double, kBodyParts, 1>::Zero();
  for (const Window& window : course.windows()) real += window.factors.rowwise().mean();
  for (const Way& way : ways) {
    if (way.engine == nullptr || !way.engine->model().velocity_factors) continue;
    for (const double scale : kScales) {
      const auto dances = course.Dance(way, scale);
      Eigen::Matrix<double, kBodyParts, 1> danced = Eigen::Matrix<double, kBodyParts, 1>::Zero();
      for (size_t i = 0; i < dances.size(); ++i) {
        danced += FactorsOf(model.skeleton, course.windows()[i].before, dances[i]).rowwise().mean();
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

Table RepetitionTable(const ClipSet& set, const ModelInfo& model, const std::vector<Way>& ways,
                      const EvalOptions& options, ProgressBar* progress) {
  Table table = LengthTable("repetition", set, "Repetition and endings",
                            "Shares of half seconds: that repeat one before them, and that hold "
                            "still in the last fifth (repetition.h).",
                            2, {});
  for (const char* what : {"repeated", "still at the end"}) {
    for (const int frames : kLongLengths)
      table.columns.push_back({std::string(what) + ", " + std::to_string(frames), 3});
  }
  std::vector<Way> all = {{"real"}};
  all.insert(all.end(), ways.begin(), ways.end());
  std::vector<std::vector<Cell>> endings(all.size());
  for (const Way& way : all) table.rows.push_back({{way.name}, {}});
  for (const int frames : kLongLengths) {
    const Course course(set, model, frames, options.windows_per_clip, progress);
    for (size_t w = 0; w < all.size(); ++w) {
      std::vector<std::vector<Pose>> dances;
      if (w == 0) {
        for (const Window& window : course.windows()) dances.push_back(window.real);
      } else {
        dances = course.Dance(all[w]);
      }
      const auto last_part = static_cast<int>((1 - kEnding) * frames);
      table.rows[w].cells.push_back(
          course.Mean(dances, [&](const Window&, const std::vector<Pose>& danced) {
            return MeasureRepetition(model.skeleton, danced, model.fps).repeated;
          }));
      endings[w].push_back(course.Mean(dances, [&](const Window&, const std::vector<Pose>& danced) {
        return MeasureRepetition(model.skeleton, danced, model.fps, last_part).frozen;
      }));
    }
  }
  for (size_t w = 0; w < all.size(); ++w)
    table.rows[w].cells.insert(table.rows[w].cells.end(), endings[w].begin(), endings[w].end());
  return table;
}

}  // namespace

std::vector<Table> EvaluateControls(const ClipSet& set, const std::vector<Method>& methods,
                                    const EvalOptions& options, ProgressBar* progress) {
  const ModelInfo* model = Judged(methods);
  if (model == nullptr) return {};
  const std::vector<Way> ways = WaysOf(methods);
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
  for (const Way& way : WaysOf(methods)) {
    if (way.engine == nullptr) continue;
    total += once;
    if (way.engine->model().velocity_factors)
      total += static_cast<int64_t>(std::size(kScales)) * count(kScaledFrames);
  }
  return total;
}

}  // namespace choreo
