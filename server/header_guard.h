#pragma once

#include <cstdint>

namespace choreo {

/// Ends connections whose headers have no end. gRPC 1.51 keeps such headers without a limit, and
/// reads all of them again with each frame; none of its settings bounds this, and it tells nobody.
/// So this stands between gRPC and the system: it defines recvmsg and SSL_read, from which gRPC has
/// all bytes, and has them fail (HeaderMeter).

/// Watches a new connection. Call it before gRPC has it. Thread-safe.
void GuardHeaders(int connection, bool encrypted);
/// Connections that were ended in this process. Thread-safe.
uint64_t HeaderFloods();

}  // namespace choreo
