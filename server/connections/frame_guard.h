#pragma once

#include <cstdint>
#include <memory>

#include "server/connections/held_off.h"

namespace choreo {

/// Ends connections that flood gRPC with frames (FrameMeter). gRPC 1.51 stores headers without a
/// limit and rereads all of them with each frame. None of its settings limits this, and it reports
/// nothing. gRPC reads all bytes with recvmsg and SSL_read, so frame_guard.cpp replaces both and
/// makes them fail. It also counts clients that leave in the TLS handshake (CountClientLeft).

/// Watches a new connection. Call it before gRPC reads from the connection. Adds the address of a
/// flooding connection to `held_off`, which may be null. Thread-safe.
void GuardFrames(int connection, bool encrypted, std::shared_ptr<HeldOff> held_off = nullptr);
/// The number of connections ended in this process, by reason. Thread-safe.
uint64_t HeaderFloods();
uint64_t EmptyFrameFloods();
/// Counts a connection that ResetGuard ended, in EmptyFrameFloods. Thread-safe.
void CountCallFlood();

}  // namespace choreo
