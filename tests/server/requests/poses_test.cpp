#include <gmock/gmock.h>

#include <cmath>

#include "tests/server/fixture.h"
#include "tests/support/turning_sampler.h"

/// How poses are encoded in messages.
namespace choreo::poses_test {

/// From frame 80 on, the dancer is farther away than a float can represent.
class LostSampler final : public FakeSampler {
 public:
  void OnFrame(const TransitionSpec& /*spec*/, Plan* plan) override {
    if (++frames_ >= 80) plan->poses.back().root_position.x() = 1e39;
  }

 private:
  int frames_ = 0;
};

class PosesTest : public ServerTest {};

TEST_F(PosesTest, AreFiniteOrTheDanceFails) {
  StartWith(std::make_unique<LostSampler>());
  v1::StreamDanceRequest request;
  *request.mutable_config() = Config();
  request.mutable_config()->set_frames(120);
  const Answer answer = Dance({request});
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::INTERNAL);
  EXPECT_EQ(answer.status.error_message(), "frame 79, as the model makes it, is not finite");
  const Answer::Joined joined = answer.Join();
  EXPECT_EQ(joined.count, 60);  // the transition before
  for (const float number : joined.root_positions) ASSERT_TRUE(std::isfinite(number));
}

TEST_F(PosesTest, QuaternionsKeepTheirSignsThroughWholeTurns) {
  StartWith(std::make_unique<TurningSampler>(0.2, 0.3));
  v1::StreamDanceRequest request;
  *request.mutable_config() = Config();
  request.mutable_config()->set_encoding(v1::ROTATION_ENCODING_QUATERNION);
  request.mutable_config()->set_frames(200);
  const Answer answer = Dance({request});
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  const Answer::Joined joined = answer.Join();
  ASSERT_EQ(joined.rotations.size(), 200U * 24 * 4);
  for (size_t i = 24 * 4; i < joined.rotations.size(); i += 4) {
    const float* now = &joined.rotations[i];
    const float* before = now - 24 * 4;
    float product = 0;
    for (int k = 0; k < 4; ++k) product += now[k] * before[k];
    ASSERT_GT(product, 0) << "frame " << i / (24 * 4);
  }
}

}  // namespace choreo::poses_test
