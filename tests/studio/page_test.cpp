#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <optional>
#include <thread>

#include "client/authoring/keys/pose_library.h"
#include "studio/page.h"
#include "tests/studio/opened_studio.h"
#include "tests/support/expect_error.h"

namespace choreo::studio::page_test {

using ::testing::HasSubstr;

/// Makes no frame while it is held.
class HeldSampler final : public FakeSampler {
 public:
  explicit HeldSampler(const std::atomic<bool>& held) : held_(held) {}
  void OnFrame(const TransitionSpec& /*spec*/, Plan* /*plan*/) override { held_.wait(true); }

 private:
  const std::atomic<bool>& held_;
};

TEST_F(StudioTest, ServesThePageAndNothingElse) {
  const Opened studio(server_.address());
  const HttpResponse page = Get(studio.port(), "/");
  EXPECT_EQ(page.result_int(), 200U);
  EXPECT_THAT(page.body(), HasSubstr("Choreo studio"));
  EXPECT_THAT(std::string(page["Content-Security-Policy"]), HasSubstr("default-src 'self'"));
  EXPECT_EQ(Get(studio.port(), "/studio.js").body(), FindPageFile("/studio.js")->data);
  EXPECT_EQ(Get(studio.port(), "/../etc/passwd").result_int(), 404U);
}

TEST_F(StudioTest, RefusesOtherOrigins) {
  const Opened studio(server_.address());
  EXPECT_EQ(Get(studio.port(), "/", "elsewhere.example").result_int(), 403U);
  EXPECT_THROW(Page(studio.port(), "http://elsewhere.example"), boost::system::system_error);
  const std::string own = "http://127.0.0.1:" + std::to_string(studio.port());
  EXPECT_EQ(Page(studio.port(), own).welcome().model().name(), "fake");
}

TEST_F(StudioTest, WelcomesWithModelPosesAndBody) {
  Clicks(4);
  const Opened studio(server_.address(), folder_ / "clicks.wav");
  const Page page(studio.port());
  EXPECT_EQ(page.welcome().model().skeleton().joint_names_size(), 24);
  // All of the library, those that stand first.
  std::vector<std::string> stances;
  for (const LibraryPose& pose : page.welcome().poses()) {
    EXPECT_EQ(authoring::FindLibraryPose(pose.id()).tags.front(), pose.stance()) << pose.id();
    if (stances.empty() || stances.back() != pose.stance()) stances.push_back(pose.stance());
  }
  EXPECT_EQ(page.welcome().poses_size(), std::ssize(authoring::PoseLibrary()));
  EXPECT_THAT(stances, testing::ElementsAre("standing", "travelling", "jump", "floor"));
  EXPECT_EQ(page.welcome().body().substr(0, 4), "glTF");
  EXPECT_EQ(page.welcome().limits().song_s(), 600);  // the server's
  EXPECT_EQ(page.welcome().limits().dancers(), 64);
  EXPECT_EQ(page.welcome().limits().key_distance(), 2);
  EXPECT_EQ(page.welcome().song().name(), "clicks.wav");
  EXPECT_NEAR(page.welcome().heard().seconds(), 4, 1e-3);
  EXPECT_EQ(page.welcome().styles_shown(), "Whether they show was not measured.");
}

// Its last request is still running, and can't be stopped.
TEST_F(StudioTest, ClosedPageBlocksNoOther) {
  std::atomic<bool> held = true;
  const TestServer slow(std::make_unique<HeldSampler>(held));
  const Opened studio(slow.address());
  std::optional<Page> page(std::in_place, studio.port());
  Request request;
  *request.mutable_retake()->mutable_dance() = Standing(40);
  request.mutable_retake()->mutable_project()->set_seconds(1);
  request.mutable_retake()->set_to(20);
  page->Say(2, request);
  while (slow.transitions() == 0) std::this_thread::yield();
  page.reset();
  const Page other(studio.port());
  held = false;
  held.notify_all();
  EXPECT_EQ(other.welcome().model().name(), "fake");
}

TEST_F(StudioTest, ServesThePhotoReaderIfInstalled) {
  const Opened without(server_.address());
  EXPECT_FALSE(Page(without.port()).welcome().reads_photos());
  EXPECT_EQ(Get(without.port(), "/photo/pose.js").result_int(), 404U);
  for (const char* name :
       {"pose.js", "pose_landmark_full.tflite", "pose_solution_packed_assets.data",
        "pose_solution_packed_assets_loader.js", "pose_solution_simd_wasm_bin.data",
        "pose_solution_simd_wasm_bin.js", "pose_solution_simd_wasm_bin.wasm", "pose_web.binarypb",
        "secret"}) {
    std::ofstream(folder_ / name) << name;
  }
  const Opened studio(server_.address(), {}, folder_.path());
  EXPECT_TRUE(Page(studio.port()).welcome().reads_photos());
  const HttpResponse part = Get(studio.port(), "/photo/pose_solution_simd_wasm_bin.wasm");
  EXPECT_EQ(part.body(), "pose_solution_simd_wasm_bin.wasm");
  EXPECT_EQ(part["Content-Type"], "application/wasm");
  EXPECT_EQ(Get(studio.port(), "/photo/secret").result_int(), 404U);
  EXPECT_EQ(Get(studio.port(), "/photo/../photo/secret").result_int(), 404U);
}

TEST_F(StudioTest, ExplainsErrors) {
  const Opened studio(server_.address());
  Page page(studio.port());
  EXPECT_THAT(page.Ask(SongRequest("hum.wav", "la la la")).failure().message(),
              HasSubstr("hum.wav: "));
  Request open;
  open.mutable_open()->set_name("walk.fbx");
  EXPECT_THAT(page.Ask(open).failure().message(), HasSubstr("walk.fbx"));
  Request dance = DanceRequest(40, 1);
  AddKey(page.welcome().poses(0), 10, dance.mutable_dance()->mutable_project())
      ->mutable_pose()
      ->mutable_rotations()
      ->RemoveLast();
  EXPECT_THAT(page.Ask(dance).failure().message(), HasSubstr("project:keyframes[0].rotations"));
  // The next call is served.
  page.Say(2, DanceRequest(20, 1));
  EXPECT_EQ(ReadDance(page).count(), 20);
}

TEST(WebServerTest, NamesAnInvalidAddress) {
  const TestServer server;
  const StudioContext context({.addresses = {server.address()}}, "");
  ExpectError(ErrorCode::kInvalidArgument, "--listen", [&] { WebServer("nowhere", context); });
  ExpectError(ErrorCode::kInvalidArgument, "--listen",
              [&] { WebServer("127.0.0.1:70000", context); });
  const WebServer first("127.0.0.1:0", context);
  ExpectError(ErrorCode::kInvalidArgument, "--listen",
              [&] { WebServer("127.0.0.1:" + std::to_string(first.port()), context); });
}

}  // namespace choreo::studio::page_test
