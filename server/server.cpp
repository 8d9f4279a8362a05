#include "server/server.h"

#include <grpc/grpc.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/impl/server_builder_option.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "model/core/error.h"
#include "model/core/limits.h"
#include "model/core/running/threads.h"
#include "model/core/text/counted.h"
#include "network/protocol.h"
#include "server/accept_guard.h"
#include "server/calls/service.h"
#include "server/calls/serving.h"
#include "server/connection_limits.h"
#include "server/connections/frame_guard.h"
#include "server/connections/handshakes.h"
#include "server/connections/listener.h"
#include "server/connections/reset_guard.h"
#include "server/metrics.h"
#include "server/process/free_memory.h"
#include "server/process/periodic_thread.h"
#include "server/process/service_manager.h"
#include "server/settings/certificate_files.h"
#include "server/telemetry/log.h"
#include "server/tls.h"

namespace choreo {
namespace {

using std::chrono::milliseconds;

/// Detects clients that vanished silently.
constexpr int kKeepaliveMs = 30'000;
constexpr int kKeepaliveTimeoutMs = 10'000;
constexpr auto kClientPingMs = static_cast<int>(1000 * kMinSilence / 4);
/// The last share of the drain time. In it streams end at their next transition, so that other
/// servers resume them without generating frames twice.
constexpr double kMovingShare = 0.25;
/// How long a drained server waits for aborted calls to end.
constexpr milliseconds kAbortTime{2'000};
constexpr milliseconds kShutdownTime{1'000};
/// The interval at which limits and engines are checked.
constexpr milliseconds kWatchInterval{100};
/// The interval at which tokens and certificate are read. A revoked token works for at most this
/// long.
constexpr milliseconds kFileInterval{500};
/// The interval at which free memory is returned to the system.
constexpr milliseconds kMemoryInterval{10'000};
/// The least default for max_streams. Waiting calls cost little.
constexpr int kLeastStreams = 64;
/// The number of successive failures after which an engine counts as broken.
constexpr int kBroken = 3;
/// ResetGuard's limit, in multiples of the calls that a connection may have.
constexpr int kWaitingCalls = 2;
/// How long a drained server still refuses new calls with a status. After gRPC's shutdown, the next
/// call on an idle connection would end with CANCELLED, which does not tell the client to use
/// another server. So the shutdown itself is short.
constexpr milliseconds kNotice{1'000};
constexpr milliseconds kShutdownTimeAfterNotice{50};

milliseconds Milliseconds(double seconds) {
  return milliseconds(static_cast<int64_t>(seconds * 1e3));
}

CallLimits LimitsOf(const ServerConfig& config) {
  return {.calls = config.max_streams,
          .calls_of_caller = config.MaxStreamsOfPeer(),
          .calls_of_lone_caller = config.MaxStreamsOfLonePeer(),
          .first_message = Milliseconds(config.first_message_seconds),
          .idle = Milliseconds(config.idle_seconds),
          .unread = Milliseconds(config.unread_seconds)};
}

// One caller gets the same share of time as of calls.
FrameShares SharesOf(const ServerConfig& config) {
  const auto share = [&config](int calls) {
    return config.max_load * std::min(1.0, double(calls) / config.max_streams);
  };
  return {.of_all = config.max_load,
          .of_caller = share(config.MaxStreamsOfPeer()),
          .of_lone_caller = share(config.MaxStreamsOfLonePeer())};
}

void LogSecurity(const ServerConfig& config, const Tokens& tokens) {
  spdlog::info("TLS is {}, certificates of clients are {}, tokens are {}",
               config.tls_certificate.empty() ? "off" : "on",
               config.tls_client_ca.empty() ? "not asked for" : "needed",
               tokens.needed() ? std::to_string(tokens.count()) + ", of which one is needed"
                               : "not asked for");
}

void LogSpeed(const SampleQueue& model) {
  constexpr int kDances = 64;
  const double load = model.LoadOf(kDances * model.model().fps);
  if (load <= 0) return;  // not measured
  spdlog::info("model \"{}\": {} dances at once take {:.1f} % of its engines' time",
               model.model().name, kDances, 100 * load);
}

/// Removes gRPC's reflection from one server. Linking the library adds it to all.
class WithoutReflection final : public grpc::ServerBuilderOption {
 public:
  void UpdateArguments(grpc::ChannelArguments* /*arguments*/) override {}
  void UpdatePlugins(std::vector<std::unique_ptr<grpc::ServerBuilderPlugin>>* plugins) override {
    std::erase_if(*plugins, [](const auto& plugin) {
      return dynamic_cast<grpc::reflection::ProtoServerReflectionPlugin*>(plugin.get()) != nullptr;
    });
  }
};

std::vector<std::unique_ptr<SampleQueue>> MakeQueues(std::vector<Server::Samplers> models,
                                                     const SampleQueue::Options& options) {
  std::vector<std::unique_ptr<SampleQueue>> queues;
  for (auto& samplers : models) {
    queues.push_back(std::make_unique<SampleQueue>(std::move(samplers), options));
    LogSpeed(*queues.back());
  }
  return queues;
}

SampleQueue::Options QueueingOf(const ServerConfig& config) {
  return {.max_bulk = config.max_waiting};
}

// The default of max_streams. The speed measured at startup is only logged, because other programs
// may be busy then. FrameBudget measures the dances themselves, and refuses those for which the
// machine is too slow.
int DefaultStreams(double max_load, const std::vector<std::unique_ptr<SampleQueue>>& queues) {
  int streams = kLeastStreams;
  for (const auto& queue : queues) {
    const double fps = queue->model().fps, load = queue->LoadOf(fps);
    if (load <= 0) continue;  // not measured
    spdlog::info("model \"{}\": as busy as this machine is now, it carries {:.0f} dances at once",
                 queue->model().name, max_load / (load + ServingCost().LoadOf(fps)));
    streams = std::max(streams, UsableCores() * kStreamsPerCore);
  }
  return streams;
}

// Sets max_streams if the configuration does not.
ServerConfig WithStreams(ServerConfig config, int by_default) {
  if (config.max_streams > 0) return config;
  config.max_streams = std::max(by_default, config.max_streams_of_peer);
  spdlog::info("at most {} calls at once; --max-streams fixes the number", config.max_streams);
  return config;
}

}  // namespace

struct Server::Impl {
  Impl(const ServerConfig& given, std::vector<std::unique_ptr<SampleQueue>> queues,
       const TimeSource& time)
      : default_streams(DefaultStreams(given.max_load, queues)),
        config(WithStreams(given, default_streams)),
        serving(std::move(queues), LimitsOf(config), SharesOf(config), config.tokens,
                static_cast<size_t>(config.outbox_kib) << 10,
                int64_t{config.max_file_music_mib} << 20,
                std::min(kMaxCandidates, config.max_waiting), config.io_threads, time),
        service(serving),
        resets(kWaitingCalls * CallsOfConnection(config),
               [this](const std::string& peer) { handshakes.Began(peer); }),
        newcomers(resets, serving.tally),
        listener(config.listen) {
    if (!config.tls_certificate.empty()) {
      certificate.emplace(config);
      certificate->LogExpiry();
      NoteExpiry();
      ForwardGrpcLog();  // it counts failed handshakes
    }
    // Never released, because a process's last grpc_shutdown can wait ten seconds for gRPC's
    // threads.
    [[maybe_unused]] static const bool kept = (grpc_init(), true);
    grpc::EnableDefaultHealthCheckService(true);  // for every server in this process
    grpc::ServerBuilder builder;
    if (!config.reflection) builder.SetOption(std::make_unique<WithoutReflection>());
    acceptor = builder.experimental().AddExternalConnectionAcceptor(
        grpc::ServerBuilder::experimental_type::ExternalConnectionType::FROM_FD,
        MakeCredentials(certificate ? &*certificate : nullptr));
    LimitConnections(config, &builder);
    resets.Watch(&builder);
    builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepaliveMs);
    builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepaliveTimeoutMs);
    builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS,
                               kClientPingMs);
    if (config.max_connection_seconds > 0) {
      builder.AddChannelArgument(
          GRPC_ARG_MAX_CONNECTION_AGE_MS,
          static_cast<int>(Milliseconds(config.max_connection_seconds).count()));
    }
    builder.RegisterService(&service);
    server = builder.BuildAndStart();
    if (!server) throw Error(ErrorCode::kUnavailable, "", "gRPC could not start");
    UpdateHealth();
    LogSecurity(config, serving.tokens);
    watch.emplace(kWatchInterval, [this] {
      serving.calls.EndIdle();
      serving.models.FreeUnused();
      serving.LookAtCost();
      LogLeftOutCalls();
      newcomers.Report(AcceptGuard::Clock::now());
      UpdateHealth();
      if (certificate) handshakes.Look();
      TellManagerOfLife();
    });
    if (serving.tokens.needed() || certificate) {
      file_watch.emplace(kFileInterval, [this] { RereadFiles(); });
    }
    memory_watch.emplace(kMemoryInterval, [memory = FreeMemory()]() mutable { memory.Look(); });
    if (!config.metrics.empty()) metrics.emplace(config.MetricsAddress(), serving);
    listener.Start([this](int listening, int connection) {
      if (!newcomers.Takes(connection)) {
        close(connection);
        return;
      }
      GuardFrames(connection, certificate.has_value(), resets.held_off());
      if (certificate) handshakes.Accepted(connection);
      grpc::experimental::ExternalConnectionAcceptor::NewConnectionParameters parameters;
      parameters.listener_fd = listening;
      parameters.fd = connection;
      acceptor->HandleNewConnection(&parameters);
    });
  }

  void RereadFiles() {
    Reloads& reloads = serving.reloads;
    if (const auto good = serving.tokens.Refresh()) reloads.Note(Reloads::kTokens, *good);
    serving.calls.EndRevoked();
    if (!certificate) return;
    if (const auto good = certificate->Refresh()) reloads.Note(Reloads::kCertificate, *good);
    NoteExpiry();
  }

  void NoteExpiry() {
    serving.reloads.certificate_expires = static_cast<double>(certificate->expires());
    serving.reloads.client_ca_expires = static_cast<double>(certificate->client_ca_expires());
  }

  // Reports the health of each model and of the server: SERVING unless the server drains or an
  // engine is broken. A removed model is NOT_SERVING.
  void UpdateHealth() {
    const std::lock_guard lock(health_mutex);
    const std::string name = v1::Choreography::service_full_name();
    bool all = !drained;
    std::set<std::string> told = {"", name};
    for (const Models::Use& queue : serving.models.served()) {
      const int failures = queue->stats().failures;
      const bool works = failures < kBroken;
      all &= works;
      const std::string of_model = name + '/' + queue->model().name;
      told.insert(of_model);
      if (SetHealth(of_model, works && !drained) && !works) {
        spdlog::error(
            "model \"{}\": its engine has failed {} times in a row; health says NOT_SERVING",
            queue->model().name, failures);
      }
    }
    for (const auto& [former, serves] : health) {
      if (!told.contains(former)) SetHealth(former, false);
    }
    SetHealth("", all);
    SetHealth(name, all);
  }

  // Returns whether the status changed.
  bool SetHealth(const std::string& name, bool serves) {
    const auto before = health.find(name);
    if (before != health.end() && before->second == serves) return false;
    server->GetHealthCheckService()->SetServingStatus(name, serves);
    health[name] = serves;
    return true;
  }

  const int default_streams;
  const ServerConfig config;  // of the start
  Serving serving;
  ChoreographyService service;
  HandshakeWatch handshakes;
  ResetGuard resets;
  AcceptGuard newcomers;
  std::optional<CertificateFiles> certificate;
  std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor> acceptor;
  std::unique_ptr<grpc::Server> server;
  Listener listener;
  std::atomic<bool> drained = false;
  std::mutex health_mutex;
  std::map<std::string, bool> health;  // last status reported, by name. Lock: health_mutex
  // Declared last, so that their threads end before the members that they use.
  std::optional<PeriodicThread> watch;
  std::optional<PeriodicThread> file_watch, memory_watch;
  std::optional<MetricsEndpoint> metrics;
};

Server::Server(const ServerConfig& config, std::vector<Samplers> models, const TimeSource& time)
    : impl_(std::make_unique<Impl>(config, MakeQueues(std::move(models), QueueingOf(config)),
                                   time)) {}

Server::~Server() { Drain(0); }

int Server::port() const { return impl_->listener.port(); }

int Server::metrics_port() const { return impl_->metrics ? impl_->metrics->port() : 0; }

int Server::transitions() const { return impl_->serving.models.transitions(); }

int Server::calls() const { return impl_->serving.calls.count(); }

void Server::GiveUp() { impl_->serving.calls.GiveUpAll(); }

bool Server::SetModels(const std::vector<std::string>& names, std::vector<Samplers> fresh) {
  if (impl_->drained) return false;
  impl_->serving.models.Set(names, MakeQueues(std::move(fresh), QueueingOf(impl_->config)));
  impl_->UpdateHealth();
  return true;
}

void Server::SetLimits(const ServerConfig& config) {
  const ServerConfig complete = WithStreams(config, impl_->default_streams);
  impl_->serving.calls.SetLimits(LimitsOf(complete));
  impl_->serving.frames.SetShares(SharesOf(complete));
}

void Server::NoteModelReload(bool good) { impl_->serving.reloads.Note(Reloads::kModels, good); }

void Server::NoteSettingsReload(bool good) {
  impl_->serving.reloads.Note(Reloads::kSettings, good);
}

void Server::Drain(double seconds) {
  if (impl_->drained.exchange(true)) return;
  CallRegistry& calls = impl_->serving.calls;
  impl_->UpdateHealth();
  calls.StopAdmitting();
  const double moving = kMovingShare * seconds;
  const auto wait = [&](double time) { return calls.WaitUntilEmpty(Milliseconds(time)); };
  bool empty = wait(seconds - moving);
  if (!empty) {
    calls.EndAtTransitions();
    empty = wait(moving);
  }
  if (!empty) {
    spdlog::warn("still in progress after {} s: {}, ended as UNAVAILABLE", seconds,
                 Counted(calls.count(), "call"));
    calls.AbortAll(ResumeElsewhere());
    calls.WaitUntilEmpty(kAbortTime);
  }
  const milliseconds notice = std::min(kNotice, Milliseconds(seconds));
  std::this_thread::sleep_for(notice);
  impl_->listener.Stop();
  impl_->newcomers.ReportRest();
  impl_->server->Shutdown(std::chrono::system_clock::now() +
                          (notice == kNotice ? kShutdownTimeAfterNotice : kShutdownTime));
  const Tally& tally = impl_->serving.tally;
  const auto [served, refused] = tally.sum();
  spdlog::info("served {} ({} refused) with {}", Counted(served, "call"), refused,
               Counted(tally.frames.load(), "frame"));
}

}  // namespace choreo
