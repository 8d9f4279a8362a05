#pragma once

#include <spdlog/spdlog.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace choreo {

/// A thread that calls `action` every `interval`, from construction to destruction. Logs
/// exceptions, such as a momentary lack of memory, and continues.
class PeriodicThread {
 public:
  PeriodicThread(std::chrono::milliseconds interval, std::function<void()> action)
      : thread_([this, interval, action = std::move(action)](const std::stop_token& stop) {
          std::unique_lock lock(mutex_);
          while (!wake_.wait_for(lock, stop, interval, [&] { return stop.stop_requested(); })) {
            try {
              action();
            } catch (const std::exception& error) {
              spdlog::error("a look at calls and engines failed: {}", error.what());
            }
          }
        }) {}

 private:
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  // last, because it uses the members above
};

}  // namespace choreo
