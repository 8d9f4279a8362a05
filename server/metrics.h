#pragma once

#include <memory>
#include <string>

#include "server/calls/serving.h"

namespace choreo {

/// Serves Prometheus metrics at http://ADDRESS/metrics, from construction to destruction. Gathers
/// them on each request. Thread-safe.
class MetricsEndpoint {
 public:
  /// `address`: HOST:PORT; port 0 picks a free port. `serving` must outlive this object. Throws
  /// Error(kUnavailable, "--metrics").
  MetricsEndpoint(const std::string& address, const Serving& serving);
  ~MetricsEndpoint();

  int port() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo
