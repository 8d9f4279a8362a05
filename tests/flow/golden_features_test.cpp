#include <gtest/gtest.h>

#include <span>

#include "model/flow/window/window_features.h"
#include "tests/flow/flow_scene.h"

// The order and the values of a window's input features, as the shipped checkpoints were trained on
// them. As long as they stay, the checkpoints' dances stay the same.
namespace choreo::golden_features_test {

WindowRequest Asked() {
  Scene scene = MakeScene(30);
  WindowRequest request = scene.request;
  request.beats = {2, 13, 25};
  ControlCurve& path = request.controls[kRootPath];
  ControlCurve& energy = request.controls[kVelocityFactors];
  path.values.resize(3, 30);
  energy.values.resize(kBodyParts, 30);
  for (int i = 0; i < 30; ++i) {
    path.values.col(i) =
        scene.truth[static_cast<size_t>(i)].root_position + Eigen::Vector3d(0.1, 0.2, 0.01 * i);
    for (int part = 0; part < kBodyParts; ++part)
      energy.values(part, i) = 0.01 * (part + 1) + 0.001 * i;
  }
  energy.requested = {true, true, false, true, true};
  request.style = 1;
  return request;
}

WindowFeatures Features() {
  FlowModelParts parts = Parts();
  parts.config.median_factors = {0.01, 0.02, 0.03, 0.04, 0.05};
  parts.config.styles = {"calm", "wild", "slow"};
  const WindowRequest request = Asked();
  return DescribeWindow(parts.skeleton, parts.config, parts.prior, request,
                        FlowWindow(parts.prior, request));
}

// clang-format off
constexpr float kOfHistory[] = {
    1, 1, 0.9898214F, -0.1423148F, -0.2817326F, -0.959493F, -0.6203098F, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0.2794155F, 0.9601703F, -0.9471481F, -0.3207965F, -0.5646425F,
    0.8253356F, -0.1886003F, 0.9820539F, -0.059964F, 0.9982005F, -0.01897253F, 0.99982F,
    -0.005999964F, 0.999982F, -0.001897365F, 0.9999982F, -0.4281827F, -0.9036922F, -0.9973804F,
    0.0723343F, -0.3507832F, -0.9364567F, 0.8942699F, 0.447528F, 0.3428978F, 0.9393727F,
    0.1104539F, 0.9938812F, 0.03499286F, 0.9993876F, 0.01106775F, 0.9999387F};
constexpr float kOfTheWindow[] = {
    0, 1, 0.9898214F, -0.1423148F, -0.2817326F, -0.959493F, -0.6203098F, 1, 1, 0.3422788F,
    0.6731758F, 0.1801201F, 0.3746935F, 0.2135741F, 0, 0.1150693F, 0.09352606F, 1, 1, 0, 1, 1,
    -0.9589243F, 0.2836622F, 0.9999465F, -0.01034232F, 0.4794255F, 0.8775826F, 0.1574559F,
    0.987526F, 0.04997917F, 0.9987503F, 0.01581073F, 0.999875F, 0.004999979F, 0.9999875F,
    0.001581138F, 0.9999987F, -0.9055784F, 0.424179F, 0.9652193F, 0.2614414F, 0.6754632F,
    -0.7373937F, 0.6881576F, 0.7255613F, 0.2377026F, 0.971338F, 0.07582182F, 0.9971214F,
    0.0239977F, 0.999712F, 0.007589393F, 0.9999712F};
// clang-format on

void ExpectColumn(const Eigen::MatrixXf& features, int at, std::span<const float> golden) {
  ASSERT_EQ(static_cast<size_t>(features.rows()), golden.size());
  for (int i = 0; i < features.rows(); ++i)
    EXPECT_NEAR(features(i, at), golden[static_cast<size_t>(i)], 1e-5) << "feature " << i;
}

TEST(GoldenFeatures, OfFrames) {
  const WindowFeatures features = Features();
  EXPECT_EQ(FrameFeatures(), 54);
  ExpectColumn(features.frames, 4, kOfHistory);
  ExpectColumn(features.frames, 15, kOfTheWindow);
}

TEST(GoldenFeatures, OfTheWhole) {
  const Eigen::VectorXf whole = Features().whole;
  struct Block {
    const char* name;
    int begin, end;
    double first, weighed;  // its first number; all of them times 1, 2, ...
  };
  const Block blocks[] = {
      {"rotations in 6D", 0, 144, 0.9920006, 3501.623},
      {"height", 144, 145, 0.01566654, 0.01566654},
      {"velocity", 145, 220, 1.600015, -2079.323},
      {"way to the key", 220, 295, 0.4238771, -756.1196},
      {"what it fixes", 295, 370, 1, 2850},
      {"whether there is one", 370, 371, 1, 1},
      {"when", 371, 387, 0.9998907, 62.59495},
      {"style", 387, 390, 0, 2},
  };
  for (const Block& block : blocks) {
    const int size = block.end - block.begin;
    const Eigen::VectorXd own = whole.segment(block.begin, size).cast<double>();
    EXPECT_NEAR(own[0], block.first, 1e-5) << block.name;
    EXPECT_NEAR(own.dot(Eigen::VectorXd::LinSpaced(size, 1, size)), block.weighed, 1e-2)
        << block.name;
  }
  EXPECT_EQ(whole.size(), blocks[7].end);
}

}  // namespace choreo::golden_features_test
