#pragma once

#include <string>

namespace choreo {

/// Reports the process's state to the service manager, such as systemd, by sd_notify(3)'s protocol:
/// one datagram to the socket named by $NOTIFY_SOCKET. `state`: lines such as "READY=1". Does
/// nothing without that variable, and logs a warning if sending fails. Thread-safe.
void TellManager(const std::string& state);

/// Reports that a reread begins. TellManager("READY=1") ends it.
void TellManagerOfReload();

/// Reports that the server drains, and asks for the time that this takes. systemd would otherwise
/// kill it after TimeoutStopSec=.
void TellManagerOfDrain(double seconds);

/// Reports that the process is alive, four times per $WATCHDOG_USEC, if that is set. Call more
/// often than that, on one thread at a time, from code that stops when the server hangs.
void TellManagerOfLife();

}  // namespace choreo
