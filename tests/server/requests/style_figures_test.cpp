#include <gtest/gtest.h>

#include "client/describe_styles.h"
#include "proto/wire/convert.h"
#include "server/calls/describe_model.h"

namespace choreo::style_figures_test {

TEST(StyleFigures, ReachClients) {
  ModelInfo model;
  model.skeleton = Skeleton::Smpl24();
  EXPECT_FALSE(wire::ToProto(DescribeModel(model)).has_style_recognition());
  EXPECT_EQ(client::DescribeStyles({}), "Whether they show was not measured.");
  model.style_figures = StyleFigures{.recognised = 7.9, .chance = 6.25, .low = 7.1};
  const v1::ModelInfo told = wire::ToProto(DescribeModel(model));
  EXPECT_FALSE(told.style_recognition().shows());
  EXPECT_EQ(told.style_recognition().recognised_percent(), 7.9);
  EXPECT_EQ(client::DescribeStyles(wire::FromProto(told).style_figures),
            "They do not show: in 8 % of seconds a classifier recognises the requested style, by "
            "chance in 6 %.");
}

}  // namespace choreo::style_figures_test
