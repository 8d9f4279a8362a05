#pragma once

#include <sys/types.h>

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

namespace choreo::studio {

/// A choreod of our own that is started again, at the same address, when it dies: dances in
/// progress then go on, bit for bit, by the client library's resume.
class ServerSupervisor {
 public:
  /// Returns when the server listens. Throws what LocalServer does.
  explicit ServerSupervisor(const std::filesystem::path& program);
  ~ServerSupervisor();
  ServerSupervisor(const ServerSupervisor&) = delete;
  ServerSupervisor& operator=(const ServerSupervisor&) = delete;

  const std::string& address() const { return address_; }
  /// That of the server that runs, or of the last one.
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
