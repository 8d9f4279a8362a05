#pragma once

#include <cstdint>
#include <memory>

#include "server/held_off.h"

namespace choreo {

/// Ends connections that flood gRPC with frames (FrameMeter). gRPC 1.51 keeps headers without an
/// end, and reads all of them again with each frame. None of its settings limits this, and it
/// reports nothing. gRPC reads all bytes with recvmsg and SSL_read, so this file defines both and
/// lets them fail.

/// Watches a new connection. Call it before gRPC reads from it. `held_off` gets the address of a
/// connection that floods; it may be null. Thread-safe.
void GuardFrames(int connection, bool encrypted, std::shared_ptr<HeldOff> held_off = nullptr);
/// Connections that were ended in this process, by reason. Thread-safe.
uint64_t HeaderFloods();
uint64_t EmptyFrameFloods();
/// ResetGuard ended a connection: counts it in EmptyFrameFloods. Thread-safe.
void CountCallFlood();

}  // namespace choreo
