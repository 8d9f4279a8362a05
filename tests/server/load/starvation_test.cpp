#include <gmock/gmock.h>
#include <grpcpp/create_channel.h>

#include <chrono>
#include <iostream>
#include <thread>

#include "tests/server/fixture.h"

namespace choreo::starvation_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

/// Clients that send nothing, or too much, while others want to dance.
class StarvationTest : public ServerTest {
 protected:
  static v1::DanceConfig MusicConfig() {
    v1::DanceConfig config = Config();
    *config.mutable_audio_format() = MusicFormat();
    return config;
  }

  // Starts a dance whose client reads nothing. HTTP/2's small windows fill, then the outbox, and
  // the dance pauses.
  std::unique_ptr<DanceClient> UnreadDance() {
    grpc::ChannelArguments small_windows;
    small_windows.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
    const auto own = grpc::CreateCustomChannel("127.0.0.1:" + std::to_string(server->port()),
                                               grpc::InsecureChannelCredentials(), small_windows);
    const auto own_stub = v1::Choreography::NewStub(own);
    auto client = std::make_unique<DanceClient>(*own_stub);
    v1::DanceConfig config = Config();
    config.set_encoding(v1::ROTATION_ENCODING_MATRIX);  // 900 bytes a frame
    config.set_frames(kUnreadFrames);
    client->Send(config);
    client->SendKeyframesComplete();
    return client;
  }

  // Checks that a dance is served, and prints how long it took.
  void ExpectServes() {
    const auto begin = std::chrono::steady_clock::now();
    const grpc::Status status = DanceToAKey().status;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_TRUE(status.ok()) << status.error_message();
    std::cout << "somebody else danced meanwhile, in " << 1e3 * took.count() << " ms\n";
  }

  static constexpr int64_t kUnreadFrames = 1'000;
};

TEST_F(StarvationTest, SilentCallsTakeNoPlaceAndEnd) {
  Start(1, [](ServerConfig& config) {
    config.max_streams = 2;
    config.max_streams_of_peer = 20;
    config.first_message_seconds = 0.3;
  });
  std::vector<std::unique_ptr<DanceClient>> silent;
  for (int i = 0; i < 10; ++i) silent.push_back(std::make_unique<DanceClient>(stub()));
  ExpectServes();
  for (const auto& client : silent) {
    EXPECT_FALSE(client->ReadOne());
    const grpc::Status status = client->Finish().status;
    EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
    EXPECT_THAT(status.error_message(), HasSubstr("no first message came within 0.3 s"));
  }
  ExpectServes();
}

TEST_F(StarvationTest, CallThatSendsNothingEnds) {
  Start(1, [](ServerConfig& config) { config.idle_seconds = 0.5; });
  const auto client = OpenEndedDance();
  while (client->ReadOne()) {
  }
  const grpc::Status status = client->Finish().status;
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_THAT(status.error_message(), HasSubstr("for 0.5 s, the server's limits.idle_s"));
  EXPECT_THAT(status.error_message(), HasSubstr("sends its generate_until again"));
  ExpectIdle();
}

// Its client has nothing to do meanwhile, however slow the model is.
TEST_F(StarvationTest, CallThatWaitsForTheModelGoesOn) {
  Start(1, [](ServerConfig& config) { config.idle_seconds = 0.5; });
  probe->Close();
  DanceClient waiting(stub());
  waiting.Send(Config());
  waiting.SendKeyframe(Key("a", 20));
  DanceClient silent(stub());  // later, and without anything to sample
  silent.Send(MusicConfig());
  while (silent.ReadOne()) {
  }
  EXPECT_EQ(silent.Finish().status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  probe->Open();
  const Answer& answer = waiting.Finish();
  EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_THAT(answer.ReachedKeys(), testing::ElementsAre("a"));
}

// The client learns the reason when it reads on, after the answers that were sent before.
TEST_F(StarvationTest, CallThatReadsNothingIsReset) {
  Start(1, [](ServerConfig& config) {
    config.outbox_kib = 16;
    config.unread_seconds = 0.5;
  });
  const auto client = UnreadDance();
  ExpectEventually([this] { return server->calls() == 1; }, "it dances");
  ExpectIdle();
  const grpc::Status status = client->Finish().status;
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED) << status.error_message();
  EXPECT_THAT(status.error_message(), HasSubstr("took no answer within 0.5 s"));
  EXPECT_THAT(status.error_message(), HasSubstr("unread_s (--unread-seconds)"));
}

TEST_F(StarvationTest, SlowReaderDoesNotBlockTheOnlyWorker) {
  Start(/*workers=*/1, [](ServerConfig& config) { config.outbox_kib = 16; });
  const Answer::Joined alone = UnreadDance()->Finish().Join();
  probe->frames = 0;
  const auto slow = UnreadDance();
  ExpectEventually([this] { return probe->frames > 20; }, "it dances");
  for (int i = 0; i < 5; ++i) ExpectServes();
  const Answer& answer = slow->Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.Join().count, kUnreadFrames);
  EXPECT_TRUE(answer.Join() == alone);
}

// Two dances whose music arrives in small pieces share the only worker.
TEST_F(StarvationTest, WaitingForMusicDoesNotBlockTheOnlyWorker) {
  StartWith(std::make_unique<FakeSampler>());
  const std::string music = Music(3);
  const auto play = [&](DanceClient& client, size_t from, size_t to) {
    client.SendAudio(music.substr(from, to - from), static_cast<int64_t>(from / 2));
  };
  DanceClient alone(stub());
  alone.Send(MusicConfig());
  play(alone, 0, music.size());
  const Answer expected = alone.Finish();
  ASSERT_TRUE(expected.status.ok());

  DanceClient first(stub()), second(stub());
  for (DanceClient* client : {&first, &second}) {
    client->Send(MusicConfig());
    client->SendKeyframesComplete();
  }
  constexpr size_t kPiece = 2 * 11'025;  // half a second
  for (size_t at = 0; at < music.size(); at += kPiece) {
    const auto frames = static_cast<int64_t>(15 * (at / kPiece + 1)) - 5;
    for (DanceClient* client : {&first, &second}) {
      play(*client, at, std::min(at + kPiece, music.size()));
      ASSERT_TRUE(client->ReadFrames(frames));
    }
  }
  EXPECT_TRUE(first.Finish().Join() == expected.Join());
  EXPECT_TRUE(second.Finish().Join() == expected.Join());
}

// More transitions arrive than the queue holds, while the live dance has none in it.
TEST_F(StarvationTest, ABurstEndsNoLiveDance) {
  Start(/*workers=*/1, [](ServerConfig& config) { config.max_waiting = 4; });
  DanceClient live(stub());
  live.Send(Config());
  live.SendGenerateUntil(0);
  live.SendKeyframe(Key("a", 30));
  live.SendKeyframe(Key("b", 60));
  live.SendGenerateUntil(31);
  ASSERT_TRUE(live.ReadFrames(31));
  ExpectEventually([this] { return server->transitions() == 0; }, "it is made");

  probe->Close();
  std::vector<std::jthread> burst;
  std::atomic<int> refused = 0, served = 0;
  for (int i = 0; i < 8; ++i) {
    burst.emplace_back([&] {
      v1::GenerateTransitionRequest request;
      *request.mutable_config() = Config();
      request.set_frames(30);
      const Answer answer = Generate(request);
      if (answer.status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED) {
        EXPECT_TRUE(DetailsOf(answer.status).retry_info);
        ++refused;
      } else {
        EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
        ++served;
      }
    });
  }
  ExpectEventually([&] { return refused == 4; }, "the others are told at once");
  live.SendGenerateUntil(61);
  probe->Open();
  EXPECT_TRUE(live.ReadFrames(61));
  EXPECT_TRUE(live.Finish().status.ok()) << live.answer().status.error_message();
  burst.clear();
  EXPECT_EQ(served, 4);
}

TEST_F(StarvationTest, RefusesAtOnceWhatCannotBeServedInTime) {
  auto slow = std::make_unique<ProbedSampler>("slow", probe);
  slow->set_seconds_a_frame(0.05);  // longer than a frame lasts
  StartWith(std::move(slow));
  probe->Close();
  DanceClient first(stub());
  first.Send(Config());
  ASSERT_TRUE(first.ReadHeader());
  const grpc::Status refused = DanceToAKey().status;
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_THAT(refused.error_message(), HasSubstr("the server is busy: calls have"));
  EXPECT_TRUE(DetailsOf(refused).retry_info);
}

TEST_F(StarvationTest, OneAddressCannotTakeAllCalls) {
  Start(1, [](ServerConfig& config) {
    config.max_streams = 8;
    config.max_streams_of_peer = 7;
  });
  std::vector<std::unique_ptr<DanceClient>> clients;
  for (int i = 0; i < 7; ++i) {
    clients.push_back(OpenEndedDance());
    ASSERT_TRUE(clients.back()->ReadFrames(5));
  }
  const grpc::Status refused = DanceToAKey().status;
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_THAT(refused.error_message(),
              HasSubstr("127.0.0.1 has 7 calls in progress, of at most 7 for one caller"));
  EXPECT_TRUE(DetailsOf(refused).retry_info);
}

}  // namespace choreo::starvation_test
