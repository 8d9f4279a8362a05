#pragma once

#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <memory>
#include <string>

#include "studio/page_session.h"

namespace choreo::studio {

/// One page's WebSocket. Reads and writes on its server's thread; the session's answers from other
/// threads are queued.
class Socket : public std::enable_shared_from_this<Socket> {
 public:
  /// Sessions end on `leaving`, because their last calls may take long while other pages are
  /// served.
  Socket(boost::beast::tcp_stream stream, const StudioContext& context,
         boost::asio::thread_pool* leaving);

  /// Upgrades the connection from HTTP.
  void Start(const boost::beast::http::request<boost::beast::http::string_body>& request);
  /// Ends all calls and the connection. Call on the server's thread.
  void Close();

 private:
  void Read();
  void EndCalls();
  void Queue(std::string message);
  void Write();

  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  const StudioContext& context_;
  boost::asio::thread_pool& leaving_;
  boost::beast::flat_buffer received_;
  std::deque<std::string> unsent_;
  std::unique_ptr<PageSession> session_;
};

}  // namespace choreo::studio
