#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace choreo {
namespace {

using testing::HasSubstr;

struct Outcome {
  int code = -1;
  std::string said;  // stdout and stderr
};

Outcome Lab(const std::string& arguments, const std::filesystem::path& folder = ".") {
  const std::string command =
      "cd '" + folder.string() + "' && '" CHOREO_LAB "' " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  Outcome outcome;
  std::array<char, 4096> buffer;
  while (const size_t count = fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.said.append(buffer.data(), count);
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

/// What a page of docs/ tells people to type: its lines that begin with choreo-lab, without that.
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

TEST(LabTest, ExplainsItself) {
  EXPECT_EQ(Lab("--version").code, 0);
  for (const char* command : {"", "train", "eval"}) {
    const Outcome outcome = Lab(std::string(command) + " --help");
    EXPECT_EQ(outcome.code, 0) << command;
    EXPECT_THAT(outcome.said, HasSubstr("Usage:")) << command;
  }
  EXPECT_THAT(Lab("train --help").said, HasSubstr("Steps of the first stage"));
}

TEST(LabTest, MisuseIsCodeTwo) {
  for (const std::string& arguments :
       {std::string(), std::string("swim"), std::string("train"), kTrain + "--preset huge"}) {
    EXPECT_EQ(Lab(arguments).code, 2) << arguments;
  }
  EXPECT_THAT(Lab(kTrain + "--preset huge").said, HasSubstr("--preset: 'huge' is not one of"));
}

TEST(LabTest, KnowsTheCommandsOfReproduceMd) {
  const TemporaryFolder empty;
  const std::vector<std::string> commands = CommandsOf("reproduce.md");
  EXPECT_EQ(commands.size(), 4U);
  for (const std::string& command : commands) {
#ifndef CHOREO_SERVICE
    if (command.starts_with("prepare")) continue;
#endif
    // Understood, but nothing that it names is here; misuse would be code 2.
    const Outcome outcome = Lab(command, empty.path());
    EXPECT_EQ(outcome.code, 1) << command << '\n' << outcome.said;
  }
}

TEST(LabTest, ADeviceThatIsNotThereIsNamedInOneLine) {
  const Outcome outcome = Lab(kTrain + "--device cuda:99");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("choreo-lab: device: cuda:99 was asked for, but"));
  EXPECT_EQ(std::count(outcome.said.begin(), outcome.said.end(), '\n'), 1) << outcome.said;
  EXPECT_THAT(Lab(kTrain + "--device tpu").said, HasSubstr("'tpu' is not one of auto, cpu, cuda"));
}

}  // namespace
}  // namespace choreo
