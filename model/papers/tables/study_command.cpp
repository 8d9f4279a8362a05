#include "model/papers/tables/study_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "model/core/error.h"
#include "model/core/limits.h"
#include "model/evaluation/eval_report.h"
#include "model/evaluation/judges/contest.h"
#include "model/papers/tables/study.h"
#include "model/papers/tables/study_dances.h"

namespace choreo {
namespace {

struct StudyArguments {
  std::vector<std::string> methods;
  std::string question = "Which dance suits the music best?";
  uint64_t seed = 0;
  std::filesystem::path folder, key, json;
  std::vector<std::filesystem::path> answers;
  ContestOptions contest;
  std::filesystem::path data, splits, songs;
  std::string split = "test";
  int frames = 300;
};

void Make(const StudyArguments& arguments) {
  std::vector<StudyMethod> methods;
  for (const std::string& text : arguments.methods) {
    const size_t mark = text.find('=');
    if (mark == std::string::npos || mark == 0)
      throw InvalidArgument("--method", '"' + text + "\" is not NAME=FOLDER");
    methods.push_back({text.substr(0, mark), text.substr(mark + 1)});
  }
  WriteStudy(methods, arguments.question, arguments.seed, arguments.folder);
}

void Dance(const StudyArguments& arguments) {
  CheckStudyFolder(arguments.folder);
  const Contest contest = MakeContest(arguments.contest);
  const std::vector<ClipSet> sets = LoadSets({arguments.data}, arguments.splits, arguments.split,
                                             contest.judged().model().skeleton);
  WriteStudy(FilmDances(sets.front(), contest.methods, arguments.frames, arguments.songs,
                        BesideStudy(arguments.folder, ".films")),
             arguments.question, arguments.seed, arguments.folder);
}

void Score(const StudyArguments& arguments) {
  if (!arguments.json.empty()) CheckReportPath(arguments.json);
  const Table table = ScoreStudy(arguments.key, arguments.answers);
  std::printf("%s", ToMarkdown(table).c_str());
  if (!arguments.json.empty()) WriteReport(arguments.json, nlohmann::json::object(), {table});
}

}  // namespace

void AddStudyCommand(CLI::App& app) {
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* study = app.add_subcommand("study", "Compare dances blindly: people rank films");
  study->require_subcommand(1);
  const auto writes = [&](const char* name, const char* what, auto run) {
    CLI::App* command = study->add_subcommand(name, what);
    command
        ->add_option("folder", arguments->folder,
                     "Where to write; FOLDER.key.json beside it says whose the films are")
        ->required();
    command->add_option("--question", arguments->question, "What the page asks")
        ->capture_default_str();
    command->add_option("--seed", arguments->seed, "Seed of the order of films")
        ->capture_default_str();
    command->callback([arguments, run] { run(*arguments); });
    return command;
  };
  CLI::App* dance = writes(
      "dance", "Let models dance beside clips, film all of them, and write the page of `make`",
      Dance);
  ContestOptions& contest = arguments->contest;
  contest.baselines = {"real", "interpolation"};
  dance->add_option("--model", contest.model, "Checkpoint")->required();
  dance->add_option("--name", contest.name, "What it is called")->capture_default_str();
  dance->add_option("--other", contest.others, "NAME=CHECKPOINT: another model");
  dance
      ->add_option("--baseline", contest.baselines,
                   "Also filmed: what was really danced, interpolation put on its feet")
      ->check(CLI::IsMember({"real", "interpolation"}))
      ->capture_default_str();
  dance->add_option("--data", arguments->data, "Folder written by `choreo-lab prepare`")
      ->required();
  dance->add_option("--splits", arguments->splits, "Which clip trains, validates, tests (JSON)")
      ->required();
  dance->add_option("--split", arguments->split, "Which of them are danced beside")
      ->capture_default_str();
  dance
      ->add_option("--songs", arguments->songs,
                   "Folder of the clips' songs, CLIP.ogg (.wav, .mp3); without, films are silent")
      ->check(CLI::ExistingDirectory);
  dance->add_option("--frames", arguments->frames, "Of a film")
      ->check(CLI::Range(30, kMaxTransitionFrames))
      ->capture_default_str();
  CLI::App* make = writes(
      "make", "Write a page that shows the dances of several methods side by side, blinded", Make);
  make->add_option("--method", arguments->methods,
                   "NAME=FOLDER of its films or pictures (.webm, .mp4, .png, .jpg), a file a clip; "
                   "once for each method. Clips that all have are shown.")
      ->required();
  CLI::App* score = study->add_subcommand("score", "Print mean ranks of what people answered");
  score->add_option("key", arguments->key, "FOLDER.key.json of `make`")->required();
  score->add_option("answers", arguments->answers, "Files that the page saved, one a person")
      ->required();
  score->add_option("--json", arguments->json, "Also write the figures here");
  score->callback([arguments] { Score(*arguments); });
}

}  // namespace choreo
