#include <gtest/gtest.h>

#include "client/describe_styles.h"
#include "model/core/safetensors.h"
#include "proto/wire/convert.h"
#include "server/calls/describe_model.h"

namespace choreo::style_figures_test {

// A checkpoint that is trained on has to be measured anew: scripts/evaluate.sh.
TEST(StyleFigures, AreOfTheShippedCheckpoints) {
  const auto figures_of = [](const std::string& name) {
    const Safetensors content =
        ReadSafetensors(SOURCE_FOLDER "/model/checkpoints/" + name + ".safetensors");
    ModelInfo model;
    model.skeleton = Skeleton::Smpl24();
    model.weights = content.metadata.at("hash");
    return DescribeModel(model).style_figures;
  };
  ASSERT_TRUE(figures_of("default"));
  EXPECT_FALSE(figures_of("default")->shows());
  ASSERT_TRUE(figures_of("free"));
  EXPECT_TRUE(figures_of("free")->shows());
  EXPECT_EQ(client::DescribeStyles({}), "Whether they show was not measured.");
}

TEST(StyleFigures, ReachClients) {
  ModelInfo model;
  model.skeleton = Skeleton::Smpl24();
  EXPECT_FALSE(wire::ToProto(DescribeModel(model)).has_style_recognition());
  model.weights = "26bfadad19dc69d0590692f89aafbedb";
  const v1::ModelInfo told = wire::ToProto(DescribeModel(model));
  EXPECT_FALSE(told.style_recognition().shows());
  EXPECT_EQ(told.style_recognition().recognised_percent(), 7.9);
  EXPECT_EQ(client::DescribeStyles(wire::FromProto(told).style_figures),
            "They do not show: in 8 % of seconds a classifier recognises the requested style, by "
            "chance in 6 %.");
}

}  // namespace choreo::style_figures_test
