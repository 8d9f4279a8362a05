#pragma once

#include <cstdint>
#include <memory>

#include "server/held_off.h"

namespace choreo {

/// Ends connections that flood gRPC with what it does not bound (FrameMeter): gRPC 1.51 keeps
/// headers without an end, and reads all of them again with each frame; none of its settings bounds
/// this, and it tells nobody. So this stands between gRPC and the system: it defines recvmsg and
/// SSL_read, from which gRPC has all bytes, and has them fail.

/// Watches a new connection. Call it before gRPC has it. `held_off`: told the address of one that
/// floods; may be null. Thread-safe.
void GuardFrames(int connection, bool encrypted, std::shared_ptr<HeldOff> held_off = nullptr);
/// Connections that were ended in this process, by reason. Thread-safe.
uint64_t HeaderFloods();
uint64_t EmptyFrameFloods();
/// Counts a connection that ResetGuard has ended among the latter. Thread-safe.
void CountCallFlood();

}  // namespace choreo
