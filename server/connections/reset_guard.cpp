#include "server/connections/reset_guard.h"

#include <fcntl.h>
#include <grpcpp/support/server_interceptor.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "server/connections/caller.h"
#include "server/connections/frame_guard.h"

namespace choreo {
namespace {

using grpc::experimental::Interceptor;

// Ends a connection. gRPC owns the descriptor, notices the end, and closes it. Drops unread data,
// which shutdown() would not.
void End(const std::string& peer) try {
  const sockaddr nobody{.sa_family = AF_UNSPEC, .sa_data = {}};
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int descriptor = std::stoi(entry.path().filename().string());
    // Listening sockets have no peer.
    if (PeerOf(descriptor) != peer) continue;
    // gRPC may close the descriptor and its number may be reused meanwhile; a copy stays with one
    // connection.
    const int copy = fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    if (PeerOf(copy) == peer) connect(copy, &nobody, sizeof nobody);
    if (copy >= 0) close(copy);
  }
} catch (const std::exception& error) {  // such as when descriptors run out
  spdlog::error("{}: {}", peer, error.what());
}

/// Exists as long as its call.
class Counted final : public Interceptor {
 public:
  Counted(ResetGuard& guard, std::string peer) : guard_(guard), peer_(std::move(peer)) {
    guard_.Enter(peer_);
  }
  ~Counted() override { guard_.Leave(peer_); }
  void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
    methods->Proceed();
  }

 private:
  ResetGuard& guard_;
  const std::string peer_;
};

class MakeCounted final : public grpc::experimental::ServerInterceptorFactoryInterface {
 public:
  explicit MakeCounted(ResetGuard& guard) : guard_(guard) {}
  Interceptor* CreateServerInterceptor(grpc::experimental::ServerRpcInfo* call) override {
    return new Counted(guard_, PeerOf(*call->server_context()));
  }

 private:
  ResetGuard& guard_;
};

}  // namespace

void ResetGuard::Watch(grpc::ServerBuilder* builder) {
  std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> makers;
  makers.push_back(std::make_unique<MakeCounted>(*this));
  builder->experimental().SetInterceptorCreators(std::move(makers));
}

bool ResetGuard::IsFull(int connection) const {
  const std::string address = AddressOf(PeerOf(connection)) + ':';
  const std::lock_guard lock(mutex_);
  for (auto at = connections_.lower_bound(address);
       at != connections_.end() && at->first.starts_with(address); ++at) {
    if (at->second.closed) return true;
  }
  return false;
}

void ResetGuard::Enter(const std::string& peer) {
  // Calls to gRPC's own services have no peer, and are not counted.
  if (peer.empty()) return;
  if (on_call_) on_call_(peer);
  {
    const std::lock_guard lock(mutex_);
    Connection& connection = connections_[peer];
    if (++connection.calls <= most_ || std::exchange(connection.closed, true)) return;
  }
  held_off_->Add(AddressOf(peer));
  CountCallFlood();
  spdlog::warn("{} has begun more calls than can be ended; its connection is closed", peer);
  End(peer);
}

void ResetGuard::Leave(const std::string& peer) {
  const std::lock_guard lock(mutex_);
  const auto at = connections_.find(peer);
  if (at != connections_.end() && --at->second.calls == 0) connections_.erase(at);
}

}  // namespace choreo
