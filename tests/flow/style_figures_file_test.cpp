#include "model/flow/style_figures_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "model/core/atomic_file.h"
#include "model/core/safetensors.h"
#include "tests/support/expect_error.h"

namespace choreo::style_figures_file_test {

// A checkpoint that is trained on has to be measured anew: scripts/evaluate.sh.
TEST(StyleFiguresFile, IsOfTheShippedCheckpoints) {
  for (const auto& [name, shows] : {std::pair{"default", false}, {"free", true}}) {
    SCOPED_TRACE(name);
    const std::filesystem::path checkpoint =
        std::string(CHOREO_SOURCE_DIR "/model/checkpoints/") + name + ".safetensors";
    const auto figures =
        ReadStyleFigures(checkpoint, ReadSafetensors(checkpoint).metadata.at("hash"));
    ASSERT_TRUE(figures);
    EXPECT_EQ(figures->shows(), shows);
    EXPECT_FALSE(ReadStyleFigures(checkpoint, "of a later training"));
  }
}

std::string Figures(int recognised, int chance, int low) {
  return R"({"weights": "a", "styles": {"recognised": )" + std::to_string(recognised) +
         R"(, "chance": )" + std::to_string(chance) + R"(, "low": )" + std::to_string(low) + "}}";
}

TEST(StyleFiguresFile, MayBeMissingButNotBroken) {
  const std::filesystem::path folder = testing::TempDir();
  const std::filesystem::path checkpoint = folder / "measured.safetensors";
  const std::filesystem::path file = folder / "measured.figures.json";
  EXPECT_FALSE(ReadStyleFigures(checkpoint, "a"));
  const std::string whole = Figures(60, 25, 50);
  WriteFile(file, whole);
  EXPECT_EQ(ReadStyleFigures(checkpoint, "a")->low, 50);
  for (const std::string& broken :
       {std::string("{"), std::string(R"({"weights": "a"})"), std::string(1'000, '['),
        whole + std::string(100'000, ' '), Figures(120, 25, 50), Figures(60, -1, 50),
        Figures(60, 25, 61)}) {
    WriteFile(file, broken);
    ExpectError(ErrorCode::kInvalidArgument, file.string(),
                [&] { ReadStyleFigures(checkpoint, "a"); });
  }
  std::filesystem::remove(file);
}

}  // namespace choreo::style_figures_file_test
