#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "client/authoring/keys/pose_library.h"
#include "client/authoring/local_server.h"
#include "client/choreo_client.h"
#include "model/metrics/control_figures.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/client/run_choreo.h"
#include "tests/support/sanitizers.h"
#include "tests/support/temporary_folder.h"

/// How the shipped model follows controls, in choreod itself.
namespace choreo::client::shipped_controls_test {

constexpr int kFrames = 241;
const Skeleton& Body() { return Skeleton::Smpl24(); }

class ShippedControlsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (kSanitized) return;  // choreod runs LibTorch
    server_ = std::make_unique<authoring::LocalServer>(CHOREOD_PROGRAM);
    client_ = std::make_unique<Client>(Options{.addresses = {server_->address()}});
  }
  static void TearDownTestSuite() {
    client_.reset();
    server_.reset();
  }
  void SetUp() override {
    if (!client_) GTEST_SKIP() << "choreod runs LibTorch";
  }

  /// An arc of two metres' radius, a point in each frame, away from the origin, 0.4 m/s.
  static ControlRequest::RootPath Arc() {
    ControlRequest::RootPath path;
    for (int frame = 0; frame < kFrames; ++frame) {
      const double angle = 0.4 * frame / 30 / 2;
      path.frames.push_back(frame);
      path.points.emplace_back(5 - 2 * std::cos(angle), 2 * std::sin(angle) - 3);
    }
    return path;
  }
  /// Dances through four poses of the library, which have no place of their own.
  static DanceResult Dance(const ControlRequest& controls, uint64_t seed = 0) {
    std::vector<KeyPose> keys;
    for (const auto& [id, frame] :
         {std::pair("groove", 60), {"side_reach", 120}, {"disco_point", 180}, {"groove", 240}}) {
      KeyPose& key = keys.emplace_back();
      key.id = id + std::to_string(frame);
      key.frame = frame;
      key.pose = authoring::FindLibraryPose(id).pose;
      key.mask.root_position = false;
    }
    return client_->Dance({.seed = seed, .frames = kFrames, .controls = controls}, keys, {});
  }
  /// Mean velocity factors, metres a frame.
  static std::array<double, kBodyParts> Liveliness(const Motion& motion) {
    return MeanPartSpeeds(Body(), motion.frames);
  }

  /// No joint flips, which is 94 radians a second; no pose is that of the frame before.
  static void ExpectNoFlip(const std::vector<Pose>& poses, const std::string& what) {
    for (size_t i = 1; i < poses.size(); ++i) {
      double most = 0;
      for (int joint = 0; joint < Body().joints(); ++joint) {
        most = std::max(most, RotationDifference(poses[i - 1].rotations.col(joint),
                                                 poses[i].rotations.col(joint))
                                  .norm());
      }
      EXPECT_LT(most * 30, 75) << what << ", frame " << i;
      EXPECT_GT(most, 0) << what << ", frame " << i;
      EXPECT_NE(poses[i].root_position, poses[i - 1].root_position) << what << ", frame " << i;
    }
  }

  static inline std::unique_ptr<authoring::LocalServer> server_;
  static inline std::unique_ptr<Client> client_;
};

TEST_F(ShippedControlsTest, ListsItsControls) {
  const ServerDescription server = client_->GetServerInfo();
  const ModelDescription& model = server.models.front();
  EXPECT_EQ(model.controls, (std::vector<std::string>{"root_path", "velocity_factors"}));
  EXPECT_FALSE(model.deterministic);
}

// Paths and factors had a model of their own once, which clients may still name.
TEST_F(ShippedControlsTest, FormerModelNameMeansTheDefault) {
  DanceConfig named{.model = "controllers", .seed = 3, .frames = 30}, plain = named;
  plain.model = "";
  const auto danced = [](const DanceConfig& request) {
    return client_->Dance(request, {}, {}).motion.frames.back().rotations;
  };
  EXPECT_EQ(danced(named), danced(plain));
  const TemporaryFolder folder;
  const Outcome outcome = Choreo("dance --seconds 3 --model controllers --server " +
                                 server_->address() + " -o " + (folder / "d.npz").string());
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, testing::HasSubstr("warning: --model: \"controllers\" is now another"));
}

TEST_F(ShippedControlsTest, CommandPrintsSpeeds) {
  const TemporaryFolder folder;
  const Outcome outcome = Choreo("dance --seconds 4 --velocity all=2 --server " +
                                 server_->address() + " -o " + (folder / "d.npz").string());
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, testing::HasSubstr("by model \"default\""));
  EXPECT_THAT(outcome.said, testing::HasSubstr("speeds danced (and requested)"));
}

TEST_F(ShippedControlsTest, InfoNamesThePretrainedModel) {
  const Outcome outcome = Choreo("info --cards --server " + server_->address());
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, testing::HasSubstr("went on from"));
}

TEST_F(ShippedControlsTest, FollowsADrawnPathThroughKeys) {
  const ControlRequest controls{.root_path = Arc()};
  const DanceResult dance = Dance(controls);
  ASSERT_EQ(dance.motion.frames.size(), static_cast<size_t>(kFrames));
  EXPECT_TRUE(dance.warnings.empty()) << dance.warnings[0].message;
  double furthest = 0;
  for (size_t i = 0; i < dance.motion.frames.size(); ++i) {
    const Eigen::Vector3d root = dance.motion.frames[i].root_position;
    furthest = std::max(
        furthest, (Eigen::Vector2d(root.x(), root.z()) - controls.root_path->points[i]).norm());
  }
  EXPECT_LT(furthest, 0.05);
  ASSERT_EQ(dance.report.keys.size(), 4U);
  for (const KeyReached& key : dance.report.keys) {
    EXPECT_LT(key.final_error_m, 1e-3) << key.id;
    EXPECT_LT(key.final_error_deg, 0.1) << key.id;
  }
  EXPECT_LT(dance.report.skate_ratio, 0.25);
}

TEST_F(ShippedControlsTest, MakesAnArmFasterOrSlower) {
  ControlRequest controls{.root_path = Arc()};
  const auto danced = [&](double factor) {
    controls.velocity_factors = {.parts = {"left_arm"}, .factors = {factor}};
    return Liveliness(Dance(controls).motion)[1];
  };
  EXPECT_GT(danced(2) / danced(0.5), 1.1);
}

TEST_F(ShippedControlsTest, ReportsPartSpeedsAndMissedOnes) {
  ControlRequest controls{.root_path = Arc()};
  EXPECT_TRUE(Dance(controls).report.part_speeds.empty()) << "nothing was asked";
  controls.velocity_factors = {.parts = {"left_arm", "left_leg"}, .factors = {1, 0}};
  const DanceResult dance = Dance(controls);
  const auto danced = Liveliness(dance.motion);
  ASSERT_EQ(dance.report.part_speeds.size(), static_cast<size_t>(kBodyParts));
  for (size_t part = 0; part < kBodyParts; ++part)
    EXPECT_NEAR(dance.report.part_speeds[part].danced, danced[part], 1e-6) << part;
  const auto& [asked, arm] = dance.report.part_speeds[1];
  EXPECT_GT(asked, 0);
  EXPECT_GT(arm, 0);
  EXPECT_EQ(dance.report.part_speeds[3].asked, 0);
  // A walking dancer cannot keep a leg still.
  ASSERT_EQ(dance.warnings.size(), 1U);
  EXPECT_THAT(dance.warnings[0].message, testing::HasSubstr("left_leg"));
  EXPECT_THAT(dance.warnings[0].message, testing::HasSubstr(" instead of 0"));
}

TEST_F(ShippedControlsTest, ArmSpeedGrowsWithTheRequest) {
  ControlRequest controls{.root_path = Arc()};
  // The way through these keys is itself faster than arms usually are.
  double before = 0;
  for (const double factor : {0.5, 2.0, 4.0}) {
    controls.velocity_factors = {.parts = {"left_arm", "right_arm"}, .factors = {factor, factor}};
    const DanceResult dance = Dance(controls);
    const double danced = dance.report.part_speeds[1].danced + dance.report.part_speeds[2].danced;
    EXPECT_GT(danced, before) << factor;
    before = danced;
  }
}

TEST_F(ShippedControlsTest, NeitherTremblesNorStopsNorFlips) {
  ControlRequest controls{.root_path = Arc()};
  for (const double factor : {0.5, 1.0, 1.5, 2.0}) {
    controls.velocity_factors = {.parts = {"left_arm", "right_arm"}, .factors = {factor, factor}};
    const std::vector<Pose> poses = Dance(controls).motion.frames;
    EXPECT_LT(TremorShare(TrackJoints(Body(), poses), 30), 0.2) << factor;
    ExpectNoFlip(poses, "arms " + std::to_string(factor));
  }
}

TEST_F(ShippedControlsTest, FollowsThePathDown) {
  ControlRequest controls{.root_path = Arc()};
  for (int frame = 0; frame < kFrames; ++frame) {
    const double u = std::clamp((frame - 60) / 60.0, 0.0, 1.0);  // down and up again before key 2
    controls.root_path->heights.push_back(0.95 - 0.3 * std::pow(std::sin(u * M_PI), 2));
  }
  // Footwork may lower the body where legs would not reach the floor, in one dance or another.
  double error = 0;
  int count = 0;
  for (uint64_t seed = 0; seed < 4; ++seed) {
    const DanceResult dance = Dance(controls, seed);
    for (const size_t frame : {75, 90, 105}) {
      error += std::abs(dance.motion.frames[frame].root_position.y() -
                        controls.root_path->heights[frame]);
      ++count;
    }
  }
  EXPECT_LT(error / count, 0.05) << error / count;
}

}  // namespace choreo::client::shipped_controls_test
