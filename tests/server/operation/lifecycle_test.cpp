#include <gmock/gmock.h>
#include <grpcpp/create_channel.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <thread>

#include "tests/server/fixture.h"
#include "tests/support/eventually.h"
#include "tests/support/sanitizers.h"

namespace choreo::lifecycle_test {

using std::chrono::milliseconds;

class LifecycleTest : public ServerTest {
 protected:
  static v1::StreamDanceRequest RemoveKey(const std::string& id) {
    v1::StreamDanceRequest request;
    request.mutable_remove_keyframe()->set_id(id);
    return request;
  }

  static int64_t Refusals(const Answer& answer) {
    return std::count_if(answer.events.begin(), answer.events.end(),
                         [](const v1::Event& event) { return event.has_keyframe_rejected(); });
  }

  bool IsDraining() {
    grpc::ClientContext context;
    v1::GetServerInfoResponse info;
    EXPECT_TRUE(stub().GetServerInfo(&context, {}, &info).ok());
    return info.draining();
  }

  void ExpectServes() { EXPECT_TRUE(DanceToAKey().status.ok()); }
};

TEST_F(LifecycleTest, CancelledDanceFreesItsPlace) {
  Start(/*workers=*/1, [](ServerConfig& config) { config.max_waiting = 1; });
  for (int round = 0; round < 3; ++round) {
    const auto client = OpenEndedDance();
    ASSERT_TRUE(client->ReadFrames(10));
    EXPECT_EQ(server->calls(), 1);
    EXPECT_EQ(client->Cancel().status.error_code(), grpc::StatusCode::CANCELLED);
    ExpectIdle();
  }
  ExpectServes();
}

TEST_F(LifecycleTest, ExpiredDanceFreesItsPlace) {
  Start();
  const auto client = OpenEndedDance(milliseconds(300));
  EXPECT_FALSE(client->ReadFrames(1'000));  // waits for music that never comes
  EXPECT_EQ(client->Finish().status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  ExpectIdle();
}

TEST_F(LifecycleTest, CancelledTransitionsFreeTheirRoom) {
  Start(/*workers=*/2);
  probe->Close();
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.set_frames(1000);
  request.set_candidates(8);  // more than workers
  grpc::ClientContext context;
  const auto reader = stub().GenerateTransition(&context, request);
  ExpectEventually([this] { return server->transitions() == 8; }, "8 transitions");
  context.TryCancel();
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::CANCELLED);
  probe->Open();
  ExpectIdle();
  ExpectServes();
}

TEST_F(LifecycleTest, StreamsBeyondTheLimitGetARetryTime) {
  Start(1, [](ServerConfig& config) {
    config.max_streams = 2;
    config.max_streams_of_peer = 10;
  });
  const auto first = OpenEndedDance();
  const auto second = OpenEndedDance();
  ASSERT_TRUE(first->ReadFrames(5));
  ASSERT_TRUE(second->ReadFrames(5));
  DanceClient third(stub());
  third.Send(Config());
  const grpc::Status refused = third.Finish().status;
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_THAT(refused.error_message(), testing::HasSubstr("2 calls are in progress, of at most 2"));
  const Details details = DetailsOf(refused);
  ASSERT_TRUE(details.retry_info);
  EXPECT_GE(details.retry_info->retry_delay().seconds(), 1);
  EXPECT_EQ(details.error_info->reason(), "SERVER_FULL");

  first->Cancel();
  ExpectEventually([this] { return server->calls() == 1; }, "the place is free");
  ExpectServes();
}

TEST_F(LifecycleTest, TransitionsBeyondTheirRoomAreRefused) {
  Start(/*workers=*/1, [](ServerConfig& config) { config.max_waiting = 3; });
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.set_frames(5);
  request.set_candidates(3);
  probe->Close();
  std::jthread other([&] { EXPECT_TRUE(Generate(request).status.ok()); });
  ExpectEventually([this] { return server->transitions() == 3; }, "there is no room");
  const grpc::Status refused = Generate(request).status;
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_TRUE(DetailsOf(refused).retry_info);
  probe->Open();
}

// No retry helps a transition with more candidates than there is ever room for.
TEST_F(LifecycleTest, CandidatesBeyondAllRoomAreInvalid) {
  Start(/*workers=*/1, [](ServerConfig& config) { config.max_waiting = 3; });
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.set_frames(5);
  request.set_candidates(4);
  const grpc::Status refused = Generate(request).status;
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(refused.error_message(), "candidates: 4 is not in [0, 3]");
  EXPECT_FALSE(DetailsOf(refused).retry_info);
  grpc::ClientContext context;
  v1::GetServerInfoResponse info;
  ASSERT_TRUE(stub().GetServerInfo(&context, {}, &info).ok());
  EXPECT_EQ(info.limits().max_candidates(), 3);
}

// The client reads nothing: HTTP/2 and the outbox fill, and the dance pauses. Then it reads all.
TEST_F(LifecycleTest, SlowReaderPausesOnlyItsOwnDance) {
  Start(1, [](ServerConfig& config) { config.outbox_kib = 16; });
  DanceClient slow(stub());
  v1::DanceConfig config = Config();
  config.set_encoding(v1::ROTATION_ENCODING_MATRIX);  // 900 bytes a frame
  config.set_frames(20'000);
  slow.Send(config);
  slow.SendKeyframesComplete();
  EXPECT_TRUE(Settles([this] { return probe->frames.load(); })) << "the dance does not pause";
  EXPECT_LT(probe->frames, 19'000);
  ExpectServes();
  const Answer& answer = slow.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.Join().count, 20'000);
}

// The server refuses each message, and the client reads no answer, so the server stops reading.
// Later every message gets its answer.
TEST_F(LifecycleTest, ServerDoesNotReadFromASlowReader) {
  Start(1, [](ServerConfig& config) { config.outbox_kib = 1; });
  grpc::ChannelArguments small_windows;
  small_windows.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  const auto own = grpc::CreateCustomChannel("127.0.0.1:" + std::to_string(server->port()),
                                             grpc::InsecureChannelCredentials(), small_windows);
  const auto own_stub = v1::Choreography::NewStub(own);
  DanceClient client(*own_stub);
  const std::string id(256, 'k');
  client.Send(Config());
  client.SendKeyframe(Key(id, 5));
  const v1::StreamDanceRequest remove = RemoveKey(id);  // too late: the key is frozen
  constexpr int kMessages = 60'000;                     // 16 MB
  std::atomic<int> sent = 0;
  std::jthread sender([&] {
    while (sent < kMessages && client.Send(remove)) ++sent;
    client.HalfClose();
  });
  EXPECT_TRUE(Settles([&] { return sent.load(); })) << "the server goes on reading";
  EXPECT_LT(sent, kMessages);
  while (client.ReadOne()) {
  }
  sender.join();
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(Refusals(answer), kMessages);
}

TEST_F(LifecycleTest, DrainLetsShortDancesFinishAndEndsTheOthers) {
  Start();
  probe->Close();
  DanceClient brief(stub());
  brief.Send(Config());
  brief.SendKeyframe(Key("a", 60));
  brief.HalfClose();
  ExpectEventually([this] { return server->transitions() == 1; }, "the dance is under way");
  const auto endless = OpenEndedDance();
  ExpectEventually([this] { return server->transitions() == 2; }, "the other dance too");

  EXPECT_FALSE(IsDraining());
  const std::jthread drain([this] { server->Drain(2.0); });
  grpc::Status refused;
  ExpectEventually(
      [&] {
        DanceClient late(stub());  // malformed as long as it is admitted
        refused = late.Finish().status;
        return refused.error_code() != grpc::StatusCode::INVALID_ARGUMENT;
      },
      "new calls are refused");
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_NE(refused.error_message().find("draining"), std::string::npos);
  EXPECT_TRUE(IsDraining());
  probe->Open();
  const Answer& answer = brief.Finish();
  EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.Join().count, 61);

  ASSERT_TRUE(endless->ReadFrames(20));
  while (endless->ReadFrames(1'000'000)) {
  }
  EXPECT_EQ(endless->Finish().status.error_code(), grpc::StatusCode::UNAVAILABLE);
  ExpectEventually([this] { return server->calls() == 0; }, "all calls are over");
}

// Another server takes over and dances no frame twice.
TEST_F(LifecycleTest, DrainedStreamEndsAfterATransition) {
  Start();
  DanceClient client(stub());
  v1::DanceConfig config = Config();
  config.set_frames(18'000);
  client.Send(config);
  client.SendGenerateUntil(30);
  ASSERT_TRUE(client.ReadFrames(30));
  const std::jthread drain([this] { server->Drain(2.0); });
  for (int64_t granted = 60; client.SendGenerateUntil(granted); granted += 30) {
    if (!client.ReadFrames(granted)) break;
    std::this_thread::sleep_for(milliseconds(10));
  }
  const Answer& answer = client.Finish();
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_THAT(answer.status.error_message(), testing::HasSubstr("the last continuation"));
  ASSERT_FALSE(answer.continuations.empty());
  EXPECT_EQ(answer.continuations.back().frame(), answer.Join().count);
}

// The connection was idle when the server stopped.
TEST_F(LifecycleTest, LateCallsAreNotCancelled) {
  for (int round = 0; round < 3; ++round) {
    Start();
    ExpectServes();
    const std::jthread drain([this] { server->Drain(20.0); });
    grpc::Status refused;
    while (refused.ok() || refused.error_code() == grpc::StatusCode::INVALID_ARGUMENT) {
      DanceClient late(stub());  // malformed as long as it is admitted
      refused = late.Finish().status;
    }
    EXPECT_EQ(refused.error_code(), grpc::StatusCode::UNAVAILABLE) << refused.error_message();
  }
}

int64_t ResidentBytes() {
  std::ifstream statm("/proc/self/statm");
  int64_t total = 0;
  int64_t resident = 0;
  statm >> total >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

// Clients leave while they send a music file, which the server keeps whole until it ends.
TEST_F(LifecycleTest, FreesMemoryOfLostClients) {
  if (kSanitized) GTEST_SKIP() << "the sanitizer keeps what is freed";
  Start();
  constexpr int64_t kPiece = 4 << 20;
  v1::DanceConfig config = Config();
  config.mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_FILE);
  const std::string piece(kPiece, 'x');
  const auto leave_early = [&](int rounds) {
    for (int round = 0; round < rounds; ++round) {
      DanceClient client(stub());
      client.Send(config);
      client.SendAudio(piece, 0);
      client.SendAudio(piece, kPiece);
      ASSERT_TRUE(client.ReadHeader());
      client.Cancel();
    }
    ExpectIdle();
  };
  leave_early(4);
  const int64_t before = ResidentBytes();
  constexpr int kRounds = 40;
  constexpr int64_t kSent = kRounds * 2 * kPiece;
  leave_early(kRounds);
  // The allocator keeps some of the freed memory.
  EXPECT_LT(ResidentBytes() - before, kSent / 3) << "of " << kSent << " sent";
}

TEST_F(LifecycleTest, MusicFilesShareOneBudget) {
  Start(1, [](ServerConfig& config) { config.max_file_music_mib = 9; });
  v1::DanceConfig config = Config();
  config.mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_FILE);
  const std::string piece(8 << 20, 'x');
  DanceClient first(stub());
  first.Send(config);
  first.SendKeyframe(Key("a", 5));
  first.SendAudio(piece, 0);
  first.Send(RemoveKey("a"));  // too late, which tells that the piece has been taken
  while (Refusals(first.answer()) == 0) ASSERT_TRUE(first.ReadOne());
  DanceClient second(stub());
  second.Send(config);
  second.SendAudio(piece, 0);
  ASSERT_TRUE(second.ReadHeader());
  ASSERT_FALSE(second.ReadFrames(1));
  const grpc::Status refused = second.Finish().status;
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << refused.error_message();
  EXPECT_NE(refused.error_message().find(std::to_string(9 << 20)), std::string::npos);
  EXPECT_TRUE(DetailsOf(refused).retry_info);
  first.Cancel();
  ExpectIdle();

  DanceClient third(stub());
  third.Send(config);
  third.SendAudio(piece, 0);
  third.SendEndOfAudio();
  ASSERT_TRUE(third.ReadHeader());
  ASSERT_FALSE(third.ReadFrames(1));
  EXPECT_EQ(third.Finish().status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);  // no music
}

TEST_F(LifecycleTest, ServerMayStopWithCallsInProgress) {
  Start();
  const auto client = OpenEndedDance();
  ASSERT_TRUE(client->ReadFrames(5));
  server.reset();
  EXPECT_FALSE(client->Finish().status.ok());
}

}  // namespace choreo::lifecycle_test
