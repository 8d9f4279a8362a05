#include <atomic>
#include <iostream>
#include <latch>
#include <mutex>
#include <thread>

#include "server/messages/read_message.h"
#include "tests/server/connections/silent_connections.h"
#include "tests/server/fixture.h"
#include "tests/server/load/real_time.h"
#include "tests/server/requests/raw_call.h"
#include "tests/support/setting.h"

/// One client takes all it can get of one resource, while nine others dance in real time from
/// another address. CHOREO_FAULT_SECONDS makes it longer.
namespace choreo::greedy_test {

constexpr int kDancers = 9;

/// What the greedy client knows of the server.
struct Victim {
  int port;
  std::shared_ptr<grpc::Channel> channel;
  v1::Choreography::Stub* stub;
  const std::atomic<bool>& over;
};

/// The ways of being greedy.
struct Greed {
  const char* name;
  void (*take)(const Victim& victim);

  friend void PrintTo(const Greed& greed, std::ostream* out) { *out << greed.name; }
};

v1::DanceConfig ConfigOf(int frames) {
  v1::DanceConfig config;
  config.set_seed(1);
  config.set_frames(frames);
  config.set_encoding(v1::ROTATION_ENCODING_MATRIX);
  return config;
}

// Opens dances that never end, and another one whenever one is refused.
void TakeCalls(const Victim& victim) {
  std::vector<std::unique_ptr<DanceClient>> dances;
  while (!victim.over) {
    auto dance = std::make_unique<DanceClient>(*victim.stub);
    dance->Send(ConfigOf(1000));
    dance->SendGenerateUntil(1);
    if (dance->ReadFrames(1)) dances.push_back(std::move(dance));
  }
}

// Opens calls and sends nothing.
void TakeTurns(const Victim& victim) {
  std::vector<std::unique_ptr<DanceClient>> calls;
  for (; !victim.over; calls.resize(std::min<size_t>(calls.size(), 200))) {
    calls.push_back(std::make_unique<DanceClient>(*victim.stub));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// Asks for all candidates of the longest transitions.
void TakeSlots(const Victim& victim) {
  std::vector<std::jthread> callers;
  for (int i = 0; i < 8; ++i) {
    callers.emplace_back([&victim] {
      v1::GenerateTransitionRequest request;
      *request.mutable_config() = ConfigOf(0);
      request.set_frames(1800);
      request.set_candidates(32);
      while (!victim.over) {
        grpc::ClientContext context;
        context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(500));
        const auto reader = victim.stub->GenerateTransition(&context, request);
        v1::GenerateTransitionResponse response;
        while (reader->Read(&response)) {
        }
        reader->Finish();
      }
    });
  }
}

// Asks for as many frames as possible, and reads none.
void TakeFrames(const Victim& victim) {
  std::vector<std::unique_ptr<DanceClient>> dances;
  for (int i = 0; i < 32; ++i) {
    dances.push_back(std::make_unique<DanceClient>(*victim.stub));
    dances.back()->Send(ConfigOf(18'000));
    dances.back()->SendKeyframesComplete();
  }
  victim.over.wait(false);
}

// Sends music files that never end.
void TakeMemory(const Victim& victim) {
  const std::string piece(4 << 20, 'x');
  std::vector<std::unique_ptr<DanceClient>> dances;
  while (!victim.over) {
    auto dance = std::make_unique<DanceClient>(*victim.stub);
    v1::DanceConfig config = ConfigOf(100);
    config.mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_FILE);
    dance->Send(config);
    if (dances.size() > 24) dances.erase(dances.begin());
    for (int i = 0; i < 4; ++i) dance->SendAudio(piece, int64_t{i} * std::ssize(piece));
    dances.push_back(std::move(dance));
  }
}

// Sends the largest messages, made of as many objects as possible.
void TakeObjects(const Victim& victim) {
  const std::string pose = WireField(v1::History::kPosesFieldNumber, "");
  std::string poses;
  while (poses.size() + 64 < static_cast<size_t>(kMaxMessageBytes)) poses += pose;
  const std::string request = WireField(1, WireField(v1::DanceConfig::kHistoryFieldNumber, poses));
  while (!victim.over) RawCall(victim.channel, "StreamDance", request);
}

void TakeConnections(const Victim& victim) {
  const SilentConnections silent("127.0.0.1:" + std::to_string(victim.port), 400);
  victim.over.wait(false);
}

class GreedyTest : public ServerTest, public testing::WithParamInterface<Greed> {};

TEST_P(GreedyTest, NineOthersDanceToTheEnd) {
  Start();
  const int seconds = Setting("CHOREO_FAULT_SECONDS", 2);
  std::mutex mutex;
  std::vector<double> lateness;  // lock: mutex
  std::atomic<bool> over = false;
  const Victim victim{server->port(), channel, &stub(), over};
  std::latch dancing(kDancers);
  std::thread greedy([&] {
    dancing.wait();
    GetParam().take(victim);
  });
  {
    std::vector<std::jthread> dancers;
    for (int i = 0; i < kDancers; ++i) {
      dancers.emplace_back([&] {
        const auto own = StubOfAnotherAddress(server->port());
        DanceInRealTime(*own, Config(), 1);
        dancing.arrive_and_wait();
        const RealTimeDance dance = DanceInRealTime(*own, Config(), seconds * 10);
        EXPECT_TRUE(dance.answer.status.ok()) << dance.answer.status.error_message();
        EXPECT_EQ(dance.answer.Join().count, seconds * 10 * kFramesOfGrant);
        const std::lock_guard lock(mutex);
        lateness.insert(lateness.end(), dance.lateness.begin(), dance.lateness.end());
      });
    }
  }
  over = true;
  over.notify_all();
  greedy.join();
  std::cout << "beside one who takes " << GetParam().name << " nine dance on: frames p50 "
            << Milliseconds(lateness, 0.5) << " ms and p99 " << Milliseconds(lateness, 0.99)
            << " ms behind their grants\n";
  ExpectIdle();
}

INSTANTIATE_TEST_SUITE_P(Beside, GreedyTest,
                         testing::Values(Greed{"Nothing", [](const Victim&) {}},
                                         Greed{"Calls", TakeCalls}, Greed{"Turns", TakeTurns},
                                         Greed{"Slots", TakeSlots}, Greed{"Frames", TakeFrames},
                                         Greed{"Memory", TakeMemory}, Greed{"Objects", TakeObjects},
                                         Greed{"Connections", TakeConnections}),
                         [](const auto& of) { return of.param.name; });

}  // namespace choreo::greedy_test
