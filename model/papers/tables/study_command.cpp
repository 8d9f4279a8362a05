#include "model/papers/tables/study_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "model/core/error.h"
#include "model/evaluation/eval_report.h"
#include "model/papers/tables/study.h"

namespace choreo {
namespace {

struct StudyArguments {
  std::vector<std::string> methods;
  std::string question = "Which dance suits the music best?";
  uint64_t seed = 0;
  std::filesystem::path folder, key, json;
  std::vector<std::filesystem::path> answers;
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

void Score(const StudyArguments& arguments) {
  if (!arguments.json.empty()) CheckReportPath(arguments.json);
  const Table table = ScoreStudy(arguments.key, arguments.answers);
  std::printf("%s", ToMarkdown(table).c_str());
  if (!arguments.json.empty()) WriteReport(arguments.json, nlohmann::json::object(), {table});
}

}  // namespace

void AddStudyCommand(CLI::App& app) {
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* study =
      app.add_subcommand("study", "Let people rank dances whose makers they don't know");
  study->require_subcommand(1);
  CLI::App* make = study->add_subcommand(
      "make", "Write a page that shows the dances of several methods side by side, blinded");
  make->add_option("folder", arguments->folder,
                   "Where to write; FOLDER.key.json beside it says whose the films are")
      ->required();
  make->add_option("--method", arguments->methods,
                   "NAME=FOLDER of its films or pictures (.webm, .mp4, .png, .jpg), a file a clip; "
                   "once for each method. Clips that all have are shown.")
      ->required();
  make->add_option("--question", arguments->question, "What the page asks")->capture_default_str();
  make->add_option("--seed", arguments->seed, "Of the order that films are shown in")
      ->capture_default_str();
  make->callback([arguments] { Make(*arguments); });
  CLI::App* score = study->add_subcommand("score", "Print mean ranks of what people answered");
  score->add_option("key", arguments->key, "FOLDER.key.json of `make`")->required();
  score->add_option("answers", arguments->answers, "Files that the page saved, one a person")
      ->required();
  score->add_option("--json", arguments->json, "Also write the figures here");
  score->callback([arguments] { Score(*arguments); });
}

}  // namespace choreo
