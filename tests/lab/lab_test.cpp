#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <wordexp.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/lab/lab.h"
#include "tests/support/sanitizers.h"
#include "tests/support/shell.h"
#include "tests/support/synthetic_clips.h"
#include "tests/support/temporary_folder.h"

namespace choreo::lab_test {

using testing::HasSubstr;

/// choreo-lab in a process of its own. LibTorch takes a CPU second to load.
Outcome LabProgram(const std::string& arguments, const std::filesystem::path& folder = ".") {
  return Shell("cd '" + folder.string() + "' && '" CHOREO_LAB "' " + arguments);
}

/// choreo-lab in this process, which reads its arguments as a shell does.
Outcome Lab(const std::string& arguments, const std::filesystem::path& folder = ".") {
  wordexp_t words;
  if (wordexp(("choreo-lab " + arguments).c_str(), &words, WRDE_NOCMD) != 0)
    throw std::invalid_argument(arguments);
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(folder);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Outcome outcome{.code = RunLab(static_cast<int>(words.we_wordc), words.we_wordv), .said = ""};
  outcome.said = testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  std::filesystem::current_path(here);
  wordfree(&words);
  return outcome;
}

/// The commands of a page of docs/: its lines that begin with choreo-lab, without that word.
std::vector<std::string> CommandsOf(const std::string& page) {
  std::ifstream file(SOURCE_FOLDER "/docs/" + page);
  std::vector<std::string> commands;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("choreo-lab ")) continue;
    for (std::string next; line.ends_with("\\") && std::getline(file, next);)
      line.replace(line.size() - 1, 1, next);
    if (line.ends_with("&&")) line.resize(line.size() - 2);
    commands.push_back(line.substr(std::string("choreo-lab ").size()));
  }
  return commands;
}

const std::string kTrain = "train --data /absent --splits /absent.json --run /absent/run ";

TEST(LabTest, HelpDescribesTheCommands) {
  EXPECT_EQ(LabProgram("--version").code, 0);
  for (const char* command : {"", "train", "eval"}) {
    const Outcome outcome = Lab(std::string(command) + " --help");
    EXPECT_EQ(outcome.code, 0) << command;
    EXPECT_THAT(outcome.said, HasSubstr("Usage:")) << command;
  }
  EXPECT_THAT(Lab("train --help").said, HasSubstr("Steps of the run"));
}

TEST(LabTest, MisuseIsCodeTwo) {
  for (const std::string& arguments :
       {std::string(), std::string("swim"), std::string("train"), kTrain + "--preset huge"}) {
    EXPECT_EQ(Lab(arguments).code, 2) << arguments;
  }
  EXPECT_THAT(Lab("eval --model m").said, HasSubstr("--data and --splits, or --music"));
  EXPECT_THAT(Lab(kTrain + "--preset huge").said, HasSubstr("--preset: 'huge' is not one of"));
  for (const std::string value : {"nan", "-nan", "inf", "2.1", "-0.1", "warm"}) {
    const Outcome outcome =
        Lab("eval --model /absent --data /absent --splits /absent.json --temperature=" + value);
    EXPECT_EQ(outcome.code, 2) << value;
    EXPECT_THAT(outcome.said,
                HasSubstr("--temperature: '" + value + "' is not a number from 0 to 2"));
  }
}

TEST(LabTest, AStudyOfDancesIsRefusedBeforeTheLongWork) {
  const TemporaryFolder empty;
  const std::string dance = "study dance there --model /absent --data /absent --splits /absent ";
  EXPECT_EQ(Lab("study dance there", empty.path()).code, 2);
  EXPECT_EQ(Lab(dance + "--baseline mean", empty.path()).code, 2);
  EXPECT_THAT(Lab(dance, empty.path()).said, HasSubstr("/absent"));
  std::filesystem::create_directory(empty.path() / "there");
  const Outcome outcome = Lab(dance, empty.path());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("there: is there already"));
}

TEST(LabTest, KnowsTheCommandsOfThePapersPages) {
  const TemporaryFolder empty;
  std::vector<std::string> commands = CommandsOf("reproduce.md");
  std::ranges::copy(CommandsOf("reproduce_controllers.md"), std::back_inserter(commands));
  EXPECT_EQ(commands.size(), 8U);
  for (const std::string& command : commands) {
#ifndef CHOREO_SERVICE
    if (command.starts_with("prepare")) continue;
#endif
    // Understood, but nothing that it names is here; misuse would be code 2.
    const Outcome outcome = Lab(command, empty.path());
    EXPECT_EQ(outcome.code, 1) << command << '\n' << outcome.said;
  }
}

TEST(LabTest, NamesAMissingDeviceInOneLine) {
  const Outcome outcome = Lab(kTrain + "--device cuda:99");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("choreo-lab: --device: cuda:99 was asked for, but"));
  EXPECT_EQ(std::count(outcome.said.begin(), outcome.said.end(), '\n'), 1) << outcome.said;
  EXPECT_THAT(Lab(kTrain + "--device tpu").said, HasSubstr("'tpu' is not one of auto, cpu, cuda"));
}

std::string Bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A model whose weights are random but for one step, and what it is measured on.
class LabEval : public testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "LibTorch is not built for sanitizers";
    testing_support::WriteSyntheticData(folder_.path() / "clips");
  }

  void TrainOneStep(const std::string& preset) {
    const Outcome outcome = Lab("train --preset " + preset + kData + " --run " + preset +
                                    " --steps 1 --batch 4 --shortest 5 --longest 20",
                                folder_.path());
    ASSERT_EQ(outcome.code, 0) << outcome.said;
  }

  Outcome Eval(const std::string& arguments, decltype(Lab)& lab = Lab) {
    return lab("eval --model ablation/checkpoint.safetensors" + kData +
                   " --lengths 10 20 --windows 2 --best-of 2 --long-dances 2 --long-frames 60 "
                   "--free-dances 2 " +
                   arguments,
               folder_.path());
  }

  inline static const std::string kData = " --data clips --splits clips/splits.json";
  const TemporaryFolder folder_;
};

TEST_F(LabEval, WritesEveryTableAndTheSameBytesAgain) {
  // The encoder's row of real motion wants two blocks of five seconds.
  WritePreparedClip(folder_.path() / "clips",
                    testing_support::SyntheticClip("held_out", 320, 0.5, true));
  TrainOneStep("ablation");
  const std::string arguments = "--engine packed --baseline real interpolation --name mine ";
  const Outcome first = Eval(arguments + "--json one/t.json");
  ASSERT_EQ(first.code, 0) << first.said;
  const Outcome second = Eval(arguments + "--json two/t.json", LabProgram);
  ASSERT_EQ(second.code, 0) << second.said;
  const auto one = folder_.path() / "one", two = folder_.path() / "two";
  for (const auto& file : std::filesystem::directory_iterator(one)) {
    const auto name = file.path().filename();
    EXPECT_EQ(Bytes(file.path()), Bytes(two / name)) << name;
  }
  const auto report = nlohmann::json::parse(Bytes(one / "t.json"));
  EXPECT_THAT(std::string(report["engine"]), HasSubstr("packed float32"));
  std::vector<std::string> names;
  for (const auto& table : report["tables"]) {
    names.push_back(table["name"]);
    EXPECT_FALSE(table["rows"].empty()) << names.back();
    EXPECT_THAT(std::string(table["note"]), HasSubstr("Engine: packed float32")) << names.back();
    EXPECT_THAT(first.said, HasSubstr("### " + std::string(table["title"]))) << names.back();
  }
  EXPECT_THAT(names, testing::ElementsAre("liveliness_clips", "liveliness_l2p_clips",
                                          "transitions_clips", "keys_clips", "long_clips",
                                          "beats_clips", "encoder_clips", "stress_clips"));
  // Every method at both lengths, and keys met.
  const auto& keys = report["tables"][3]["rows"];
  EXPECT_EQ(keys.size(), 8U);
  for (const auto& row : keys) {
    if (row["method"] == "mine") {
      EXPECT_LE(row["final error worst mm"], 1);
    } else if (row["method"] == "real") {
      EXPECT_EQ(row["raw KPD cm²"], 0);
    }
  }
  EXPECT_TRUE(std::filesystem::exists(one / "t_transitions_clips.png"));
}

TEST_F(LabEval, ThePapersTablesHaveEachNetworkRawAndAsServed) {
  WritePreparedClip(folder_.path() / "clips",
                    testing_support::SyntheticClip("held_out", 320, 0.5, true));
  TrainOneStep("ablation");
  const Outcome trained = Lab("train --preset ablation --no-keys" + kData +
                                  " --run keyless --steps 1 --batch 4 --shortest 5 --longest 20",
                              folder_.path());
  ASSERT_EQ(trained.code, 0) << trained.said;
  const Outcome outcome = Eval(
      "--paper --baseline real interpolation --name mine --long-frames 120 --other "
      "keyless=keyless/checkpoint.safetensors --json t.json");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const auto tables = nlohmann::json::parse(Bytes(folder_.path() / "t.json"))["tables"];
  std::map<std::string, nlohmann::json> rows;
  std::vector<std::string> names;
  for (const auto& table : tables) {
    names.push_back(table["name"]);
    for (const auto& row : table["rows"])
      rows[names.back() + "/" + std::string(row["method"])] = row;
  }
  EXPECT_THAT(names,
              testing::ElementsAre("paper_l2p_clips", "paper_dances_clips", "paper_beats_clips"));
  // The raw network misses the key, the served dance does not; a network trained without keys gets
  // none.
  EXPECT_GT(rows.at("paper_dances_clips/mine, raw")["KPD cm²"], 1);
  EXPECT_LT(rows.at("paper_dances_clips/mine")["KPD cm²"], 1e-4);
  EXPECT_TRUE(rows.at("paper_dances_clips/keyless")["KPD cm²"].is_null());
  EXPECT_TRUE(rows.contains("paper_dances_clips/real"));
  for (const char* figure : {"FID", "variability", "diversity"}) {
    EXPECT_NE(rows.at("paper_dances_clips/mine, raw")[figure],
              rows.at("paper_dances_clips/mine")[figure])
        << figure;
    EXPECT_TRUE(rows.at("paper_dances_clips/keyless, raw")[figure].is_number()) << figure;
  }
  EXPECT_FALSE(rows.contains("paper_beats_clips/keyless"));
  EXPECT_TRUE(rows.contains("paper_beats_clips/mine, raw"));
  EXPECT_NE(rows.at("paper_l2p_clips/mine, raw")["cm at 10"],
            rows.at("paper_l2p_clips/mine")["cm at 10"]);
  EXPECT_EQ(rows.at("paper_l2p_clips/interpolation")["÷ interpolation at 10"], 1);
}

TEST_F(LabEval, RefusesImpossibleOptionsAtOnce) {
  for (const auto& [arguments, why] : std::vector<std::pair<std::string, std::string>>{
           {"--data clips/", "choreo-lab: --data: 'clips/': another set is called 'clips'"},
           {"--other a=b --other a=c", "choreo-lab: --other: 'a=c': another row is called 'a'"},
           {"--json clips/splits.json/t.json", "choreo-lab: --json: 'clips/splits.json/t.json'"},
           {"--json clips", "choreo-lab: --json: 'clips' cannot be written"}}) {
    const Outcome outcome = Eval(arguments);
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_THAT(outcome.said, HasSubstr(why)) << arguments;
    EXPECT_EQ(std::count(outcome.said.begin(), outcome.said.end(), '\n'), 1) << outcome.said;
  }
}

TEST_F(LabEval, TrainingRefusesOptionsOutsideAPreset) {
  for (const auto& [options, why] : std::vector<std::pair<std::string, std::string>>{
           {"ablation --one-lstm", "--one-lstm: is not an ablation of the preset ablation"},
           {"default --hidden 64", "--hidden: is not an option of the preset default"},
           {"harvey --no-keys", "--no-keys: is not an ablation of the preset harvey"},
           {"harvey --no-key-loss", "--no-key-loss: is not an ablation of the preset harvey"},
           {"default --longest 20", "--longest: is not an option of the preset default"},
           {"controllers-paper --no-keys",
            "--no-keys: is not an ablation of the preset controllers-paper"}}) {
    const Outcome outcome = Lab("train --run refused --preset " + options + kData, folder_.path());
    EXPECT_EQ(outcome.code, 1) << options;
    EXPECT_THAT(outcome.said, HasSubstr("choreo-lab: " + why)) << options;
  }
  // Cards of earlier versions have all options: those that are not used may stand at their
  // defaults.
  const Outcome typed =
      Lab("train --run typed --preset controllers-paper --hidden 0 --steps 1 --batch 4" + kData +
              " --shortest 5 --longest 20",
          folder_.path());
  EXPECT_EQ(typed.code, 0) << typed.said;
}

TEST_F(LabEval, WarnsOfLengthsWithoutWindows) {
  TrainOneStep("ablation");
  TrainOneStep("controllers-paper");
  const Outcome outcome = Lab("eval --model ablation/checkpoint.safetensors" + kData +
                                  " --lengths 10 115 --windows 1 --best-of 0 --long-dances 0 "
                                  "--free-dances 0 --no-encoder --engine packed",
                              folder_.path());
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("--lengths: no clip of clips has 115 frames"));
  EXPECT_THAT(outcome.said, testing::Not(HasSubstr("has 10 frames")));
  EXPECT_THAT(outcome.said, HasSubstr("0 windows of 115 frames"));
  const Outcome endless =
      Lab("eval --model ablation/checkpoint.safetensors" + kData +
              " --lengths 1800 --other r=controllers-paper/checkpoint.safetensors",
          folder_.path());
  EXPECT_EQ(endless.code, 1);
  EXPECT_THAT(endless.said, HasSubstr("choreo-lab: --lengths: 1800 frames are more than the 600 "
                                      "that --other r (controllers-paper) takes"));
  // Baselines made of the judged model do not have its name.
  const Outcome judged = Lab("eval --model controllers-paper/checkpoint.safetensors" + kData +
                                 " --lengths 10 601 --name mine",
                             folder_.path());
  EXPECT_EQ(judged.code, 1);
  EXPECT_THAT(
      judged.said,
      HasSubstr("--lengths: 601 frames are more than the 600 that --model (controllers-paper)"));
}

TEST_F(LabEval, MeasuresAnyGroupOfTheSplitsFileAndNamesThemAll) {
  std::ofstream(folder_.path() / "clips" / "splits.json")
      << R"({"ours": {"train": ["train_0"], "validation": ["held_out"], "another genre": ["last"]}})";
  TrainOneStep("ablation");
  const std::string brief =
      "--engine packed --best-of 0 --long-dances 0 --free-dances 0 --no-encoder ";
  const Outcome other = Eval(brief + "--split 'another genre' --json t.json");
  EXPECT_EQ(other.code, 0) << other.said;
  EXPECT_THAT(other.said, HasSubstr(", another genre clips, "));
  EXPECT_EQ(nlohmann::json::parse(Bytes(folder_.path() / "t.json"))["split"], "another genre");
  const Outcome unknown = Eval(brief + "--split test");
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.said, HasSubstr("no clip of 'clips' is in 'test'; they are in 'another "
                                      "genre', 'train', 'validation'"));
  const Outcome nowhere =
      Lab("eval --model ablation/checkpoint.safetensors --data /nope --splits "
          "clips/splits.json",
          folder_.path());
  EXPECT_EQ(nowhere.code, 1);
  EXPECT_THAT(nowhere.said, HasSubstr("choreo-lab: /nope: no such folder"));
}

}  // namespace choreo::lab_test
