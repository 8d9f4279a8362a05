#include "model/papers/tables/paper_tables.h"

#include <algorithm>
#include <cmath>

#include "model/evaluation/judges/encoded_figures.h"
#include "model/evaluation/judges/long_plans.h"
#include "model/evaluation/judges/transition_judge.h"
#include "model/evaluation/tables/beat_table.h"
#include "model/metrics/pose_distance.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

// Each method, preceded by its raw network.
std::vector<Method> WithRaw(const std::vector<Method>& methods) {
  std::vector<Method> all;
  for (const Method& method : methods) {
    if (method.kind == Method::Kind::kModel && method.network) {
      all.push_back(method);
      all.back().name += ", raw";
      all.back().finished = false;
    }
    all.push_back(method);
  }
  return all;
}

bool HasMusic(const ClipSet& set) {
  return std::ranges::any_of(set.clips, [](const auto& clip) { return clip.audio.cols() > 0; });
}

// The beats and keys of one long dance.
struct LongScore {
  size_t clip = 0;
  BeatFigures beats;
  double key_m2 = NAN, key_m = NAN;  // mean over keys, of squares; of the norm over all joints
};

LongScore ScoreDance(const Evaluation& evaluation, const LongPlan& plan,
                     const std::vector<Pose>& poses) {
  const Skeleton& skeleton = evaluation.model().skeleton;
  const JointTrack track = TrackJoints(skeleton, poses);
  const double fps = evaluation.model().fps;
  LongScore score{.clip = plan.clip, .beats = {}};
  score.beats = ScoreBeats(MeanSpeeds(track, fps), plan.beats, fps);
  double squares = 0, norms = 0;
  for (const auto& [frame, key] : plan.keys) {
    const Eigen::Matrix3Xd key_joints = JointPositions(skeleton, key);
    squares += KeyPoseDistance(track[static_cast<size_t>(frame)], key_joints);
    norms += (track[static_cast<size_t>(frame)] - key_joints).norm();
  }
  if (const auto keys = static_cast<double>(plan.keys.size()); keys > 0) {
    score.key_m2 = squares / keys;
    score.key_m = norms / keys;
  }
  return score;
}

std::vector<LongScore> ScoreDances(const Evaluation& evaluation, const Method& method,
                                   KeyTimes times) {
  std::vector<LongPlan> plans =
      PlanLongDances(evaluation.model(), evaluation.set, method.keys ? times : KeyTimes::kNone,
                     evaluation.options.long_seeds, evaluation.options);
  std::vector<LongScore> scores;
  if (method.kind == Method::Kind::kReal) {
    for (LongPlan& plan : plans) {
      plan.keys.clear();
      scores.push_back(ScoreDance(evaluation, plan, RealMotionBeside(plan, evaluation.set)));
    }
    return scores;
  }
  for (LongPlan& plan : plans) {
    plan.temperature = evaluation.TemperatureOf(method);
    plan.finished = method.finished;
  }
  const std::vector<LongDance> dances = evaluation.runner.DanceLong(*method.sampler, plans);
  for (size_t i = 0; i < dances.size(); ++i)
    scores.push_back(ScoreDance(evaluation, plans[i], dances[i].poses));
  return scores;
}

Cell HitRate(const std::vector<LongScore>& scores) {
  return Mean(scores, [](const auto& one) { return 100 * one.beats.hit_rate; });
}

// Table 1, and Table 4's row of the same method.
void AddLongRows(const Evaluation& evaluation, const Method& method, Table* table, Table* beats) {
  const bool dances = method.kind != Method::Kind::kInterpolation;
  const bool music = HasMusic(evaluation.set);
  const std::vector<LongScore> equal =
      dances ? ScoreDances(evaluation, method, KeyTimes::kEqual) : std::vector<LongScore>{};
  if (!dances) return;
  const EncodedFigures encoded = MeasureEncoded(evaluation, method);
  const bool keyed = method.keys && method.kind == Method::Kind::kModel;
  table->AddRow({method.name});
  table->Put("beat hit rate %", 1, music ? HitRate(equal) : Cell());
  table->Put("coverage", 2,
             music ? Mean(equal, [](const auto& one) { return one.beats.coverage; }) : Cell());
  table->Put("FID", 2, encoded.fid);
  table->Put("KPD cm²", 1, keyed ? Mean(equal, &LongScore::key_m2, 1e4) : Cell());
  table->Put("key norm cm", 1, keyed ? Mean(equal, &LongScore::key_m, 100) : Cell());
  table->Put("variability", 2, encoded.variability);
  table->Put("diversity", 1, encoded.diversity);
  if (!music || !keyed) return;
  const std::vector<LongScore> on_beats = ScoreDances(evaluation, method, KeyTimes::kOnBeats);
  beats->AddRow({method.name});
  beats->Put("keys each 100 frames %", 1, HitRate(equal));
  beats->Put("as many keys, on beats %", 1, HitRate(on_beats));
}

}  // namespace

std::vector<Table> EvaluatePaperTransitions(const Evaluation& evaluation) {
  Table table = evaluation.NewTable("paper_l2p", "Paper F, Table 2: L2P", {"method"});
  table.note = "Mean of " + std::to_string(std::max(1, evaluation.options.best_of)) +
               " samples; cm a joint, and over interpolation's; norm: of all joints at once, as in "
               "Eq. 10, over interpolation's.";
  struct Length {
    int frames;
    Figures line;
    TransitionJudge judge;
  };
  std::vector<Length> lengths;
  for (const int frames : evaluation.options.lengths) {
    TransitionJudge judge(evaluation, evaluation.model(), frames);
    if (judge.windows().empty()) continue;
    const Figures line = judge.Interpolation();
    lengths.push_back({frames, line, judge});
  }
  for (const Method& method : WithRaw(evaluation.methods)) {
    if (method.kind == Method::Kind::kReal) continue;
    table.AddRow({method.name});
    for (const Length& length : lengths) {
      const bool samples = method.kind == Method::Kind::kModel && method.network;
      const int count = samples ? std::max(1, evaluation.options.best_of) : 1;
      std::vector<ClipFigure> way, norm, line, line_norm;
      for (int sample = 0; sample < count; ++sample) {
        for (const WindowFigures& window : length.judge.Run(
                 method, evaluation.TemperatureOf(method), static_cast<uint32_t>(sample))) {
          way.push_back({window.clip, 100 * window.l2p});
          norm.push_back({window.clip, 100 * window.l2p_norm});
        }
        for (const WindowFigures& window : length.line) {
          line.push_back({window.clip, 100 * window.l2p});
          line_norm.push_back({window.clip, 100 * window.l2p_norm});
        }
      }
      const std::string n = std::to_string(length.frames);
      table.Put("cm at " + n, 1, Mean(way));
      table.Put("÷ interpolation at " + n, 2, Ratio(way, line));
      table.Put("norm ÷ interpolation's at " + n, 2, Ratio(norm, line_norm));
    }
  }
  return {table};
}

std::vector<Table> EvaluatePaperDances(const Evaluation& evaluation) {
  if (evaluation.options.long_seeds == 0) return {};
  Table table = evaluation.NewTable("paper_dances", "Paper F, Table 1", {"method"});
  table.note =
      "Keys are the clip's own poses each 100 frames. KPD: mean squared distance of joints at "
      "keys; key norm: of all joints at once. FID, variability and diversity of dances of 10 s "
      "with a key each 2 s, in codes of an encoder of our own.";
  Table beats = evaluation.NewTable("paper_beats", "Paper F, Table 4: beat hit rate", {"method"});
  beats.note = "Keys at equal distances, and each on the beat nearest to there.";
  for (const Method& method : WithRaw(evaluation.methods))
    AddLongRows(evaluation, method, &table, &beats);
  if (beats.rows.empty()) return {table};
  return {table, beats};
}

}  // namespace choreo
