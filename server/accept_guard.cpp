#include "server/accept_guard.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "server/connections/caller.h"

namespace choreo {
namespace {

constexpr std::chrono::seconds kBetweenRefusalReports{60}, kBetweenSweeps{10};

const char* Reason(ConnectionRefusal refusal) {
  switch (refusal) {
    case ConnectionRefusal::kFlood:
      return "has flooded the server";
    case ConnectionRefusal::kResets:
      return "has begun more calls than can be ended";
    case ConnectionRefusal::kRate:
      break;
  }
  return "connects too often";
}

}  // namespace

bool AcceptGuard::Takes(int connection) {
  const std::string address = AddressOf(PeerOf(connection));
  const auto now = Clock::now();
  ++tally_.connections;
  ConnectionRefusal refusal = ConnectionRefusal::kRate;
  if (resets_.IsFull(connection)) {
    refusal = ConnectionRefusal::kResets;
  } else if (resets_.held_off()->Has(address)) {
    refusal = ConnectionRefusal::kFlood;
  } else if (TakesFrom(address, now)) {
    return true;
  }
  Refuse(address, refusal, now);
  return false;
}

void AcceptGuard::Refuse(const std::string& address, ConnectionRefusal why, Clock::time_point now) {
  ++tally_.refused_connections[static_cast<size_t>(why)];
  const std::lock_guard lock(mutex_);
  latest_ = address + ' ' + Reason(why);
  ++untold_;
  if (now < next_report_) return;
  next_report_ = now + kBetweenRefusalReports;
  Log();
}

void AcceptGuard::Report(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (untold_ == 0 || now < next_report_) return;
  next_report_ = now + kBetweenRefusalReports;
  Log();
}

void AcceptGuard::ReportRest() {
  const std::lock_guard lock(mutex_);
  if (untold_ > 0) Log();
}

void AcceptGuard::Log() {
  spdlog::warn("{}; {}", latest_,
               untold_ == 1 ? "its new connection is closed"
                            : "since the last such line " + std::to_string(untold_) +
                                  " new connections were closed");
  untold_ = 0;
}

bool AcceptGuard::TakesFrom(const std::string& address, Clock::time_point now) {
  if (now >= next_sweep_) {
    next_sweep_ = now + kBetweenSweeps;
    std::erase_if(paid_back_, [now](const auto& one) { return one.second <= now; });
  }
  constexpr auto kPrice = std::chrono::nanoseconds(std::chrono::seconds(1)) / kPerSecond;
  Clock::time_point& paid_back = paid_back_[address];
  const auto after = std::max(paid_back, now) + kPrice;
  if (after - now > kAtOnce * kPrice) return false;
  paid_back = after;
  return true;
}

}  // namespace choreo
