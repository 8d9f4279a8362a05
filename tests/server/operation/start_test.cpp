#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>

#include "client/authoring/local_server.h"
#include "client/choreo_client.h"
#include "model/core/files/safetensors.h"
#include "tests/server/load/interrupted_dance.h"
#include "tests/support/sanitizers.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

/// choreod, started with checkpoints that it cannot serve, exits at once with one line that names
/// the file, the fault and the reason.
namespace choreo::start_test {

Outcome StartWith(const std::filesystem::path& checkpoint) {
  return Shell("'" CHOREOD_PROGRAM "' --log-level critical --listen 127.0.0.1:0 --checkpoint '" +
               checkpoint.string() + "'");
}

class StartTest : public testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "choreod runs LibTorch";
    std::filesystem::copy_file(SHIPPED_CHECKPOINT, path_);
  }

  void ExpectRefused(const std::vector<std::string>& says) {
    const Outcome outcome = StartWith(path_);
    EXPECT_EQ(outcome.code, 2) << "no restart mends it";
    EXPECT_EQ(std::count(outcome.said.begin(), outcome.said.end(), '\n'), 1) << outcome.said;
    EXPECT_THAT(outcome.said, testing::HasSubstr(path_.string()));
    for (const std::string& word : says) EXPECT_THAT(outcome.said, testing::HasSubstr(word));
  }

  void ChangeMetadata(const std::string& key, const std::string& value) {
    Safetensors content = ReadSafetensors(path_);
    content.metadata[key] = value;
    WriteSafetensors(path_, content);
  }

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "model.safetensors";
};

TEST_F(StartTest, ATruncatedCheckpoint) {
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  ExpectRefused({"tensor ", "truncated"});
}

TEST_F(StartTest, ACheckpointOfAnotherVersion) {
  ChangeMetadata("format", "choreo-flow-9");
  ExpectRefused({"format 'choreo-flow-9'", "this build reads 'choreo-flow-"});
}

TEST_F(StartTest, ACheckpointWithAWrongHash) {
  ChangeMetadata("hash", std::string(32, '0'));
  ExpectRefused({"content hash ", "the file states 00000000000000000000000000000000"});
}

TEST_F(StartTest, ACheckpointWithAChangedWeight) {
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(-1, std::ios::end);
  file.put('\x7f');
  file.close();
  ExpectRefused({"content hash ", "damaged or was edited"});
}

TEST_F(StartTest, RefusesAFileThatIsNoCheckpoint) {
  std::ofstream(path_) << "just a line of text";
  ExpectRefused({"not a usable safetensors file"});
}

TEST_F(StartTest, ServesAShippedModelByItsName) {
  const authoring::LocalServer server(CHOREOD_PROGRAM, "127.0.0.1:0", "free");
  const auto models = client::Client({.addresses = {server.address()}}).GetServerInfo().models;
  ASSERT_EQ(models.size(), 1U);
  EXPECT_EQ(models[0].name, "free");
  const Outcome other = Shell("'" CHOREOD_PROGRAM "' --listen 127.0.0.1:0 --model nosuch");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.said,
              testing::HasSubstr("\"nosuch\" does not ship, but default, free, paper-f, paper-c"));
  const Outcome both =
      Shell("'" CHOREOD_PROGRAM "' --model free --checkpoint '" + path_.string() + "'");
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.said, testing::HasSubstr("--model: \"free\" is a shipped model"));
}

// A model dances as well without its figures: at start, at a check and at SIGHUP.
TEST_F(StartTest, WarnsOfABrokenFileOfFigures) {
  const std::filesystem::path figures = folder_ / "model.figures.json";
  std::ofstream(figures) << R"({"weights": 7})";
  const Outcome outcome = Shell("'" CHOREOD_PROGRAM "' --check --listen 127.0.0.1:0 --models '" +
                                folder_.path().string() + "'");
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said,
              testing::HasSubstr(figures.string() +
                                 ": weights: 7 is no text; its styles count as unmeasured"));
}

// It listens only after it has loaded.
TEST_F(StartTest, WarnsOfSettingsThatTheModelIgnores) {
  const std::string log = path_.string() + ".log";
  const Outcome outcome = Shell(
      "'" CHOREOD_PROGRAM "' --listen 127.0.0.1:0 --engine torch --kernels avx2 --checkpoint '" +
      path_.string() + "' > '" + log + "' 2>&1 & until grep -q 'choreod listens on' '" + log +
      "' || ! kill -0 $!; do sleep 0.1; done; kill $!; wait $!; cat '" + log + "'");
  EXPECT_THAT(outcome.said, testing::HasSubstr("--kernels avx2: model \"default\" ignores it"));
  EXPECT_THAT(outcome.said, testing::HasSubstr("dances at once take"));
}

// The server keeps what it has loaded, so running and later dances are unaffected.
TEST_F(StartTest, ARunningServerOutlivesItsCheckpoint) {
  ::setenv("CHOREO_CHECKPOINT", path_.c_str(), 1);
  authoring::LocalServer server(CHOREOD_PROGRAM);
  ::unsetenv("CHOREO_CHECKPOINT");
  const client::Client client({.addresses = {server.address()}});
  const std::vector<Pose> wanted = DanceAround(client, "", 300);
  const auto expect_the_same_around = [&](const std::function<void()>& between) {
    ExpectSamePoses(DanceAround(client, "", 300, between), wanted);
  };
  // Overwritten in place, so that a program that has it open would notice.
  expect_the_same_around([&] { std::ofstream(path_, std::ios::trunc) << "no checkpoint"; });
  expect_the_same_around({});
  expect_the_same_around([&] { std::filesystem::remove(path_); });
  expect_the_same_around({});
  server.RequireRunning();
  std::cout << "4 dances of " << wanted.size() << " frames, all as before\n";
}

}  // namespace choreo::start_test
