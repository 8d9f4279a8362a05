#include "model/engine/sample_queue.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "model/core/running/threads.h"
#include "model/engine/sampling_cost.h"

namespace choreo {
namespace {

using Clock = std::chrono::steady_clock;

double Seconds(Clock::duration time) { return std::chrono::duration<double>(time).count(); }
double Seconds(Clock::time_point time) { return Seconds(time.time_since_epoch()); }

// The exception being handled, as an Error. Call inside a catch block.
Error CurrentError() {
  try {
    throw;
  } catch (const Error& error) {
    return error;
  } catch (const std::exception& error) {
    return Error(ErrorCode::kInternal, "", error.what());
  } catch (...) {
    return Error(ErrorCode::kInternal, "", "unknown exception");
  }
}

}  // namespace

// One mutex guards the queue's state. It is never held during calls to jobs, except Cancelled.
struct SampleQueue::Impl {
  /// Orders jobs by when they are due, in seconds, and then by submission.
  using Due = std::pair<double, uint64_t>;

  /// A job from its submission until its OnDone.
  struct Entry {
    std::shared_ptr<SampleJob> job;
    bool is_bulk;
    Due due;           ///< of bulk: 0, as it has no listener
    double submitted;  ///< seconds
    double taken = 0;  ///< seconds that its slices have taken so far
  };
  using Entries = std::vector<std::unique_ptr<Entry>>;

  /// Jobs ordered by when they are due.
  class Line {
   public:
    size_t size() const { return dances_.size() + bulk_.size(); }
    void Add(std::unique_ptr<Entry> entry) {
      auto& kind = entry->is_bulk ? bulk_ : dances_;
      const Due due = entry->due;
      kind.emplace(due, std::move(entry));
    }
    /// The first one, and when it is due, if bulk is due at `bulk_due`; null without any.
    std::pair<Due, Entry*> First(double bulk_due) const {
      std::pair<Due, Entry*> first = {{}, nullptr};
      if (!dances_.empty()) first = {dances_.begin()->first, dances_.begin()->second.get()};
      if (bulk_.empty()) return first;
      const Due due = {bulk_due, bulk_.begin()->first.second};
      if (first.second == nullptr || due < first.first) return {due, bulk_.begin()->second.get()};
      return first;
    }
    std::unique_ptr<Entry> Take(const Entry& entry) {
      auto& kind = entry.is_bulk ? bulk_ : dances_;
      return std::move(kind.extract(entry.due).mapped());
    }
    /// Removes and returns all jobs that `chosen` selects.
    Entries TakeAll(const auto& chosen) {
      Entries all;
      for (auto* kind : {&dances_, &bulk_}) {
        for (auto at = kind->begin(); at != kind->end();) {
          const auto next = std::next(at);
          if (chosen(*at->second)) all.push_back(std::move(kind->extract(at).mapped()));
          at = next;
        }
      }
      return all;
    }

   private:
    std::map<Due, std::unique_ptr<Entry>> dances_, bulk_;
  };

  /// The amount of reserved bulk. Shared with reservations, which may outlive the queue.
  struct Bulk {
    std::mutex mutex;
    int reserved = 0;  ///< Lock: mutex
  };

  /// One sampler, and the only thread that uses it.
  struct Worker {
    explicit Worker(std::unique_ptr<Sampler> one)
        : sampler(std::move(one)), cost(sampler->seconds_a_frame()) {}

    const std::unique_ptr<Sampler> sampler;
    SamplingCost cost;
    std::thread thread;
    Line begun;          ///< Lock: mutex
    bool looks = false;  ///< it must look for cancelled jobs next. Lock: mutex
    std::atomic<int> failures_in_a_row = 0;
  };

  Options options;
  std::vector<std::unique_ptr<Worker>> workers;
  const std::shared_ptr<Bulk> bulk = std::make_shared<Bulk>();

  mutable std::mutex mutex;
  std::condition_variable work;          ///< wakes workers
  mutable std::condition_variable idle;  ///< signalled when `live` becomes 0
  Line waiting;                          ///< Lock: mutex
  size_t live = 0;                       ///< waiting, begun, and inside OnDone. Lock: mutex
  uint64_t submitted = 0;                ///< Lock: mutex
  bool stopped = false;                  ///< Lock: mutex
  bool exit = false;                     ///< ends workers, after `stopped`. Lock: mutex

  std::atomic<uint64_t> frames = 0, transitions = 0;
  std::atomic<double> cpu_seconds = 0;
  Histogram slice_seconds{Histogram::Seconds()};
  Histogram transition_seconds{Histogram::Seconds()};
  Histogram lateness_seconds{Histogram::Seconds()};

  void Accept(std::shared_ptr<SampleJob> job, bool is_bulk);

  // The caller holds the lock; these functions release it while they call jobs.
  using Lock = std::unique_lock<std::mutex>;
  void Run(Worker* worker);
  Entry* Next(Worker* worker);
  void MakeSlice(Worker* worker, Entry* entry, Lock& lock);
  void End(std::unique_ptr<Entry> entry, const Error* failure, Lock& lock);
  void EndAll(Worker* worker, const Error& failure, Lock& lock);
};

// ---- Calls of clients ---------------------------------------------------------------------------

void SampleQueue::Impl::Accept(std::shared_ptr<SampleJob> job, bool is_bulk) {
  if (job == nullptr) throw InvalidArgument("job", "is null");
  auto entry = std::make_unique<Entry>();
  const double deadline = is_bulk ? 0 : job->Deadline();
  *entry = {.job = std::move(job),
            .is_bulk = is_bulk,
            .due = {std::isnan(deadline) ? std::numeric_limits<double>::infinity() : deadline, 0},
            .submitted = Seconds(Clock::now())};
  const std::lock_guard lock(mutex);
  if (stopped) throw Error(ErrorCode::kUnavailable, "", "the queue takes no new jobs");
  entry->due.second = submitted++;
  waiting.Add(std::move(entry));
  ++live;
  work.notify_one();
}

// ---- One worker ---------------------------------------------------------------------------------

void SampleQueue::Impl::Run(Worker* worker) {
  FlushDenormals();
  Lock lock(mutex);
  for (;;) {
    if (stopped) EndAll(worker, Error(ErrorCode::kUnavailable, "", "the queue is stopped"), lock);
    if (std::exchange(worker->looks, false)) {
      EndAll(worker, Error(ErrorCode::kCancelled, "", "cancelled"), lock);
    } else if (Entry* next = Next(worker)) {
      MakeSlice(worker, next, lock);
    } else if (exit) {
      return;
    } else {
      work.wait(lock);
    }
  }
}

// The job that is due first among the worker's begun jobs and the waiting jobs; null if there is
// none. The worker begins a waiting job.
SampleQueue::Impl::Entry* SampleQueue::Impl::Next(Worker* worker) {
  // Bulk has no playback, so it is due after all dances that need frames within bulk_yields.
  const double bulk_due = Seconds(Clock::now()) + Seconds(options.bulk_yields);
  const auto [mine_due, mine] = worker->begun.First(bulk_due);
  const auto [fresh_due, fresh] = waiting.First(bulk_due);
  if (fresh == nullptr || (mine != nullptr && mine_due < fresh_due)) return mine;
  worker->begun.Add(waiting.Take(*fresh));
  return fresh;
}

void SampleQueue::Impl::MakeSlice(Worker* worker, Entry* entry, Lock& lock) {
  lock.unlock();
  std::optional<Error> failure;
  bool more = false;
  const Clock::time_point begin = Clock::now();
  const double cpu_begin = ThreadCpuSeconds();
  if (entry->job->Cancelled()) {
    failure.emplace(ErrorCode::kCancelled, "", "cancelled");
  } else {
    try {
      more = entry->job->Continue(*worker->sampler);
    } catch (...) {
      failure = CurrentError();
      // kInternal is the sampler's failure; with any other code the job itself was at fault.
      if (failure->code() == ErrorCode::kInternal) worker->failures_in_a_row.fetch_add(1);
    }
    const double took = Seconds(Clock::now() - begin);
    cpu_seconds += ThreadCpuSeconds() - cpu_begin;
    entry->taken += took;
    slice_seconds.Add(took);
  }
  const int made = entry->job->frames();
  if (!more && !failure && made > 0) {
    worker->failures_in_a_row = 0;
    worker->cost.Add(entry->taken, made);
    transition_seconds.Add(entry->taken);
    frames += static_cast<uint64_t>(made);
    ++transitions;
    if (!entry->is_bulk) {
      const double due = std::max(entry->due.first, entry->submitted);
      lateness_seconds.Add(std::max(0.0, Seconds(Clock::now()) - due));
    }
  }
  lock.lock();
  if (more) return;
  End(worker->begun.Take(*entry), failure ? &*failure : nullptr, lock);
}

void SampleQueue::Impl::End(std::unique_ptr<Entry> entry, const Error* failure, Lock& lock) {
  lock.unlock();
  entry->job->OnDone(failure);
  entry.reset();
  lock.lock();
  if (--live == 0) idle.notify_all();
}

void SampleQueue::Impl::EndAll(Worker* worker, const Error& failure, Lock& lock) {
  const auto ends = [&](const Entry& entry) {
    return failure.code() == ErrorCode::kUnavailable || entry.job->Cancelled();
  };
  for (Line* line : {&worker->begun, &waiting}) {
    for (std::unique_ptr<Entry>& entry : line->TakeAll(ends)) End(std::move(entry), &failure, lock);
  }
}

// ---- SampleQueue --------------------------------------------------------------------------------

SampleQueue::SampleQueue(std::vector<std::unique_ptr<Sampler>> samplers, Options options)
    : impl_(std::make_unique<Impl>()) {
  if (samplers.empty()) throw InvalidArgument("samplers", "is empty; at least 1 is needed");
  const auto check = [](const char* field, int64_t value) {
    if (value < 0) throw InvalidArgument(field, std::to_string(value) + " is below 0");
  };
  check("max_bulk", options.max_bulk);
  check("bulk_yields", options.bulk_yields.count());
  impl_->options = options;
  const std::string fingerprint = samplers[0]->model().fingerprint;
  for (size_t i = 0; i < samplers.size(); ++i) {
    const std::string& other = samplers[i]->model().fingerprint;
    if (other != fingerprint) {
      throw InvalidArgument("samplers[" + std::to_string(i) + "]",
                            "its fingerprint " + other + " is not " + fingerprint);
    }
    impl_->workers.push_back(std::make_unique<Impl::Worker>(std::move(samplers[i])));
  }
  for (const auto& worker : impl_->workers)
    worker->thread = std::thread([this, one = worker.get()] { impl_->Run(one); });
}

SampleQueue::~SampleQueue() {
  Stop();
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->exit = true;
    impl_->work.notify_all();
  }
  for (const auto& worker : impl_->workers) worker->thread.join();
}

void SampleQueue::Submit(std::shared_ptr<SampleJob> job) { impl_->Accept(std::move(job), false); }

void SampleQueue::SubmitBulk(std::shared_ptr<SampleJob> job) {
  impl_->Accept(std::move(job), true);
}

SampleQueue::Reservation SampleQueue::ReserveBulk(int transitions) {
  const std::shared_ptr<Impl::Bulk> bulk = impl_->bulk;
  const int most = impl_->options.max_bulk;
  const std::lock_guard lock(bulk->mutex);
  if (bulk->reserved + transitions > most) {
    throw Error(
        ErrorCode::kResourceExhausted, "",
        std::to_string(bulk->reserved) + " transitions are in progress or wait already; with " +
            std::to_string(transitions) + " more there would be more than " + std::to_string(most));
  }
  Reservation reservation(nullptr, [bulk, transitions](void*) {
    const std::lock_guard again(bulk->mutex);
    bulk->reserved -= transitions;
  });
  bulk->reserved += transitions;
  return reservation;
}

void SampleQueue::CheckCancelled() {
  const std::lock_guard lock(impl_->mutex);
  for (const auto& worker : impl_->workers) worker->looks = true;
  impl_->work.notify_all();
}

void SampleQueue::Stop() noexcept {
  const std::lock_guard lock(impl_->mutex);
  impl_->stopped = true;
  impl_->work.notify_all();
}

bool SampleQueue::WaitUntilIdle(std::chrono::milliseconds limit) const {
  std::unique_lock lock(impl_->mutex);
  return impl_->idle.wait_for(lock, limit, [this] { return impl_->live == 0; });
}

const ModelInfo& SampleQueue::model() const { return impl_->workers.front()->sampler->model(); }

std::vector<std::string> SampleQueue::devices() const {
  std::vector<std::string> devices;
  for (const auto& worker : impl_->workers) devices.push_back(worker->sampler->device());
  return devices;
}

SampleQueue::Stats SampleQueue::stats() const {
  Stats stats{.workers = static_cast<int>(impl_->workers.size()),
              .frames = impl_->frames,
              .transitions = impl_->transitions,
              .cpu_seconds = impl_->cpu_seconds};
  if (impl_->options.max_bulk > 0) {
    const std::lock_guard lock(impl_->bulk->mutex);
    stats.bulk_share = double(impl_->bulk->reserved) / impl_->options.max_bulk;
  }
  const std::lock_guard lock(impl_->mutex);
  stats.waiting = static_cast<int>(impl_->waiting.size());
  for (const auto& worker : impl_->workers) {
    stats.active += static_cast<int>(worker->begun.size());
    stats.failures = std::max(stats.failures, worker->failures_in_a_row.load());
  }
  return stats;
}

double SampleQueue::LoadOf(double frames_per_second) const {
  const auto workers = static_cast<double>(impl_->workers.size());
  double load = 0;
  for (const auto& worker : impl_->workers)
    load += worker->cost.LoadOf(frames_per_second / workers) / workers;
  return load;
}

SampleQueue::Histograms SampleQueue::histograms() const {
  return {.slice_s = impl_->slice_seconds.snapshot(),
          .transition_s = impl_->transition_seconds.snapshot(),
          .lateness_s = impl_->lateness_seconds.snapshot()};
}

}  // namespace choreo
