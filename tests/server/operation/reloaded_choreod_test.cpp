#include <gmock/gmock.h>
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>

#include "client/authoring/local_server.h"
#include "client/choreo_client.h"
#include "tests/server/load/interrupted_dance.h"
#include "tests/support/eventually.h"
#include "tests/support/sanitizers.h"
#include "tests/support/temporary_folder.h"

namespace choreo::reloaded_choreod_test {

/// How choreod reacts to signals.
class ReloadedChoreodTest : public testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "choreod runs LibTorch";
    Put("default");
    ::setenv("CHOREO_MODELS", models.path().c_str(), 1);
    // The default: OpenBLAS starts threads before choreod's main.
    ::setenv("OPENBLAS_NUM_THREADS", "2", 1);
    server.emplace(CHOREOD_PROGRAM);
    ::unsetenv("OPENBLAS_NUM_THREADS");
    ::unsetenv("CHOREO_MODELS");
  }

  void Put(const std::string& name) const {
    const auto shipped = std::filesystem::path(SHIPPED_CHECKPOINT).parent_path();
    std::filesystem::copy_file(shipped / (name + ".safetensors"), models / "written");
    std::filesystem::rename(models / "written", models / (name + ".safetensors"));
  }
  std::vector<std::string> Served() const {
    std::vector<std::string> served;
    for (const auto& model : Client().GetServerInfo().models) served.push_back(model.name);
    return served;
  }
  client::Client Client() const { return client::Client({.addresses = {server->address()}}); }

  std::vector<Pose> Dance(const std::string& model,
                          const std::function<void()>& between = {}) const {
    return DanceAround(Client(), model, 150, between);
  }
  // Loading takes seconds, and longer where others compute.
  static void WaitUntil(const std::function<bool()>& condition) {
    Eventually(condition, std::chrono::minutes(2));
  }
  void Await(const std::vector<std::string>& served) const {
    WaitUntil([&] { return Served() == served; });
    ASSERT_EQ(Served(), served);
  }
  void HangUp(int times) const {
    for (int i = 0; i < times; ++i) kill(server->process(), SIGHUP);
  }

  TemporaryFolder models;
  std::optional<authoring::LocalServer> server;
};

TEST_F(ReloadedChoreodTest, ReloadsItsFolderOnSighup) {
  const std::vector<Pose> wanted = Dance("default");
  ExpectSamePoses(Dance("default",
                        [&] {
                          Put("free");
                          HangUp(100);
                          Await({"default", "free"});
                        }),
                  wanted);
  const std::vector<Pose> free = Dance("free");
  ExpectSamePoses(Dance("default",
                        [&] {
                          std::filesystem::remove(models / "default.safetensors");
                          std::ofstream(models / "free.safetensors") << "broken in its place";
                          HangUp(1);
                          Await({"free"});
                        }),
                  wanted);
  ExpectSamePoses(Dance(""), free);
}

// The kernel may deliver a signal to any thread of the process.
TEST_F(ReloadedChoreodTest, HandlesASignalOnAnyThread) {
  Put("free");
  const std::string tasks = "/proc/" + std::to_string(server->process()) + "/task";
  for (const auto& task : std::filesystem::directory_iterator(tasks))
    tgkill(server->process(), std::stoi(task.path().filename()), SIGHUP);
  Await({"default", "free"});
}

TEST_F(ReloadedChoreodTest, ExitsWithZeroDuringSighups) {
  Put("free");
  HangUp(1);
  kill(server->process(), SIGTERM);
  try {
    WaitUntil([&] {
      HangUp(10);
      server->RequireRunning();
      return false;
    });
    FAIL() << "it does not leave";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("exit code 0"));
  }
}

}  // namespace choreo::reloaded_choreod_test
