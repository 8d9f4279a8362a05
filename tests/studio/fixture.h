#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <thread>

#include "model/core/atomic_file.h"
#include "studio/web_server.h"
#include "tests/client/test_music.h"
#include "tests/client/test_server.h"
#include "tests/studio/page.h"
#include "tests/support/temporary_folder.h"

namespace choreo::studio {

/// The studio in this process, open to pages.
class Opened {
 public:
  explicit Opened(const std::string& server, const std::filesystem::path& song = {},
                  const std::filesystem::path& photo_model = {})
      : context_({.addresses = {server}}, song, photo_model), web_("127.0.0.1:0", context_) {
    thread_ = std::thread([this] { web_.Run([] { return true; }); });
  }
  ~Opened() {
    web_.Stop();
    thread_.join();
  }
  int port() const { return web_.port(); }
  const StudioContext& context() const { return context_; }

 private:
  StudioContext context_;
  WebServer web_;
  std::thread thread_;
};

/// A studio with its server; the test is the page.
class StudioTest : public testing::Test {
 protected:
  std::string Clicks(double seconds) {
    WriteClicks(folder_ / "clicks.wav", seconds);
    return ReadFile(folder_ / "clicks.wav");
  }
  static Request SongRequest(const std::string& name, const std::string& data) {
    Request request;
    request.mutable_song()->set_name(name);
    request.mutable_song()->set_data(data);
    return request;
  }
  static Request DanceRequest(int64_t frames, uint64_t seed) {
    Request request;
    request.mutable_dance()->mutable_config()->set_frames(frames);
    request.mutable_dance()->mutable_config()->set_seed(seed);
    return request;
  }
  static Request KeyRequest(const LibraryPose& pose, int64_t frame) {
    Request request;
    v1::Keyframe* key = request.mutable_dance()->mutable_keyframe();
    key->set_id(pose.id());
    key->set_frame(frame);
    *key->mutable_pose() = pose.pose();
    return request;
  }
  static Request Complete() {
    Request request;
    request.mutable_dance()->mutable_keyframes_complete();
    return request;
  }
  /// All frames of call 2, to its summary.
  static v1::Frames ReadDance(Page& page) {
    v1::Frames all;
    for (;;) {
      const Response response = page.Read();
      EXPECT_EQ(response.call(), 2U);
      EXPECT_FALSE(response.has_failure()) << response.failure().message();
      if (response.has_failure() || response.dance().has_summary()) return all;
      const v1::Frames& frames = response.dance().frames();
      EXPECT_EQ(frames.count() == 0 || frames.first_frame() == all.count(), true);
      all.set_count(all.count() + frames.count());
      all.mutable_root_positions()->MergeFrom(frames.root_positions());
      all.mutable_rotations()->MergeFrom(frames.rotations());
      all.mutable_contacts()->MergeFrom(frames.contacts());
    }
  }

  TemporaryFolder folder_;
  TestServer server_;
};

}  // namespace choreo::studio
