#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace choreo {

/// A few threads for work too long for gRPC's threads, such as decoding files or analysing minutes
/// of music. A call has at most one task here at a time, so the queue is bounded. Thread-safe.
class TaskPool {
 public:
  explicit TaskPool(int threads);
  ~TaskPool();  ///< Runs all queued tasks, then joins the threads.

  /// Queues a task, which must not throw.
  void Post(std::function<void()> task);

 private:
  void Work();

  std::mutex mutex_;
  std::condition_variable ready_;
  std::deque<std::function<void()>> tasks_;  // guarded by mutex_
  bool stopping_ = false;                    // guarded by mutex_
  std::vector<std::thread> threads_;
};

}  // namespace choreo
