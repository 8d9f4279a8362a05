#include "server/call_registry.h"

#include <string>
#include <vector>

namespace choreo {

void CallRegistry::Enter(const std::shared_ptr<Call>& call) {
  const std::lock_guard lock(mutex_);
  if (!admitting_) {
    throw Error(ErrorCode::kUnavailable, "", "the server is going away; try another one");
  }
  if (static_cast<int>(calls_.size()) >= max_calls_) {
    ++refused_;
    throw Error(ErrorCode::kResourceExhausted, "",
                "the server is full: " + std::to_string(calls_.size()) +
                    " calls are in progress, of at most " + std::to_string(max_calls_));
  }
  calls_.emplace(call.get(), call);
  ++total_;
}

void CallRegistry::Leave(const Call* call) {
  const std::lock_guard lock(mutex_);
  calls_.erase(call);
  if (calls_.empty()) left_.notify_all();
}

void CallRegistry::StopAdmitting() {
  const std::lock_guard lock(mutex_);
  admitting_ = false;
}

void CallRegistry::AbortAll(const Error& error) {
  std::vector<std::shared_ptr<Call>> calls;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [key, call] : calls_) {
      if (auto alive = call.lock()) calls.push_back(std::move(alive));
    }
  }
  for (const auto& call : calls) call->Abort(error);
}

bool CallRegistry::WaitUntilEmpty(std::chrono::milliseconds limit) const {
  std::unique_lock lock(mutex_);
  return left_.wait_for(lock, limit, [this] { return calls_.empty(); });
}

int CallRegistry::count() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(calls_.size());
}

uint64_t CallRegistry::total() const {
  const std::lock_guard lock(mutex_);
  return total_;
}

uint64_t CallRegistry::refused() const {
  const std::lock_guard lock(mutex_);
  return refused_;
}

}  // namespace choreo
