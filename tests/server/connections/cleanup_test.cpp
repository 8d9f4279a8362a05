#include <filesystem>
#include <iostream>
#include <tuple>

#include "tests/server/fixture.h"
#include "tests/support/setting.h"
#include "tests/support/tcp_proxy.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

/// A call gives back all it held, however it ends: its place, its transitions, threads and
/// descriptors.
namespace choreo::cleanup_test {

using std::chrono::milliseconds;

enum class Kind { kTransition, kStream, kControlled };
enum class End { kSuccess, kCancel, kDeadline, kError, kShutdown, kClientGone };

const char* NameOf(Kind kind) {
  constexpr const char* kNames[] = {"Transition", "Stream", "Controlled"};
  return kNames[static_cast<int>(kind)];
}
const char* NameOf(End end) {
  constexpr const char* kNames[] = {"Success", "Cancel",   "Deadline",
                                    "Error",   "Shutdown", "ClientGone"};
  return kNames[static_cast<int>(end)];
}

/// The number of entries in a folder of /proc/self.
int64_t CountIn(const char* folder) {
  return std::distance(std::filesystem::directory_iterator(folder),
                       std::filesystem::directory_iterator());
}

class CleanupTest : public ServerTest, public testing::WithParamInterface<std::tuple<Kind, End>> {
 protected:
  static v1::Controls Path() {
    v1::Controls controls;
    auto* path = controls.mutable_root_path();
    for (const int frame : {0, 100}) {
      path->add_frames(frame);
      path->add_points(0.01F * static_cast<float>(frame));
      path->add_points(0);
    }
    return controls;
  }

  void StartServer() {
    ServerConfig config;
    config.listen = "127.0.0.1:0";
    config.max_load = 2;
    std::vector<Server::Samplers> models(1);
    models[0].push_back(std::make_unique<ControlledSampler>());
    Connect(std::make_unique<Server>(config, std::move(models)));
  }

  // Starts a call that lasts until it is ended, and ends it in the given way.
  void Call(Kind kind, End end) {
    std::optional<TcpProxy> proxy;
    std::shared_ptr<grpc::Channel> own = channel;
    if (end == End::kClientGone) {
      proxy.emplace(server->port());
      own = grpc::CreateChannel(proxy->address(), grpc::InsecureChannelCredentials());
    }
    const auto own_stub = v1::Choreography::NewStub(own);
    const auto deadline = end == End::kDeadline ? std::optional(milliseconds(200)) : std::nullopt;
    const auto finish = [&](auto& client, const auto& cancel) {
      if (end == End::kCancel) cancel();
      if (end == End::kShutdown) server->Drain(0);
      if (end == End::kClientGone) proxy.reset();
      return client.Finish();
    };
    if (kind == Kind::kTransition) {
      v1::GenerateTransitionRequest request;
      *request.mutable_config() = Config();
      request.mutable_config()->set_encoding(v1::ROTATION_ENCODING_MATRIX);
      // A dance that is not read does not end, because the outbox fills.
      request.set_frames(end == End::kError ? 0 : 1800);
      request.set_candidates(end == End::kSuccess ? 1 : 32);
      grpc::ClientContext context;
      if (deadline) context.set_deadline(std::chrono::system_clock::now() + *deadline);
      const auto reader = own_stub->GenerateTransition(&context, request);
      v1::GenerateTransitionResponse response;
      if (end != End::kError && end != End::kDeadline) {
        ASSERT_TRUE(reader->Read(&response));
      }
      if (end == End::kDeadline) std::this_thread::sleep_for(2 * *deadline);
      if (end == End::kCancel) context.TryCancel();
      if (end == End::kShutdown) server->Drain(0);
      if (end == End::kClientGone) proxy.reset();
      while (reader->Read(&response)) {
      }
      EXPECT_EQ(reader->Finish().ok(), end == End::kSuccess);
      return;
    }
    DanceClient client(*own_stub, deadline);
    v1::DanceConfig config = Config();
    if (end == End::kSuccess) {
      config.set_frames(40);
    } else {
      *config.mutable_audio_format() = MusicFormat();
    }
    client.Send(config);
    if (kind == Kind::kControlled) {
      v1::StreamDanceRequest controls;
      *controls.mutable_controls() = Path();
      client.Send(controls);
    }
    client.SendKeyframesComplete();
    if (end != End::kSuccess) {
      client.SendAudio(Music(1), 0);
      if (end != End::kDeadline) {
        ASSERT_TRUE(client.ReadFrames(5));
      }
    }
    if (end == End::kError) client.Send(config);
    if (end == End::kDeadline) std::this_thread::sleep_for(2 * *deadline);
    const Answer& answer = finish(client, [&] { client.context.TryCancel(); });
    EXPECT_EQ(answer.status.ok(), end == End::kSuccess) << answer.status.error_message();
  }
};

TEST_P(CleanupTest, FreesEverything) {
  const auto [kind, end] = GetParam();
  StartServer();
  Call(Kind::kStream, End::kSuccess);  // gRPC sets things up at its first call
  ExpectIdle();
  const int64_t threads = CountIn("/proc/self/task"), descriptors = CountIn("/proc/self/fd");
  const int rounds = Setting("CHOREO_FAULT_ROUNDS", 20);
  for (int round = 0; round < rounds; ++round) {
    Call(kind, end);
    if (HasFatalFailure()) return;
    if (end == End::kShutdown) StartServer();
  }
  ExpectIdle();
  // gRPC keeps some threads and a connection or two for a while.
  constexpr int64_t kSpare = 10;
  ExpectEventually([&] { return CountIn("/proc/self/fd") < descriptors + kSpare; },
                   "descriptors come back");
  ExpectEventually([&] { return CountIn("/proc/self/task") < threads + kSpare; },
                   "threads come back");
  std::cout << rounds << " calls: threads " << threads << " -> " << CountIn("/proc/self/task")
            << ", descriptors " << descriptors << " -> " << CountIn("/proc/self/fd") << '\n';
  DanceClient after(stub());
  after.Send(Config());
  after.SendKeyframe(Key("a", 20));
  EXPECT_TRUE(after.Finish().status.ok());
}

INSTANTIATE_TEST_SUITE_P(
    Calls, CleanupTest,
    testing::Combine(testing::Values(Kind::kTransition, Kind::kStream, Kind::kControlled),
                     testing::Values(End::kSuccess, End::kCancel, End::kDeadline, End::kError,
                                     End::kShutdown, End::kClientGone)),
    [](const auto& of) {
      return std::string(NameOf(std::get<0>(of.param))) + NameOf(std::get<1>(of.param));
    });

}  // namespace choreo::cleanup_test
