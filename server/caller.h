#pragma once

#include <grpcpp/server_context.h>

#include <string>
#include <string_view>

namespace choreo {

/// Who calls, as the log tells of it.
struct Caller {
  std::string peer;    ///< as gRPC has it: an address and a port
  std::string holder;  ///< of the token that was sent; empty without
  /// Of the W3C traceparent that was sent, in hexadecimal digits: what joins this call with what
  /// its client does. Empty without a valid one.
  std::string trace_id, span_id;
  /// Of a call that dances: 16 hexadecimal digits, which the client is told as kStreamIdHeader.
  std::string stream_id = {};

  /// Whose calls are counted together, as people are told: the token's holder, or else an address.
  std::string Party() const;
};

inline constexpr const char* kStreamIdHeader = "choreo-stream-id";
std::string FreshStreamId();

/// A peer without its port.
std::string AddressOf(const std::string& peer);

/// Everything but the holder.
Caller CallerOf(const grpc::CallbackServerContext& context);

/// The value of a header of the call; empty where it is not there exactly once.
std::string_view HeaderOf(const grpc::CallbackServerContext& context, const char* name);

}  // namespace choreo
