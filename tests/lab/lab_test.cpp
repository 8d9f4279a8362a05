#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

namespace choreo {
namespace {

using testing::HasSubstr;

struct Outcome {
  int code = -1;
  std::string said;  // stdout and stderr
};

Outcome Lab(const std::string& arguments) {
  FILE* pipe = popen(("'" CHOREO_LAB "' " + arguments + " 2>&1").c_str(), "r");
  Outcome outcome;
  std::array<char, 4096> buffer;
  while (const size_t count = fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.said.append(buffer.data(), count);
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
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
  EXPECT_THAT(Lab(kTrain + "--preset huge").said, HasSubstr("--preset: huge not in {"));
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
