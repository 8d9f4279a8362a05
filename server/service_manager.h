#pragma once

#include <string>

namespace choreo {

/// Tells the manager that started the process, such as systemd, its state by sd_notify(3)'s
/// protocol: one datagram to the socket that $NOTIFY_SOCKET names. `state`: lines such as
/// "READY=1". Does nothing without that variable; logs a warning if the manager cannot be told.
/// Thread-safe.
void TellManager(const std::string& state);

/// TellManager that a reread begins; "READY=1" ends it.
void TellManagerOfReload();

/// TellManager that the process lives, where $WATCHDOG_USEC asks for it: four times in that time.
/// Call regularly, more often than that, from what stops when the server hangs; on one thread at a
/// time.
void TellManagerOfLife();

}  // namespace choreo
