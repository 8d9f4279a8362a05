#include "model/evaluation/eval_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>

#include "model/core/error.h"
#include "model/engine/engine_kind.h"
#include "model/evaluation/contest.h"
#include "model/evaluation/control_tables.h"
#include "model/evaluation/encoder_table.h"
#include "model/evaluation/eval_report.h"
#include "model/evaluation/liveliness_table.h"
#include "model/evaluation/long_tables.h"
#include "model/evaluation/method_sheet.h"
#include "model/evaluation/paired_sheets.h"
#include "model/evaluation/stress_table.h"
#include "model/evaluation/transition_tables.h"

namespace choreo {
namespace {

enum class Scope { kAll, kControls, kLiveliness };

struct Arguments {
  ContestOptions contest;
  std::vector<std::filesystem::path> data;
  std::filesystem::path splits;
  std::string split = "validation";
  ReportPaths paths;
  EvalOptions options;
  float temperature = -1;
  Scope scope = Scope::kAll;
  bool encode = true, sheets = false;  // of the tables
};

// Beside the progress on stderr.
void Warn(const std::string& what) { std::fprintf(stderr, "choreo-lab: %s\n", what.c_str()); }

void WarnOfEmptyLengths(const std::vector<ClipSet>& sets, int history,
                        const std::vector<int>& lengths) {
  for (const ClipSet& set : sets) {
    for (const int frames : lengths) {
      if (!ChooseWindows(set, history, frames, 1).empty()) continue;
      Warn("--lengths: no clip of " + set.name + " has " + std::to_string(frames) +
           " frames behind a history of " + std::to_string(history) + ", so there are no rows");
    }
  }
}

void CheckLengths(const std::vector<Method>& methods, const std::vector<int>& lengths) {
  const int longest = std::ranges::max(lengths);
  for (const Method& method : methods) {
    // The other engines have the limit of the judged one, and names that nobody gave them.
    if (method.kind != Method::Kind::kEngine || !method.network || !method.keys) continue;
    const ModelInfo& model = method.engine->model();
    if (longest <= model.max_transition_frames) continue;
    const std::string option = method.name == kServed ? "--model" : "--other " + method.name;
    throw InvalidArgument("--lengths", std::to_string(longest) + " frames are more than the " +
                                           std::to_string(model.max_transition_frames) + " that " +
                                           option + " (" + model.name + ") takes");
  }
}

// CLI::Range lets NaN pass.
std::string CheckTemperature(const std::string& text) {
  float value = 0;
  if (CLI::detail::lexical_cast(text, value) && value >= 0 && value <= 2) return "";
  return "'" + text + "' is not a number from 0 to 2";
}

std::string Summary(const Arguments& arguments, const Contest& contest) {
  // Of the fingerprint the model's part; builds differ, figures hardly.
  const std::string& print = contest.judged().model().fingerprint;
  char temperature[32];
  std::snprintf(temperature, sizeof(temperature), "%.2f", arguments.options.temperature);
  return "Model " + print.substr(0, print.find('/', print.find('/') + 1)) + ", " + arguments.split +
         " clips, temperature " + temperature +
         " unless a row says otherwise. Engine: " + contest.stepped_by + ".";
}

// Of a set: those that are judged by themselves, not beside others.
std::vector<const Method*> Judged(const std::vector<Method>& methods) {
  std::vector<const Method*> judged;
  for (const Method& method : methods) {
    if (method.kind == Method::Kind::kEngine && method.network && method.keys)
      judged.push_back(&method);
  }
  return judged;
}

int64_t CountFrames(const ClipSet& set, const Contest& contest, bool encode, Scope scope,
                    const EvalOptions& options) {
  const std::vector<Method>& methods = contest.methods;
  int64_t frames = 0;
  if (scope != Scope::kLiveliness) frames += CountControlFrames(set, methods, options);
  if (scope != Scope::kControls) {
    for (const Method* method : Judged(methods))
      frames += CountLivelyFrames(set, method->engine->model(), options);
  }
  if (scope != Scope::kAll) return frames;
  if (encode) frames += CountEncodedFrames(set, methods, options);
  return frames + CountTransitionFrames(set, methods, options) +
         CountLongFrames(set, contest.judged().model(), options);
}

std::vector<Table> MakeTables(const std::vector<ClipSet>& sets, const Contest& contest,
                              const std::optional<MotionEncoder>& encoder, Scope scope,
                              const EvalOptions& options) {
  StepEngine& judged = contest.judged();
  int64_t frames = 0;
  for (const ClipSet& set : sets)
    frames += CountFrames(set, contest, encoder.has_value(), scope, options);
  std::vector<Table> tables;
  const auto add = [&](std::vector<Table> more) {
    std::ranges::move(more, std::back_inserter(tables));
  };
  ProgressBar progress("evaluating", frames);
  for (const ClipSet& set : sets) {
    if (scope != Scope::kLiveliness)
      add(EvaluateControls(set, contest.methods, options, &progress));
    if (scope != Scope::kControls) {
      for (const Method* method : Judged(contest.methods))
        add(EvaluateLiveliness(set, *method, options, &progress));
    }
    if (scope != Scope::kAll) continue;
    add(EvaluateTransitions(set, contest.methods, options, &progress));
    add(EvaluateLongDances(set, judged, options, &progress));
    if (encoder) add({EvaluateEncoded(set, contest.methods, *encoder, options, &progress)});
    add({EvaluateStress(set, judged, options)});
  }
  progress.Finish();
  // Every table says it of itself: they get quoted one by one.
  for (Table& table : tables)
    table.note += (table.note.empty() ? "Engine: " : " Engine: ") + contest.stepped_by + ".";
  return tables;
}

void DrawSheets(const Arguments& arguments, const Contest& contest,
                const std::vector<ClipSet>& sets) {
  const float temperature = arguments.options.temperature;
  for (const ClipSet& set : sets) {
    if (arguments.scope == Scope::kLiveliness) {
      const auto png = [&](const std::string& clip) {
        return arguments.paths.Picture("pair_" + set.name + "_" + clip);
      };
      const std::string answers = DrawPairedSheets(set, contest.methods.back(), temperature, png);
      std::ofstream(arguments.paths.Picture("pair_" + set.name).replace_extension(".txt"))
          << answers;
      continue;
    }
    for (const Method& method : contest.methods) {
      DrawMethodSheet(set, method, contest.judged().model(), temperature,
                      arguments.paths.Picture("sheet_" + set.name + "_" + method.name));
    }
  }
}

void Evaluate(Arguments arguments) {
  // What can be refused is refused before the long work.
  SetNames(arguments.data);
  CheckReportPaths(arguments.paths);
  if (!arguments.paths.markdown.empty() && arguments.paths.json.empty())
    Warn("--markdown: no plots without --json, beside which they are drawn");
  const Contest contest = MakeContest(arguments.contest);
  const ModelInfo& model = contest.judged().model();
  EvalOptions& options = arguments.options;
  const bool controls = arguments.scope == Scope::kControls;
  if (controls && !model.root_path) throw InvalidArgument("--controls", model.name + " takes none");
  if (!controls) CheckLengths(contest.methods, options.lengths);
  options.temperature = arguments.temperature >= 0 ? arguments.temperature
                                                   : static_cast<float>(model.default_temperature);
  const auto sets = LoadSets(arguments.data, arguments.splits, arguments.split, model.skeleton);
  if (!controls) WarnOfEmptyLengths(sets, model.history_frames, options.lengths);
  std::optional<MotionEncoder> encoder;
  if (arguments.encode && arguments.scope == Scope::kAll) {
    encoder = MotionEncoder::Train(
        LoadSets(arguments.data, arguments.splits, kTrainGroup, model.skeleton));
  }
  std::vector<Table> tables = MakeTables(sets, contest, encoder, arguments.scope, options);
  NameJudged(arguments.contest.name, &tables);
  const std::string summary = Summary(arguments, contest);
  std::printf("%s\n", summary.c_str());
  for (const Table& table : tables) std::printf("\n%s", ToMarkdown(table).c_str());
  WriteReport(arguments.paths,
              {model.name, model.fingerprint, arguments.split, contest.stepped_by, summary,
               options.temperature},
              tables);
  if (arguments.sheets) DrawSheets(arguments, contest, sets);
}

}  // namespace

void AddEvalCommand(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  EvalOptions& options = arguments->options;
  CLI::App* command =
      app.add_subcommand("eval", "Measure a model on held-out clips, as it is served");
  command->add_option("--model", arguments->contest.model, "Checkpoint")->required();
  command
      ->add_option("--data", arguments->data,
                   "Folders written by `choreo-lab prepare`: each is a set with tables of its own")
      ->required();
  command->add_option("--splits", arguments->splits, "Which clip trains, validates, tests (JSON)")
      ->required();
  command
      ->add_option("--split", arguments->split,
                   "Which of them is measured: validation | test | any other group of clips that "
                   "the file names, such as test_unseen_genre")
      ->capture_default_str();
  command
      ->add_option("--baseline", arguments->contest.baselines,
                   "Further rows of the tables: \"real\" by real, "
                   "\"interpolation\" and \"interpolation, foot lock\" by interpolation, "
                   "\"model without keys\" by music_only")
      ->capture_default_str()
      ->check(CLI::IsMember({"real", "interpolation", "music_only"}));
  command->add_option("--other", arguments->contest.others,
                      "NAME=CHECKPOINT: a row for another model, danced just as the first");
  command->add_option("--name", arguments->contest.name, "What the rows of --model are called")
      ->capture_default_str();
  command
      ->add_option("--engine", arguments->contest.engine,
                   EngineKindNames() +
                       "; packed is float32 on any CPU; what is not paper F's flow is run by torch "
                       "all the same")
      ->capture_default_str()
      ->check(CLI::IsMember(
          std::vector<std::string>(kEngineKindNames.begin(), kEngineKindNames.end())));
  command->add_option("--json", arguments->paths.json,
                      "Also write the figures here, and plots beside it");
  command
      ->add_flag("--sheets", arguments->sheets,
                 "Also draw ten random transitions of each method beside the JSON; of --liveliness "
                 "each clip beside the real one, which of the two is which in a text file")
      ->needs("--json");
  command->add_option("--markdown", arguments->paths.markdown,
                      "Also write the tables here; they show plots if there is a --json");
  command
      ->add_option("--lengths", options.lengths,
                   "Frames of the transitions, at most as many as every model takes: 150 of the "
                   "presets default and recurrent")
      ->capture_default_str()
      ->check(CLI::Range(1, 1800));
  command->add_option("--windows", options.windows_per_clip, "Transitions a clip and length")
      ->take_last()
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  command
      ->add_option("--best-of", options.best_of, "Samples a transition at temperature 1; 0: none")
      ->take_last()
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  command->add_option("--long-dances", options.long_seeds, "Long dances of each kind; 0: none")
      ->take_last()
      ->capture_default_str()
      ->check(CLI::Range(0, 100000));
  command->add_option("--long-frames", options.long_frames, "Frames of a long dance")
      ->take_last()
      ->capture_default_str()
      ->check(CLI::Range(60, 100000));
  command->add_flag("!--no-encoder", arguments->encode,
                    "No FID, variability and diversity, for which an encoder is learnt from the "
                    "training clips of the data");
  command
      ->add_option_function<std::string>(
          "--controls",
          [arguments](const std::string& which) {
            arguments->scope = Scope::kControls;
            arguments->options.all_controls = which == "all";
          },
          "all | paper: only the tables of controls, or of those paper C's alone; they have "
          "lengths "
          "of their own")
      ->check(CLI::IsMember({"all", "paper"}));
  command
      ->add_flag_callback(
          "--liveliness", [arguments] { arguments->scope = Scope::kLiveliness; },
          "Only the tables that tell whether the dance lives")
      ->excludes("--controls");
  command
      ->add_option("--free-dances", options.free_dances,
                   "Dances without keys in the table of liveliness; 0: none")
      ->take_last()
      ->capture_default_str()
      ->check(CLI::Range(0, 100000));
  command
      ->add_option("--temperature", arguments->temperature,
                   "From 0 to 2, instead of the model's own")
      ->check(CheckTemperature);
  command->callback([arguments] { Evaluate(*arguments); });
}

}  // namespace choreo
