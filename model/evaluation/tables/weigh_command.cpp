#include "model/evaluation/tables/weigh_command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/evaluation/eval_report.h"
#include "model/evaluation/judges/contest.h"
#include "model/evaluation/judges/weighed_dance.h"
#include "model/metrics/contrast.h"
#include "model/training/clips/prepared_clip.h"

namespace choreo {
namespace {

struct WeighArguments {
  std::vector<std::filesystem::path> data;
  std::filesystem::path json;
};

void PutRow(const std::string& name, const WeighedDances& dances, Table* table) {
  table->AddRow({name});
  const auto put = [&](const std::string& heading, double (*figure)(const WeighedDance&),
                       double unit) {
    table->Put(heading, 1, MeanOfKnown(dances, figure, unit).value);
  };
  put(
      "floor cm", [](const WeighedDance& one) { return one.floor; }, 100);
  for (const WeightRow& row : WeightRows()) put(row.name, row.figure, row.unit);
  put(
      "spread between windows", [](const WeighedDance& one) { return one.spread; }, 1);
}

Table WeighSet(const std::filesystem::path& folder, const std::string& name) {
  Table table;
  table.name = "weight_of_" + name;
  table.title = "Do recordings have weight, " + name;
  table.label_headings = {"clip"};
  WeighedDances all;
  for (const std::filesystem::path& path : ListPreparedClips(folder)) {
    const PreparedClip clip = ReadPreparedClip(path);
    all.push_back(Weigh(clip.skeleton, clip.motion.fps, all.size(),
                        TrackJoints(clip.skeleton, clip.motion.frames),
                        WindowTurns(clip.motion.frames, clip.motion.fps)));
    PutRow(clip.name, {all.back()}, &table);
  }
  PutRow("all", all, &table);
  table.note = std::to_string(all.size()) +
               " clips, as prepared. The floor is the 5th percentile of the lower foot, which "
               "heights of the other columns are above.";
  return table;
}

void WeighSets(const WeighArguments& arguments) {
  const std::vector<std::string> names = SetNames(arguments.data);
  if (!arguments.json.empty()) CheckReportPath(arguments.json);
  std::vector<Table> tables;
  for (size_t i = 0; i < names.size(); ++i) {
    tables.push_back(WeighSet(arguments.data[i], names[i]));
    std::printf("%s%s", i > 0 ? "\n" : "", ToMarkdown(tables.back()).c_str());
  }
  if (!arguments.json.empty()) WriteReport(arguments.json, nlohmann::json::object(), tables);
}

}  // namespace

void AddWeighCommand(CLI::App& app) {
  auto arguments = std::make_shared<WeighArguments>();
  CLI::App* command =
      app.add_subcommand("weigh", "Print how prepared clips stand on their floor, push and fall");
  command
      ->add_option("data", arguments->data,
                   "Folders written by `choreo-lab prepare`: each is a set")
      ->required();
  command->add_option("--json", arguments->json, "Also write the figures here");
  command->callback([arguments] { WeighSets(*arguments); });
}

}  // namespace choreo
