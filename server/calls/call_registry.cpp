#include "server/calls/call_registry.h"

#include <algorithm>

#include "model/core/text/counted.h"
#include "server/messages/refusal.h"

namespace choreo {
namespace {

constexpr double kShareOfLast = 0.1;  // weight of the latest call in the running mean
constexpr double kLongestWait = 60;
/// How long a caller counts as connected after a call: the longest retry delay that it may have
/// received.
constexpr std::chrono::seconds kThere{60};

const char* const kGoingAway = "the server is draining; try another one";

Refused Full(int calls, int most) {
  return {Refusal::kStreams, "the server is full: " + Counted(calls, "call") +
                                 (calls == 1 ? " is" : " are") + " in progress, of at most " +
                                 std::to_string(most)};
}

std::string Seconds(std::chrono::milliseconds limit) {
  const std::string text = std::to_string(std::chrono::duration<double>(limit).count());
  return text.substr(0, text.find('.') + 2) + " s";
}

}  // namespace

Error ResumeElsewhere() {
  return {ErrorCode::kUnavailable, "",
          "the server is draining; another one can resume from the last continuation"};
}

void CallRegistry::Enter(const std::shared_ptr<Call>& call, std::string caller) {
  const std::lock_guard lock(mutex_);
  if (!admitting_) throw Refused(Refusal::kDraining, kGoingAway);
  if (visits_[0].caller != caller) std::swap(visits_[0], visits_[1]);
  visits_[0] = {caller, time_.Now()};
  const auto found = of_caller_.find(caller);
  const int calls = found == of_caller_.end() ? 0 : found->second, most = MostOf(caller);
  if (calls >= most) {
    // A caller that may use all places has no limit of its own.
    if (most >= limits_.calls) throw Full(calls, limits_.calls);
    throw Refused(Refusal::kStreamsOfPeer, caller + " has " + Counted(calls, "call") +
                                               " in progress, of at most " + std::to_string(most) +
                                               " for one caller");
  }
  ++of_caller_[caller];
  calls_.emplace(call.get(), Entry{call, std::move(caller), time_.Now()});
}

void CallRegistry::Admit(const Call* call) {
  const std::lock_guard lock(mutex_);
  const auto at = calls_.find(call);
  if (!admitting_ || at == calls_.end()) throw Refused(Refusal::kDraining, kGoingAway);
  if (admitted_ >= limits_.calls) throw Full(admitted_, limits_.calls);
  at->second.admitted = true;
  at->second.since = time_.Now();
  ++admitted_;
}

void CallRegistry::Leave(const Call* call) {
  const std::lock_guard lock(mutex_);
  const auto at = calls_.find(call);
  if (at == calls_.end()) return;
  const Entry& entry = at->second;
  if (entry.admitted) {
    --admitted_;
    const double took = std::chrono::duration<double>(time_.Now() - entry.since).count();
    mean_seconds_ +=
        std::max(kShareOfLast, 1.0 / static_cast<double>(++ended_)) * (took - mean_seconds_);
    refused_ = std::max(0, refused_ - 1);
  }
  const auto others = of_caller_.find(entry.caller);
  if (--others->second == 0) of_caller_.erase(others);
  calls_.erase(at);
  if (calls_.empty()) left_.notify_all();
}

int CallRegistry::CountOf(const std::string& caller) const {
  const std::lock_guard lock(mutex_);
  const auto found = of_caller_.find(caller);
  return found == of_caller_.end() ? 0 : found->second;
}

void CallRegistry::EndIdle() {
  struct Idle {
    std::shared_ptr<Call> call;
    bool unread;
    Error error;
  };
  std::vector<Idle> idle;
  {
    const auto now = time_.Now();
    const std::lock_guard lock(mutex_);
    for (const auto& [key, entry] : calls_) {
      const auto call = entry.call.lock();
      if (!call) continue;
      if (!entry.admitted) {
        if (now - entry.since < limits_.first_message) continue;
        idle.push_back({call, false,
                        Error(ErrorCode::kDeadlineExceeded, "",
                              "no first message came within " + Seconds(limits_.first_message))});
        continue;
      }
      const CallProgress progress = call->progress();
      const auto limit = progress.unread ? limits_.unread : limits_.idle;
      if (now - std::max(progress.since, entry.since) < limit) continue;
      idle.push_back(
          {call, progress.unread,
           Error(ErrorCode::kDeadlineExceeded, "",
                 progress.unread ? "the client took no answer within " + Seconds(limit) +
                                       ", the server's limits.unread_s (--unread-seconds): read "
                                       "faster, or resume from the last continuation"
                                 : "no message came or went for " + Seconds(limit) +
                                       ", the server's limits.idle_s (--idle-seconds): a paused "
                                       "player sends its generate_until again to keep the call")});
    }
  }
  for (const Idle& one : idle) {
    one.call->End(one.error, one.unread ? Ending::kNow : Ending::kAfterCurrent);
  }
}

void CallRegistry::EndRevoked() {
  std::vector<std::shared_ptr<Call>> calls;
  {
    const std::lock_guard lock(mutex_);
    calls = Calls();
  }
  for (const auto& call : calls) call->EndIfRevoked();
}

std::vector<std::shared_ptr<Call>> CallRegistry::Calls(std::optional<bool> admitted) const {
  std::vector<std::shared_ptr<Call>> calls;
  for (const auto& [key, entry] : calls_) {
    auto call = entry.call.lock();
    if (call && entry.admitted == admitted.value_or(entry.admitted))
      calls.push_back(std::move(call));
  }
  return calls;
}

void CallRegistry::StopAdmitting() {
  std::vector<std::shared_ptr<Call>> silent;
  {
    const std::lock_guard lock(mutex_);
    admitting_ = false;
    silent = Calls(/*admitted=*/false);
  }
  for (const auto& call : silent)
    call->End(Refused(Refusal::kDraining, kGoingAway), Ending::kAfterCurrent);
}

void CallRegistry::AbortAll(const Error& error) {
  std::vector<std::shared_ptr<Call>> calls;
  {
    const std::lock_guard lock(mutex_);
    calls = Calls(/*admitted=*/true);
  }
  for (const auto& call : calls) call->End(error, Ending::kAfterCurrent);
}

void CallRegistry::GiveUpAll() {
  std::vector<std::shared_ptr<Call>> calls;
  {
    const std::lock_guard lock(mutex_);
    calls = Calls(/*admitted=*/true);
  }
  for (const auto& call : calls) call->GiveUp();
}

bool CallRegistry::WaitUntilEmpty(std::chrono::milliseconds limit) const {
  std::unique_lock lock(mutex_);
  return left_.wait_for(lock, limit, [this] { return calls_.empty(); });
}

bool CallRegistry::admitting() const {
  const std::lock_guard lock(mutex_);
  return admitting_;
}

int CallRegistry::count() const {
  const std::lock_guard lock(mutex_);
  return admitted_;
}

bool CallRegistry::HasRival(const std::string& caller) const {
  const std::lock_guard lock(mutex_);
  return IsRivalled(caller);
}

bool CallRegistry::IsRivalled(const std::string& caller) const {
  if (of_caller_.size() > (of_caller_.contains(caller) ? 1U : 0U)) return true;
  const auto now = time_.Now();
  return std::ranges::any_of(visits_, [&](const Visit& visit) {
    return !visit.caller.empty() && visit.caller != caller && now - visit.at < kThere;
  });
}

int CallRegistry::MostOf(const std::string& caller) const {
  return IsRivalled(caller) ? limits_.calls_of_caller : limits_.calls_of_lone_caller;
}

CallLimits CallRegistry::limits() const {
  const std::lock_guard lock(mutex_);
  return limits_;
}

void CallRegistry::SetLimits(const CallLimits& limits) {
  const std::lock_guard lock(mutex_);
  limits_ = limits;
}

double CallRegistry::utilisation() const {
  const std::lock_guard lock(mutex_);
  double most = static_cast<double>(admitted_) / limits_.calls;
  for (const auto& [caller, calls] : of_caller_) {
    most = std::max(most, static_cast<double>(calls) / MostOf(caller));
  }
  return most;
}

double CallRegistry::Spread(double seconds) {
  return std::min(kLongestWait,
                  std::uniform_real_distribution(1.0, 1.5)(random_) * std::max(1.0, seconds));
}

double CallRegistry::RetryAfter(double room) {
  const std::lock_guard lock(mutex_);
  const int calls = std::max(1, admitted_);
  refused_ = std::min(refused_ + 1, calls);  // bounds the delay when callers never return
  return Spread(std::max(room, mean_seconds_ * refused_ / calls));
}

double CallRegistry::RetryElsewhere() {
  const std::lock_guard lock(mutex_);
  return Spread(1);
}

}  // namespace choreo
