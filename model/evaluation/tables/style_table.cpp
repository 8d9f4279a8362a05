#include <algorithm>

#include "model/evaluation/evaluation.h"
#include "model/evaluation/judges/long_plans.h"
#include "model/metrics/style_classifier.h"
#include "model/training/clips/prepared_clip.h"

namespace choreo {
namespace {

constexpr int kSeconds = 20;

// Index of a style among `styles`, or -1.
int StyleIn(const std::vector<std::string>& styles, const std::string& style) {
  const auto found = std::ranges::find(styles, style);
  return found == styles.end() ? -1 : static_cast<int>(found - styles.begin());
}

// The styles that the model accepts and that its training clips contain.
std::vector<std::string> RecordedStyles(const ModelInfo& model, const ClipSet& training) {
  std::vector<std::string> styles;
  for (const std::string& style : model.styles) {
    if (std::ranges::any_of(training.clips,
                            [&](const auto& clip) { return StyleOf(clip.name) == style; }))
      styles.push_back(style);
  }
  return styles;
}

StyleClassifier LearnStyles(const ModelInfo& model, const ClipSet& training,
                            const std::vector<std::string>& styles) {
  CriticWindows seen;
  for (const PreparedClip& clip : training.clips) {
    const int style = StyleIn(styles, StyleOf(clip.name));
    if (style < 0) continue;
    seen.Add(TrackJoints(model.skeleton, clip.motion.frames), model.fps,
             static_cast<size_t>(style));
  }
  return {seen, static_cast<int>(styles.size())};
}

// A dance in each style, from the beginning of each clip.
std::vector<LongPlan> PlanStyles(const Evaluation& evaluation,
                                 const std::vector<std::string>& styles) {
  const ModelInfo& model = evaluation.model();
  const int history = model.history_frames;
  std::vector<LongPlan> plans;
  for (size_t i = 0; i < evaluation.set.clips.size(); ++i) {
    if (std::ssize(evaluation.set.clips[i].motion.frames) < history) continue;
    for (size_t style = 0; style < styles.size(); ++style) {
      LongPlan plan;
      plan.clip = i;
      plan.frames = kSeconds * static_cast<int>(model.fps);
      plan.seed = style;
      plan.history = RealPoses(evaluation.set, {i, history}, 0, history);
      plan.temperature = evaluation.options.temperature;
      plan.style = styles[style];
      plans.push_back(std::move(plan));
    }
  }
  return plans;
}

}  // namespace

std::vector<Table> EvaluateStyles(const Evaluation& evaluation) {
  const ModelInfo& model = evaluation.model();
  if (evaluation.training == nullptr || model.styles.empty()) return {};
  const std::vector<std::string> styles = RecordedStyles(model, *evaluation.training);
  if (styles.size() < 2) return {};
  const StyleClassifier classifier = LearnStyles(model, *evaluation.training, styles);
  const auto recognised = [&](std::span<const Pose> poses, int style) {
    CriticWindows windows;
    windows.Add(TrackJoints(model.skeleton, poses), model.fps, 0);
    const auto right = std::ranges::count_if(
        windows.features, [&](const auto& one) { return classifier.Classify(one) == style; });
    return 100.0 * right / windows.features.size();
  };

  std::vector<ClipFigure> real, danced;
  for (size_t i = 0; i < evaluation.set.clips.size(); ++i) {
    const PreparedClip& clip = evaluation.set.clips[i];
    const int style = StyleIn(styles, StyleOf(clip.name));
    if (style >= 0 && clip.motion.frames.size() > 2 * model.fps)
      real.push_back({i, recognised(clip.motion.frames, style)});
  }
  const std::vector<LongPlan> plans = PlanStyles(evaluation, styles);
  const std::vector<LongDance> dances =
      evaluation.runner.DanceLong(*evaluation.judged().sampler, plans);
  for (size_t i = 0; i < dances.size(); ++i)
    danced.push_back({plans[i].clip, recognised(dances[i].poses, StyleIn(styles, plans[i].style))});
  Table table =
      evaluation.NewTable("liveliness_styles", "Is an asked style recognised", {"figure"});
  table.note =
      "Seconds that a classifier, which has seen the training clips, takes for the style that was "
      "asked for, of " +
      std::to_string(styles.size()) + "; no keys, " + std::to_string(kSeconds) + " s a dance.";
  table.AddRow({"right %"});
  table.Put("real motion", 1, Mean(real));
  table.Put("danced", 1, Mean(danced));
  table.Put("chance", 1, 100.0 / styles.size());
  return {table};
}

}  // namespace choreo
