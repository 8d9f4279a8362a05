#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "network/protocol.h"

namespace choreo {

/// The parts of HOST:PORT, as written.
struct Address {
  std::string host, port;
};

/// Splits at the last colon. Without a colon, the whole text is the host.
inline Address SplitAddress(const std::string& address) {
  const size_t colon = address.rfind(':');
  if (colon == std::string::npos) return {address, ""};
  return {address.substr(0, colon), address.substr(colon + 1)};
}

/// Removes the brackets of an IPv6 address ("[::1]" -> "::1"), which getaddrinfo does not accept.
inline std::string WithoutBrackets(const std::string& host) {
  const bool has = host.size() > 1 && host.starts_with('[') && host.ends_with(']');
  return has ? host.substr(1, host.size() - 2) : host;
}

/// Whether the text consists of digits only, at least one.
inline bool IsNumber(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Parses a port: digits only, at most kMaxPort. None for anything else.
inline std::optional<int> ParsePort(const std::string& port) {
  if (!IsNumber(port) || port.size() > 5 || std::stoi(port) > kMaxPort) return std::nullopt;
  return std::stoi(port);
}

}  // namespace choreo
