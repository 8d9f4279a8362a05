#include "studio/socket.h"

#include <boost/asio/post.hpp>

namespace choreo::studio {
namespace {

namespace beast = boost::beast;
constexpr size_t kMaxMessageBytes = size_t{256} << 20;  // enough for a song

}  // namespace

Socket::Socket(beast::tcp_stream stream, const StudioContext& context,
               boost::asio::thread_pool* leaving)
    : stream_(std::move(stream)), context_(context), leaving_(*leaving) {}

void Socket::Start(const beast::http::request<beast::http::string_body>& request) {
  beast::get_lowest_layer(stream_).expires_never();
  stream_.set_option(beast::websocket::stream_base::timeout::suggested(beast::role_type::server));
  stream_.read_message_max(kMaxMessageBytes);
  stream_.binary(true);
  stream_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
    if (error) return;
    // Weak: messages to an ended connection are dropped.
    const std::weak_ptr<Socket> weak = self;
    self->session_ = std::make_unique<PageSession>(
        self->context_, [weak, executor = self->stream_.get_executor()](const Response& response) {
          boost::asio::post(executor, [weak, message = response.SerializeAsString()]() mutable {
            if (const auto socket = weak.lock()) socket->Queue(std::move(message));
          });
        });
    self->Read();
  });
}

void Socket::EndCalls() {
  if (session_)
    boost::asio::post(leaving_, [session = std::move(session_)]() mutable { session.reset(); });
}

void Socket::Close() {
  EndCalls();
  beast::error_code ignored;
  beast::get_lowest_layer(stream_).socket().shutdown(boost::asio::socket_base::shutdown_both,
                                                     ignored);
  beast::get_lowest_layer(stream_).close();
}

void Socket::Read() {
  stream_.async_read(received_, [self = shared_from_this()](beast::error_code error, size_t) {
    if (error || !self->session_) return self->EndCalls();
    Request request;
    const auto bytes = self->received_.data();
    const bool good = request.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
    self->received_.consume(bytes.size());
    if (!good) return self->Close();
    self->session_->Receive(std::move(request));
    self->Read();
  });
}

void Socket::Queue(std::string message) {
  unsent_.push_back(std::move(message));
  if (unsent_.size() == 1) Write();
}

void Socket::Write() {
  stream_.async_write(boost::asio::buffer(unsent_.front()),
                      [self = shared_from_this()](beast::error_code error, size_t) {
                        if (error) return;
                        self->unsent_.pop_front();
                        if (!self->unsent_.empty()) self->Write();
                      });
}

}  // namespace choreo::studio
