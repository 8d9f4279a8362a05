#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <fstream>
#include <optional>
#include <thread>

#include "client/cli/key_file.h"
#include "client/cli/photo_pose.h"
#include "client/convert.h"
#include "model/motion/kinematics.h"
#include "studio/keeper.h"
#include "studio/page.h"
#include "studio/web_server.h"
#include "tests/client/test_music.h"
#include "tests/client/test_server.h"
#include "tests/studio/page.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::studio::studio_test {

using ::testing::HasSubstr;

/// The studio in this process, open to pages.
class Opened {
 public:
  explicit Opened(const std::string& server, const std::filesystem::path& song = {},
                  const std::filesystem::path& photo_model = {})
      : house_({.addresses = {server}}, song, photo_model), web_("127.0.0.1:0", house_) {
    thread_ = std::thread([this] { web_.Run([] { return true; }); });
  }
  ~Opened() {
    web_.Stop();
    thread_.join();
  }
  int port() const { return web_.port(); }
  const House& house() const { return house_; }

 private:
  House house_;
  WebServer web_;
  std::thread thread_;
};

/// Makes no step while it is held.
class HeldEngine final : public FakeEngine {
 public:
  explicit HeldEngine(const std::atomic<bool>& held) : held_(held) {}
  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override {
    held_.wait(true);
    FakeEngine::Step(in, out);
  }

 private:
  const std::atomic<bool>& held_;
};

class StudioTest : public testing::Test {
 protected:
  std::string Clicks(double seconds) {
    WriteClicks(folder_ / "clicks.wav", seconds);
    return ReadBytes(folder_ / "clicks.wav");
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

TEST_F(StudioTest, ServesThePageAndNothingElse) {
  const Opened studio(server_.address());
  const HttpResponse page = Get(studio.port(), "/");
  EXPECT_EQ(page.result_int(), 200U);
  EXPECT_THAT(page.body(), HasSubstr("Choreo studio"));
  EXPECT_THAT(std::string(page["Content-Security-Policy"]), HasSubstr("default-src 'self'"));
  EXPECT_EQ(Get(studio.port(), "/studio.js").body(), FindPageFile("/studio.js")->data);
  EXPECT_EQ(Get(studio.port(), "/../etc/passwd").result_int(), 404U);
}

TEST_F(StudioTest, IsForItsOwnPageAlone) {
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
  EXPECT_GE(page.welcome().poses_size(), 12);
  EXPECT_EQ(page.welcome().body().substr(0, 4), "glTF");
  EXPECT_EQ(page.welcome().song().name(), "clicks.wav");
  EXPECT_NEAR(page.welcome().heard().seconds(), 4, 1e-3);
}

TEST_F(StudioTest, HearsASongAndComposesOnItsBeats) {
  const Opened studio(server_.address());
  Page page(studio.port());
  const Response heard = page.Ask(SongRequest("clicks.wav", Clicks(12)));
  ASSERT_TRUE(heard.has_song()) << heard.failure().message();
  EXPECT_NEAR(heard.song().tempo(), 120, 3);
  EXPECT_EQ(heard.song().suggested_size(), 5);
  EXPECT_EQ(heard.song().peaks_size(), 480);
  Request compose;
  compose.mutable_compose()->set_seconds(12);
  const Response keys = page.Ask(compose);
  EXPECT_GE(keys.keyframes().keyframes_size(), 5);
}

// The same frames as the client library gets: the studio adds the song and its beats, no more.
TEST_F(StudioTest, DancesAsTheClientLibraryDoes) {
  const Opened studio(server_.address());
  Page page(studio.port());
  const std::string clicks = Clicks(4);
  ASSERT_TRUE(page.Ask(SongRequest("clicks.wav", clicks)).has_song());
  const LibraryPose& kick = page.welcome().poses(6);
  page.Say(2, DanceRequest(120, 7));
  page.Say(2, KeyRequest(kick, 45));
  page.Say(2, Complete());
  const v1::Frames frames = ReadDance(page);
  ASSERT_EQ(frames.count(), 120);

  const Song song = HearSong(folder_ / "clicks.wav", "clicks.wav", 600);
  client::KeyPose key{.id = kick.id(), .frame = 45};
  key.pose.root_position = {kick.pose().root_position().x(), kick.pose().root_position().y(),
                            kick.pose().root_position().z()};
  key.pose.rotations =
      Eigen::Map<const Eigen::Matrix3Xf>(kick.pose().rotations().data(), 3, 24).cast<double>();
  client::DanceConfig config{.seed = 7, .frames = 120};
  config.music_beats = cli::BeatsBefore(song.music, song.heard.seconds());
  const client::DanceResult own = studio.house().client().Dance(config, {key}, song.audio);
  ASSERT_EQ(own.motion.frames.size(), 120U);
  for (int frame = 0; frame < 120; ++frame) {
    for (int i = 0; i < 72; ++i) {
      ASSERT_EQ(frames.rotations(72 * frame + i),
                static_cast<float>(own.motion.frames[static_cast<size_t>(frame)].rotations(i)))
          << "frame " << frame;
    }
  }
}

// Of a key that no body could dance, once all are there; and of one that an interval leads to.
TEST_F(StudioTest, TellsOfImpossibleKeys) {
  const Opened studio(server_.address());
  Page page(studio.port());
  LibraryPose sunk = page.welcome().poses(6);
  sunk.mutable_pose()->mutable_root_position()->set_y(0.2F);
  page.Say(2, DanceRequest(90, 7));
  page.Say(2, KeyRequest(page.welcome().poses(6), 30));
  page.Say(2, KeyRequest(sunk, 60));
  page.Say(2, Complete());
  const auto next_warning = [&](auto event_of) {
    while (true) {
      const v1::Event event = event_of(page.Read());
      if (event.has_warning()) return event;
    }
  };
  const v1::Event told = next_warning([](const Response& said) { return said.dance().event(); });
  EXPECT_EQ(told.frame(), 60);
  EXPECT_THAT(told.warning().message(), HasSubstr("floor"));

  Request request;
  v1::GenerateTransitionRequest* transition = request.mutable_transition();
  transition->set_frames(20);
  transition->set_target_id("sunk");
  *transition->mutable_target() = sunk.pose();
  page.Say(3, request);
  const v1::Event again =
      next_warning([](const Response& said) { return said.transition().event(); });
  EXPECT_EQ(again.frame(), 19);
  EXPECT_THAT(again.warning().message(), HasSubstr("key \"sunk\": "));
}

TEST_F(StudioTest, DancesInAStyle) {
  const Opened studio(server_.address());
  Page page(studio.port());
  EXPECT_THAT(page.welcome().model().styles(), testing::ElementsAre("calm", "wild"));
  const auto danced = [&](const std::string& style) {
    Request request = DanceRequest(20, 7);
    request.mutable_dance()->mutable_config()->set_style(style);
    page.Say(2, request);
    page.Say(2, Complete());
    return ReadDance(page).SerializeAsString();
  };
  const std::string calm = danced("");
  EXPECT_EQ(calm, danced("calm"));
  EXPECT_NE(calm, danced("wild"));
}

TEST_F(StudioTest, RefusesASongThatIsLongerThanADance) {
  Clicks(5);
  ExpectError(ErrorCode::kInvalidArgument, "long.wav: is longer than 4 s",
              [&] { HearSong(folder_ / "clicks.wav", "long.wav", 4); });
  EXPECT_NEAR(HearSong(folder_ / "clicks.wav", "long.wav", 5).heard.seconds(), 5, 1e-3);
}

// What a moved key does: from the frames before it onto it, and into those that follow.
TEST_F(StudioTest, DancesAnIntervalAnew) {
  const Opened studio(server_.address());
  Page page(studio.port());
  Request request;
  v1::GenerateTransitionRequest* transition = request.mutable_transition();
  const v1::Pose rest = client::ToProto(RestPose(Skeleton::Smpl24()));
  *transition->mutable_config()->mutable_history()->add_poses() = rest;
  transition->mutable_config()->mutable_history()->set_first_frame(30);
  transition->set_frames(20);
  *transition->mutable_target() = page.welcome().poses(0).pose();
  transition->set_candidates(2);
  page.Say(2, request);
  EXPECT_TRUE(page.Read().transition().has_header());
  for (uint32_t candidate = 0; candidate < 2; ++candidate) {
    const v1::Frames frames = page.Read().transition().frames();
    EXPECT_EQ(frames.count(), 20);
    EXPECT_EQ(frames.first_frame(), 30);
  }
  const Response end = page.Read();
  ASSERT_EQ(end.transition().summary().candidates_size(), 2);
  EXPECT_EQ(end.transition().summary().candidates(0).continuation().frame(), 50);
}

// What it asked for last is still being made, and can't be stopped.
TEST_F(StudioTest, APageThatIsClosedHoldsUpNoOther) {
  std::atomic<bool> held = true;
  const TestServer slow(std::make_unique<HeldEngine>(held));
  const Opened studio(slow.address());
  std::optional<Page> page(std::in_place, studio.port());
  Request request;
  request.mutable_transition()->set_frames(20);
  page->Say(2, request);
  while (slow.transitions() == 0) std::this_thread::yield();
  page.reset();
  const Page other(studio.port());
  held = false;
  held.notify_all();
  EXPECT_EQ(other.welcome().model().name(), "fake");
}

TEST_F(StudioTest, WritesAndOpensFiles) {
  const Opened studio(server_.address());
  Page page(studio.port());
  page.Say(2, DanceRequest(40, 1));
  page.Say(2, KeyRequest(page.welcome().poses(2), 30));
  page.Say(2, Complete());
  const v1::Frames frames = ReadDance(page);
  for (const std::string name : {"dance.npz", "dance.glb", "dance.bvh"}) {
    Request write;
    write.mutable_export_()->set_name(name);
    *write.mutable_export_()->mutable_clip()->mutable_frames() = frames;
    write.mutable_export_()->mutable_clip()->set_frame_rate(30);
    const Response file = page.Ask(write);
    ASSERT_TRUE(file.has_file()) << file.failure().message();
    Request open;
    *open.mutable_open() = file.file();
    const Response clip = page.Ask(open);
    ASSERT_TRUE(clip.has_clip()) << clip.failure().message();
    EXPECT_EQ(clip.clip().frame_rate(), 30);
    ASSERT_EQ(clip.clip().frames().count(), 40) << name;
    for (int i = 0; i < frames.root_positions_size(); ++i)
      EXPECT_NEAR(clip.clip().frames().root_positions(i), frames.root_positions(i), 1e-4) << name;
  }
}

// What the microphone of a page hears: frames come while it sounds, and the song has no part in it.
TEST_F(StudioTest, DancesToMusicAsItSounds) {
  const Opened studio(server_.address());
  Page page(studio.port());
  const auto dance = [&](float loudness) {
    Request config;
    v1::DanceConfig* asked = config.mutable_dance()->mutable_config();
    asked->set_seed(7);
    asked->set_generate_until(0);
    asked->mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_PCM_F32LE);
    asked->mutable_audio_format()->set_sample_rate(16000);
    asked->mutable_audio_format()->set_channels(1);
    page.Say(2, config);
    Request grant, piece, end;
    grant.mutable_dance()->mutable_generate_until()->set_frame(30);
    page.Say(2, grant);
    std::vector<float> samples(32000);
    for (size_t i = 0; i < samples.size(); ++i) samples[i] = i % 8000 < 200 ? loudness : 0;
    piece.mutable_dance()->mutable_audio()->set_data(samples.data(),
                                                     samples.size() * sizeof(float));
    page.Say(2, piece);
    v1::Frames all;
    const auto read = [&] {
      const Response response = page.Read();
      EXPECT_FALSE(response.has_failure()) << response.failure().message();
      all.set_count(all.count() + response.dance().frames().count());
      all.mutable_rotations()->MergeFrom(response.dance().frames().rotations());
      return !response.has_failure() && !response.dance().has_summary();
    };
    while (all.count() < 30 && read()) continue;
    EXPECT_EQ(all.count(), 30);  // while it sounds
    end.mutable_dance()->mutable_end_of_audio();
    page.Say(2, end);
    page.Say(2, Complete());
    while (read()) continue;
    EXPECT_EQ(all.count(), 60);
    return all.SerializeAsString();
  };
  const std::string silent = dance(0);
  ASSERT_TRUE(page.Ask(SongRequest("clicks.wav", Clicks(2))).has_song());
  EXPECT_EQ(dance(0), silent);
  EXPECT_NE(dance(0.5F), silent);
}

TEST_F(StudioTest, RefusesMusicThatIsNone) {
  const Opened studio(server_.address());
  Page page(studio.port());
  Request config;
  v1::AudioFormat* format = config.mutable_dance()->mutable_config()->mutable_audio_format();
  format->set_encoding(v1::AUDIO_ENCODING_FILE);
  page.Say(2, config);
  EXPECT_THAT(page.Read().failure().message(), HasSubstr("config.audio_format.encoding"));
  format->set_encoding(v1::AUDIO_ENCODING_PCM_F32LE);
  format->set_sample_rate(16000);
  format->set_channels(0);
  page.Say(2, config);
  EXPECT_EQ(page.Read().failure().message(),
            "config.audio_format.channels: 0 is not within 1 to 8");
  format->set_channels(1);
  format->set_sample_rate(4'000'000'000);
  page.Say(2, config);
  EXPECT_THAT(page.Read().failure().message(), HasSubstr("config.audio_format.sample_rate: "));
  format->set_sample_rate(16000);
  page.Say(3, config);
  Request piece;
  piece.mutable_dance()->mutable_audio()->set_data("abc");
  page.Say(3, piece);
  Response end = page.Read();
  while (end.has_dance()) end = page.Read();
  EXPECT_EQ(end.failure().message(), "audio.data: 3 bytes are no whole floats");
  // A dance to the song takes no other music.
  page.Say(4, DanceRequest(40, 1));
  piece.mutable_dance()->mutable_audio()->set_data("abcd");
  page.Say(4, piece);
  end = page.Read();
  while (end.has_dance()) end = page.Read();
  EXPECT_THAT(end.failure().message(), HasSubstr("samples"));
}

TEST_F(StudioTest, FitsTheBodyToWhatWasSeenInAPhoto) {
  const Opened studio(server_.address());
  Page page(studio.port());
  std::string landmarks = "[";
  for (int i = 0; i < 33; ++i) {
    const std::string number = std::to_string(i);
    landmarks += (i ? ",{\"x\":" : "{\"x\":") + std::to_string(0.3 * std::sin(i)) +
                 ",\"y\":" + std::to_string(0.05 * i - 0.8) + ",\"z\":0." + number + "}";
  }
  landmarks += "]";
  Request request;
  request.mutable_landmarks()->set_name("beach.jpg");
  request.mutable_landmarks()->set_data(landmarks);
  const Response seen = page.Ask(request);
  ASSERT_TRUE(seen.has_pose()) << seen.failure().message();
  EXPECT_EQ(seen.pose().id(), "beach");
  const Pose pose = cli::ParseLandmarkPose(landmarks, "beach.jpg", studio.house().model().skeleton);
  EXPECT_EQ(seen.pose().pose().SerializeAsString(), client::ToProto(pose).SerializeAsString());
  for (const char* bad : {"", "[]", "{", "[1]", "\xff"}) {
    request.mutable_landmarks()->set_data(bad);
    EXPECT_THAT(page.Ask(request).failure().message(), HasSubstr("beach.jpg")) << bad;
  }
}

TEST_F(StudioTest, TellsHowJointsTurnAndReadsKeyFiles) {
  const Opened studio(server_.address());
  Page page(studio.port());
  const Skeleton& skeleton = studio.house().model().skeleton;
  ASSERT_EQ(page.welcome().turns_size(), skeleton.joints());
  const JointTurn& elbow = page.welcome().turns(skeleton.Find("left_elbow"));
  EXPECT_EQ(elbow.part(), v1::BODY_PART_LEFT_ARM);
  EXPECT_EQ(elbow.hinge_size(), 3);
  EXPECT_EQ(elbow.low(), 0);
  EXPECT_EQ(elbow.high(), 160);
  EXPECT_EQ(page.welcome().turns(skeleton.Find("head")).part(), v1::BODY_PART_TRUNK);
  EXPECT_EQ(page.welcome().turns(skeleton.Find("head")).hinge_size(), 0);

  const std::string text =
      R"({"keyframes": [{"time": 2, "joints": {"left_elbow": 60}}, {"time": 1, "pose": "kick", "hold": 0.1}]})";
  Request request;
  request.mutable_keys()->set_name("mine.json");
  request.mutable_keys()->set_data(text);
  const Response answer = page.Ask(request);
  ASSERT_TRUE(answer.has_keyframes()) << answer.failure().message();
  const std::vector<client::KeyPose> keys = cli::ParseKeyFile(text, "mine.json", skeleton);
  ASSERT_EQ(answer.keyframes().keyframes_size(), 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(answer.keyframes().keyframes(i).SerializeAsString(),
              client::ToProto(keys[static_cast<size_t>(i)]).SerializeAsString());
  }
  EXPECT_EQ(answer.keyframes().keyframes(0).mask().joints_size(), 1);
  for (const char* bad : {"", "[]", "{", R"({"keyframes": [{}]})", "\xff"}) {
    request.mutable_keys()->set_data(bad);
    EXPECT_THAT(page.Ask(request).failure().message(), HasSubstr("mine.json")) << bad;
  }
}

TEST_F(StudioTest, ServesWhatReadsPhotosWhereItIs) {
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

TEST_F(StudioTest, SaysInWordsWhatCannotBe) {
  const Opened studio(server_.address());
  Page page(studio.port());
  EXPECT_THAT(page.Ask(SongRequest("hum.wav", "la la la")).failure().message(),
              HasSubstr("hum.wav: "));
  Request open;
  open.mutable_open()->set_name("walk.fbx");
  EXPECT_THAT(page.Ask(open).failure().message(), HasSubstr("walk.fbx"));
  page.Say(3, DanceRequest(40, 1));
  Request key = KeyRequest(page.welcome().poses(0), 10);
  key.mutable_dance()->mutable_keyframe()->mutable_pose()->mutable_rotations()->RemoveLast();
  page.Say(3, key);
  Response end = page.Read();
  while (end.has_dance()) end = page.Read();  // what came before the bad key
  EXPECT_EQ(end.failure().message(), "keyframe.pose.rotations: 71 numbers, must be 72");
  // The next call is served.
  page.Say(2, DanceRequest(20, 1));
  page.Say(2, Complete());
  EXPECT_EQ(ReadDance(page).count(), 20);
}

TEST(WebServerTest, NamesAnAddressThatIsNone) {
  const TestServer server;
  const House house({.addresses = {server.address()}}, "");
  ExpectError(ErrorCode::kInvalidArgument, "--listen", [&] { WebServer("nowhere", house); });
  ExpectError(ErrorCode::kInvalidArgument, "--listen",
              [&] { WebServer("127.0.0.1:70000", house); });
  const WebServer first("127.0.0.1:0", house);
  ExpectError(ErrorCode::kInvalidArgument, "--listen",
              [&] { WebServer("127.0.0.1:" + std::to_string(first.port()), house); });
}

// A choreod of our own that is killed in the middle of a dance comes back, and the dance goes on.
TEST_F(StudioTest, SurvivesTheLossOfItsServer) {
  const Keeper keeper{std::filesystem::path(FAKE_CHOREOD)};
  const Opened studio(keeper.address());
  Page page(studio.port());
  page.Say(2, DanceRequest(60, 3));
  page.Say(2, KeyRequest(page.welcome().poses(1), 30));
  v1::Frames all;
  const auto take = [&](const Response& response) {
    ASSERT_FALSE(response.has_failure()) << response.failure().message();
    all.set_count(all.count() + response.dance().frames().count());
    all.mutable_rotations()->MergeFrom(response.dance().frames().rotations());
  };
  while (all.count() < 31) take(page.Read());
  kill(keeper.process(), SIGKILL);
  page.Say(2, Complete());
  bool has_resumed = false;
  for (;;) {
    const Response response = page.Read();
    has_resumed = has_resumed || response.has_resumed();
    take(response);
    if (HasFatalFailure() || response.dance().has_summary()) break;
  }
  EXPECT_TRUE(has_resumed);
  EXPECT_EQ(all.count(), 60);

  Page calm(studio.port());
  calm.Say(2, DanceRequest(60, 3));
  calm.Say(2, KeyRequest(calm.welcome().poses(1), 30));
  calm.Say(2, Complete());
  const v1::Frames whole = ReadDance(calm);
  EXPECT_TRUE(std::equal(all.rotations().begin(), all.rotations().end(), whole.rotations().begin(),
                         whole.rotations().end()));
}

}  // namespace choreo::studio::studio_test
