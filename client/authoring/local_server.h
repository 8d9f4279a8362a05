#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>

namespace choreo::authoring {

/// This process's own choreod, on a free port of this machine. It stops when this object is
/// destroyed or this process dies.
class LocalServer {
 public:
  /// The path of the choreod beside this program; empty if there is none.
  static std::filesystem::path Program();
  /// Starts the choreod beside this program and waits until it listens. `model`: the shipped model
  /// to serve alone; any other name: the default models. Throws Error(kNotFound) if there is no
  /// choreod, and Error(kUnavailable) if it does not listen within two minutes; its stderr gives
  /// the reason.
  static std::unique_ptr<LocalServer> Start(const std::string& model);
  /// `listen`: HOST:PORT; port 0 takes a free one.
  explicit LocalServer(const std::filesystem::path& program,
                       const std::string& listen = "127.0.0.1:0", const std::string& model = "");
  ~LocalServer();
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  const std::string& address() const { return address_; }
  pid_t process() const { return process_; }
  /// Throws Error(kUnavailable) if the server has ended. The message explains how.
  void RequireRunning();

 private:
  /// Reads the line in which the server reports its address. Returns an empty string if the server
  /// ends or takes too long.
  static std::string ReadAddress(int from);
  void Stop() noexcept;

  std::string program_;
  pid_t process_ = -1;
  std::string address_;
};

}  // namespace choreo::authoring
