#include "server/connections/caller.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <utility>

#include "network/address.h"

namespace choreo {
namespace {

// "00-TRACE-SPAN-FLAGS" (W3C Trace Context); later versions may have more after it.
constexpr size_t kTraceDigits = 32, kSpanDigits = 16;
constexpr size_t kTraceAt = 3, kSpanAt = kTraceAt + kTraceDigits + 1;
constexpr size_t kStreamIdDigits = 16;
constexpr size_t kLength = kSpanAt + kSpanDigits + 3;

bool IsHexadecimal(std::string_view digits) {
  return std::ranges::all_of(
      digits, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

bool IsId(std::string_view digits) {
  return IsHexadecimal(digits) && digits.find_first_not_of('0') != std::string_view::npos;
}

bool IsTraceparent(std::string_view text) {
  const bool shaped = text.size() >= kLength && text[2] == '-' && text[kSpanAt - 1] == '-' &&
                      text[kSpanAt + kSpanDigits] == '-' &&
                      (text.size() == kLength || text[kLength] == '-');
  return shaped && !text.starts_with("ff") && IsId(text.substr(kTraceAt, kTraceDigits)) &&
         IsId(text.substr(kSpanAt, kSpanDigits));
}

}  // namespace

std::string_view HeaderOf(const grpc::CallbackServerContext& context, const char* name) {
  const auto& headers = context.client_metadata();
  if (headers.count(name) != 1) return {};
  const grpc::string_ref value = headers.find(name)->second;
  return {value.data(), value.size()};
}

std::string PeerOf(int connection) {
  sockaddr_storage peer{};
  socklen_t size = sizeof peer;
  if (getpeername(connection, reinterpret_cast<sockaddr*>(&peer), &size) != 0) return "";
  char text[INET6_ADDRSTRLEN] = "";
  if (peer.ss_family == AF_INET) {
    const auto& of = reinterpret_cast<const sockaddr_in&>(peer);
    inet_ntop(AF_INET, &of.sin_addr, text, sizeof text);
    return "ipv4:" + std::string(text) + ':' + std::to_string(ntohs(of.sin_port));
  }
  if (peer.ss_family != AF_INET6) return "";
  const auto& of = reinterpret_cast<const sockaddr_in6&>(peer);
  const std::string port = ':' + std::to_string(ntohs(of.sin6_port));
  if (IN6_IS_ADDR_V4MAPPED(&of.sin6_addr)) {
    inet_ntop(AF_INET, &of.sin6_addr.s6_addr[12], text, sizeof text);
    return "ipv4:" + std::string(text) + port;
  }
  inet_ntop(AF_INET6, &of.sin6_addr, text, sizeof text);
  return "ipv6:[" + std::string(text) + ']' + port;
}

std::string PeerOf(const grpc::ServerContextBase& call) {
  std::string peer = call.peer();
  // A scope follows a percent sign: "fe80::1%eth0".
  using Code = std::pair<const char*, const char*>;
  for (const auto& [code, sign] : {Code("%5B", "["), Code("%5D", "]"), Code("%25", "%")}) {
    if (const size_t at = peer.find(code); at != peer.npos) peer.replace(at, 3, sign);
  }
  return peer;
}

std::string AddressOf(const std::string& peer) { return SplitAddress(peer).host; }

std::string Caller::Name() const {
  return holder.empty() ? AddressOf(peer) : "holder \"" + holder + '"';
}

std::string FreshStreamId() {
  std::random_device device;
  char digits[kStreamIdDigits + 1];
  std::snprintf(digits, sizeof digits, "%08x%08x", device(), device());
  return digits;
}

bool IsStreamId(std::string_view text) {
  return text.size() == kStreamIdDigits && IsHexadecimal(text);
}

Caller CallerOf(const grpc::CallbackServerContext& context) {
  Caller caller;
  caller.peer = PeerOf(context);
  if (const auto parent = HeaderOf(context, "traceparent"); IsTraceparent(parent)) {
    caller.trace_id = parent.substr(kTraceAt, kTraceDigits);
    caller.span_id = parent.substr(kSpanAt, kSpanDigits);
  }
  return caller;
}

}  // namespace choreo
