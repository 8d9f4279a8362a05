#include "studio/web_server.h"

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/post.hpp>
#include <chrono>
#include <optional>

#include "model/core/error.h"
#include "network/address.h"
#include "network/protocol.h"
#include "studio/page.h"
#include "studio/socket.h"

namespace choreo::studio {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using tcp = boost::asio::ip::tcp;

constexpr int kLeaveAtOnce = 4;  // closing pages that are handled concurrently
constexpr std::chrono::milliseconds kAskEvery{100};
constexpr std::chrono::seconds kPatience{30};       // for a request
constexpr size_t kMaxBodyBytes = size_t{64} << 20;  // for a project with its song
constexpr const char* kSocketPath = "/studio";
constexpr std::string_view kPhotoPath = "/photo/";
// Browsers enforce this policy for everything that the page loads.
constexpr const char* kPolicy =
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; "
    "media-src 'self' blob:; connect-src 'self' blob:; frame-ancestors 'none'";

Address ParseAddress(const std::string& listen) {
  Address address = SplitAddress(listen);
  if (address.host.empty() || !ParsePort(address.port)) {
    throw InvalidArgument("--listen", "\"" + listen + "\" is not HOST:PORT with a port from 0 to " +
                                          std::to_string(kMaxPort));
  }
  address.host = WithoutBrackets(address.host);
  return address;
}

/// One connection until it becomes a WebSocket or ends.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  using Upgrade = std::function<void(beast::tcp_stream, const http::request<http::string_body>&)>;

  Connection(tcp::socket socket, std::string host, const PhotoModel& photo_model,
             ProjectCalls* calls, Upgrade upgrade)
      : stream_(std::move(socket)),
        host_(std::move(host)),
        photo_model_(photo_model),
        calls_(*calls),
        upgrade_(std::move(upgrade)) {}

  void Read() {
    parser_.emplace();
    parser_->body_limit(kMaxBodyBytes);
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, size_t) {
                       if (error == http::error::body_limit) return self->RefuseBody();
                       if (error) return;
                       self->request_ = self->parser_->release();
                       self->Answer();
                     });
  }

 private:
  /// Checks the host name in the browser's request: anybody can point another name here.
  bool NamesOurHost() const {
    const std::string host(request_[http::field::host]);
    const std::string name = SplitAddress(host).host;
    return name == "localhost" || name == "127.0.0.1" || name == "[::1]" || name == host_;
  }
  bool FromOurPage() const {
    const std::string origin(request_[http::field::origin]);
    return origin.empty() || origin == "http://" + std::string(request_[http::field::host]);
  }

  void Answer() {
    if (!NamesOurHost() || !FromOurPage())
      return Say(http::status::forbidden, "text/plain", "The studio is for its own page.\n");
    if (beast::websocket::is_upgrade(request_)) {
      if (request_.target() != kSocketPath)
        return Say(http::status::not_found, "text/plain", "No WebSocket here.\n");
      return upgrade_(std::move(stream_), request_);
    }
    const std::string target(request_.target());
    const std::string path = target.substr(0, target.find('?'));
    if (path == "/dance") return Dance(target);
    if (request_.method() != http::verb::get && request_.method() != http::verb::head)
      return Say(http::status::method_not_allowed, "text/plain", "GET alone.\n");
    if (path == "/model") return Say(calls_.Model());
    if (path.starts_with(kPhotoPath)) {
      if (const auto part = photo_model_.Read(path.substr(kPhotoPath.size())))
        return Say(http::status::ok, part->type, part->data);
    }
    const PageFile* file = FindPageFile(path);
    if (!file) return Say(http::status::not_found, "text/plain", "No such page.\n");
    Say(http::status::ok, file->type, file->data);
  }

  /// Dances a project while this connection waits.
  void Dance(const std::string& target) {
    beast::error_code error;
    const bool is_near = stream_.socket().remote_endpoint(error).address().is_loopback();
    if (error || !is_near)
      return Say(ProjectCalls::Refuse(403, "only this machine may dance projects"));
    if (request_.method() != http::verb::post)
      return Say(ProjectCalls::Refuse(405, "POST a project"));
    // Pages from elsewhere cannot send this type without a preflight.
    if (!request_[http::field::content_type].starts_with("application/json"))
      return Say(ProjectCalls::Refuse(415, "Content-Type must be application/json"));
    const std::string query = target.substr(std::min(target.find('?'), target.size()));
    if (!query.empty() && query != "?as=bvh" && query != "?as=json")
      return Say(ProjectCalls::Refuse(400, "as: must be json or bvh"));
    stream_.expires_never();
    calls_.Dance(std::move(request_.body()), query == "?as=bvh",
                 [self = shared_from_this()](ProjectCalls::Reply reply) {
                   boost::asio::post(self->stream_.get_executor(),
                                     [self, reply = std::move(reply)] {
                                       self->stream_.expires_after(kPatience);
                                       self->Say(reply);
                                     });
                 });
  }

  /// Bytes after an unread body could be taken for another request.
  void RefuseBody() {
    request_ = {};
    request_.keep_alive(false);
    Say(ProjectCalls::Refuse(
        413, "project: is larger than " + std::to_string(kMaxBodyBytes) + " bytes"));
  }

  void Say(const ProjectCalls::Reply& reply) {
    Say(http::int_to_status(reply.status), reply.type, reply.body);
  }

  void Say(http::status status, std::string_view type, std::string_view text) {
    auto response = std::make_shared<http::response<http::string_body>>(status, request_.version());
    response->set(http::field::content_type, beast::string_view(type.data(), type.size()));
    response->set(http::field::cache_control, "no-cache");
    response->set("Content-Security-Policy", kPolicy);
    response->set("X-Content-Type-Options", "nosniff");
    response->keep_alive(request_.keep_alive());
    if (request_.method() != http::verb::head) response->body() = text;
    response->prepare_payload();
    http::async_write(stream_, *response,
                      [self = shared_from_this(), response](beast::error_code error, size_t) {
                        if (!error && response->keep_alive()) self->Read();
                      });
  }

  beast::tcp_stream stream_;
  const std::string host_;
  const PhotoModel& photo_model_;
  ProjectCalls& calls_;
  const Upgrade upgrade_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::request<http::string_body> request_;
};

}  // namespace

WebServer::WebServer(const std::string& listen, const StudioContext& context)
    : context_(context), calls_(context), acceptor_(io_), timer_(io_), leaving_(kLeaveAtOnce) {
  const Address address = ParseAddress(listen);
  host_ = address.host;
  try {
    const tcp::endpoint endpoint = *tcp::resolver(io_).resolve(address.host, address.port).begin();
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(tcp::acceptor::reuse_address(true));
    acceptor_.bind(endpoint);
    acceptor_.listen();
  } catch (const boost::system::system_error& error) {
    throw InvalidArgument("--listen", listen + ": " + error.code().message());
  }
}

WebServer::~WebServer() {
  for (const auto& weak : sockets_)
    if (const auto socket = weak.lock()) socket->Close();
  leaving_.join();  // while io_ exists, because they answer through it
}

std::string WebServer::url() const {
  const bool is_v6 = host_.find(':') != std::string::npos;
  return "http://" + (is_v6 ? "[" + host_ + "]" : host_) + ":" + std::to_string(port());
}

void WebServer::Run(const std::function<bool()>& go_on) {
  Accept();
  Ask(go_on);
  io_.run();
}

void WebServer::Stop() { io_.stop(); }

void WebServer::Ask(const std::function<bool()>& go_on) {
  timer_.expires_after(kAskEvery);
  timer_.async_wait([this, &go_on](beast::error_code error) {
    if (error) return;
    std::erase_if(sockets_, [](const auto& weak) { return weak.expired(); });
    go_on() ? Ask(go_on) : Stop();
  });
}

void WebServer::Accept() {
  acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (!error) {
      std::make_shared<Connection>(
          std::move(socket), host_, context_.photo_model(), &calls_,
          [this](beast::tcp_stream stream, const http::request<http::string_body>& request) {
            const auto page = std::make_shared<Socket>(std::move(stream), context_, &leaving_);
            sockets_.insert(page);
            page->Start(request);
          })
          ->Read();
    }
    Accept();
  });
}

}  // namespace choreo::studio
