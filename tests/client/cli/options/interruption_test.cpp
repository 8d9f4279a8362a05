#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/command_fixture.h"
#include "tests/client/test_music.h"
#include "tests/support/eventually.h"

/// How programs stop on a signal.
namespace choreo::interruption_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

/// Slows frames down, and counts them.
class SlowSampler final : public FakeSampler {
 public:
  explicit SlowSampler(std::atomic<int>* frames) : frames_(frames) {}
  void OnFrame(const TransitionSpec& /*spec*/, Plan* /*plan*/) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    ++*frames_;
  }

 private:
  std::atomic<int>* frames_;
};

class InterruptionTest : public CommandTest {
 protected:
  /// Runs `choreo` and sends it `signal` once `when` holds.
  Outcome Interrupt(const std::string& arguments, int signal, const std::function<bool()>& when) {
    const std::string pid_file = (folder_ / "pid").string();
    std::atomic<bool> over = false;
    std::thread sender([&] {
      Eventually([&] { return over || (when() && std::filesystem::exists(pid_file)); },
                 std::chrono::seconds(300));
      pid_t process = 0;
      if (std::ifstream(pid_file) >> process) kill(process, signal);
    });
    Outcome outcome = Choreo(arguments, "echo $$ > '" + pid_file + "'; exec ");
    over = true;
    sender.join();
    return outcome;
  }
};

TEST_F(InterruptionTest, KeepsReceivedFrames) {
  WriteClicks(folder_ / "song.wav", 60);
  for (const int signal : {SIGINT, SIGTERM}) {
    std::atomic<int> steps = 0;
    const TestServer slow(std::make_unique<SlowSampler>(&steps));
    const Outcome outcome =
        Interrupt("dance --server " + slow.address() + " " + At("song.wav") + " -o " + At("d.npz"),
                  signal, [&] { return steps > 300; });
    EXPECT_EQ(outcome.code, 130) << outcome.said;
    EXPECT_THAT(outcome.said, testing::HasSubstr("the dance was cut off"));
    EXPECT_THAT(outcome.said, testing::Not(testing::HasSubstr("choreo:")));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "d.npz"));
    const size_t frames = ReadMotion(folder_ / "d.partial.npz", Body()).frames.size();
    EXPECT_GT(frames, 0U);
    EXPECT_LT(frames, 1800U);
    std::filesystem::remove(folder_ / "d.partial.npz");
  }
}

TEST_F(InterruptionTest, LeavesNoPartialVideo) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "no ffmpeg here (scripts/install_packages.sh video)";
  WriteMotion(folder_ / "a.npz", Body(),
              {.fps = 30, .frames = std::vector<Pose>(6000, RestPose(Body()))});
  const auto partial = folder_ / "a.mp4.partial";
  const Outcome outcome = Interrupt("render " + At("a.npz") + " --video " + At("a.mp4"), SIGTERM,
                                    [&] { return std::filesystem::exists(partial); });
  EXPECT_EQ(outcome.code, 130) << outcome.said;
  EXPECT_THAT(outcome.said, testing::Not(testing::HasSubstr("choreo:")));
  EXPECT_FALSE(std::filesystem::exists(partial));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mp4"));
}

}  // namespace choreo::interruption_test
