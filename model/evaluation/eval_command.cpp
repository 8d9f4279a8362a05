#include "model/evaluation/eval_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "model/core/error.h"
#include "model/engine/torch_engine.h"
#include "model/evaluation/evaluation.h"
#include "model/training/clip_split.h"

namespace choreo {
namespace {

struct EvalOptions {
  std::filesystem::path model;
  std::vector<std::filesystem::path> data;
  std::filesystem::path splits;
  std::string split = "validation";
  std::filesystem::path json;
  std::vector<int> lengths = {10, 30, 60, 90};
  int windows_per_clip = 4;
  int long_frames = 600;
  int long_dances = 5;
  float temperature = -1;
};

nlohmann::json EvaluateTable(StepEngine& engine, const std::vector<PreparedClip>& clips,
                             const EvalOptions& options) {
  nlohmann::json table = nlohmann::json::array();
  std::printf("%6s %7s %10s %8s %6s | %-28s | %9s %9s | %-24s | %-13s\n", "frames", "windows",
              "interp. cm", "model cm", "ratio", "raw key cm: mean median worst", "final mm",
              "final deg", "m/s^2: p95 (real) max (real)", "skate (real)");
  for (const int frames : options.lengths) {
    const TransitionRow row =
        EvaluateTransitions(engine, clips, frames, options.windows_per_clip, options.temperature);
    std::printf(
        "%6d %7d %10.2f %8.2f %6.3f | %12.2f %6.2f %7.2f   | %9.4f %9.5f | %7.1f (%5.1f) %5.0f "
        "(%4.0f) | %4.2f (%4.2f)\n",
        row.frames, row.windows, 100 * row.interpolation_m, 100 * row.model_m, row.ratio(),
        100 * row.raw_key_m, 100 * row.raw_key_median_m, 100 * row.raw_key_worst_m,
        1000 * row.final_key_m, row.final_key_deg, row.p95_acceleration, row.real_p95_acceleration,
        row.max_acceleration, row.real_max_acceleration, row.skate_ratio, row.real_skate_ratio);
    table.push_back({{"frames", row.frames},
                     {"windows", row.windows},
                     {"interpolation_m", row.interpolation_m},
                     {"model_m", row.model_m},
                     {"ratio", row.ratio()},
                     {"raw_key_m", row.raw_key_m},
                     {"raw_key_median_m", row.raw_key_median_m},
                     {"raw_key_worst_m", row.raw_key_worst_m},
                     {"worst_window", row.worst_window},
                     {"final_key_m", row.final_key_m},
                     {"final_key_deg", row.final_key_deg},
                     {"p95_acceleration", row.p95_acceleration},
                     {"real_p95_acceleration", row.real_p95_acceleration},
                     {"max_acceleration", row.max_acceleration},
                     {"real_max_acceleration", row.real_max_acceleration},
                     {"skate_ratio", row.skate_ratio},
                     {"real_skate_ratio", row.real_skate_ratio},
                     {"log_likelihood", row.mean_log_likelihood}});
  }
  return table;
}

nlohmann::json EvaluateLong(StepEngine& engine, const std::vector<PreparedClip>& clips,
                            const EvalOptions& options) {
  const SpeedRange real = MeasureRealSpeeds(clips);
  std::printf("\nreal motion: median speed %.2f m/s, hinges bent backwards %.3f %%\n", real.median,
              100 * real.bent_backwards);
  std::printf("%-20s %5s %7s %7s %7s %8s %13s %10s %9s %8s\n", "long dance from", "keys", "finite",
              "median", "late", "reach m", "root height", "backwards", "in range", "key mm");
  nlohmann::json rows = nlohmann::json::array();
  const size_t stride =
      std::max<size_t>(1, clips.size() / static_cast<size_t>(options.long_dances));
  for (size_t i = 0; i < clips.size() && rows.size() < 2 * static_cast<size_t>(options.long_dances);
       i += stride) {
    for (const int interval : {60, 0}) {
      const LongDanceRow row = EvaluateLongDance(engine, clips[i], options.long_frames, interval,
                                                 options.temperature, i, real);
      std::printf("%-20s %5s %7s %7.2f %7.2f %8.1f %6.2f-%6.2f %8.3f %% %7.0f %% %8.4f\n",
                  clips[i].name.c_str(), interval > 0 ? "2 s" : "none", row.finite ? "yes" : "NO",
                  row.median_speed, row.late_speed, row.root_reach_m, row.lowest_m, row.highest_m,
                  100 * row.bent_backwards, 100 * row.joints_in_real_speed, 1000 * row.worst_key_m);
      rows.push_back({{"clip", clips[i].name},
                      {"key_interval", interval},
                      {"finite", row.finite},
                      {"median_speed", row.median_speed},
                      {"late_speed", row.late_speed},
                      {"root_reach_m", row.root_reach_m},
                      {"bent_backwards", row.bent_backwards},
                      {"joints_in_real_speed", row.joints_in_real_speed},
                      {"worst_key_m", row.worst_key_m}});
    }
  }
  return {{"real_median_speed", real.median},
          {"real_bent_backwards", real.bent_backwards},
          {"dances", rows}};
}

void Evaluate(EvalOptions options) {
  const Split split = options.split == "test" ? Split::kTest : Split::kValidation;
  const auto engine = MakeTorchEngine(options.model, Device{}, 1);
  if (options.temperature < 0)
    options.temperature = static_cast<float>(engine->model().default_temperature);
  const std::vector<PreparedClip> clips = LoadClips(options.data, options.splits, split);
  const Skeleton& skeleton = engine->model().skeleton;
  if (!(clips.front().skeleton == skeleton)) {
    throw InvalidArgument("--data", "the clips' skeleton is " + clips.front().skeleton.Describe() +
                                        ", the model's " + skeleton.Describe());
  }
  std::map<std::string, std::vector<PreparedClip>> sets;
  for (const PreparedClip& clip : clips) sets[clip.source].push_back(clip);
  nlohmann::json report = {{"model", engine->model().name},
                           {"fingerprint", engine->model().fingerprint},
                           {"split", options.split},
                           {"temperature", options.temperature}};
  for (const auto& [source, members] : sets) {
    std::printf("%s, %s clips (%zu), temperature %.2f\n", source.c_str(), options.split.c_str(),
                members.size(), options.temperature);
    report["sets"][source]["transitions"] = EvaluateTable(*engine, members, options);
    report["sets"][source]["long"] = EvaluateLong(*engine, members, options);
    std::printf("\n");
  }
  if (!options.json.empty()) {
    std::ofstream file(options.json);
    file << report.dump(1) << "\n";
    if (!file) throw Error(ErrorCode::kInternal, options.json.string(), "can't be written");
  }
}

}  // namespace

void AddEvalCommand(CLI::App& app) {
  auto options = std::make_shared<EvalOptions>();
  CLI::App* command =
      app.add_subcommand("eval", "Measure a model on held-out clips, as it is served");
  command->add_option("--model", options->model, "Checkpoint")->required();
  command->add_option("--data", options->data, "Folders written by `choreo-lab prepare`")
      ->required();
  command->add_option("--splits", options->splits, "Which clip trains, validates, tests (JSON)")
      ->required();
  command->add_option("--split", options->split, "validation | test")
      ->capture_default_str()
      ->check(CLI::IsMember({"validation", "test"}));
  command->add_option("--json", options->json, "Also write the figures here");
  command->add_option("--lengths", options->lengths, "Frames of the transitions")
      ->capture_default_str();
  command->add_option("--windows", options->windows_per_clip, "Transitions a clip and length")
      ->capture_default_str();
  command->add_option("--long-frames", options->long_frames, "Frames of a long dance")
      ->capture_default_str();
  command
      ->add_option("--long-dances", options->long_dances,
                   "Long dances a set, with and without keys")
      ->capture_default_str();
  command->add_option("--temperature", options->temperature, "Instead of the model's own");
  command->callback([options] { Evaluate(*options); });
}

}  // namespace choreo
