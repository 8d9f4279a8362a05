#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <future>
#include <stdexcept>
#include <utility>

#include "client/authoring/key_file.h"
#include "client/convert.h"
#include "model/motion/kinematics.h"
#include "studio/page_session.h"
#include "studio/server_supervisor.h"
#include "tests/studio/fixture.h"

namespace choreo::studio::dances_test {

using ::testing::HasSubstr;

// The same frames as the client library gets: the studio only adds the song and its analysis.
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
  authoring::ConfigureMusic(song.music, song.heard.seconds(), &config);
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
  session.Take(dance);
  Request complete = Complete();
  complete.set_call(2);
  session.Take(complete);
  EXPECT_EQ(answered.get_future().get(), "the page is gone");
}

// The page's beats replace the detected ones.
TEST_F(StudioTest, DancesOnTheBeatsOfThePage) {
  const Opened studio(server_.address());
  Page page(studio.port());
  ASSERT_TRUE(page.Ask(SongRequest("clicks.wav", Clicks(4))).has_song());
  const auto danced = [&](const std::vector<double>& beats) {
    Request request = DanceRequest(60, 7);
    request.mutable_dance()->mutable_config()->mutable_music_beats()->Add(beats.begin(),
                                                                          beats.end());
    page.Say(2, request);
    page.Say(2, Complete());
    return ReadDance(page).SerializeAsString();
  };
  const Song song = HearSong(folder_ / "clicks.wav", "clicks.wav", 600);
  const std::string heard = danced({});
  EXPECT_EQ(danced(authoring::BeatsBefore(song.music, 4)), heard);
  EXPECT_NE(danced({0.3, 1.3}), heard);

  Request request = DanceRequest(60, 7);
  for (const double beat : {0.3, 0.8, 1.3})
    request.mutable_dance()->mutable_config()->add_music_beats(beat);
  request.mutable_dance()->mutable_config()->add_music_downbeats(0.8);
  page.Say(2, request);
  page.Say(2, Complete());
  std::vector<double> downbeats;
  for (Response said = page.Read(); !said.dance().has_summary(); said = page.Read()) {
    ASSERT_FALSE(said.has_failure()) << said.failure().message();
    const v1::Event& event = said.dance().event();
    if (event.beat().downbeat()) downbeats.push_back(event.time());
  }
  EXPECT_EQ(downbeats, std::vector{0.8}) << "of which it is the 1";

  request = DanceRequest(60, 7);
  auto* beats = request.mutable_dance()->mutable_config()->mutable_music_beats();
  beats->Add(1);
  beats->Add(std::nan(""));
  page.Say(3, request);
  EXPECT_EQ(page.Read().failure().message(), "config.music_beats[1]: nan s is not within 0 to 600");
  beats->Set(1, 1);
  page.Say(3, request);
  EXPECT_THAT(page.Read().failure().message(),
              HasSubstr("config.music_beats[1]: 1 s is not after"));
}

// Of a key that no body could dance, once all are there; and of one that an interval leads to.
TEST_F(StudioTest, WarnsOfImpossibleKeys) {
  const Opened studio(server_.address());
  Page page(studio.port());
  LibraryPose sunk = page.welcome().poses(6);
  sunk.set_id("sunk");
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
  EXPECT_GT(end.transition().summary().timing().elapsed_s(), 0);
}

TEST_F(StudioTest, RefusesFieldsThatItDoesNotRead) {
  const Opened studio(server_.address());
  Page page(studio.port());
  const auto failure = [&](const auto& ask) {
    Request request;
    request.mutable_transition()->set_frames(20);
    ask(*request.mutable_transition());
    return page.Ask(request).failure().message();
  };
  const std::string absent = ": must be absent: the studio decides it";
  using Asked = v1::GenerateTransitionRequest;
  EXPECT_EQ(failure([](Asked& asked) { asked.set_rank_by(v1::RANK_BY_LIKELIHOOD); }),
            "rank_by" + absent);
  EXPECT_EQ(failure([](Asked& asked) { asked.mutable_audio(); }), "audio" + absent);
  EXPECT_EQ(failure([](Asked& asked) { asked.mutable_config()->mutable_audio_format(); }),
            "config.audio_format" + absent);
  EXPECT_EQ(failure([](Asked& asked) {
              asked.mutable_config()->set_encoding(v1::ROTATION_ENCODING_QUATERNION);
            }),
            "config.encoding" + absent);
  EXPECT_EQ(failure([](Asked& asked) { asked.mutable_config()->set_allow_inexact_resume(true); }),
            "config.allow_inexact_resume" + absent);
  EXPECT_EQ(failure([](Asked& asked) { asked.mutable_config()->set_model("fake"); }),
            "config.model" + absent);
}

// Music from the page's microphone: frames come while it plays, independent of the song.
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
}

// 120 clicks a minute, of which every second one is danced to. The program needs a moment to find
// them, so the music comes in pieces until their events show.
TEST_F(StudioTest, LiveDancesFollowTheListenersBeats) {
  const Opened studio(server_.address());
  Page page(studio.port());
  Request config = DanceRequest(3000, 1);
  v1::DanceConfig& asked = *config.mutable_dance()->mutable_config();
  asked.set_generate_until(0);
  asked.mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_PCM_F32LE);
  asked.mutable_audio_format()->set_sample_rate(22050);
  asked.mutable_audio_format()->set_channels(1);
  page.Say(2, config);
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
    Request grant, sound;
    grant.mutable_dance()->mutable_generate_until()->set_frame(15 * (piece + 1));
    page.Say(2, grant);
    sound.mutable_dance()->mutable_audio()->set_data(music.data() + 11025 * piece,
                                                     11025 * sizeof(float));
    page.Say(2, sound);
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

// A choreod of our own that is killed in the middle of a dance restarts, and the dance continues.
TEST_F(StudioTest, SurvivesTheLossOfItsServer) {
  const ServerSupervisor supervisor{std::filesystem::path(FAKE_CHOREOD)};
  const Opened studio(supervisor.address());
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
  kill(supervisor.process(), SIGKILL);
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

}  // namespace choreo::studio::dances_test
