#include "client/authoring/local_server.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "model/core/error.h"
#include "model/core/programs.h"

namespace choreo::authoring {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kStartLimit{120};
constexpr std::chrono::seconds kStopLimit{10};
constexpr const char* kListens = "choreod listens on ";

/// Turns the child process into the server. Does not return.
[[noreturn]] void Become(const std::filesystem::path& program, const std::string& listen,
                         const std::string& model, int to, pid_t parent) {
  // Ends the server when the parent dies, which may have happened before this line.
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(127);
  setpgid(0, 0);  // a terminal's Ctrl-C reaches only the parent, which stops the server in order
  dup2(to, STDOUT_FILENO);
  execl(program.c_str(), "choreod", "--listen", listen.c_str(), "--log-level", "warning",
        "--log-format", "text", "--drain-seconds", "0", model.empty() ? nullptr : "--model",
        model.c_str(), nullptr);
  _exit(127);
}

}  // namespace

std::filesystem::path LocalServer::Program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "choreod";
}

std::unique_ptr<LocalServer> LocalServer::Start(const std::string& model) {
  // Checkpoints in the environment determine the models.
  const bool ships = std::ranges::find(kShippedModels, model) != std::end(kShippedModels) &&
                     std::getenv("CHOREO_CHECKPOINT") == nullptr &&
                     std::getenv("CHOREO_MODELS") == nullptr;
  return std::make_unique<LocalServer>(Program(), "127.0.0.1:0", ships ? model : "");
}

LocalServer::LocalServer(const std::filesystem::path& program, const std::string& listen,
                         const std::string& model)
    : program_(program) {
  if (access(program.c_str(), X_OK) != 0) {
    throw Error(ErrorCode::kNotFound, program.string(),
                "does not exist, so no server can be started; name one with --server");
  }
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw Error(ErrorCode::kInternal, "", std::string("pipe: ") + std::strerror(errno));
  const pid_t self = getpid();
  process_ = fork();
  if (process_ == 0) Become(program, listen, model, ends[1], self);
  close(ends[1]);
  if (process_ > 0) address_ = ReadAddress(ends[0]);
  close(ends[0]);
  if (address_.empty()) {
    Stop();
    throw Error(ErrorCode::kUnavailable, program.string(), "did not start");
  }
}

LocalServer::~LocalServer() { Stop(); }

void LocalServer::RequireRunning() {
  int status = 0;
  if (process_ > 0 && waitpid(process_, &status, WNOHANG) == 0) return;
  process_ = -1;
  const std::string how = WIFSIGNALED(status) ? std::string(strsignal(WTERMSIG(status)))
                                              : "exit code " + std::to_string(WEXITSTATUS(status));
  throw Error(ErrorCode::kUnavailable, program_,
              "the server of this command has ended (" + how + ")");
}

std::string LocalServer::ReadAddress(int from) {
  const Clock::time_point limit = Clock::now() + kStartLimit;
  std::string output;
  for (;;) {
    if (const size_t end = output.find('\n'); end != std::string::npos) {
      if (output.starts_with(kListens))
        return output.substr(std::strlen(kListens), end - std::strlen(kListens));
      output.erase(0, end + 1);
      continue;
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(limit - Clock::now());
    pollfd waiting{from, POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(left.count()));
    if (ready < 0 && errno == EINTR) continue;
    char buffer[256];
    const ssize_t count = ready > 0 ? read(from, buffer, sizeof buffer) : 0;
    if (count <= 0) return "";
    output.append(buffer, static_cast<size_t>(count));
  }
}

void LocalServer::Stop() noexcept {
  if (process_ <= 0) return;
  kill(process_, SIGTERM);
  const Clock::time_point limit = Clock::now() + kStopLimit;
  while (waitpid(process_, nullptr, WNOHANG) == 0) {
    if (Clock::now() > limit) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  process_ = -1;
}

}  // namespace choreo::authoring
