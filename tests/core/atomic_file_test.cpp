#include "model/core/files/atomic_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "model/core/files/npy.h"
#include "model/core/files/safetensors.h"
#include "tests/support/expect_error.h"
#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

namespace choreo::atomic_file_test {

class AtomicFileTest : public testing::Test {
 protected:
  std::string Text(const std::filesystem::path& path) const {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  size_t Files() const {
    return static_cast<size_t>(
        std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "file";
};

TEST_F(AtomicFileTest, AppearsWhenItIsComplete) {
  WriteFile(path_, "old");
  {
    AtomicFile file(path_);
    std::ofstream(file.partial()) << "new";
    EXPECT_EQ(Text(path_), "old");
    file.Commit();
  }
  EXPECT_EQ(Text(path_), "new");
  EXPECT_EQ(Files(), 1U);
}

TEST_F(AtomicFileTest, IsDiscardedUnlessCommitted) {
  {
    const AtomicFile file(path_);
    std::ofstream(file.partial()) << "new";
  }
  EXPECT_EQ(Files(), 0U);
}

TEST_F(AtomicFileTest, FailedWriteKeepsTheOldFile) {
  const std::string long_text(100'000, 'x');
  const std::vector<float> values(10'000, 1);
  WriteFile(path_, "good");
  {
    const FullDisk full(5000);
    ExpectError(ErrorCode::kInternal, "file: cannot be written: File too large",
                [&] { WriteFile(path_, long_text); });
    ExpectError(ErrorCode::kInternal, "file: cannot be written", [&] {
      WriteNpy(path_, {{10'000}, values});
    });
    ExpectError(ErrorCode::kInternal, "file: can't be written", [&] {
      WriteSafetensors(path_, {{{"a", {{10'000}, values}}}, {}});
    });
  }
  EXPECT_EQ(Text(path_), "good");
  EXPECT_EQ(Files(), 1U);
}

TEST_F(AtomicFileTest, KeepsALink) {
  WriteFile(folder_ / "there", "old");
  std::filesystem::create_symlink("there", path_);
  WriteFile(path_, "new");
  EXPECT_TRUE(std::filesystem::is_symlink(path_));
  EXPECT_EQ(Text(folder_ / "there"), "new");
}

TEST_F(AtomicFileTest, WritesDevicesInPlace) {
  WriteFile("/dev/null", "nothing");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  ExpectError(ErrorCode::kInternal, "/dev/full: cannot be written: No space left",
              [] { WriteFile("/dev/full", "something"); });
}

TEST_F(AtomicFileTest, ReportsTheReasonOfAFailure) {
  ExpectError(ErrorCode::kInternal, "a: cannot be written: No such file or directory",
              [this] { WriteFile(folder_ / "absent" / "a", "x"); });
}

}  // namespace choreo::atomic_file_test
