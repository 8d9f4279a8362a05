#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <utility>

#include "model/engine/scheduler.h"

/// The inside of Scheduler: scheduler.cpp is what callers see of it, scheduler_worker.cpp what its
/// threads do.
namespace choreo {

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
    double deadline = 0;  ///< asked for where not all can go at once
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
    std::vector<Entry*> arrivals;                    ///< have a slot, not yet admitted
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
  void AdmitArrivals(Worker* worker);
  void GatherBatch(Worker* worker);
  void StepBatch(Worker* worker);

  bool Admit(Worker* worker, Entry* entry);
  void Leave(Worker* worker, Entry* entry, const Error* failure);
  void EndWaiting(std::unique_ptr<Entry> entry, const Error& failure);

  /// Earliest deadline first, then in order of submission.
  static bool GoesFirst(const Entry* a, const Entry* b) {
    return a->deadline != b->deadline ? a->deadline < b->deadline : a->order < b->order;
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

}  // namespace choreo
