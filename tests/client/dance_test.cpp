#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <thread>

#include "client/authoring/keys/pose_library.h"
#include "client/choreo_client.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/test_music.h"
#include "tests/client/test_server.h"
#include "tests/support/eventually.h"
#include "tests/support/expect_error.h"

namespace choreo::client::dance_test {

using authoring::FindLibraryPose;

const Skeleton& Body() { return Skeleton::Smpl24(); }

std::vector<KeyPose> FourKeys() {
  std::vector<KeyPose> keys;
  for (const char* id : {"contrapposto", "side_lunge", "arabesque", "victory_v"}) {
    KeyPose& key = keys.emplace_back();
    key.id = id;
    key.frame = 60 * static_cast<int64_t>(keys.size()) - 1;
    key.pose = FindLibraryPose(id).pose;
  }
  return keys;
}

void ExpectSameMotion(const Motion& a, const Motion& b) {
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (size_t i = 0; i < a.frames.size(); ++i) {
    ASSERT_EQ(a.frames[i].root_position, b.frames[i].root_position) << "frame " << i;
    ASSERT_EQ(a.frames[i].rotations, b.frames[i].rotations) << "frame " << i;
  }
}

Options FastRetries(std::vector<std::string> addresses) {
  Options options;
  options.addresses = std::move(addresses);
  options.first_backoff_s = 0.01;
  return options;
}

TEST(DanceTest, DescribesTheServer) {
  TestServer server;
  const ServerDescription info = Client({.addresses = {server.address()}}).GetServerInfo();
  ASSERT_EQ(info.models.size(), 1U);
  EXPECT_EQ(info.models[0].name, "fake");
  EXPECT_EQ(info.models[0].skeleton.joint_names, Body().joint_names);
  EXPECT_EQ(info.models[0].skeleton.feet, Body().feet);
  EXPECT_NEAR(info.models[0].skeleton.pelvis_height, Body().pelvis_height, 1e-6);
  EXPECT_GT(info.limits.max_keyframes, 0);
  EXPECT_FALSE(info.devices.empty());
}

TEST(DanceTest, HitsItsKeysToTheMusic) {
  TestServer server;
  const Client client({.addresses = {server.address()}});
  int blocks = 0;
  const DanceResult dance =
      client.Dance({.seed = 4,
                    .frames = 250,
                    .known = {.music_beats = {0.5, 1, 1.5, 2, 2.5}, .music_downbeats = {1}}},
                   FourKeys(), ClicksAudio(9), [&](const Message& message) {
                     blocks += std::holds_alternative<FrameBlock>(message) ? 1 : 0;
                   });
  EXPECT_GT(blocks, 1);
  EXPECT_EQ(dance.header.seed, 4U);
  EXPECT_EQ(dance.motion.fps, 30);
  ASSERT_EQ(dance.motion.frames.size(), 250U);
  EXPECT_EQ(dance.contacts.size(), 250U);
  EXPECT_EQ(dance.report.frames, 250);
  ASSERT_EQ(dance.beats.size(), 5U);
  for (const Beat& beat : dance.beats) EXPECT_EQ(beat.downbeat, beat.time_s == 1);
  EXPECT_TRUE(dance.rejected.empty());
  ASSERT_EQ(dance.report.keys.size(), 4U);
  for (const KeyPose& key : FourKeys()) {
    const PoseError error =
        ComparePoses(Body(), dance.motion.frames[static_cast<size_t>(*key.frame)], key.pose);
    EXPECT_LE(error.position_m, 0.001) << key.id;
    EXPECT_LE(error.angle_deg, 0.1) << key.id;
  }
  for (const KeyReached& key : dance.report.keys) EXPECT_LE(key.final_error_m, 0.001) << key.id;
}

TEST(DanceTest, IsTheSameForTheSameSeed) {
  TestServer server;
  const Client client({.addresses = {server.address()}});
  const auto dance = [&](uint64_t seed) {
    return client.Dance({.seed = seed, .frames = 120}, {}, ClicksAudio(5)).motion;
  };
  const Motion a = dance(1);
  ExpectSameMotion(a, dance(1));
  EXPECT_NE(a.frames.back().rotations, dance(2).frames.back().rotations);
}

TEST(DanceTest, SendsMusicAsAFileOrAsSamples) {
  TestServer server;
  const Client client({.addresses = {server.address()}});
  const auto path = std::filesystem::path(testing::TempDir()) / "choreo_dance_test.wav";
  WriteClicks(path, 4);
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  Audio audio;
  audio.format.kind = AudioKind::kFile;
  audio.bytes.resize(bytes.size());
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(audio.bytes.data()));
  const DanceResult dance = client.Dance({.seed = 1}, {}, audio);
  EXPECT_EQ(dance.motion.frames.size(), 120U);
  EXPECT_FALSE(dance.beats.empty());
}

TEST(DanceTest, ErrorsAreTheServersOwn) {
  TestServer server;
  const Client client({.addresses = {server.address()}});
  ExpectError(ErrorCode::kNotFound, "swan",
              [&] { client.Dance({.model = "swan", .frames = 30}, {}, {}); });
  std::vector<KeyPose> keys = FourKeys();
  keys[1].pose.rotations(0, 16) = 7.9;
  ExpectError(ErrorCode::kInvalidArgument, "keyframes[1]",
              [&] { client.Dance({.seed = 1}, keys, {}); });
  const auto dance = client.StartDance({.frames = 30});
  ExpectError(ErrorCode::kInvalidArgument, "samples",
              [&] { dance->SendSamples(std::vector<float>(4)); });
}

TEST(DanceTest, NamesAMissingServer) {
  const Client client({.addresses = {"127.0.0.1:1"}, .retry_s = 0.05, .first_backoff_s = 0.01});
  ExpectError(ErrorCode::kUnavailable, "127.0.0.1:1", [&] { client.GetServerInfo(); });
  ExpectError(ErrorCode::kUnavailable, "127.0.0.1:1",
              [&] { client.Dance({.frames = 30}, {}, {}); });
}

TEST(DanceTest, RefusesOptionsThatCannotBeUsed) {
  ExpectError(ErrorCode::kInvalidArgument, "addresses", [] { Client({.addresses = {}}); });
  for (const char* address : {"http://one:50051", "one", "dns:///one", "one:70000"}) {
    ExpectError(ErrorCode::kInvalidArgument, address, [&] { Client({.addresses = {address}}); });
  }
  ExpectError(ErrorCode::kInvalidArgument, "deadline_s", [] { Client({.deadline_s = -1}); });
  ExpectError(ErrorCode::kInvalidArgument, "ca_certificate",
              [] { Client({.tls = true, .ca_certificate = "/absent.pem"}); });
}

TEST(DanceTest, GivesUpAtItsDeadline) {
  TestServer server;
  const Client client({.addresses = {server.address()}, .deadline_s = 0.2});
  const auto dance = client.StartDance({.frames = 30});
  // Nothing is granted, so no frame comes.
  ExpectError(ErrorCode::kDeadlineExceeded, "", [&] {
    while (dance->Next()) {
    }
  });
}

TEST(DanceTest, CanBeCancelledWhileItWaits) {
  TestServer server;
  const Client client({.addresses = {server.address()}});
  const auto dance = client.StartDance({.frames = 30});
  EXPECT_TRUE(std::holds_alternative<Header>(*dance->Next()));
  std::thread canceller([&] { dance->Cancel(); });
  ExpectError(ErrorCode::kCancelled, "", [&] { dance->Next(); });
  canceller.join();
}

// The server accepts connections and never answers.
TEST(DanceTest, CanBeSteeredAndCancelledWhileItConnects) {
  const int mute = socket(AF_INET, SOCK_STREAM, 0);
  ASSERT_EQ(listen(mute, 1), 0);  // at a free port
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getsockname(mute, reinterpret_cast<sockaddr*>(&address), &size);
  const Client client({.addresses = {"127.0.0.1:" + std::to_string(ntohs(address.sin_port))},
                       .connect_timeout_s = 600});
  const auto dance = client.StartDance({.frames = 30});
  std::thread reader([&] { ExpectError(ErrorCode::kCancelled, "", [&] { dance->Next(); }); });
  const int connection = accept(mute, nullptr, nullptr);
  dance->CompleteKeys();
  dance->Cancel();
  reader.join();
  close(connection);
  close(mute);
}

TEST(DanceTest, CanBeAbandoned) {
  TestServer server;
  {
    const Client client({.addresses = {server.address()}});
    const auto dance = client.StartDance({.frames = 900});
    dance->CompleteKeys();
    dance->Next();
  }
  EXPECT_TRUE(Eventually([&] { return server.calls() == 0; }));
}

/// Dances through FourKeys, two of which are sent when `between` was called after the continuation
/// after the second key.
struct SteeredDance {
  Motion motion;
  std::vector<std::string> reached;
  std::vector<std::string> rejected;
  std::vector<Resumed> resumed;
  Report report;
};
SteeredDance Steer(const Client& client, double fps, const std::function<void()>& between) {
  const std::vector<KeyPose> keys = FourKeys();
  const Audio audio = ClicksAudio(9);
  const auto dance =
      client.StartDance({.fps = fps, .seed = 4, .audio = audio.format, .frames = 250});
  dance->SendKey(keys[0]);
  dance->SendKey(keys[1]);
  dance->SendSamples(audio.samples);
  SteeredDance result;
  while (const std::optional<Message> message = dance->Next()) {
    if (const auto* block = std::get_if<FrameBlock>(&*message)) {
      result.motion.frames.insert(result.motion.frames.end(), block->poses.begin(),
                                  block->poses.end());
    } else if (const auto* key = std::get_if<KeyReached>(&*message)) {
      result.reached.push_back(key->id);
    } else if (const auto* rejected = std::get_if<KeyRejected>(&*message)) {
      result.rejected.push_back(rejected->id);
      EXPECT_EQ(rejected->code, KeyRejected::Code::kTooLate);
    } else if (const auto* resumed = std::get_if<Resumed>(&*message)) {
      result.resumed.push_back(*resumed);
    } else if (const auto* report = std::get_if<Report>(&*message)) {
      result.report = *report;
    } else if (const auto* continuation = std::get_if<Continuation>(&*message)) {
      if (continuation->frame != *keys[1].frame + 1) continue;
      between();
      dance->SendKey(keys[2]);
      dance->SendKey(keys[3]);
      dance->CompleteKeys();
      dance->EndAudio();
    }
  }
  return result;
}

class ResumeTest : public testing::TestWithParam<double> {};

TEST_P(ResumeTest, GoesOnBitForBitWhenTheServerDies) {
  TestServer undisturbed;
  const SteeredDance wanted =
      Steer(Client({.addresses = {undisturbed.address()}}), GetParam(), [] {});
  ASSERT_EQ(wanted.motion.frames.size(),
            static_cast<size_t>(1 + std::floor(249 * GetParam() / 30 + 1e-9)));

  TestServer dying;
  TestServer heir;
  const SteeredDance resumed = Steer(Client(FastRetries({dying.address(), heir.address()})),
                                     GetParam(), [&] { dying.Die(); });
  ExpectSameMotion(resumed.motion, wanted.motion);
  ASSERT_EQ(resumed.resumed.size(), 1U);
  EXPECT_EQ(resumed.resumed[0].address, heir.address());
  EXPECT_TRUE(resumed.resumed[0].exact);
  EXPECT_EQ(resumed.reached, wanted.reached);
  EXPECT_EQ(resumed.rejected, wanted.rejected);
  ASSERT_EQ(resumed.report.keys.size(), 4U);
  EXPECT_EQ(resumed.report.keys[0].id, "contrapposto");
}

INSTANTIATE_TEST_SUITE_P(Rates, ResumeTest, testing::Values(30.0, 60.0, 24.0));

TEST(ResumeTest, RefusesAnotherFingerprintUnlessAllowed) {
  TestServer other("fake-2");
  {
    TestServer dying;
    Options options = FastRetries({dying.address(), other.address()});
    options.retry_s = 0.3;  // the one that is gone might come back
    const Client strict(options);
    ExpectError(ErrorCode::kFailedPrecondition, "fake-2",
                [&] { Steer(strict, 30, [&] { dying.Die(); }); });
  }
  TestServer dying;
  Options options = FastRetries({dying.address(), other.address()});
  options.allow_inexact_resume = true;
  const SteeredDance dance = Steer(Client(options), 30, [&] { dying.Die(); });
  EXPECT_EQ(dance.motion.frames.size(), 250U);
  ASSERT_EQ(dance.resumed.size(), 1U);
  EXPECT_FALSE(dance.resumed[0].exact);
}

/// A dance without keys, whose server dies before its first continuation: how many frames came, and
/// what was told of the resume.
std::pair<size_t, std::vector<Resumed>> LoseBeforeContinuation(const Client& client,
                                                               TestServer* dying) {
  const auto dance = client.StartDance({.seed = 4, .frames = 90, .generate_until = 0});
  dance->GenerateUntil(30);
  std::pair<size_t, std::vector<Resumed>> result;
  bool lost = false;
  while (const std::optional<Message> message = dance->Next()) {
    EXPECT_TRUE(lost || !std::holds_alternative<Continuation>(*message));
    if (const auto* resumed = std::get_if<Resumed>(&*message)) result.second.push_back(*resumed);
    const auto* block = std::get_if<FrameBlock>(&*message);
    if (block == nullptr) continue;
    result.first += block->poses.size();
    if (std::exchange(lost, true)) continue;
    dying->Die();
    dance->GenerateUntil(90);
    dance->CompleteKeys();
  }
  return result;
}

TEST(ResumeTest, RestartsOnAnotherFingerprintIfAllowed) {
  TestServer other("fake-2");
  {
    TestServer dying;
    Options options = FastRetries({dying.address(), other.address()});
    options.retry_s = 0.3;
    const Client strict(options);
    ExpectError(ErrorCode::kFailedPrecondition, "allow_inexact_resume",
                [&] { LoseBeforeContinuation(strict, &dying); });
  }
  {
    TestServer dying;
    TestServer heir;
    // The client leaves a server that may not continue for one that may.
    const Client strict(FastRetries({dying.address(), other.address(), heir.address()}));
    const auto [frames, resumed] = LoseBeforeContinuation(strict, &dying);
    EXPECT_EQ(frames, 90U);
    ASSERT_EQ(resumed.size(), 1U);
    EXPECT_EQ(resumed[0].address, heir.address());
    EXPECT_TRUE(resumed[0].exact);
  }
  TestServer dying;
  Options options = FastRetries({dying.address(), other.address()});
  options.allow_inexact_resume = true;
  const auto [frames, resumed] = LoseBeforeContinuation(Client(options), &dying);
  EXPECT_EQ(frames, 90U);
  ASSERT_EQ(resumed.size(), 1U);
  EXPECT_FALSE(resumed[0].exact);
}

TEST(ResumeTest, EndsWhenNoServerIsLeft) {
  TestServer dying;
  Options options = FastRetries({dying.address()});
  options.retry_s = 0.1;
  ExpectError(ErrorCode::kUnavailable, dying.address(),
              [&] { Steer(Client(options), 30, [&] { dying.Die(); }); });
}

TEST(ResumeTest, ReportsTheWholeAndTheMeasuredPart) {
  TestServer dying;
  TestServer heir;
  const SteeredDance dance =
      Steer(Client(FastRetries({dying.address(), heir.address()})), 30, [&] { dying.Die(); });
  EXPECT_EQ(dance.report.frames, 250);
  EXPECT_EQ(dance.report.measured_from, *FourKeys()[1].frame + 1);
  EXPECT_EQ(Steer(Client({.addresses = {heir.address()}}), 30, [] {}).report.measured_from, 0);
}

TEST(DanceTest, KeepsReceivedFramesOfACutDance) {
  TestServer breaking(std::make_unique<BreakingSampler>(130));
  TestServer sound;
  DanceResult whole;
  Client({.addresses = {sound.address()}})
      .Dance({.seed = 4, .frames = 250}, FourKeys(), {}, {}, &whole);
  DanceResult cut;
  ExpectError(ErrorCode::kInternal, "the device is gone", [&] {
    Client({.addresses = {breaking.address()}})
        .Dance({.seed = 4, .frames = 250}, FourKeys(), {}, {}, &cut);
  });
  ASSERT_GE(cut.motion.frames.size(), 120U);
  EXPECT_EQ(cut.contacts.size(), cut.motion.frames.size());
  whole.motion.frames.resize(cut.motion.frames.size());
  ExpectSameMotion(cut.motion, whole.motion);
}

TEST(TransitionTest, MakesCandidatesThatAllArrive) {
  TestServer server;
  const Client client({.addresses = {server.address()}});
  TransitionRequest request;
  request.config.seed = 3;
  request.config.history = {FindLibraryPose("contrapposto").pose};
  request.frames = 45;
  request.target = {.pose = FindLibraryPose("kick").pose};
  request.audio = ClicksAudio(2);
  request.candidates = 3;
  const TransitionResult result = client.GenerateTransition(request);
  ASSERT_EQ(result.candidates.size(), 3U);
  for (const TransitionCandidate& candidate : result.candidates) {
    ASSERT_EQ(candidate.motion.frames.size(), 45U);
    EXPECT_LE(ComparePoses(Body(), candidate.motion.frames.back(), request.target->pose).position_m,
              0.001);
    ASSERT_EQ(candidate.report.keys.size(), 1U);
    EXPECT_EQ(candidate.continuation.frame, 45);
  }
}

TEST(TransitionTest, ContinuesIntoADance) {
  TestServer server;
  const Client client({.addresses = {server.address()}});
  TransitionRequest request;
  request.config.seed = 3;
  request.frames = 30;
  request.target = {.pose = FindLibraryPose("kick").pose};
  const TransitionResult transition = client.GenerateTransition(request);
  const DanceResult dance =
      client.Dance({.continuation = transition.candidates[0].continuation, .frames = 90}, {}, {});
  EXPECT_EQ(dance.header.first_frame, 30);
  EXPECT_EQ(dance.header.seed, 3U);
  EXPECT_EQ(dance.motion.frames.size(), 60U);
}

TEST(TransitionTest, TriesAnotherReplicaWhenOneIsAway) {
  TestServer server;
  const Client client(FastRetries({"127.0.0.1:1", server.address()}));
  TransitionRequest request;
  request.frames = 10;
  request.target = {.pose = FindLibraryPose("kick").pose};
  EXPECT_EQ(client.GenerateTransition(request).candidates.front().motion.frames.size(), 10U);
}

}  // namespace choreo::client::dance_test
