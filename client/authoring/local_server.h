#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>

namespace choreo::authoring {

/// Our own choreod: started on a free port of this machine, and stopped with this object, or when
/// this process dies.
class LocalServer {
 public:
  /// The choreod beside this program, if any.
  static std::filesystem::path Program();
  /// Starts the choreod beside this program and returns when it listens. `model`: a shipped one, to
  /// serve alone; any other name: the default ones. Throws Error(kNotFound) if there is none, and
  /// Error(kUnavailable) if it does not listen within two minutes; its stderr says why.
  static std::unique_ptr<LocalServer> Start(const std::string& model);
  /// `listen`: HOST:PORT; port 0 takes a free one.
  explicit LocalServer(const std::filesystem::path& program,
                       const std::string& listen = "127.0.0.1:0", const std::string& model = "");
  ~LocalServer();
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  const std::string& address() const { return address_; }
  pid_t process() const { return process_; }
  /// Throws Error(kUnavailable) saying how it ended, if it has.
  void RequireRunning();

 private:
  /// Reads the line in which the server reports its address; empty if it ends or takes too long.
  static std::string ReadAddress(int from);
  void Stop() noexcept;

  std::string program_;
  pid_t process_ = -1;
  std::string address_;
};

}  // namespace choreo::authoring
