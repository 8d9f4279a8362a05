#include "server/serve.h"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <ucontext.h>
#include <unistd.h>

#include <condition_variable>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "model/core/error.h"
#include "model/core/programs.h"
#include "network/address.h"
#include "server/connections/listener.h"
#include "server/process/service_manager.h"
#include "server/server.h"
#include "server/settings/certificate_files.h"
#include "server/settings/fault_list.h"
#include "server/settings/tokens.h"
#include "server/telemetry/log.h"

namespace choreo {
namespace {

sigset_t SetOf(std::initializer_list<int> signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals) sigaddset(&set, signal);
  return set;
}

// Exits without cleanup: loading cannot be interrupted, and only the log remains to be written.
[[noreturn]] void Leave() {
  spdlog::default_logger()->flush();
  std::_Exit(0);
}

/// From Begin until this object ends, stop signals end choreod at once.
class LeaveAtOnce {
 public:
  /// While models load: SIGHUP waits for the server.
  LeaveAtOnce() : LeaveAtOnce(SetOf({SIGTERM, SIGINT}), [] {}) { Begin(); }
  /// While the server drains. `last`: runs before the exit.
  explicit LeaveAtOnce(std::function<void()> last)
      : LeaveAtOnce(SetOf({SIGTERM, SIGINT, SIGHUP}), std::move(last)) {}

  void Begin() {
    const std::lock_guard lock(mutex_);
    begun_ = true;
    wake_.notify_all();
  }

 private:
  LeaveAtOnce(sigset_t asked, std::function<void()> last)
      : thread_([this, asked, last = std::move(last)](const std::stop_token& stop) {
          constexpr timespec kLook{.tv_sec = 0, .tv_nsec = 20'000'000};
          {
            std::unique_lock lock(mutex_);
            if (!wake_.wait(lock, stop, [this] { return begun_; })) return;
          }
          while (!stop.stop_requested()) {
            const int signal = sigtimedwait(&asked, nullptr, &kLook);
            if (signal <= 0) continue;
            if (signal == SIGHUP) {
              spdlog::warn("{}: nothing is read again while the server drains; SIGTERM ends it",
                           strsignal(signal));
              continue;
            }
            spdlog::info("{}: exits immediately", strsignal(signal));
            last();
            Leave();
          }
        }) {}

  std::mutex mutex_;
  std::condition_variable_any wake_;
  bool begun_ = false;   // lock: mutex_
  std::jthread thread_;  // last, because it uses the members above
};

std::vector<Server::Samplers> LoadAll(const ServerConfig& config, ModelFolder& folder,
                                      const ModelFolder::Loader& load) {
  const LeaveAtOnce leave;
  if (!config.models.empty()) return folder.Load();
  std::vector<Server::Samplers> models;
  FaultList faults;
  for (const auto& path :
       config.checkpoints.empty() ? ShippedCheckpoints(config.names) : config.checkpoints) {
    faults.Try([&] { models.push_back(load(path)); });
  }
  faults.Throw();
  return models;
}

// Reports unusable addresses before loading models, which takes seconds. When asked to check, a
// running server has them in use.
void CheckAddresses(const ServerConfig& config, FaultList* faults) {
  std::vector<std::unique_ptr<Listener>> taken;  // so that each finds those of the others in use
  const auto check = [&](const std::string& address, const std::string& field) {
    faults->Try([&] {
      if (config.check) return RequireOwnAddress(address, field);
      taken.push_back(std::make_unique<Listener>(address, field));
    });
  };
  check(config.listen, "--listen");
  if (!config.metrics.empty()) check(config.MetricsAddress(), "--metrics");
}

// Finds unusable files of secrets before loading models, too.
void CheckSecrets(const ServerConfig& config, FaultList* faults) {
  faults->Try([&] {
    if (config.tls_certificate.empty()) return;
    CertificateFiles certificate(config);
    if (config.check) certificate.LogExpiry();  // as the server itself does
  });
  faults->Try([&] { const Tokens tokens(config.tokens); });
}

// Threads that libraries started before main do not inherit main's signal mask: such a thread
// blocks a signal that reaches it, and sends it again.
void HandOn(int signal, siginfo_t* /*info*/, void* context) {
  sigaddset(&static_cast<ucontext_t*>(context)->uc_sigmask, signal);
  kill(getpid(), signal);
}

}  // namespace

void OpenStandardStreams() {
  int fd = 0;
  do {
    fd = open("/dev/null", O_RDWR);  // it gets the lowest free number
  } while (fd >= 0 && fd <= STDERR_FILENO);
  if (fd > STDERR_FILENO) close(fd);
}

void HoldSignals() {
  signal(SIGPIPE, SIG_IGN);  // a log without a reader must not end the process
  const sigset_t held = SetOf({SIGTERM, SIGINT, SIGHUP});
  pthread_sigmask(SIG_BLOCK, &held, nullptr);
  struct sigaction action {};
  action.sa_sigaction = HandOn;
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  for (const int one : {SIGTERM, SIGINT, SIGHUP}) sigaction(one, &action, nullptr);
}

void Serve(const ServerConfig& config, const ModelFolder::Loader& load,
           const SettingsReader& reread) {
  ModelFolder folder(config.models, load);
  FaultList faults;
  CheckAddresses(config, &faults);
  CheckSecrets(config, &faults);
  if (!config.check) faults.Throw();
  std::vector<Server::Samplers> models;
  faults.Try([&] { models = LoadAll(config, folder, load); });
  faults.Throw();
  if (config.check) {
    std::cout << "ok" << std::endl;
    return;
  }
  Server server(config, std::move(models));
  // Its thread is made before anybody calls: a stop must not need one that the system refuses.
  std::optional<LeaveAtOnce> leave(std::in_place, [&server] { server.GiveUp(); });
  // Programs that start a choreod wait for this line.
  const std::string line = "choreod listens on " + SplitAddress(config.listen).host + ':' +
                           std::to_string(server.port());
  Reloader reloader(config, reread, config.models.empty() ? nullptr : &folder, server, line);
  std::cout << (config.log_format == "json" ? JsonLine("info", line) : line) << std::endl;
  TellManager("READY=1\nSTATUS=" + line);

  const sigset_t heard = SetOf({SIGTERM, SIGINT, SIGHUP});
  int signal = 0;
  while (sigwait(&heard, &signal) == 0 && signal == SIGHUP) reloader.Request();
  reloader.Stop();
  const double drain_seconds = reloader.drain_seconds();
  spdlog::info("{}: draining for up to {} s; again to exit immediately", strsignal(signal),
               drain_seconds);
  TellManagerOfDrain(drain_seconds);
  leave->Begin();
  server.Drain(drain_seconds);
  leave.reset();
  if (reloader.loads()) Leave();
}

int ExitCodeOf(const std::exception& error) {
  const auto* known = dynamic_cast<const Error*>(&error);
  const bool is_misuse = known != nullptr && (known->code() == ErrorCode::kInvalidArgument ||
                                              known->code() == ErrorCode::kNotFound);
  return is_misuse ? kMisused : kFailed;
}

}  // namespace choreo
