#include "server/settings/live_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "server/settings/config_flags.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

/// What a running server takes over from settings that have changed.
namespace choreo::live_settings_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class LiveSettingsTest : public testing::Test {
 protected:
  ServerConfig Read(const std::string& settings, std::vector<const char*> flags = {}) {
    std::ofstream(file) << settings;
    return Reread(std::move(flags));
  }
  ServerConfig Reread(std::vector<const char*> flags = {}) {
    flags.insert(flags.begin(), {"choreod", "--config", file.c_str()});
    return RereadConfig(static_cast<int>(flags.size()), flags.data());
  }

  TemporaryFolder folder;
  const std::string file = (folder / "choreod.toml").string();
};

TEST_F(LiveSettingsTest, LimitsAreUsedAtOnceAndOthersWait) {
  ServerConfig config = Read("max-streams = 5\nidle-seconds = 30\nio-threads = 2\n");
  const ServerConfig fresh = Read("max-streams = 7\nlog-level = \"debug\"\nio-threads = 3\n");
  SettingsChange change = TakeOver(fresh, &config);
  EXPECT_THAT(change.used,
              ElementsAre("idle-seconds is the default, was 30",
                          "log-level is debug, was the default", "max-streams is 7, was 5"));
  EXPECT_THAT(change.waiting, ElementsAre("io-threads is 3, was 2"));
  EXPECT_EQ(config.max_streams, 7);
  EXPECT_EQ(config.idle_seconds, ServerConfig().idle_seconds);
  EXPECT_EQ(config.log_level, "debug");
  EXPECT_EQ(config.io_threads, 2);
  change = TakeOver(fresh, &config);
  EXPECT_THAT(change.used, IsEmpty());
  EXPECT_THAT(change.waiting, ElementsAre("io-threads is 3, was 2")) << "it still waits";
}

TEST_F(LiveSettingsTest, ThePageNamesThoseThatAreUsedAtOnce) {
  std::ifstream page(std::filesystem::path(SOURCE_FOLDER) / "docs/settings.md");
  std::string row;
  while (std::getline(page, row) && !row.starts_with("| `max-streams`, ")) continue;
  const RereadSettings reread = SettingsToReread();
  for (const auto& [flag, copy] : reread) EXPECT_THAT(row, HasSubstr('`' + flag + '`'));
  EXPECT_EQ(static_cast<size_t>(std::ranges::count(row, '`')), 2 * reread.size());
}

TEST_F(LiveSettingsTest, AFlagStillOverridesTheFile) {
  ServerConfig config = Read("max-streams = 5\n", {"--max-streams", "9"});
  const ServerConfig fresh = Read("max-streams = 7\nreflection = true\nidle-seconds = 9\n",
                                  {"--max-streams", "9", "--no-reflection"});
  EXPECT_THAT(TakeOver(fresh, &config).used, ElementsAre("idle-seconds is 9, was the default"));
  EXPECT_EQ(config.max_streams, 9);
  EXPECT_THAT(fresh.overridden, ElementsAre("max-streams", "reflection"));
}

TEST_F(LiveSettingsTest, ABadSettingIsNamedWithItsLine) {
  ExpectError(ErrorCode::kInvalidArgument, file + ":2: --max-streams: -1",
              [&] { Read("workers = 1\nmax-streams = -1\n"); });
}

// A writer may have failed, or the disk was full.
TEST_F(LiveSettingsTest, AFileThatSetsNothingIsRefused) {
  for (const char* empty : {"", "\n", "# max-streams = 5\n"})
    ExpectError(ErrorCode::kInvalidArgument, "--config: " + file + " sets nothing",
                [&] { Read(empty); });
}

TEST_F(LiveSettingsTest, AFileThatCannotBeReadIsNamedWithTheReason) {
  std::filesystem::create_symlink(file, file);
  const auto expect = [&](const std::string& fault) {
    ExpectError(ErrorCode::kInvalidArgument, "--config: " + fault, [&] { Reread(); });
  };
  expect("cannot read " + file + ": Too many levels of symbolic links");
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  expect(file + " is a directory, no file");
  std::filesystem::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  expect(file + " is a FIFO, no file");
  std::filesystem::remove(file);
  ExpectError(ErrorCode::kInvalidArgument, "--config: " + file + " has 2097152 bytes, of at most",
              [&] { Read(std::string(2 << 20, '#')); });
  EXPECT_EQ(Read("max-streams = 6\n").max_streams, 6);
}

}  // namespace choreo::live_settings_test
