#include <gmock/gmock.h>
#include <grpcpp/create_channel.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <semaphore>
#include <span>
#include <stdexcept>
#include <thread>
#include <utility>

#include "client/authoring/keys/key_file.h"
#include "client/convert.h"
#include "client/edit.h"
#include "model/motion/kinematics/kinematics.h"
#include "studio/from_page.h"
#include "studio/page_session.h"
#include "studio/project_dance.h"
#include "studio/server_supervisor.h"
#include "tests/client/scripted_server.h"
#include "tests/studio/opened_studio.h"

namespace choreo::studio::dances_test {

using ::testing::HasSubstr;

// The same frames as the client library gets: the studio only adds the song and its analysis.
TEST_F(StudioTest, DancesAsTheClientLibraryDoes) {
  const Opened studio(server_.address());
  Page page(studio.port());
  const std::string clicks = Clicks(4);
  ASSERT_TRUE(page.Ask(SongRequest("clicks.wav", clicks)).has_song());
  const LibraryPose& kick = page.welcome().poses(6);
  Request request = DanceRequest(120, 7);
  AddKey(kick, 45, request.mutable_dance()->mutable_project());
  page.Say(2, request);
  const v1::Frames frames = ReadDance(page);
  ASSERT_EQ(frames.count(), 120);

  const Song song = HearSong(folder_ / "clicks.wav", "clicks.wav", 600);
  client::KeyPose key{.id = kick.id(), .frame = 45};
  key.pose.root_position = {kick.pose().root_position().x(), kick.pose().root_position().y(),
                            kick.pose().root_position().z()};
  key.pose.rotations =
      Eigen::Map<const Eigen::Matrix3Xf>(kick.pose().rotations().data(), 3, 24).cast<double>();
  client::DanceConfig config{.seed = 7, .frames = 120};
  authoring::FillInMusic(song.music, song.heard.seconds(), &config.known);
  const client::DanceResult own = studio.context().client().Dance(config, {key}, song.audio);
  ASSERT_EQ(own.motion.frames.size(), 120U);
  for (int frame = 0; frame < 120; ++frame) {
    for (int i = 0; i < 72; ++i) {
      ASSERT_EQ(frames.rotations(72 * frame + i),
                static_cast<float>(own.motion.frames[static_cast<size_t>(frame)].rotations(i)))
          << "frame " << frame;
    }
  }
}

TEST_F(StudioTest, AKeyBesideTheBeginningIsDancedOnTheFirstFrame) {
  const Opened studio(server_.address());
  Page page(studio.port());
  Request request = DanceRequest(60, 7);
  AddKey(page.welcome().poses(6), 1, request.mutable_dance()->mutable_project());
  page.Say(2, request);
  for (;;) {
    const Response response = page.Read();
    ASSERT_FALSE(response.has_failure()) << response.failure().message();
    if (response.dance().event().has_keyframe_reached()) {
      EXPECT_EQ(response.dance().event().frame(), 0);
      return;
    }
  }
}

// Sending fails once, with another exception than ours.
TEST_F(StudioTest, AnswersAFailureOfADancesThread) {
  const StudioContext context({.addresses = {server_.address()}}, {}, {});
  std::promise<std::string> answered;
  bool failed = false;
  PageSession session(context, [&](const Response& response) {
    if (response.has_failure()) answered.set_value(response.failure().message());
    if (!response.has_dance() || std::exchange(failed, true)) return;
    throw std::runtime_error("the page is gone");
  });
  Request dance = DanceRequest(10, 1);
  dance.set_call(2);
  session.Receive(dance);
  EXPECT_EQ(answered.get_future().get(), "the page is gone");
}

// Its reader has not ended yet when the page hears of the end.
TEST_F(StudioTest, ANumberIsFreeOnceItsDanceHasEnded) {
  const StudioContext context({.addresses = {server_.address()}}, {}, {});
  std::binary_semaphore ended(0), again(0);
  std::promise<std::string> answered;
  PageSession session(context, [&, dances = 0](const Response& response) mutable {
    if (response.has_failure()) answered.set_value(response.failure().message());
    if (!response.dance().has_summary()) return;
    if (++dances == 2) return answered.set_value("");
    ended.release();
    again.acquire();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // a reader that is late
  });
  Request dance = DanceRequest(10, 1);
  dance.set_call(2);
  session.Receive(dance);
  ended.acquire();
  again.release();
  session.Receive(dance);
  EXPECT_EQ(answered.get_future().get(), "");
}

TEST_F(StudioTest, ASecondDanceOfANumberLeavesTheFirst) {
  const Opened studio(server_.address());
  Page page(studio.port());
  page.Say(2, LiveRequest(7, 22050));
  page.Say(2, DanceRequest(10, 1));
  Response said = page.Read();
  while (!said.has_failure()) said = page.Read();
  EXPECT_EQ(said.failure().message(), "dance: came twice");
  Grant(2, 10, &page);
  Play(2, std::vector<float>(22050), &page);
  while (said.dance().frames().count() == 0) said = page.Read();
  EXPECT_EQ(said.call(), 2U);
}

// The page's beats replace the detected ones.
TEST_F(StudioTest, DancesOnTheBeatsOfThePage) {
  const Opened studio(server_.address());
  Page page(studio.port());
  ASSERT_TRUE(page.Ask(SongRequest("clicks.wav", Clicks(4))).has_song());
  const auto request_on = [&](const std::vector<double>& beats) {
    Request request = DanceRequest(60, 7);
    if (beats.empty()) return request;
    Beats* own = request.mutable_dance()->mutable_project()->mutable_beats();
    own->set_bar(4);
    own->mutable_times()->Add(beats.begin(), beats.end());
    for (uint32_t i = 0; i < beats.size(); ++i) own->add_counts((i + 3) % 4 + 1);
    return request;
  };
  const auto danced = [&](const std::vector<double>& beats) {
    page.Say(2, request_on(beats));
    return ReadDance(page).SerializeAsString();
  };
  const Song song = HearSong(folder_ / "clicks.wav", "clicks.wav", 600);
  const std::string heard = danced({});
  EXPECT_EQ(danced(authoring::BeatsBefore(song.music, 4)), heard);
  EXPECT_NE(danced({0.3, 1.3}), heard);

  page.Say(2, request_on({0.3, 0.8, 1.3}));
  std::vector<double> downbeats;
  for (Response said = page.Read(); !said.dance().has_summary(); said = page.Read()) {
    ASSERT_FALSE(said.has_failure()) << said.failure().message();
    const v1::Event& event = said.dance().event();
    if (event.beat().downbeat()) downbeats.push_back(event.time());
  }
  EXPECT_EQ(downbeats, std::vector{0.8}) << "of which it is the 1";
  EXPECT_THAT(page.Ask(request_on({1, 1})).failure().message(), HasSubstr("project:beats[1]"));
}

// Of a key that no body could dance, once all are there; and of one that an interval leads to.
TEST_F(StudioTest, WarnsOfImpossibleKeys) {
  const Opened studio(server_.address());
  Page page(studio.port());
  LibraryPose sunk = page.welcome().poses(6);
  sunk.set_id("sunk");
  sunk.mutable_pose()->mutable_root_position()->set_y(0.2F);
  Request dance = DanceRequest(90, 7);
  Project* project = dance.mutable_dance()->mutable_project();
  AddKey(page.welcome().poses(6), 30, project);
  AddKey(sunk, 60, project);
  page.Say(2, dance);
  const auto about_floor = [](const v1::Event& event) {
    return event.frame() == 60 && event.warning().message().find("floor") != std::string::npos;
  };
  while (!about_floor(page.Read().dance().event())) continue;

  Request request;
  Retake* retake = request.mutable_retake();
  *retake->mutable_project() = *project;
  *retake->mutable_dance() = Standing(90);
  retake->set_from(50);
  retake->set_to(70);
  Response answer = page.Read();
  while (!answer.dance().has_summary()) answer = page.Read();
  answer = page.Ask(request);
  ASSERT_TRUE(answer.has_takes()) << answer.failure().message();
  EXPECT_TRUE(std::ranges::any_of(answer.takes().warnings(), about_floor));
}

// The pose before an interval, or before a dance that goes on, is on the way, too.
TEST_F(StudioTest, WarnsOfWaysThatBeginBeforeAnEdit) {
  const Opened studio(server_.address());
  Page page(studio.port());
  LibraryPose low = page.welcome().poses(6);
  low.set_id("low");
  low.mutable_pose()->mutable_root_position()->set_y(0.2F);
  Request dance = DanceRequest(90, 7);
  Project* project = dance.mutable_dance()->mutable_project();
  AddKey(low, 30, project);
  AddKey(page.welcome().poses(6), 45, project);
  const auto about_rise = [](const v1::Event& event) {
    return event.frame() == 45 && event.warning().message().find("would rise") != std::string::npos;
  };
  Request request;
  Retake* retake = request.mutable_retake();
  *retake->mutable_project() = *project;
  *retake->mutable_dance() = Standing(90);
  retake->set_from(30);
  retake->set_to(45);
  const Response answer = page.Ask(request);
  ASSERT_TRUE(answer.has_takes()) << answer.failure().message();
  EXPECT_TRUE(std::ranges::any_of(answer.takes().warnings(), about_rise));
  retake->set_from(45);
  retake->set_to(60);
  EXPECT_TRUE(std::ranges::none_of(page.Ask(request).takes().warnings(), about_rise));

  auto* history = dance.mutable_dance()->mutable_history();
  history->set_first_frame(31);
  for (int i = 0; i < 10; ++i) *history->add_poses() = low.pose();
  page.Say(2, dance);
  while (!about_rise(page.Read().dance().event())) continue;
}

TEST_F(StudioTest, DancesInAStyle) {
  const Opened studio(server_.address());
  Page page(studio.port());
  EXPECT_THAT(page.welcome().model().styles(), testing::ElementsAre("calm", "wild"));
  const auto danced = [&](const std::string& style) {
    Request request = DanceRequest(20, 7);
    request.mutable_dance()->mutable_project()->set_style(style);
    page.Say(2, request);
    return ReadDance(page).SerializeAsString();
  };
  const std::string calm = danced("");
  EXPECT_EQ(calm, danced("calm"));
  EXPECT_NE(calm, danced("wild"));
}

// As `choreo edit` does: from the frames before, through the keys, into those that follow.
TEST_F(StudioTest, DancesAnIntervalAnew) {
  const Opened studio(server_.address());
  Page page(studio.port());
  Request request;
  Retake* retake = request.mutable_retake();
  *retake->mutable_dance() = Standing(60);
  retake->mutable_project()->set_seconds(2);
  retake->mutable_project()->set_seed(7);
  retake->set_from(10);
  retake->set_to(40);
  retake->set_takes(2);
  const client::FinishedDance still = FromProto(retake->dance(), Skeleton::Smpl24());
  client::EditOptions options;
  options.model = studio.context().model();
  options.seed = 7;
  const auto expect_takes_of = [&](client::Gap gap) {
    const Response answer = page.Ask(request);
    ASSERT_EQ(answer.takes().frames_size(), 2) << answer.failure().message();
    gap.from = 10;
    gap.to = 40;
    const std::vector<client::EditedDance> own =
        client::DanceTakes(studio.context().client(), still, options, gap, 2);
    for (int take = 0; take < 2; ++take) {
      const v1::Frames& frames = answer.takes().frames(take);
      ASSERT_EQ(frames.count(), 29);
      const Motion& motion = own[static_cast<size_t>(take)].dance.motion;
      for (int i = 0; i < frames.rotations_size(); ++i) {
        ASSERT_EQ(
            frames.rotations(i),
            static_cast<float>(motion.frames[static_cast<size_t>(11 + i / 72)].rotations(i % 72)));
      }
    }
    EXPECT_NE(answer.takes().frames(0).rotations(72 * 5),
              answer.takes().frames(1).rotations(72 * 5));
  };
  expect_takes_of({});
  AddKey(page.welcome().poses(0), 25, retake->mutable_project());
  client::KeyPose key{.id = page.welcome().poses(0).id(), .frame = 25};
  const v1::Pose& pose = page.welcome().poses(0).pose();
  key.pose.root_position = {pose.root_position().x(), pose.root_position().y(),
                            pose.root_position().z()};
  key.pose.rotations =
      Eigen::Map<const Eigen::Matrix3Xf>(pose.rotations().data(), 3, 24).cast<double>();
  expect_takes_of({.keys = {key}});
  retake->set_to(61);
  EXPECT_THAT(page.Ask(request).failure().message(), HasSubstr("to: 61 is not in [12, 60]"));
}

// Also of a dance to live music.
TEST_F(StudioTest, AProjectSaysHowToDance) {
  const StudioContext context({.addresses = {server_.address()}}, {}, {});
  Project project;
  project.set_seconds(2);
  project.set_seed(7);
  project.set_music_dynamics(1);
  project.set_variation(0);
  const client::DanceConfig config = DanceOf(context, project, nullptr).config;
  EXPECT_EQ(config.manner.music_dynamics, 1);
  EXPECT_EQ(config.manner.variation, 0);
  EXPECT_EQ(config.seed, 7U);
  EXPECT_EQ(config.frames, 60);
}

// Music from the page's microphone: frames come while it plays, independent of the song.
TEST_F(StudioTest, DancesToMusicAsItSounds) {
  const Opened studio(server_.address());
  Page page(studio.port());
  const auto dance = [&](float loudness) {
    page.Say(2, LiveRequest(7, 16000));
    Grant(2, 30, &page);
    std::vector<float> samples(32000);
    for (size_t i = 0; i < samples.size(); ++i) samples[i] = i % 8000 < 200 ? loudness : 0;
    Play(2, samples, &page);
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
    EndMusic(2, &page);
    while (read()) continue;
    EXPECT_EQ(all.count(), 60);
    return all.SerializeAsString();
  };
  const std::string silent = dance(0);
  ASSERT_TRUE(page.Ask(SongRequest("clicks.wav", Clicks(2))).has_song());
  EXPECT_EQ(dance(0), silent);
}

// 120 clicks a minute, of which every second one is danced to. The program needs a moment to find
// them, so the music comes in pieces until their events show.
TEST_F(StudioTest, LiveDancesFollowTheListenersBeats) {
  const Opened studio(server_.address());
  Page page(studio.port());
  page.Say(2, LiveRequest(1, 22050));
  Request beats;
  beats.mutable_live_beats()->set_tempo(120);
  beats.mutable_live_beats()->set_half_time(true);
  page.Say(2, beats);
  const std::vector<float> music = choreo::Clicks(100);
  std::vector<double> times;
  int64_t frames = 0;
  bool has_downbeats = false;
  const auto halved = [&] {
    return times.size() > 6 && times.back() - times[times.size() - 6] > 4.9;
  };
  for (int piece = 0; piece < 200 && !halved(); ++piece) {
    Grant(2, 15 * (piece + 1), &page);
    Play(2, std::span(music).subspan(static_cast<size_t>(11025 * piece), 11025), &page);
    // The frames of the music before this piece.
    while (frames < 15 * (piece - 2)) {
      const Response response = page.Read();
      ASSERT_FALSE(response.has_failure()) << response.failure().message();
      frames += response.dance().frames().count();
      if (!response.dance().event().has_beat()) continue;
      times.push_back(response.dance().event().time());
      has_downbeats = has_downbeats || response.dance().event().beat().downbeat();
    }
  }
  EXPECT_TRUE(halved()) << times.size() << " beats";
  EXPECT_TRUE(has_downbeats);
  Request wrong;
  wrong.mutable_live_beats()->set_tempo(20);
  page.Say(3, wrong);
  Response answer = page.Read();
  while (!answer.has_failure()) answer = page.Read();
  EXPECT_EQ(answer.failure().message(), "live_beats.tempo: 20 is not within 50 to 200");
}

TEST_F(StudioTest, RefusesInvalidMusic) {
  const Opened studio(server_.address());
  Page page(studio.port());
  Request dance = LiveRequest(1, 16000);
  v1::AudioFormat* format = dance.mutable_dance()->mutable_live_music();
  format->set_encoding(v1::AUDIO_ENCODING_FILE);
  EXPECT_THAT(page.Ask(dance).failure().message(), HasSubstr("dance.live_music.encoding"));
  format->set_encoding(v1::AUDIO_ENCODING_PCM_F32LE);
  format->set_channels(0);
  EXPECT_EQ(page.Ask(dance).failure().message(),
            "dance.live_music.channels: 0 is not within 1 to 8");
  format->set_channels(1);
  format->set_sample_rate(4'000'000'000);
  EXPECT_THAT(page.Ask(dance).failure().message(), HasSubstr("dance.live_music.sample_rate: "));
  format->set_sample_rate(16000);
  const auto failure = [&](const Request& request) {
    page.Say(3, request);
    Response end = page.Read();
    while (end.has_dance()) end = page.Read();
    return end.failure().message();
  };
  page.Say(3, dance);
  Request piece;
  piece.mutable_live()->mutable_audio()->set_data("abc");
  EXPECT_EQ(failure(piece), "audio.data: 3 bytes are not whole samples of 4 bytes");
  format->set_channels(2);
  page.Say(3, dance);
  piece.mutable_live()->mutable_audio()->set_data(std::string(12, 0));
  EXPECT_EQ(failure(piece), "audio.data: 12 bytes are not whole samples of 8 bytes");
  page.Say(3, dance);
  Request controls;
  controls.mutable_live()->mutable_controls();
  EXPECT_EQ(failure(controls), "live: has this setting in its project");
  // A dance to the song takes no other music.
  page.Say(3, DanceRequest(3000, 1));
  EXPECT_EQ(failure(piece), "live: is for dances to live music");
}

// Also fields of a later version.
TEST_F(StudioTest, RelaysTheMessagesOfALiveDance) {
  v1::GetServerInfoResponse info;
  grpc::ClientContext call;
  ASSERT_TRUE(v1::Choreography::NewStub(
                  grpc::CreateChannel(server_.address(), grpc::InsecureChannelCredentials()))
                  ->GetServerInfo(&call, {}, &info)
                  .ok());
  std::vector<v1::StreamDanceResponse> sent(4, ScriptedServer::Header());
  AddUnknownField(sent[0].mutable_header());
  sent[1].mutable_event()->mutable_warning()->set_code(static_cast<v1::WarningCode>(99));
  AddUnknownField(sent[1].mutable_event()->mutable_warning());
  sent[2].mutable_continuation()->set_frame(10);
  AddUnknownField(sent[3].mutable_summary()->mutable_report());
  std::vector<v1::StreamDanceRequest> received(1);
  const ScriptedServer scripted(
      [&](ScriptedServer::Stream& stream) {
        while (stream.Read(&received.back()) && !received.back().has_keyframes_complete())
          received.emplace_back();
        for (const v1::StreamDanceResponse& response : sent) stream.Write(response);
        return grpc::Status::OK;
      },
      info);
  const Opened studio(scripted.address());
  Page page(studio.port());
  page.Say(2, LiveRequest(7, 16000));
  Request key;
  v1::Keyframe* asked = key.mutable_live()->mutable_keyframe();
  asked->set_id("key");
  asked->set_time(2);
  *asked->mutable_pose() = page.welcome().poses(1).pose();
  AddUnknownField(asked);
  page.Say(2, key);
  EndMusic(2, &page);
  for (const size_t i : {0U, 1U, 3U})
    EXPECT_EQ(page.Read().dance().SerializeAsString(), sent[i].SerializeAsString()) << i;
  ASSERT_EQ(received.size(), 4U);
  EXPECT_TRUE(received[0].config().reject_invalid_keys());
  EXPECT_EQ(received[1].SerializeAsString(), key.live().SerializeAsString());
  EXPECT_TRUE(received[2].has_end_of_audio());
}

// A choreod of our own that is killed in the middle of a dance restarts, and the dance continues.
TEST_F(StudioTest, SurvivesTheLossOfItsServer) {
  const ServerSupervisor supervisor{std::filesystem::path(FAKE_CHOREOD)};
  const Opened studio(supervisor.address());
  Page page(studio.port());
  const std::vector<float> silence(32000);
  const auto begin = [&](Page& by) {
    by.Say(2, LiveRequest(3, 16000));
    Request key;
    v1::Keyframe* asked = key.mutable_live()->mutable_keyframe();
    asked->set_id("key");
    asked->set_frame(40);
    *asked->mutable_pose() = by.welcome().poses(1).pose();
    by.Say(2, key);
    Grant(2, 31, &by);
    Play(2, silence, &by);
  };
  v1::Frames all;
  const auto take = [&](const Response& response) {
    ASSERT_FALSE(response.has_failure()) << response.failure().message();
    all.set_count(all.count() + response.dance().frames().count());
    all.mutable_rotations()->MergeFrom(response.dance().frames().rotations());
  };
  begin(page);
  while (all.count() < 31) take(page.Read());
  kill(supervisor.process(), SIGKILL);
  EndMusic(2, &page);
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
  begin(calm);
  EndMusic(2, &calm);
  const v1::Frames whole = ReadDance(calm);
  EXPECT_TRUE(std::equal(all.rotations().begin(), all.rotations().end(), whole.rotations().begin(),
                         whole.rotations().end()));
}

}  // namespace choreo::studio::dances_test
