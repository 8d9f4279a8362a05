#pragma once

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "studio/studio.pb.h"

namespace choreo::studio {

using HttpResponse = boost::beast::http::response<boost::beast::http::string_body>;

/// What a browser gets for a path. `host`: by which name it came.
inline HttpResponse Get(int port, const std::string& path, const std::string& host = "127.0.0.1") {
  namespace http = boost::beast::http;
  boost::asio::io_context io;
  boost::beast::tcp_stream stream(io);
  stream.connect({boost::asio::ip::make_address("127.0.0.1"), static_cast<uint16_t>(port)});
  http::request<http::empty_body> request(http::verb::get, path, 11);
  request.set(http::field::host, host + ":" + std::to_string(port));
  http::write(stream, request);
  boost::beast::flat_buffer buffer;
  HttpResponse response;
  http::read(stream, buffer, response);
  return response;
}

/// The studio's page as its program sees it.
class Page {
 public:
  /// Throws boost::system::system_error where it is sent away.
  explicit Page(int port, const std::string& origin = "") : stream_(io_) {
    const std::string host = "127.0.0.1:" + std::to_string(port);
    stream_.next_layer().connect(
        {boost::asio::ip::make_address("127.0.0.1"), static_cast<uint16_t>(port)});
    stream_.set_option(boost::beast::websocket::stream_base::decorator(
        [&](boost::beast::websocket::request_type& request) {
          if (!origin.empty()) request.set(boost::beast::http::field::origin, origin);
        }));
    stream_.read_message_max(size_t{64} << 20);
    stream_.handshake(host, "/studio");
    stream_.binary(true);
    welcome_ = Read().welcome();
  }

  const Welcome& welcome() const { return welcome_; }

  void Say(uint32_t call, Request request) {
    request.set_call(call);
    stream_.write(boost::asio::buffer(request.SerializeAsString()));
  }
  Response Read() {
    boost::beast::flat_buffer buffer;
    stream_.read(buffer);
    Response response;
    const auto data = buffer.data();
    if (!response.ParseFromArray(data.data(), static_cast<int>(data.size())))
      throw std::runtime_error("no Response");
    return response;
  }
  /// A call with one answer.
  Response Ask(Request request) {
    Say(1, std::move(request));
    return Read();
  }

 private:
  boost::asio::io_context io_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  Welcome welcome_;
};

}  // namespace choreo::studio
