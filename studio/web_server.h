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

/// Serves the page over HTTP, a WebSocket at /studio with a PageSession for each page, and project
/// calls of other programs (project_calls.h) on this machine. Refuses requests that come under
/// another host name or from another site's page. The headers keep the page from sending any
/// request off this machine.
class WebServer {
 public:
  /// Listens at HOST:PORT; port 0 takes a free one. `context` must outlive it. Throws
  /// Error(kInvalidArgument) whose field is "--listen".
  WebServer(const std::string& listen, const StudioContext& context);
  ~WebServer();

  /// The address to type into a browser: "http://127.0.0.1:8765".
  std::string url() const;
  int port() const { return acceptor_.local_endpoint().port(); }

  /// Serves until Stop, or until `go_on`, polled a few times a second, returns false.
  void Run(const std::function<bool()>& go_on);
  /// Call from any thread.
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
  boost::asio::thread_pool leaving_;  // closed pages end their calls here
};

}  // namespace choreo::studio
