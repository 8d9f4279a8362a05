#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <iostream>
#include <thread>

#include "server/connections/frame_guard.h"
#include "server/connections/listener.h"
#include "server/process/process_usage.h"
#include "tests/server/connections/http2.h"
#include "tests/server/connections/silent_connections.h"
#include "tests/server/fixture.h"
#include "tests/server/load/real_time.h"
#include "tests/support/eventually.h"
#include "tests/support/sanitizers.h"
#include "tests/support/setting.h"

/// Clients that misuse HTTP/2, and the clients that are served meanwhile.
namespace choreo::hostile_test {

using Clock = std::chrono::steady_clock;

int64_t ResidentBytes(const std::string& process) {
  std::ifstream statm("/proc/" + process + "/statm");
  int64_t total = 0, resident = 0;
  statm >> total >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

class HostileTest : public ServerTest {
 protected:
  // Dances one dance after another during `harm`. Returns the seconds of the longest.
  double SlowestDanceDuring(const std::function<void()>& harm) {
    std::atomic<bool> over = false;
    std::jthread harming([&] {
      harm();
      over = true;
    });
    double slowest = 0;
    do {
      const auto begin = Clock::now();
      EXPECT_TRUE(DanceToAKey().status.ok());
      slowest = std::max(slowest, std::chrono::duration<double>(Clock::now() - begin).count());
    } while (!over);
    return slowest;
  }
};

// A client announces 4 GiB and sends a few bytes. The server reserves nothing for the rest, and the
// call ends like one without a first message.
TEST_F(HostileTest, AMessageOf4GiBTakesNoMemory) {
  Start(1, [](ServerConfig& config) { config.first_message_seconds = 1; });
  const int64_t before = ResidentBytes("self");
  Http2 client(server->port());
  const std::string begun = std::string("\0\xff\xff\xff\xff", 5) + std::string(1000, 'x');
  uint32_t stream = 1;
  for (const char* method : {"GetServerInfo", "GenerateTransition", "StreamDance"}) {
    client.Send(Http2::Call(stream, method) + Http2::Frame(Http2::kData, 0, stream, begun));
    stream += 2;
  }
  EXPECT_TRUE(client.Ends(stream - 2));
  const int64_t grown = ResidentBytes("self") - before;
  EXPECT_LT(grown, 64 << 20);
  SlowestDanceDuring([] {});
  std::cout << "memory grew by " << (grown >> 10) << " KiB\n";
}

// The callers of gRPC's own services are unknown: such calls end no connection, the server keeps
// listening, and it keeps threads for others.
TEST_F(HostileTest, IdleReflectionClosesNoConnection) {
  Start(1);
  SlowestDanceDuring([] {});
  const int64_t before = Threads(getpid());
  constexpr int kConnections = 8, kCalls = 100;
  std::vector<std::unique_ptr<Http2>> open;
  for (int i = 0; i < kConnections; ++i) {
    open.push_back(std::make_unique<Http2>(server->port()));
    for (uint32_t call = 0; call < kCalls; ++call) {
      ASSERT_TRUE(open.back()->Send(Http2::Call(
          2 * call + 1, "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo")));
    }
  }
  SlowestDanceDuring([] {});
  EXPECT_LT(Threads(getpid()) - before, kCalls / 2);
  grpc::ClientContext context;
  v1::GetServerInfoResponse info;
  const auto newcomer = StubOfAnotherAddress(server->port());
  EXPECT_TRUE(newcomer->GetServerInfo(&context, {}, &info).ok());
  open.clear();
  SlowestDanceDuring([] {});
}

// Unread answers are limited for each address; the next call is refused.
TEST_F(HostileTest, AnswersThatNobodyReadsAreBounded) {
  Start(1);
  constexpr int kConnections = 4, kCalls = 90, kSome = 64;
  const int64_t before = ResidentBytes("self");
  const std::string no_window("\0\x04\0\0\0\0", 6), empty(5, '\0');
  std::vector<std::unique_ptr<Http2>> deaf;
  for (int i = 0; i < kConnections; ++i) {
    deaf.push_back(std::make_unique<Http2>(server->port()));
    deaf.back()->Send(Http2::Frame(Http2::kSettings, 0, 0, no_window));
    for (uint32_t stream = 1; stream < 2 * kCalls; stream += 2)
      deaf.back()->Send(Http2::Call(stream, "GetServerInfo") +
                        Http2::Frame(Http2::kData, 1, stream, empty));
    EXPECT_EQ(deaf.back()->Ends(2 * kCalls - 1), true) << "it is refused";
  }
  const auto ask = [&](v1::Choreography::Stub& stub) {
    grpc::ClientContext context;
    v1::GetServerInfoResponse info;
    return stub.GetServerInfo(&context, {}, &info);
  };
  const grpc::Status refused = ask(stub());
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_THAT(refused.error_message(), testing::HasSubstr(std::to_string(kSome)));
  EXPECT_TRUE(ask(*StubOfAnotherAddress(server->port())).ok());
  std::cout << kConnections * kCalls
            << " answers unread: " << ((ResidentBytes("self") - before) >> 20) << " MiB more\n";
  deaf.clear();
  EXPECT_TRUE(Eventually([&] { return ask(stub()).ok(); }));
}

// A client begins and resets calls as fast as it can.
TEST_F(HostileTest, OthersAreServedDuringRapidResets) {
  // Here all clients have one address, and would share its places.
  Start(1, [](ServerConfig& config) { config.max_streams_of_peer = 65'536; });
  constexpr int kCalls = 20'000;
  const int64_t before = ResidentBytes("self");
  int begun = 0;
  const double slowest = SlowestDanceDuring([&] { begun = Http2(server->port()).Reset(kCalls); });
  EXPECT_GT(begun, 0);
  ExpectIdle();
  const int64_t grown = ResidentBytes("self") - before;
  EXPECT_LT(grown, 256 << 20);
  std::cout << begun << " calls reset: the slowest dance of the others took " << slowest
            << " s, memory grew by " << (grown >> 20) << " MiB\n";
}

// The same where the server has a tenth of a core, so that calls wait to be ended; beside a
// well-behaved dance in real time. Refused clients retry. CHOREO_FAULT_CALLS makes it longer
// (scripts/faults.sh).
TEST_F(HostileTest, RapidResetsWithoutCpu) {
  const int calls = Setting("CHOREO_FAULT_CALLS", 20'000);
  // The well-behaved dance waits, too, and must not count as silent.
  ::setenv("CHOREO_FIRST_MESSAGE_SECONDS", "600", 1);
  const authoring::LocalServer starved(FAKE_CHOREOD);
  ::unsetenv("CHOREO_FIRST_MESSAGE_SECONDS");
  const int port = std::stoi(starved.address().substr(starved.address().rfind(':') + 1));
  const std::string process = std::to_string(starved.process());
  std::jthread starve([&](const std::stop_token& stop) {
    constexpr std::chrono::milliseconds kRuns{10}, kStands{90};
    while (!stop.stop_requested()) {
      kill(starved.process(), SIGSTOP);
      std::this_thread::sleep_for(kStands);
      kill(starved.process(), SIGCONT);
      std::this_thread::sleep_for(kRuns);
    }
  });
  const auto behaved = StubOfAnotherAddress(port);
  constexpr int kGrants = 50;
  DanceInRealTime(*behaved, Config(), kGrants);  // gRPC sets things up at its first call
  const std::vector<double> alone = DanceInRealTime(*behaved, Config(), kGrants).lateness;
  const int64_t before = ResidentBytes(process);
  std::atomic<bool> over = false;
  std::atomic<int> begun = 0, connections = 0;
  std::jthread harm([&] {
    while (begun < calls) {
      const char* method = connections++ % 2 == 0 ? "StreamDance" : "GenerateTransition";
      begun += Http2(port).Reset(calls - begun, method);
    }
    over = true;
  });
  std::vector<double> beside;
  int64_t most = before;
  std::jthread look([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      most = std::max(most, ResidentBytes(process));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  int lost = 0;
  do {
    const RealTimeDance dance = DanceInRealTime(*behaved, Config(), kGrants);
    lost += dance.answer.status.ok() ? 0 : 1;
    beside.insert(beside.end(), dance.lateness.begin(), dance.lateness.end());
  } while (!over);
  look.request_stop();
  look.join();
  const auto newcomer = StubOfAnotherAddress(port);
  const grpc::Status after = DanceInRealTime(*newcomer, Config(), 1).answer.status;
  EXPECT_TRUE(after.ok()) << after.error_message();
  if (!kSanitized) {
    EXPECT_LT(most - before, 128 << 20);
  }
  std::cout << begun << " calls reset over " << connections
            << " connections of a server with a tenth of a core: memory grew by "
            << ((most - before) >> 20) << " MiB; frames of a dance beside them p50 "
            << Milliseconds(beside, 0.5) << " ms and p99 " << Milliseconds(beside, 0.99)
            << " ms behind their grants, " << lost << " lost; without p50 "
            << Milliseconds(alone, 0.5) << " ms and p99 " << Milliseconds(alone, 0.99) << " ms\n";
}

// An endless header in frames so small that gRPC rereads it as often as possible.
TEST_F(HostileTest, HeadersWithoutAnEndAreCutOff) {
  Start(1);
  const auto behaved = StubOfAnotherAddress(server->port());
  constexpr size_t kFrame = 32, kMost = 16 << 20;
  std::string frames;
  while (frames.size() < (64 << 10)) {
    frames += Http2::Frame(Http2::kContinuation, 0, 1, std::string(kFrame, 'a'));
  }
  Http2 client(server->port());
  // A literal header named "x-a" with an announced value of 128 MiB.
  client.Send(Http2::Frame(Http2::kHeaders, 0, 1,
                           std::string("\x83\x86\0\x03x-a\x7f\x80\x80\x80\x40", 12)));
  size_t sent = 0;
  while (sent < kMost && client.Send(frames)) sent += frames.size();
  EXPECT_LT(sent, kMost);
  EXPECT_TRUE(DanceInRealTime(*behaved, Config(), 1).answer.status.ok());
}

// Bytes of another protocol may look like a frame that announces a flood of headers. Nobody of that
// address is locked out.
TEST_F(HostileTest, WhoSpeaksNoHttp2FloodsNothing) {
  Start(1);
  const uint64_t before = HeaderFloods() + EmptyFrameFloods();
  const std::string head("\x01\0\x01\x09\0\0\0\0\x01", 9);  // CONTINUATION, 65,537 bytes
  const SilentConnections junk("127.0.0.1:" + std::to_string(server->port()), 1,
                               std::string(24, 'J') + head + std::string(500, 'A'));
  ExpectEventually([&] { return junk.Closed() == 1; }, "gRPC closes it");
  EXPECT_EQ(HeaderFloods() + EmptyFrameFloods(), before);
  EXPECT_TRUE(DanceToAKey().status.ok());
}

// Frames of no call, or of a finished one. No window limits them, and gRPC handles each. A client
// that has flooded the server may not reconnect for a while.
TEST_F(HostileTest, FramesWithoutContentAreCutOff) {
  Start(1);
  const auto behaved = StubOfAnotherAddress(server->port());
  constexpr int kPriority = 2, kWindow = 8;
  const std::pair<const char*, std::string> floods[] = {
      {"127.0.0.3", Http2::Frame(kPriority, 0, 1, std::string("\0\0\0\0\x10", 5))},
      {"127.0.0.4", Http2::Frame(kWindow, 0, 0, std::string("\0\0\0\1", 4))},
      {"127.0.0.5", Http2::Frame(Http2::kData, 0, 1, "x")},
  };
  const auto before = EmptyFrameFloods();
  for (const auto& [from, frame] : floods) {
    std::string frames;
    while (frames.size() < (64 << 10)) frames += frame;
    constexpr size_t kMost = 64 << 20;
    Http2 client(server->port(), from);
    client.Send(Http2::Call(1, "Nothing"));
    size_t sent = 0;
    while (sent < kMost && client.Send(frames)) sent += frames.size();
    EXPECT_LT(sent, kMost);
    EXPECT_TRUE(Http2(server->port(), from).Ends(1));
  }
  EXPECT_EQ(EmptyFrameFloods(), before + std::size(floods));
  EXPECT_TRUE(DanceInRealTime(*behaved, Config(), 1).answer.status.ok());
}

// Connections whose HTTP/2 never begins do not keep descriptors for long.
TEST_F(HostileTest, HalfOpenConnectionsAreClosed) {
  constexpr int kConnections = 100;
  Start(1);
  const std::string address = "127.0.0.1:" + std::to_string(server->port());
  const SilentConnections silent(address, kConnections);
  const SilentConnections greeting(address, kConnections, "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n");
  ExpectEventually(
      [&] { return silent.Closed() == kConnections && greeting.Closed() == kConnections; },
      "the server closes them");
}

TEST_F(HostileTest, SilentConnectionsBlockNobody) {
  constexpr int kConnections = 2'000;
  RaiseDescriptorLimit();
  const authoring::LocalServer server_of_its_own(FAKE_CHOREOD);
  const SilentConnections silent(server_of_its_own.address(), kConnections);
  const auto begin = Clock::now();
  ExpectEventually([&] { return Serves(server_of_its_own); }, "somebody new is served");
  std::cout << "beside " << kConnections - silent.Closed()
            << " silent connections somebody new is served in "
            << std::chrono::duration<double>(Clock::now() - begin).count() << " s\n";
}

}  // namespace choreo::hostile_test
