#include "model/lab/eval_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <optional>
#include <span>

#include "model/core/error.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"
#include "model/core/running/progress.h"
#include "model/engine/engine_choice.h"
#include "model/evaluation/eval_report.h"
#include "model/evaluation/judges/contest.h"
#include "model/evaluation/judges/motion_encoder.h"
#include "model/evaluation/tables/paired_sheets.h"
#include "model/lab/hear_songs.h"
#include "model/papers/tables/paper_tables.h"

namespace choreo {
namespace {

using Evaluate = std::vector<Table> (*)(const Evaluation&);

// In the order of the report.
constexpr Evaluate kPaperControls[] = {EvaluateControls};
constexpr Evaluate kControlTables[] = {EvaluateControls, EvaluateMultipliers, EvaluateRepetition,
                                       EvaluateDrawnPaths};
constexpr Evaluate kLiveliness[] = {EvaluateLiveliness, EvaluateStyles, EvaluateNearness};
constexpr Evaluate kPaper[] = {EvaluatePaperTransitions, EvaluatePaperDances};
constexpr Evaluate kAll[] = {EvaluateControls,   EvaluateMultipliers, EvaluateRepetition,
                             EvaluateDrawnPaths, EvaluateLiveliness,  EvaluateStyles,
                             EvaluateNearness,   EvaluateTransitions, EvaluateLongDances,
                             EvaluateEncoded,    EvaluateStress};

struct Arguments {
  ContestOptions contest;
  std::vector<std::filesystem::path> data;
  std::filesystem::path splits;
  std::string split = "validation";
  std::filesystem::path json;
  EvalOptions options;
  float temperature = -1;
  std::span<const Evaluate> tables = kAll;
  bool controls = false;  // only the tables about controls, which have their own lengths
  bool encode = true, sheets = false;
  std::vector<std::filesystem::path> music;
};

void WarnOfEmptyLengths(const std::vector<ClipSet>& sets, int history,
                        const std::vector<int>& lengths) {
  for (const ClipSet& set : sets) {
    for (const int frames : lengths) {
      if (!ChooseWindows(set, history, frames, 1).empty()) continue;
      std::fprintf(stderr,
                   "choreo-lab: --lengths: no clip of %s has %d frames after a history of %d, so "
                   "there are no rows\n",
                   set.name.c_str(), frames, history);
    }
  }
}

void CheckLengths(const std::vector<Method>& methods, const std::vector<int>& lengths) {
  const int longest = std::ranges::max(lengths);
  for (const Method& method : methods) {
    // Other engines have the judged one's limit, and their names are built in.
    if (!method.Judged()) continue;
    const ModelInfo& model = method.sampler->model();
    if (longest <= model.max_transition_frames) continue;
    const std::string option = &method == &methods.back() ? "--model" : "--other " + method.name;
    throw InvalidArgument("--lengths", std::to_string(longest) + " frames are more than the " +
                                           std::to_string(model.max_transition_frames) + " that " +
                                           option + " (" + model.name + ") takes");
  }
}

// CLI::Range accepts NaN.
std::string CheckTemperature(const std::string& text) {
  float value = 0;
  if (CLI::detail::lexical_cast(text, value) && value >= 0 && value <= kMaxTemperature) return "";
  return "'" + text + "' is not a number from 0 to " + Rounded(kMaxTemperature);
}

std::string Summary(const Arguments& arguments, const Contest& contest) {
  const ModelInfo& model = contest.judged().model();
  char temperature[32];
  std::snprintf(temperature, sizeof(temperature), "%.2f", arguments.options.temperature);
  return "Model " + model.name + "/" + model.weights + ", " + arguments.split +
         " clips, temperature " + temperature +
         " unless a row says otherwise. Engine: " + contest.engine + ".";
}

std::vector<Table> MakeTables(const std::vector<ClipSet>& sets, const Contest& contest,
                              const MotionEncoder* encoder, const std::vector<ClipSet>& training,
                              const Arguments& arguments) {
  std::vector<Table> tables;
  ProgressBar progress("evaluating", 0);
  for (size_t i = 0; i < sets.size(); ++i) {
    const ClipSet& set = sets[i];
    const Runner runner([&](int frames) { progress.Advance(frames, "frames, " + set.name); });
    const Evaluation evaluation{set,    contest.methods, arguments.options,
                                runner, encoder,         training.empty() ? nullptr : &training[i]};
    for (const Evaluate evaluate : arguments.tables)
      std::ranges::move(evaluate(evaluation), std::back_inserter(tables));
  }
  progress.Finish();
  // Every table states the engine, because pages quote single tables.
  for (Table& table : tables)
    table.note += (table.note.empty() ? "Engine: " : " Engine: ") + contest.engine + ".";
  return tables;
}

void EvaluateAll(Arguments arguments) {
  // Check everything before the long work.
  SetNames(arguments.data);
  if (!arguments.json.empty()) CheckReportPath(arguments.json);
  const Contest contest = MakeContest(arguments.contest);
  const ModelInfo& model = contest.judged().model();
  EvalOptions& options = arguments.options;
  if (arguments.controls && !model.Supports(kRootPath))
    throw InvalidArgument("--controls", model.name + " takes none");
  if (!arguments.controls) CheckLengths(contest.methods, options.lengths);
  options.own_temperatures = arguments.temperature < 0;
  options.temperature = arguments.temperature >= 0 ? arguments.temperature
                                                   : static_cast<float>(model.default_temperature);
  const auto sets = LoadSets(arguments.data, arguments.splits, arguments.split, model.skeleton);
  std::vector<ClipSet> training;
  if (!arguments.controls) {
    WarnOfEmptyLengths(sets, model.history_frames, options.lengths);
    training = LoadSets(arguments.data, arguments.splits, kTrainGroup, model.skeleton);
  }
  std::optional<MotionEncoder> encoder;
  if (arguments.encode && (std::ranges::count(arguments.tables, &EvaluateEncoded) > 0 ||
                           std::ranges::count(arguments.tables, &EvaluatePaperDances) > 0))
    encoder.emplace(training);
  const std::vector<Table> tables =
      MakeTables(sets, contest, encoder ? &*encoder : nullptr, training, arguments);
  const std::string summary = Summary(arguments, contest);
  std::printf("%s\n", summary.c_str());
  for (const Table& table : tables) std::printf("\n%s", ToMarkdown(table).c_str());
  if (arguments.json.empty()) return;
  WriteReport(arguments.json,
              {{"model", model.name},
               {"fingerprint", model.fingerprint},
               {"split", arguments.split},
               {"temperature", options.temperature},
               {"engine", contest.engine},
               {"summary", summary}},
              tables);
  if (!arguments.sheets) return;
  for (const ClipSet& set : sets)
    DrawPairedSheets(set, contest.methods.back(), options.temperature, arguments.json);
}

using SharedArguments = std::shared_ptr<Arguments>;

// The model, its data and outputs.
void AddInputs(const SharedArguments& arguments, CLI::App* command) {
  command->add_option("--model", arguments->contest.model, "Checkpoint")->required();
  CLI::Option* data = command->add_option(
      "--data", arguments->data,
      "Folders written by `choreo-lab prepare`: each is a set with its own tables");
  CLI::Option* splits = command->add_option("--splits", arguments->splits,
                                            "Which clip trains, validates, tests (JSON)");
  data->needs(splits);
  splits->needs(data);
  command
      ->add_option("--music", arguments->music,
                   "Measure hearing instead of clips, with made songs and these (files or folders)")
      ->check(CLI::ExistingPath)
      ->excludes(data);
  command->add_option("--other", arguments->contest.others,
                      "NAME=CHECKPOINT: a row for another model, danced like the first");
  command->add_option("--json", arguments->json,
                      "Also write the figures here, and plots beside it");
  command
      ->add_flag("--sheets", arguments->sheets,
                 "Also draw each clip beside the dance through its poses, next to the JSON; a "
                 "text file says which is which")
      ->needs("--json");
}

// The choice of tables.
void AddTableChoice(const SharedArguments& arguments, CLI::App* command) {
  command->add_flag("!--no-encoder", arguments->encode,
                    "Skip FID, variability and diversity, which learn an encoder from the "
                    "training clips of the data");
  command
      ->add_option_function<std::string>(
          "--controls",
          [arguments](const std::string& which) {
            arguments->controls = true;
            arguments->tables = kPaperControls;
            if (which == "all") arguments->tables = kControlTables;
          },
          "all | paper: only the tables of controls, or only paper C's; they have their own "
          "lengths")
      ->check(CLI::IsMember({"all", "paper"}));
  command
      ->add_flag_callback(
          "--liveliness", [arguments] { arguments->tables = kLiveliness; },
          "Only the tables of liveliness")
      ->excludes("--controls");
  command
      ->add_flag_callback(
          "--paper", [arguments] { arguments->tables = kPaper; },
          "Only paper F's tables, every row raw and as served, at its own temperature")
      ->excludes("--controls")
      ->excludes("--liveliness");
}

// Options whose defaults --help shows: rows and sizes of tables.
void AddTableOptions(const SharedArguments& arguments, CLI::App* command) {
  EvalOptions& options = arguments->options;
  command->add_option("--split", arguments->split,
                      "The group to measure: validation | test | any other group of clips "
                      "in the file, such as test_unseen_genre");
  command
      ->add_option("--baseline", arguments->contest.baselines,
                   "Further rows of the tables: \"real\" by real, \"interpolation\" and "
                   "\"interpolation, footwork\" by interpolation, \"model without keys\" by "
                   "music_only")
      ->check(CLI::IsMember({"real", "interpolation", "music_only"}));
  command->add_option("--name", arguments->contest.name, "Name of the rows of --model");
  command
      ->add_option("--engine", arguments->contest.engine,
                   EngineKindNames() +
                       "; packed is float32 on any CPU; torch always runs deterministic "
                       "networks")
      ->check(CLI::IsMember(
          std::vector<std::string>(kEngineKindNames.begin(), kEngineKindNames.end())));
  command
      ->add_option("--lengths", options.lengths,
                   "Frames of the transitions, within every model's limit: 150 for the preset "
                   "default")
      ->check(CLI::Range(1, kMaxTransitionFrames));
  const auto count = [&](const char* name, int& value, int least, int most, const char* what) {
    command->add_option(name, value, what)->take_last()->check(CLI::Range(least, most));
  };
  count("--windows", options.windows_per_clip, 1, 100000, "Transitions per clip and length");
  count("--best-of", options.best_of, 0, 1000,
        "Samples per transition, of which the nearest counts");
  count("--long-dances", options.long_seeds, 0, 100000, "Long dances of each kind; 0: none");
  count("--long-frames", options.long_frames, 60, 100000, "Frames of a long dance");
  count("--free-dances", options.free_dances, 0, 100000,
        "Dances without keys in the liveliness table; 0: none");
}

}  // namespace

void AddEvalCommand(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("eval", "Measure a model on held-out clips, as it is served");
  AddInputs(arguments, command);
  AddTableChoice(arguments, command);
  command->add_option("--temperature", arguments->temperature, "Instead of the model's own")
      ->check(CheckTemperature);
  command->option_defaults()->always_capture_default();
  AddTableOptions(arguments, command);
  command->callback([arguments] {
    if (!arguments->music.empty())
      return HearSongs({arguments->contest.model, arguments->music, arguments->json});
    if (arguments->data.empty()) throw CLI::RequiredError("--data and --splits, or --music");
    EvaluateAll(*arguments);
  });
}

}  // namespace choreo
