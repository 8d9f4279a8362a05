#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "model/core/files/atomic_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "proto/wire/convert.h"
#include "studio/web_server.h"
#include "tests/client/test_music.h"
#include "tests/client/test_server.h"
#include "tests/studio/page_client.h"
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
    Project* project = request.mutable_dance()->mutable_project();
    project->set_seconds(static_cast<double>(frames) / 30);
    project->set_seed(seed);
    return request;
  }
  static v1::Keyframe* AddKey(const LibraryPose& pose, int64_t frame, Project* project) {
    v1::Keyframe* key = project->add_keys()->mutable_key();
    key->set_id(pose.id());
    key->set_frame(frame);
    *key->mutable_pose() = pose.pose();
    return key;
  }
  /// Live music of one channel.
  static Request LiveRequest(uint64_t seed, uint32_t rate) {
    Request request = DanceRequest(3000, seed);
    v1::AudioFormat* format = request.mutable_dance()->mutable_live_music();
    format->set_encoding(v1::AUDIO_ENCODING_PCM_F32LE);
    format->set_sample_rate(rate);
    format->set_channels(1);
    return request;
  }
  static void Grant(uint32_t call, int64_t frame, Page* page) {
    Request request;
    request.mutable_live()->mutable_generate_until()->set_frame(frame);
    page->Say(call, request);
  }
  static void Play(uint32_t call, std::span<const float> samples, Page* page) {
    Request request;
    request.mutable_live()->mutable_audio()->set_data(samples.data(), samples.size_bytes());
    page->Say(call, request);
  }
  static void EndMusic(uint32_t call, Page* page) {
    Request end, complete;
    end.mutable_live()->mutable_end_of_audio();
    complete.mutable_live()->mutable_keyframes_complete();
    page->Say(call, end);
    page->Say(call, complete);
  }
  /// The dancer at rest.
  static Clip Standing(int frames) {
    Clip clip;
    clip.set_frame_rate(30);
    const Pose rest = RestPose(Skeleton::Smpl24());
    *clip.mutable_frames() = wire::ToProto(0, std::vector<Pose>(static_cast<size_t>(frames), rest),
                                           std::vector<Contacts>(static_cast<size_t>(frames)));
    return clip;
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
