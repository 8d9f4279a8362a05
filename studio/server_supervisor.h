#pragma once

#include <sys/types.h>

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

namespace choreo::studio {

/// Runs a choreod and restarts it at the same address when it dies. The client library then resumes
/// dances in progress, bit for bit.
class ServerSupervisor {
 public:
  /// Returns when the server listens. Throws like LocalServer.
  explicit ServerSupervisor(const std::filesystem::path& program);
  ~ServerSupervisor();
  ServerSupervisor(const ServerSupervisor&) = delete;
  ServerSupervisor& operator=(const ServerSupervisor&) = delete;

  const std::string& address() const { return address_; }
  /// The process of the running server or, without one, of the last.
  pid_t process() const { return process_; }

 private:
  void Supervise(const std::filesystem::path& program, std::exception_ptr* failure);

  std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  bool started_ = false;
  std::string address_;
  std::atomic<pid_t> process_ = -1;
  // Servers end with the thread that started them, so one thread starts them all.
  std::thread thread_;
};

}  // namespace choreo::studio
