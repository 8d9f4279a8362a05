#include "server/connection_limits.h"

#include <grpc/compression.h>
#include <grpcpp/resource_quota.h>

#include "server/messages/read_message.h"

namespace choreo {
namespace {

/// Calls per connection in addition to max_streams. They allow health checks, and let a full server
/// refuse calls. Further calls wait at the client.
constexpr int kSpareCalls = 100;
/// The threads of gRPC's reflection, which takes one for each call. Calls beyond are refused
/// (RESOURCE_EXHAUSTED), so that strangers leave the process threads.
constexpr int kReflectionThreads = 8;
/// The time limit for a new connection's TLS handshake and HTTP/2 settings.
constexpr int kHandshakeMs = 5'000;
/// The time after which a connection without calls is closed. Clients reconnect when they need to.
constexpr int kIdleMs = 300'000;

}  // namespace

int CallsOfConnection(const ServerConfig& config) { return config.max_streams + kSpareCalls; }

void LimitConnections(const ServerConfig& config, grpc::ServerBuilder* builder) {
  builder->SetMaxReceiveMessageSize(static_cast<int>(kMaxMessageBytes));
  builder->SetResourceQuota(grpc::ResourceQuota("choreod")
                                .Resize(static_cast<size_t>(config.max_network_mib) << 20)
                                .SetMaxThreads(kReflectionThreads));
  builder->AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, CallsOfConnection(config));
  builder->AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, kHandshakeMs);
  builder->AddChannelArgument(GRPC_ARG_MAX_CONNECTION_IDLE_MS, kIdleMs);
  // The first argument refuses calls that announce compression; the second ensures that nothing is
  // decompressed.
  builder->AddChannelArgument(GRPC_COMPRESSION_CHANNEL_ENABLED_ALGORITHMS_BITSET,
                              1 << GRPC_COMPRESS_NONE);
  builder->AddChannelArgument(GRPC_ARG_ENABLE_PER_MESSAGE_DECOMPRESSION, 0);
}

}  // namespace choreo
