#pragma once

#include <memory>
#include <string>

#include "server/serving.h"

namespace choreo {

/// Serves figures for Prometheus at http://ADDRESS/metrics from construction to destruction,
/// gathered on each request. Thread-safe.
class MetricsEndpoint {
 public:
  /// HOST:PORT; port 0 takes a free one. `serving` must outlive it. Throws Error(kUnavailable,
  /// "--metrics").
  MetricsEndpoint(const std::string& address, const Serving& serving);
  ~MetricsEndpoint();

  int port() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo
