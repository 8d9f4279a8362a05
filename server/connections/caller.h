#pragma once

#include <grpcpp/server_context.h>

#include <string>
#include <string_view>

namespace choreo {

/// Who made a call, for the log.
struct Caller {
  std::string peer;    ///< an address and a port
  std::string holder;  ///< its token's holder; empty without a token
  /// Hexadecimal ids from the call's W3C traceparent header, which link the call to the client's
  /// trace. Empty without a valid header.
  std::string trace_id, span_id;
  /// Identifies a call that dances. 16 hexadecimal digits, sent to the client as kStreamIdHeader.
  std::string stream_id = {};
  /// The stream_id of the call in which the dance began, as stated by the client in
  /// kResumedFromHeader. Sent back to the client.
  std::string resumed_from = {};

  /// Calls with the same Party are counted together: the token's holder or, without one, the
  /// address.
  std::string Name() const;
};

inline constexpr const char* kStreamIdHeader = "choreo-stream-id";
inline constexpr const char* kResumedFromHeader = "choreo-resumed-from";
std::string FreshStreamId();
bool IsStreamId(std::string_view text);

/// A connection's peer, an address and a port as in "ipv6:[::1]:60092"; empty for other
/// descriptors.
std::string PeerOf(int connection);
/// A call's peer, in the form of a connection's peer. gRPC itself writes %5B and %5D for the
/// brackets.
std::string PeerOf(const grpc::ServerContextBase& call);

/// A peer without its port.
std::string AddressOf(const std::string& peer);

/// The caller of a call, without the holder.
Caller CallerOf(const grpc::CallbackServerContext& context);

/// The value of a header; empty unless it exists exactly once.
std::string_view HeaderOf(const grpc::CallbackServerContext& context, const char* name);

}  // namespace choreo
