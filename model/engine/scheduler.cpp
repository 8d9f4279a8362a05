#include "model/engine/scheduler.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <utility>

#include "model/core/threads.h"

namespace choreo {
namespace {

// What is being thrown, as an Error. Call inside a catch block.
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

// One mutex guards who waits, who has which engine and who was woken. It is never held while a job
// or an engine is called. A round takes it once, the end of a job twice more.
struct Scheduler::Impl {
  struct Worker;

  /// A job from Submit until its OnDone.
  struct Entry {
    std::shared_ptr<StepJob> job;
    uint64_t order = 0;        ///< of submission; settles equal deadlines
    Worker* worker = nullptr;  ///< whose slot it has or is given; null: it waits. Lock: mutex
    bool woken = false;        ///< Wake was called since it was last looked at. Lock: mutex

    // Of the worker's thread alone:
    int slot = -1;        ///< of the engine, once admitted
    bool asleep = false;  ///< NextInput said no, and no Wake has come since
    double deadline = 0;  ///< asked for only in crowded rounds
  };

  /// One engine and the thread that alone touches it.
  struct Worker {
    Impl* owner = nullptr;
    std::unique_ptr<StepEngine> engine;
    int slots = 0;  ///< the engine's, constant
    std::thread thread;
    std::condition_variable work;  ///< BeginRound has something to see

    int taken = 0;              ///< slots given to jobs, in `inbox` or `active`. Lock: mutex
    std::vector<Entry*> inbox;  ///< given a slot by Submit, not yet admitted. Lock: mutex

    // Of the worker's thread alone. Capacities are reserved at the start: a round allocates
    // nothing.
    std::vector<Entry*> arrivals;                    ///< what was in `inbox`
    std::vector<std::shared_ptr<StepJob>> suspects;  ///< woken while they wait: cancelled?
    std::vector<Entry*> active;                      ///< admitted to the engine
    std::vector<Entry*> ready;                       ///< of `active`, those not asleep
    std::vector<Entry*> batch;                       ///< of `ready`, those that step
    std::vector<StepInput> inputs;
    std::vector<StepOutput> outputs;
    bool in_on_done = false;  ///< inside the OnDone of a job that has just left its slot
    Entry* heir = nullptr;    ///< submitted from inside that OnDone
  };

  enum class Phase { kOpen, kDraining, kStopped };

  Options options;
  std::vector<std::unique_ptr<Worker>> workers;

  mutable std::mutex mutex;
  mutable std::condition_variable idle;                                ///< `live` became 0
  std::unordered_map<const StepJob*, std::unique_ptr<Entry>> entries;  ///< Lock: mutex
  std::deque<Entry*> waiting;  ///< oldest first; filled only while no slot is free. Lock: mutex
  size_t live = 0;             ///< `entries` and those inside OnDone. Lock: mutex
  uint64_t submitted = 0;      ///< Lock: mutex
  bool check_waiting = false;  ///< some of `waiting` were woken. Lock: mutex
  Phase phase = Phase::kOpen;  ///< Lock: mutex
  bool exit = false;           ///< workers end, after Phase::kStopped. Lock: mutex

  std::atomic<uint64_t> frames = 0;
  std::atomic<uint64_t> steps = 0;

  static thread_local Worker* current;  ///< the worker whose thread this is

  void Run(Worker* worker);
  bool BeginRound(Worker* worker, bool* stopped);
  void EndEverything(Worker* worker);
  void EndCancelledSuspects(Worker* worker);
  void GatherBatch(Worker* worker);
  void StepBatch(Worker* worker);

  Entry* Admit(Worker* worker, Entry* entry);
  Entry* Leave(Worker* worker, Entry* entry, const Error* failure);
  void EndWaiting(std::unique_ptr<Entry> entry, const Error& failure);

  /// Ends a job and fills its slot with the next, and that one's, should it be unfit.
  void Settle(Worker* worker, Entry* entry, const Error* failure) {
    Entry* next = Leave(worker, entry, failure);
    while (next != nullptr) next = Admit(worker, next);
  }

  // The caller of these holds the mutex.
  std::unique_ptr<Entry> Extract(const StepJob* job) {
    auto node = entries.extract(job);
    return std::move(node.mapped());
  }
  void CountOut() {
    if (--live == 0) idle.notify_all();
  }
  Worker* MostFreeWorker() {
    const auto free = [](const auto& worker) { return worker->slots - worker->taken; };
    const auto most = std::max_element(workers.begin(), workers.end(),
                                       [&](auto& a, auto& b) { return free(a) < free(b); });
    return free(*most) > 0 ? most->get() : nullptr;
  }
};

thread_local Scheduler::Impl::Worker* Scheduler::Impl::current = nullptr;

// ---- One worker ---------------------------------------------------------------------------------

void Scheduler::Impl::Run(Worker* worker) {
  FlushDenormals();
  current = worker;
  bool stopped = false;
  while (BeginRound(worker, &stopped)) {
    if (stopped) {
      EndEverything(worker);
      continue;
    }
    EndCancelledSuspects(worker);
    for (Entry* arrival : worker->arrivals) {
      for (Entry* next = arrival; next != nullptr;) next = Admit(worker, next);
    }
    worker->arrivals.clear();
    GatherBatch(worker);
    if (!worker->batch.empty()) StepBatch(worker);
  }
}

// Blocks until there is something to do, and takes over what others left under the mutex. False:
// end.
bool Scheduler::Impl::BeginRound(Worker* worker, bool* stopped) {
  std::unique_lock lock(mutex);
  for (;;) {
    worker->arrivals.swap(worker->inbox);
    bool any_awake = false;
    for (Entry* entry : worker->active) {
      if (std::exchange(entry->woken, false)) entry->asleep = false;
      any_awake |= !entry->asleep;
    }
    *stopped = phase == Phase::kStopped;
    if (*stopped) {
      if (!worker->arrivals.empty() || !worker->active.empty() || !waiting.empty()) return true;
      if (exit) return false;
    } else {
      if (std::exchange(check_waiting, false)) {
        for (Entry* entry : waiting) {
          if (std::exchange(entry->woken, false)) worker->suspects.push_back(entry->job);
        }
      }
      if (any_awake || !worker->arrivals.empty() || !worker->suspects.empty()) return true;
    }
    worker->work.wait(lock);
  }
}

void Scheduler::Impl::EndEverything(Worker* worker) {
  const Error stopping(ErrorCode::kUnavailable, "", "the scheduler is stopped");
  while (!worker->active.empty()) Settle(worker, worker->active.back(), &stopping);
  for (Entry* arrival : worker->arrivals) Settle(worker, arrival, &stopping);
  worker->arrivals.clear();
  for (;;) {
    std::unique_ptr<Entry> entry;
    {
      std::lock_guard lock(mutex);
      if (waiting.empty()) return;
      entry = Extract(waiting.front()->job.get());
      waiting.pop_front();
    }
    EndWaiting(std::move(entry), stopping);
  }
}

void Scheduler::Impl::EndCancelledSuspects(Worker* worker) {
  for (const std::shared_ptr<StepJob>& job : worker->suspects) {
    if (!job->Cancelled()) continue;
    std::unique_ptr<Entry> entry;
    {
      std::lock_guard lock(mutex);
      // In the meantime another worker may have taken it; then it is that worker's to end.
      const auto at = std::find_if(waiting.begin(), waiting.end(),
                                   [&](const Entry* other) { return other->job == job; });
      if (at == waiting.end()) continue;
      waiting.erase(at);
      entry = Extract(job.get());
    }
    EndWaiting(std::move(entry), Error(ErrorCode::kCancelled, "", "cancelled while waiting"));
  }
  worker->suspects.clear();
}

void Scheduler::Impl::GatherBatch(Worker* worker) {
  const auto limit = static_cast<size_t>(options.max_batch);
  worker->ready.clear();
  for (size_t i = 0; i < worker->active.size();) {
    Entry* entry = worker->active[i];
    if (entry->job->Cancelled()) {
      const Error cancelled(ErrorCode::kCancelled, "", "cancelled");
      Settle(worker, entry, &cancelled);  // another stands at i now, or none
      continue;
    }
    if (!entry->asleep) worker->ready.push_back(entry);
    ++i;
  }
  if (worker->ready.size() > limit) {
    for (Entry* entry : worker->ready) {
      const double deadline = entry->job->NextDeadline();
      entry->deadline = std::isnan(deadline) ? std::numeric_limits<double>::infinity() : deadline;
    }
    std::sort(worker->ready.begin(), worker->ready.end(), [](const Entry* a, const Entry* b) {
      return a->deadline != b->deadline ? a->deadline < b->deadline : a->order < b->order;
    });
  }
  worker->batch.clear();
  worker->inputs.clear();
  for (Entry* entry : worker->ready) {
    if (worker->batch.size() == limit) break;
    StepInput input;
    try {
      entry->asleep = !entry->job->NextInput(&input);
    } catch (...) {
      const Error failure = CurrentError();
      Settle(worker, entry, &failure);
      continue;
    }
    if (entry->asleep) continue;
    input.slot = entry->slot;
    worker->inputs.push_back(input);
    worker->batch.push_back(entry);
  }
}

void Scheduler::Impl::StepBatch(Worker* worker) {
  const size_t size = worker->batch.size();
  try {
    worker->engine->Step(worker->inputs, std::span(worker->outputs).first(size));
  } catch (...) {
    // Some of them may have advanced and some not: none can go on.
    const Error failure = CurrentError();
    for (Entry* entry : worker->batch) Settle(worker, entry, &failure);
    return;
  }
  steps.fetch_add(1, std::memory_order_relaxed);
  frames.fetch_add(size, std::memory_order_relaxed);
  for (size_t i = 0; i < size; ++i) {
    Entry* entry = worker->batch[i];
    try {
      if (!entry->job->OnFrame(worker->outputs[i])) Settle(worker, entry, nullptr);
    } catch (...) {
      const Error failure = CurrentError();
      Settle(worker, entry, &failure);
    }
  }
}

// ---- One job's way ------------------------------------------------------------------------------

// Starts a job in the place that it was given. Returns the job that takes its place instead, should
// it be cancelled or refused.
Scheduler::Impl::Entry* Scheduler::Impl::Admit(Worker* worker, Entry* entry) {
  try {
    if (entry->job->Cancelled()) throw Error(ErrorCode::kCancelled, "", "cancelled");
    entry->slot = worker->engine->Admit(entry->job->spec());
    worker->active.push_back(entry);
    return nullptr;
  } catch (...) {
    const Error failure = CurrentError();
    return Leave(worker, entry, &failure);
  }
}

// Frees a job's slot, tells the job, and returns who has the place now: the job's heir, else the
// longest waiting, else none (nullptr).
Scheduler::Impl::Entry* Scheduler::Impl::Leave(Worker* worker, Entry* entry, const Error* failure) {
  if (entry->slot >= 0) {
    worker->engine->Release(entry->slot);
    std::erase(worker->active, entry);
  }
  std::unique_ptr<Entry> own;
  {
    std::lock_guard lock(mutex);
    own = Extract(entry->job.get());
  }
  worker->in_on_done = true;
  own->job->OnDone(failure);
  worker->in_on_done = false;
  own.reset();

  std::lock_guard lock(mutex);
  CountOut();
  if (Entry* heir = std::exchange(worker->heir, nullptr); heir != nullptr) return heir;
  if (waiting.empty() || phase == Phase::kStopped) {
    --worker->taken;
    return nullptr;
  }
  Entry* next = waiting.front();
  waiting.pop_front();
  next->worker = worker;
  return next;
}

void Scheduler::Impl::EndWaiting(std::unique_ptr<Entry> entry, const Error& failure) {
  entry->job->OnDone(&failure);
  entry.reset();
  std::lock_guard lock(mutex);
  CountOut();
}

// ---- The interface ------------------------------------------------------------------------------

Scheduler::Scheduler(std::vector<std::unique_ptr<StepEngine>> engines, Options options)
    : impl_(std::make_unique<Impl>()) {
  if (engines.empty()) throw InvalidArgument("engines", "is empty; at least 1 is needed");
  if (options.max_waiting < 0) {
    throw InvalidArgument("max_waiting", std::to_string(options.max_waiting) + " is below 0");
  }
  if (options.max_batch < 1) {
    throw InvalidArgument("max_batch", std::to_string(options.max_batch) + " is below 1");
  }
  impl_->options = options;
  const std::string fingerprint = engines[0]->model().fingerprint;
  for (size_t i = 0; i < engines.size(); ++i) {
    const std::string& other = engines[i]->model().fingerprint;
    if (other != fingerprint) {
      throw InvalidArgument("engines[" + std::to_string(i) + "]",
                            "its fingerprint " + other + " is not " + fingerprint);
    }
    auto worker = std::make_unique<Impl::Worker>();
    worker->owner = impl_.get();
    worker->engine = std::move(engines[i]);
    worker->slots = worker->engine->slots();
    if (worker->slots < 1) {
      throw InvalidArgument("engines[" + std::to_string(i) + "]", "has no slots");
    }
    const auto slots = static_cast<size_t>(worker->slots);
    for (auto* list :
         {&worker->inbox, &worker->arrivals, &worker->active, &worker->ready, &worker->batch}) {
      list->reserve(slots);
    }
    worker->suspects.reserve(static_cast<size_t>(options.max_waiting));
    worker->inputs.reserve(slots);
    worker->outputs.resize(slots);
    impl_->workers.push_back(std::move(worker));
  }
  for (const auto& worker : impl_->workers) {
    worker->thread = std::thread([this, one = worker.get()] { impl_->Run(one); });
  }
}

Scheduler::~Scheduler() {
  Stop(false);
  {
    std::lock_guard lock(impl_->mutex);
    impl_->exit = true;
    for (const auto& worker : impl_->workers) worker->work.notify_one();
  }
  for (const auto& worker : impl_->workers) worker->thread.join();
}

void Scheduler::Submit(std::shared_ptr<StepJob> job) {
  if (job == nullptr) throw InvalidArgument("job", "is null");
  const StepJob* key = job.get();
  auto entry = std::make_unique<Impl::Entry>();
  entry->job = std::move(job);

  Impl::Worker* here = Impl::current;
  const bool inherits =
      here != nullptr && here->owner == impl_.get() && here->in_on_done && here->heir == nullptr;

  std::lock_guard lock(impl_->mutex);
  if (impl_->phase == Impl::Phase::kStopped ||
      (impl_->phase == Impl::Phase::kDraining && !inherits)) {
    throw Error(ErrorCode::kUnavailable, "", "the scheduler takes no new jobs");
  }
  if (impl_->entries.contains(key)) throw InvalidArgument("job", "is submitted already");
  Impl::Worker* worker = inherits ? here : impl_->MostFreeWorker();
  if (worker == nullptr &&
      impl_->waiting.size() >= static_cast<size_t>(impl_->options.max_waiting)) {
    throw Error(
        ErrorCode::kResourceExhausted, "",
        "every slot is taken and " + std::to_string(impl_->waiting.size()) + " jobs wait already");
  }
  entry->order = impl_->submitted++;
  entry->worker = worker;
  Impl::Entry* raw = entry.get();
  impl_->entries.emplace(key, std::move(entry));
  ++impl_->live;
  if (inherits) {
    here->heir = raw;
  } else if (worker != nullptr) {
    ++worker->taken;
    worker->inbox.push_back(raw);
    worker->work.notify_one();
  } else {
    impl_->waiting.push_back(raw);
  }
}

void Scheduler::Wake(const StepJob* job) {
  std::lock_guard lock(impl_->mutex);
  const auto at = impl_->entries.find(job);
  if (at == impl_->entries.end()) return;
  Impl::Entry* entry = at->second.get();
  entry->woken = true;
  if (entry->worker != nullptr) {
    entry->worker->work.notify_one();
    return;
  }
  // A waiting job is everyone's: the first worker to look at it ends it, if it was cancelled.
  impl_->check_waiting = true;
  for (const auto& worker : impl_->workers) worker->work.notify_one();
}

void Scheduler::Stop(bool drain) noexcept {
  std::lock_guard lock(impl_->mutex);
  impl_->phase = std::max(impl_->phase, drain ? Impl::Phase::kDraining : Impl::Phase::kStopped);
  for (const auto& worker : impl_->workers) worker->work.notify_one();
}

bool Scheduler::WaitUntilIdle(std::chrono::milliseconds limit) const {
  std::unique_lock lock(impl_->mutex);
  return impl_->idle.wait_for(lock, limit, [this] { return impl_->live == 0; });
}

const ModelInfo& Scheduler::model() const { return impl_->workers.front()->engine->model(); }

std::vector<std::string> Scheduler::devices() const {
  std::vector<std::string> devices;
  for (const auto& worker : impl_->workers) devices.push_back(worker->engine->device());
  return devices;
}

Scheduler::Stats Scheduler::stats() const {
  Stats stats;
  stats.frames = impl_->frames.load(std::memory_order_relaxed);
  stats.steps = impl_->steps.load(std::memory_order_relaxed);
  std::lock_guard lock(impl_->mutex);
  stats.waiting = static_cast<int>(impl_->waiting.size());
  for (const auto& worker : impl_->workers) {
    stats.active += worker->taken;
    stats.slots += worker->slots;
  }
  return stats;
}

}  // namespace choreo
