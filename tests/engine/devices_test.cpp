#include "model/engine/engine_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/core/error.h"

namespace choreo::devices_test {

using ::testing::HasSubstr;

constexpr AvailableDevices kCpuBuild{};
constexpr AvailableDevices kTwoGpus{.cuda_build = true, .cuda_devices = 2};

std::vector<std::string> Names(std::string_view text, const AvailableDevices& available) {
  std::vector<std::string> names;
  for (const Device& device : ParseDevices(text, available)) names.push_back(device.name());
  return names;
}

Error Failure(std::string_view text, const AvailableDevices& available) {
  try {
    ParseDevices(text, available);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "'" << text << "' was accepted";
  return Error(ErrorCode::kInternal, "", "");
}

TEST(DevicesTest, AutoTakesEveryGpuElseTheCpu) {
  EXPECT_THAT(Names("auto", kTwoGpus), testing::ElementsAre("cuda:0", "cuda:1"));
  EXPECT_THAT(Names("auto", kCpuBuild), testing::ElementsAre("cpu"));
  EXPECT_THAT(Names("auto", {.cuda_build = true}), testing::ElementsAre("cpu"));
}

TEST(DevicesTest, NamesAreTakenInTheirOrder) {
  EXPECT_THAT(Names("cpu", kTwoGpus), testing::ElementsAre("cpu"));
  EXPECT_THAT(Names("cuda:1", kTwoGpus), testing::ElementsAre("cuda:1"));
  EXPECT_THAT(Names("cuda:1,0", kTwoGpus), testing::ElementsAre("cuda:1", "cuda:0"));
}

TEST(DevicesTest, CpuBuildListsItsDevicesWhenCudaIsRequested) {
  const Error error = Failure("cuda:0", kCpuBuild);
  EXPECT_EQ(error.code(), ErrorCode::kNotFound);
  EXPECT_EQ(error.field(), "--device");
  EXPECT_THAT(error.what(), HasSubstr("cuda:0 was asked for"));
  EXPECT_THAT(error.what(), HasSubstr("this build has no CUDA, only: cpu"));
}

TEST(DevicesTest, MissingGpuListsAvailableOnes) {
  EXPECT_THAT(Failure("cuda:0,2", kTwoGpus).what(), HasSubstr("there are: cpu, cuda:0, cuda:1"));
  EXPECT_THAT(Failure("cuda:0", {.cuda_build = true}).what(), HasSubstr("no CUDA device answers"));
}

TEST(DevicesTest, OtherFormsAreRefused) {
  for (const char* text : {"", "gpu", "CPU", "cuda", "cuda:", "cuda:x", "cuda:-1", "cuda:0,",
                           "cuda:0,,1", "cuda:0 ", "cuda:99999999999", "cpu,cuda:0", "cuda:0,0"}) {
    EXPECT_EQ(Failure(text, kTwoGpus).code(), ErrorCode::kInvalidArgument) << text;
  }
}

}  // namespace choreo::devices_test
