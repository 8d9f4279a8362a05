#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "client/authoring/local_server.h"
#include "server/connections/listener.h"
#include "server/messages/refusal.h"
#include "server/settings/reloads.h"
#include "tests/server/connections/silent_connections.h"
#include "tests/server/fixture.h"
#include "tests/support/certificates.h"
#include "tests/support/sanitizers.h"
#include "tests/support/tcp_proxy.h"
#include "tests/support/temporary_folder.h"

/// The metrics that a server exports to Prometheus.
namespace choreo::metrics_test {

using testing::HasSubstr;
using testing::Not;

class MetricsTest : public ServerTest {
 protected:
  std::string Metrics() const { return MetricsAt(server->metrics_port()); }

  static int ConnectTo(int port) {
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    return fd;
  }
  // Returns the text of http://127.0.0.1:PORT/metrics.
  static std::string MetricsAt(int port) { return AnswerTo(port, "GET /metrics"); }
  static std::string AnswerTo(int port, const std::string& line) {
    const int fd = ConnectTo(port);
    const std::string request = line + " HTTP/1.0\r\n\r\n";
    EXPECT_EQ(send(fd, request.data(), request.size(), 0), std::ssize(request));
    std::string said;
    char bytes[4096];
    for (ssize_t count = 1; count > 0;) {
      count = recv(fd, bytes, sizeof bytes, 0);
      if (count > 0) said.append(bytes, static_cast<size_t>(count));
    }
    close(fd);
    return said;
  }
  // Returns -1 for a missing series.
  double Figure(const std::string& name) const {
    const std::string all = Metrics();
    const size_t at = all.find('\n' + name + ' ');
    return at == std::string::npos ? -1 : std::stod(all.substr(at + name.size() + 2));
  }
};

TEST_F(MetricsTest, CountFinishedWork) {
  Start(2, [](ServerConfig& config) { config.metrics = "0"; });
  ASSERT_TRUE(DanceToAKey().status.ok());
  DanceClient bad(stub());
  EXPECT_FALSE(bad.Finish().status.ok());
  ExpectIdle();
  const std::string of_fake = R"({model="fake"})";
  EXPECT_EQ(Figure(R"(choreo_calls_total{method="StreamDance",status="OK"})"), 1);
  const std::string refused =
      R"(choreo_calls_total{method="StreamDance",status="INVALID_ARGUMENT"})";
  ExpectEventually([&] { return Figure(refused) == 1; }, "the other call is counted, too");
  EXPECT_EQ(Figure(R"(choreo_call_seconds_count{method="StreamDance",status="OK"})"), 1);
  EXPECT_GT(Figure(R"(choreo_call_seconds_sum{method="StreamDance",status="OK"})"), 0);
  EXPECT_THAT(
      Metrics(),
      HasSubstr(
          R"(choreo_call_seconds_bucket{method="StreamDance",status="INVALID_ARGUMENT",le="60"} 1)"));
  EXPECT_EQ(Figure("choreo_sent_frames_total"), 21);
  EXPECT_EQ(Figure("choreo_frames_total" + of_fake), 21);
  EXPECT_EQ(Figure("choreo_steered_metres_count" + of_fake), 1);
  EXPECT_EQ(Figure("choreo_support_ratio_count" + of_fake), 1);
  EXPECT_EQ(Figure("choreo_first_frame_seconds_count"), 1);
  EXPECT_GE(Figure("choreo_sending_lateness_seconds_count"), 1);
  EXPECT_EQ(Figure("choreo_transitions_total" + of_fake), 1);
  EXPECT_EQ(Figure("choreo_transition_seconds_count" + of_fake), 1);
  EXPECT_GT(Figure("choreo_slice_seconds_count" + of_fake), 21);
  EXPECT_EQ(Figure("choreo_lateness_seconds_count" + of_fake), 1);
  EXPECT_EQ(Figure("choreo_workers" + of_fake), 2);
  EXPECT_THAT(Metrics(), HasSubstr(R"(choreo_lateness_seconds_bucket{model="fake",le="+Inf"} 1)"));
  EXPECT_THAT(Metrics(), HasSubstr(R"(choreo_lateness_seconds_bucket{model="fake",le="0.033"} )"))
      << "a frame at 30 a second";
  EXPECT_THAT(Metrics(), HasSubstr(R"(device="fake:0")"));
}

/// Its own motion misses keys by 20 cm.
class DriftingSampler final : public FakeSampler {
 public:
  DriftingSampler() { model_.name = "drifting"; }
  void OnFrame(const TransitionSpec& /*spec*/, Plan* plan) override {
    plan->poses.back().root_position.x() += 0.2;
  }
};

TEST_F(MetricsTest, ShowWhichModelDrifts) {
  Start(1, [](ServerConfig& config) { config.metrics = "0"; });
  std::vector<Server::Samplers> fresh(1);
  fresh[0].push_back(std::make_unique<DriftingSampler>());
  server->SetModels({"fake", "drifting"}, std::move(fresh));
  const auto steered = [&](const std::string& model) {
    DanceClient client(stub());
    v1::DanceConfig config = Config();
    config.set_model(model);
    client.Send(config);
    client.SendKeyframe(Key("a", 20));
    EXPECT_TRUE(client.Finish().status.ok());
    EXPECT_EQ(Figure("choreo_support_ratio_count{model=\"" + model + "\"}"), 1);
    return Figure("choreo_steered_metres_sum{model=\"" + model + "\"}");
  };
  const double sound = steered("fake");
  EXPECT_GT(steered("drifting"), sound + 0.1);
  EXPECT_EQ(Figure("choreo_steered_metres_sum{model=\"fake\"}"), sound);
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.set_frames(20);
  request.set_candidates(3);
  *request.mutable_target() = KeyPose(0.3, 0.4, 0.8F);
  EXPECT_TRUE(Generate(request).status.ok());
  EXPECT_EQ(Figure("choreo_steered_metres_count{model=\"fake\"}"), 4);
}

TEST_F(MetricsTest, ShowWorkInProgress) {
  Start(1, [](ServerConfig& config) {
    config.metrics = "0";
    config.max_streams = 4;
  });
  probe->Close();
  DanceClient client(stub()), other(stub());
  for (DanceClient* one : {&client, &other}) {
    one->Send(Config());
    one->SendKeyframe(Key("a", 20));
  }
  const std::string of_fake = R"({model="fake"})";
  // Both may wait for a moment, until the worker starts one of them.
  ExpectEventually([&] { return Figure("choreo_transitions_active" + of_fake) == 1; },
                   "the one has begun");
  ExpectEventually([&] { return Figure("choreo_transitions_waiting" + of_fake) == 1; },
                   "the other waits for it");
  other.Cancel();
  probe->Open();
  ExpectEventually([&] { return Figure("choreo_streams") == 1; }, "the other has left");
  EXPECT_EQ(Figure("choreo_utilisation"), 0.25);
  client.Cancel();
}

TEST_F(MetricsTest, CountResumedDances) {
  Start(1, [](ServerConfig& config) { config.metrics = "0"; });
  DanceClient client(stub());
  client.Send(Config());
  client.SendKeyframe(Key("a", 20));
  v1::DanceConfig config = Config();
  *config.mutable_continuation() = client.Finish().continuations.at(0);
  EXPECT_EQ(Figure("choreo_dances_resumed_total"), 0);
  DanceClient resumed(stub());
  resumed.Send(config);
  resumed.SendKeyframe(Key("b", 40));
  EXPECT_TRUE(resumed.Finish().status.ok());
  EXPECT_EQ(Figure("choreo_dances_resumed_total"), 1);
}

// Prometheus would take a falling counter for a restart, and show a jump in its rate.
TEST_F(MetricsTest, ContinueAcrossAModelReload) {
  Start(1, [](ServerConfig& config) { config.metrics = "0"; });
  const auto dance = [&] {
    DanceClient client(stub());
    client.Send(Config());
    client.SendKeyframe(Key("a", 20));
    EXPECT_TRUE(client.Finish().status.ok());
  };
  dance();
  std::vector<Server::Samplers> fresh(1);
  fresh[0].push_back(std::make_unique<ProbedSampler>("fake", probe));
  server->SetModels({"fake"}, std::move(fresh));
  dance();
  const std::string of_fake = R"({model="fake"})";
  ExpectEventually([&] { return Figure("choreo_workers" + of_fake) == 1; },
                   "the former one is gone");
  EXPECT_EQ(Figure("choreo_frames_total" + of_fake), 42);
  EXPECT_EQ(Figure("choreo_transition_seconds_count" + of_fake), 2);
  EXPECT_EQ(Figure("choreo_load" + of_fake), 0);
}

// Series of removed models disappear, so the list does not grow.
TEST_F(MetricsTest, OfARemovedModelEndWithItsLastDance) {
  Start(1, [](ServerConfig& config) { config.metrics = "0"; }, {"fake", "other"});
  DanceClient client(stub());
  v1::DanceConfig config = Config();
  config.set_model("other");
  client.Send(config);
  client.SendGenerateUntil(10);
  ASSERT_TRUE(client.ReadFrames(10));
  server->SetModels({"fake"}, {});
  EXPECT_THAT(Metrics(), HasSubstr(R"(choreo_frames_total{model="other"})"));
  client.SendKeyframe(Key("a", 20));
  ASSERT_TRUE(client.Finish().status.ok());
  ExpectEventually([&] { return Metrics().find("other") == std::string::npos; },
                   "no series names it any more");
  EXPECT_EQ(Figure("choreo_sent_frames_total"), 21) << "calls are counted all the same";
  EXPECT_EQ(Figure(R"(choreo_frames_total{model="fake"})"), 0);
}

// Each series in a query, with the labels by which it is summed.
TEST_F(MetricsTest, DashboardUsesExistingMetrics) {
  Start(1, [](ServerConfig& config) { config.metrics = "0"; });
  const std::string all = Metrics();
  std::ifstream file(std::filesystem::path(SOURCE_FOLDER) / "docker/grafana.json");
  const nlohmann::json dashboard = nlohmann::json::parse(file);
  const auto expect_label = [&](const std::string& series, const std::string& label) {
    const size_t at = all.find('\n' + series + '{');
    EXPECT_THAT(all.substr(at, all.find('\n', at + 1) - at), HasSubstr(label + "=\""))
        << series << " has no label " << label;
  };
  int asked = 0;
  for (const auto& panel : dashboard.at("panels")) {
    for (const auto& target : panel.at("targets")) {
      const std::string query = target.at("expr");
      SCOPED_TRACE(query);
      std::string series;
      const std::regex names("choreo_[a-z_]+");
      for (auto at = std::sregex_iterator(query.begin(), query.end(), names);
           at != std::sregex_iterator(); ++at, ++asked) {
        series = at->str();
        EXPECT_TRUE(all.find('\n' + series + '{') != all.npos ||
                    all.find('\n' + series + ' ') != all.npos)
            << "nobody exports " << series;
      }
      std::smatch by;
      if (!std::regex_search(query, by, std::regex("by *\\(([a-z_, ]+)\\)"))) continue;
      std::stringstream labels(by[1].str());
      for (std::string label; std::getline(labels >> std::ws, label, ',');) {
        if (label != "le") expect_label(series, label);
      }
    }
  }
  EXPECT_GT(asked, 15);
}

// An alert on a rate sees the first failure only if the series existed before.
TEST_F(MetricsTest, EveryStatusIsThereFromTheStart) {
  Start(1, [](ServerConfig& config) { config.metrics = "0"; });
  for (const std::string method : {"StreamDance", "GenerateTransition", "GetServerInfo"}) {
    for (const std::string status : {"OK", "INTERNAL", "UNAUTHENTICATED", "RESOURCE_EXHAUSTED"}) {
      EXPECT_EQ(Figure("choreo_calls_total{method=\"" + method + "\",status=\"" + status + "\"}"),
                0);
    }
  }
}

// gRPC shows a dead connection as the end of the client's messages first, at which a dance ends.
TEST_F(MetricsTest, DeadClientsAreCancelled) {
  constexpr int kClients = 30;
  Start(2, [](ServerConfig& config) { config.metrics = "0"; });
  std::vector<std::unique_ptr<TcpProxy>> proxies;
  std::vector<std::unique_ptr<DanceClient>> clients;
  for (int i = 0; i < kClients; ++i) {
    proxies.push_back(std::make_unique<TcpProxy>(server->port()));
    const auto own = grpc::CreateChannel(proxies[i]->address(), grpc::InsecureChannelCredentials());
    clients.push_back(std::make_unique<DanceClient>(*v1::Choreography::NewStub(own)));
    v1::DanceConfig config = Config();
    *config.mutable_audio_format() = MusicFormat();
    clients[i]->Send(config);
    clients[i]->SendKeyframesComplete();
    clients[i]->SendAudio(Music(2), 0);
    ASSERT_TRUE(clients[i]->ReadFrames(5));
  }
  for (int i = 0; i < kClients; ++i) {
    proxies[i].reset();
    EXPECT_FALSE(clients[i]->Finish().status.ok());
  }
  ExpectIdle();
  const auto ended = [this](const std::string& status) {
    return Figure("choreo_calls_total{method=\"StreamDance\",status=\"" + status + "\"}");
  };
  ExpectEventually([&] { return ended("CANCELLED") + ended("OK") == kClients; }, "all are counted");
  EXPECT_EQ(ended("OK"), 0);
}

// Autoscalers and alerts use it.
TEST_F(MetricsTest, UtilisationIsOneWhereverCallsAreRefused) {
  Start(1, [](ServerConfig& config) {
    config.metrics = "0";
    config.max_streams = 8;
    config.max_streams_of_peer = 2;
    config.max_waiting = 2;
  });
  EXPECT_EQ(Figure("choreo_utilisation"), 0);
  {
    DanceClient first(stub()), second(stub());
    for (DanceClient* one : {&first, &second}) {
      one->Send(Config());
      ASSERT_TRUE(one->ReadHeader());
    }
    EXPECT_EQ(Figure("choreo_utilisation"), 1) << "the caller gets no third call";
  }
  ExpectEventually([&] { return Figure("choreo_utilisation") == 0; }, "all have left");
  probe->Close();
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.set_frames(5);
  request.set_candidates(2);
  std::thread caller([&] { EXPECT_TRUE(Generate(request).status.ok()); });
  ExpectEventually([&] { return Figure("choreo_utilisation") == 1; }, "candidates fill it");
  probe->Open();
  caller.join();
}

TEST_F(MetricsTest, ShowWhoseCallsTheyAre) {
  const TemporaryFolder folder;
  const std::filesystem::path tokens = folder / "tokens";
  // Of the token "a" and of nobody's.
  std::ofstream(tokens)
      << "ca978112ca1bbdcafac231b39a23dc4da786eff8147c4e72b9807785afee48bb alice\n"
      << std::string(64, 'a') << " bob\n"
      << std::string(64, 'b') << " bob\n";
  Start(1, [&](ServerConfig& config) {
    config.metrics = "0";
    config.tokens = tokens;
    config.max_streams_of_peer = 1;
    config.max_streams = 1;
  });
  const auto figure = [this](const std::string& name, const std::string& holder) {
    return Figure("choreo_holder_" + name + "{holder=\"" + holder + "\"}");
  };
  grpc::ClientContext first, second;
  for (grpc::ClientContext* context : {&first, &second})
    context->AddMetadata("authorization", "Bearer a");
  const auto dance = stub().StreamDance(&first);
  ExpectEventually([&] { return figure("streams", "alice") == 1; }, "her call is in progress");
  const auto refused = stub().StreamDance(&second);
  EXPECT_EQ(refused->Finish().error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  ExpectEventually([&] { return figure("refused_calls_total", "alice") == 1; }, "it is counted");
  first.TryCancel();
  dance->Finish();
  ExpectEventually([&] { return figure("calls_total", "alice") == 1; }, "it is over");
  EXPECT_EQ(figure("streams", "alice"), 0);
  EXPECT_EQ(figure("calls_total", "bob"), 0);
}

TEST_F(MetricsTest, ShowFailedReloads) {
  const TemporaryFolder folder;
  const std::filesystem::path tokens = folder / "tokens";
  const std::string good = std::string(64, 'a') + " alice\n";
  std::ofstream(tokens) << good;
  Start(1, [&](ServerConfig& config) {
    config.metrics = "0";
    config.tokens = tokens;
  });
  const auto figure = [this](const std::string& name, const std::string& of) {
    return Figure("choreo_last_reload_" + name + "{of=\"" + of + "\"}");
  };
  for (const char* of : Reloads::kNames) EXPECT_EQ(figure("successful", of), 1) << of;
  const double begun = figure("success_timestamp_seconds", "tokens");
  EXPECT_GT(begun, 1e9);
  std::ofstream(tokens) << good << "nobody\n";
  ExpectEventually([&] { return figure("successful", "tokens") == 0; }, "it has a bad line");
  EXPECT_EQ(figure("success_timestamp_seconds", "tokens"), begun);
  std::filesystem::remove(tokens);
  std::ofstream(tokens) << good;
  ExpectEventually([&] { return figure("successful", "tokens") == 1; }, "it is good again");
  EXPECT_GT(figure("success_timestamp_seconds", "tokens"), begun);
  std::ofstream(tokens).flush();
  ExpectEventually([&] { return figure("successful", "tokens") == 0; }, "it is empty");
  server->NoteModelReload(false);
  EXPECT_EQ(figure("successful", "models"), 0);
  EXPECT_EQ(Figure("choreo_certificate_expiry_timestamp_seconds"), -1) << "there is none";
}

TEST_F(MetricsTest, TellWhenCertificatesExpireAndHandshakesFail) {
  const TemporaryFolder folder;
  const Authority authority(folder.path(), "authority");
  const Certificate own = authority.Issue("own");
  Start(1, [&](ServerConfig& config) {
    config.metrics = "0";
    config.tls_certificate = own.certificate;
    config.tls_key = own.key;
    config.tls_client_ca = authority.certificate();
  });
  const auto now = static_cast<double>(std::time(nullptr));
  EXPECT_GT(Figure("choreo_certificate_expiry_timestamp_seconds"), now);
  EXPECT_GT(Figure("choreo_client_ca_expiry_timestamp_seconds"), now);
  const std::string not_tls = "choreo_tls_handshake_failures_total{reason=\"not_tls\"}";
  const double before = Figure(not_tls);
  EXPECT_GE(before, 0);
  DanceClient without_tls(stub());
  EXPECT_FALSE(without_tls.Finish().status.ok());
  ExpectEventually([&] { return Figure(not_tls) > before; }, "it is counted");
}

TEST_F(MetricsTest, CountRefusalsByReason) {
  Start(1, [](ServerConfig& config) {
    config.metrics = "0";
    config.max_streams = 3;
    config.max_streams_of_peer = 2;
  });
  const auto refused = [this](const std::string& reason) {
    return Figure("choreo_refused_calls_total{reason=\"" + reason + "\"}");
  };
  for (const char* reason : kRefusals) EXPECT_EQ(refused(reason), 0) << reason;
  std::vector<std::unique_ptr<DanceClient>> clients;
  for (int i = 0; i < 2; ++i) {
    clients.push_back(std::make_unique<DanceClient>(stub()));
    clients.back()->Send(Config());
    ASSERT_TRUE(clients.back()->ReadHeader());
  }
  DanceClient third(stub());
  EXPECT_EQ(third.Finish().status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  ExpectEventually([&] { return refused("max_streams_of_peer") == 1; }, "it is counted");
  EXPECT_EQ(refused("max_streams"), 0);
  clients[1]->Cancel();
  ExpectEventually([this] { return server->calls() == 1; }, "one is left");
  std::thread drain([this] { server->Drain(300); });
  ExpectEventually([this] { return Figure("choreo_draining") == 1; }, "it drains");
  DanceClient late(stub());
  EXPECT_EQ(late.Finish().status.error_code(), grpc::StatusCode::UNAVAILABLE);
  ExpectEventually([&] { return refused("draining") == 1; }, "it is counted, too");
  clients[0]->Cancel();
  drain.join();
}

TEST_F(MetricsTest, ShowProcessResources) {
  Start(1, [](ServerConfig& config) { config.metrics = "0"; });
  EXPECT_EQ(Figure("choreo_draining"), 0);
  EXPECT_GT(Figure("process_cpu_seconds_total"), 0);
  EXPECT_GT(Figure("process_resident_memory_bytes"), 1 << 20);
  EXPECT_GT(Figure("process_virtual_memory_bytes"), Figure("process_resident_memory_bytes"));
  EXPECT_GT(Figure("process_open_fds"), 3);
  EXPECT_GE(Figure("process_max_fds"), Figure("process_open_fds"));
  EXPECT_GT(Figure("process_threads"), 1);
  const double age = static_cast<double>(std::time(nullptr)) - Figure("process_start_time_seconds");
  EXPECT_GE(age, -2);
  EXPECT_LT(age, 24 * 3600);
}

// A change of this figure means a restart.
TEST_F(MetricsTest, TheStartStaysTheSame) {
  Start(1, [](ServerConfig& config) { config.metrics = "0"; });
  std::set<double> starts;
  for (int i = 0; i < 30; ++i) {
    starts.insert(Figure("process_start_time_seconds"));
    std::this_thread::sleep_for(std::chrono::milliseconds(40));
  }
  EXPECT_EQ(starts.size(), 1U);
}

TEST_F(MetricsTest, FollowHttp) {
  Start(1, [](ServerConfig& config) { config.metrics = "0"; });
  const auto answer = [&](const std::string& line) {
    return AnswerTo(server->metrics_port(), line);
  };
  EXPECT_THAT(answer("GET /metrics?x=1"), HasSubstr("\nchoreo_streams 0"));
  const std::string head = answer("HEAD /metrics");
  EXPECT_THAT(head, testing::StartsWith("HTTP/1.1 200 OK\r\n"));
  EXPECT_THAT(head, testing::EndsWith("\r\n\r\n"));
  EXPECT_THAT(head, Not(HasSubstr("Content-Length: 0")));
  EXPECT_THAT(answer("GET /metricsx"), testing::StartsWith("HTTP/1.1 404 "));
  EXPECT_THAT(answer("HEAD /"), testing::EndsWith("\r\n\r\n"));
  EXPECT_THAT(answer("POST /metrics"), testing::StartsWith("HTTP/1.1 405 "));
  EXPECT_THAT(answer(""), testing::StartsWith("HTTP/1.1 405 "));
}

TEST_F(MetricsTest, DropSlowHttpClients) {
  Start(1, [](ServerConfig& config) { config.metrics = "0"; });
  const int fd = ConnectTo(server->metrics_port());
  bool left = false;
  for (int i = 0; i < 40 && !left; ++i) {
    send(fd, "G", 1, MSG_NOSIGNAL);
    pollfd waited{.fd = fd, .events = POLLIN, .revents = 0};
    char byte;
    left = poll(&waited, 1, 250) == 1 && recv(fd, &byte, 1, 0) <= 0;
  }
  close(fd);
  EXPECT_TRUE(left) << "within ten seconds";
  EXPECT_THAT(Metrics(), HasSubstr("choreo_workers"));
}

TEST_F(MetricsTest, IdleConnectionsDelayNobody) {
  Start(1, [](ServerConfig& config) { config.metrics = "0"; });
  const std::string address = "127.0.0.1:" + std::to_string(server->metrics_port());
  const SilentConnections few(address, 5);
  EXPECT_THAT(Metrics(), HasSubstr("choreo_workers"));
  EXPECT_EQ(few.Closed(), 0) << "it was not their end that let others be served";
  const SilentConnections many(address, 200);
  EXPECT_THAT(Metrics(), HasSubstr("choreo_workers"));
  ExpectEventually([&] { return many.Closed() > 100; }, "the oldest ones have to go");
}

TEST_F(MetricsTest, NameATakenAddress) {
  Start(1, [](ServerConfig& config) { config.metrics = "0"; });
  const std::string taken = std::to_string(server->metrics_port());
  try {
    Start(1, [&](ServerConfig& config) { config.metrics = taken; });
    FAIL() << "two serve metrics at one port";
  } catch (const Error& error) {
    EXPECT_EQ(error.field(), "--metrics");
    EXPECT_THAT(error.what(), HasSubstr("127.0.0.1:" + taken));
  }
}

// The same with LibTorch, which needs more of each thread.
TEST_F(MetricsTest, AreServedByTheProgram) {
  if (kSanitized) GTEST_SKIP() << "choreod runs LibTorch";
  const int port = Listener("127.0.0.1:0").port();  // free, most likely still in a moment
  ::setenv("CHOREO_METRICS", std::to_string(port).c_str(), 1);
  const authoring::LocalServer program(CHOREOD_PROGRAM);
  ::unsetenv("CHOREO_METRICS");
  EXPECT_THAT(MetricsAt(port), HasSubstr("choreo_workers{model=\"default\"}"));
}

}  // namespace choreo::metrics_test
