#include "client/style_figures.h"

#include <gtest/gtest.h>

#include "model/core/safetensors.h"

namespace choreo::style_figures_test {

// A checkpoint that is trained on has to be measured anew: scripts/evaluate.sh.
TEST(StyleFigures, AreOfTheShippedCheckpoints) {
  const auto figures_of = [](const std::string& name) {
    const Safetensors content =
        ReadSafetensors(SOURCE_FOLDER "/model/checkpoints/" + name + ".safetensors");
    return client::FindStyleFigures(name + "/" + content.metadata.at("hash") + "/choreo 1.0.0");
  };
  ASSERT_TRUE(figures_of("default"));
  EXPECT_FALSE(figures_of("default")->shows());
  ASSERT_TRUE(figures_of("free"));
  EXPECT_TRUE(figures_of("free")->shows());
  EXPECT_FALSE(client::FindStyleFigures("fake-1"));
  EXPECT_EQ(client::DescribeStyles("fake-1"), "Whether they show was not measured.");
}

}  // namespace choreo::style_figures_test
