#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "studio/project_calls.h"

namespace choreo::studio {

class Socket;

/// Serves the page over HTTP, and a WebSocket at /studio with a PageSession behind each; projects
/// of other programs (project_calls.h), which must run on this machine. Answers only those who came
/// to it by its own name: a page from elsewhere, or a name of elsewhere that leads here, is
/// refused. No request of the page leaves this machine: its headers see to it.
class WebServer {
 public:
  /// Listens at HOST:PORT; port 0 takes a free one. `context` must outlive it. Throws
  /// Error(kInvalidArgument) whose field is "--listen".
  WebServer(const std::string& listen, const StudioContext& context);
  ~WebServer();

  /// As a browser takes it: "http://127.0.0.1:8765".
  std::string url() const;
  int port() const { return acceptor_.local_endpoint().port(); }

  /// Serves until Stop; asks `go_on` a few times a second, and stops when that says false.
  void Run(const std::function<bool()>& go_on);
  /// From any thread.
  void Stop();

 private:
  void Accept();
  void Ask(const std::function<bool()>& go_on);

  const StudioContext& context_;
  boost::asio::io_context io_;
  ProjectCalls calls_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer timer_;
  std::string host_;
  std::set<std::weak_ptr<Socket>, std::owner_less<>> sockets_;
  boost::asio::thread_pool leaving_;  // where pages that are closed end their calls
};

}  // namespace choreo::studio
