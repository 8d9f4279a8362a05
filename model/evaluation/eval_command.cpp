#include "model/evaluation/eval_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/engine/engines.h"
#include "model/evaluation/control_tables.h"
#include "model/evaluation/encoder_table.h"
#include "model/evaluation/interpolation_engine.h"
#include "model/evaluation/long_tables.h"
#include "model/evaluation/method_sheet.h"
#include "model/evaluation/song_beats.h"
#include "model/evaluation/stress_table.h"
#include "model/evaluation/transition_tables.h"
#include "model/training/clip_split.h"

namespace choreo {
namespace {

constexpr int kSlots = 16;  // a tile of the torch engine: a fuller batch is hardly dearer

struct Arguments {
  std::filesystem::path model;
  std::vector<std::filesystem::path> data;
  std::filesystem::path splits;
  std::string split = "validation";
  std::vector<std::string> baselines = {"real", "interpolation", "music_only"};
  std::vector<std::string> others;
  std::string engine = "auto";
  std::filesystem::path json, markdown;
  EvalOptions options;
  float temperature = -1;
  bool encode = true, sheets = false;
};

// The engines of one evaluation, and the methods that use them.
struct Contest {
  std::vector<std::unique_ptr<StepEngine>> engines;
  std::vector<Method> methods;

  StepEngine* Add(std::unique_ptr<StepEngine> engine) {
    engines.push_back(std::move(engine));
    return engines.back().get();
  }
};

Contest MakeContest(const Arguments& arguments) {
  using Kind = Method::Kind;
  Contest contest;
  const EngineKind kind = ParseEngineKind(arguments.engine);
  StepEngine* model = contest.Add(MakeEngine(arguments.model, Device{}, kSlots, kind));
  const auto wants = [&](const char* name) {
    return std::ranges::find(arguments.baselines, name) != arguments.baselines.end();
  };
  if (wants("real")) contest.methods.push_back({"real", Kind::kReal});
  if (wants("interpolation")) {
    contest.methods.push_back({"interpolation", Kind::kInterpolation});
    contest.methods.push_back({"interpolation, foot lock", Kind::kEngine,
                               contest.Add(std::make_unique<InterpolationEngine>(model->model()))});
  }
  if (wants("music_only"))
    contest.methods.push_back({"model without keys", Kind::kEngine, model, false});
  for (const std::string& other : arguments.others) {
    const size_t equals = other.find('=');
    if (equals == std::string::npos || equals == 0 || other.substr(0, equals) == kServed)
      throw InvalidArgument("--other", "'" + other + "' is not NAME=CHECKPOINT");
    StepEngine* engine = contest.Add(MakeEngine(other.substr(equals + 1), Device{}, kSlots, kind));
    if (!(engine->model().skeleton == model->model().skeleton))
      throw InvalidArgument("--other", other + " dances on another skeleton than the model");
    contest.methods.push_back({other.substr(0, equals), Kind::kEngine, engine});
  }
  contest.methods.push_back({kServed, Kind::kEngine, model});
  return contest;
}

std::vector<ClipSet> LoadSets(const Arguments& arguments, const Skeleton& skeleton, Split split) {
  std::vector<ClipSet> sets;
  for (std::filesystem::path folder : arguments.data) {
    if (!folder.has_filename()) folder = folder.parent_path();
    sets.push_back({folder.filename().string(), LoadClips({folder}, arguments.splits, split)});
    for (const PreparedClip& clip : sets.back().clips)
      sets.back().beats.push_back(SongBeats(clip.audio, clip.motion.fps));
    const Skeleton& theirs = sets.back().clips.front().skeleton;
    if (!(theirs == skeleton)) {
      throw InvalidArgument("--data", folder.string() + ": the clips' skeleton is " +
                                          theirs.Describe() + ", the model's " +
                                          skeleton.Describe());
    }
  }
  return sets;
}

// OUT.json, OUT_TABLE.png beside it, and the Markdown that shows both.
void WriteResults(const Arguments& arguments, const ModelInfo& model,
                  const std::vector<Table>& tables, const std::string& summary) {
  nlohmann::json report = {
      {"model", model.name},      {"fingerprint", model.fingerprint},
      {"split", arguments.split}, {"temperature", arguments.options.temperature},
      {"summary", summary},       {"tables", nlohmann::json::array()}};
  std::string markdown = summary + "\n";
  for (const Table& table : tables) {
    report["tables"].push_back(ToJson(table));
    markdown += "\n" + ToMarkdown(table);
    if (!table.plot || arguments.json.empty()) continue;
    std::filesystem::path png = arguments.json;
    png.replace_filename(arguments.json.stem().string() + "_" + table.name + ".png");
    DrawPlot(*table.plot, png);
    if (arguments.markdown.empty()) continue;
    const auto here = std::filesystem::absolute(arguments.markdown).parent_path();
    markdown += "\n![" + table.plot->title + "](" +
                std::filesystem::relative(png, here).generic_string() + ")\n";
  }
  if (!arguments.json.empty()) WriteFile(arguments.json, report.dump(1) + "\n");
  if (!arguments.markdown.empty()) WriteFile(arguments.markdown, markdown);
}

// OUT_sheet_SET_METHOD.png beside OUT.json.
void DrawSheets(const Arguments& arguments, const Contest& contest,
                const std::vector<ClipSet>& sets) {
  for (const ClipSet& set : sets) {
    for (const Method& method : contest.methods) {
      std::string name = "_sheet_" + set.name + "_" + method.name + ".png";
      std::ranges::replace_if(
          name, [](char c) { return c == ' ' || c == ',' || c == '/'; }, '_');
      std::filesystem::path png = arguments.json;
      png.replace_filename(arguments.json.stem().string() + name);
      DrawMethodSheet(set, method, contest.engines.front()->model(), arguments.options.temperature,
                      png);
    }
  }
}

void Evaluate(Arguments arguments) {
  const Contest contest = MakeContest(arguments);
  StepEngine& engine = *contest.engines.front();
  EvalOptions& options = arguments.options;
  options.temperature = arguments.temperature >= 0
                            ? arguments.temperature
                            : static_cast<float>(engine.model().default_temperature);
  const Split split = arguments.split == "test" ? Split::kTest : Split::kValidation;
  const std::vector<ClipSet> sets = LoadSets(arguments, engine.model().skeleton, split);
  std::optional<MotionEncoder> encoder;
  if (arguments.encode) {
    encoder = MotionEncoder::Train(LoadSets(arguments, engine.model().skeleton, Split::kTrain));
  }
  int64_t frames = 0;
  for (const ClipSet& set : sets) {
    frames += CountTransitionFrames(set, contest.methods, options) +
              CountLongFrames(set, engine.model(), options) +
              CountControlFrames(set, contest.methods, options);
    if (encoder) frames += CountEncodedFrames(set, contest.methods, options);
  }
  std::vector<Table> tables;
  ProgressBar progress("evaluating", frames);
  for (const ClipSet& set : sets) {
    for (Table& table : EvaluateTransitions(set, contest.methods, options, &progress))
      tables.push_back(std::move(table));
    for (Table& table : EvaluateControls(set, contest.methods, options, &progress))
      tables.push_back(std::move(table));
    for (Table& table : EvaluateLongDances(set, engine, options, &progress))
      tables.push_back(std::move(table));
    if (encoder)
      tables.push_back(EvaluateEncoded(set, contest.methods, *encoder, options, &progress));
    tables.push_back(EvaluateStress(set, engine, options));
  }
  progress.Finish();
  // Of the fingerprint the model's part; builds differ, figures hardly.
  const std::string& print = engine.model().fingerprint;
  char temperature[32];
  std::snprintf(temperature, sizeof(temperature), "%.2f", options.temperature);
  const std::string summary = "Model " + print.substr(0, print.find('/', print.find('/') + 1)) +
                              ", " + arguments.split + " clips, temperature " + temperature +
                              " unless a row says otherwise.";
  std::printf("%s\n", summary.c_str());
  for (const Table& table : tables) std::printf("\n%s", ToMarkdown(table).c_str());
  WriteResults(arguments, engine.model(), tables, summary);
  if (arguments.sheets) DrawSheets(arguments, contest, sets);
}

}  // namespace

void AddEvalCommand(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  EvalOptions& options = arguments->options;
  CLI::App* command =
      app.add_subcommand("eval", "Measure a model on held-out clips, as it is served");
  command->add_option("--model", arguments->model, "Checkpoint")->required();
  command
      ->add_option("--data", arguments->data,
                   "Folders written by `choreo-lab prepare`: each is a set with tables of its own")
      ->required();
  command->add_option("--splits", arguments->splits, "Which clip trains, validates, tests (JSON)")
      ->required();
  command->add_option("--split", arguments->split, "validation | test")
      ->capture_default_str()
      ->check(CLI::IsMember({"validation", "test"}));
  command
      ->add_option("--baseline", arguments->baselines, "Further rows of the tables of transitions")
      ->capture_default_str()
      ->check(CLI::IsMember({"real", "interpolation", "music_only"}));
  command->add_option("--other", arguments->others,
                      "NAME=CHECKPOINT: a row for another model, danced just as the first");
  command->add_option("--engine", arguments->engine, "auto | torch | packed")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "torch", "packed", "packed-bf16"}));
  command->add_option("--json", arguments->json,
                      "Also write the figures here, and plots beside it");
  command
      ->add_flag("--sheets", arguments->sheets,
                 "Also draw ten random transitions of each method beside the JSON")
      ->needs("--json");
  command->add_option("--markdown", arguments->markdown, "Also write the tables here");
  command->add_option("--lengths", options.lengths, "Frames of the transitions")
      ->capture_default_str()
      ->check(CLI::Range(1, 1800));
  command->add_option("--windows", options.windows_per_clip, "Transitions a clip and length")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  command
      ->add_option("--best-of", options.best_of, "Samples a transition at temperature 1; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  command->add_option("--long-dances", options.long_seeds, "Long dances of each kind; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0, 100000));
  command->add_option("--long-frames", options.long_frames, "Frames of a long dance")
      ->capture_default_str()
      ->check(CLI::Range(60, 100000));
  command->add_flag("!--no-encoder", arguments->encode,
                    "No FID, variability and diversity, for which an encoder is learnt from the "
                    "training clips of the data");
  command->add_option("--temperature", arguments->temperature, "Instead of the model's own")
      ->check(CLI::Range(0.0, 2.0));
  command->callback([arguments] { Evaluate(*arguments); });
}

}  // namespace choreo
