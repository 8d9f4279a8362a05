#include "model/flow/checkpoint/style_figures_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "model/core/files/atomic_file.h"
#include "model/core/files/safetensors.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

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
    ExpectError(ErrorCode::kInvalidArgument, "weights: \"",
                [&] { ReadStyleFigures(checkpoint, "of a later training"); });
  }
}

std::string Figures(int recognised, int chance, int low) {
  return R"({"weights": "a", "styles": {"recognised": )" + std::to_string(recognised) +
         R"(, "chance": )" + std::to_string(chance) + R"(, "low": )" + std::to_string(low) + "}}";
}

TEST(StyleFiguresFile, MayBeMissingButNotBroken) {
  const TemporaryFolder folder;
  const std::filesystem::path checkpoint = folder / "measured.safetensors";
  const std::filesystem::path file = folder / "measured.figures.json";
  EXPECT_FALSE(ReadStyleFigures(checkpoint, "a"));
  const std::string whole = Figures(60, 25, 50);
  WriteFile(file, whole);
  EXPECT_EQ(ReadStyleFigures(checkpoint, "a")->low, 50);
  const std::pair<std::string, std::string> faults[] = {
      {"{", ": is not JSON from byte 2 on"},
      {std::string(1'000, '['), ": is JSON of more than 64 levels"},
      {whole + std::string(100'000, ' '), ": 100071 bytes, the limit is 65536"},
      {"1e999", ": has a number beyond 1.8e308"},
      {"[1]", ": weights: missing"},
      {R"({"weights": 7})", ": weights: 7 is no text"},
      {R"({"weights": "b"})", R"(: weights: "b" is another checkpoint's hash; this one's is "a")"},
      {R"({"weights": "a"})", ": styles: missing"},
      {R"({"weights": "a", "styles": {}})", ": styles.recognised: missing"},
      {R"({"weights": "a", "styles": {"recognised": "60"}})",
       R"(: styles.recognised: "60" is no number)"},
      {Figures(120, 25, 50), ": styles.recognised: 120 % is not in [0, 100]"},
      {Figures(60, -1, 50), ": styles.chance: -1 % is not in [0, 100]"},
      {Figures(60, 25, 61), ": styles.low: 61 % is above recognised, 60 %"},
  };
  for (const auto& [broken, fault] : faults) {
    WriteFile(file, broken);
    ExpectError(ErrorCode::kInvalidArgument, file.string() + fault,
                [&] { ReadStyleFigures(checkpoint, "a"); });
  }
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  ExpectError(ErrorCode::kInvalidArgument, file.string() + ": is no regular file",
              [&] { ReadStyleFigures(checkpoint, "a"); });
}

}  // namespace choreo::style_figures_file_test
