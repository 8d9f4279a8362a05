#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <unordered_map>
#include <utility>

#include "model/engine/engine_cost.h"
#include "model/engine/scheduler.h"

/// The inside of Scheduler: scheduler.cpp is what callers see of it, scheduler_worker.cpp what its
/// threads do, scheduler_slots.cpp who has a slot and who waits for one.
namespace choreo {

// One mutex guards who waits, who has which engine and who was woken. It is never held while a job
// or an engine is called. A round takes it once, the end of a job twice more.
struct Scheduler::Impl {
  using Clock = std::chrono::steady_clock;
  struct Worker;

  /// A job from its submission until its OnDone. It has a slot (`worker`), waits for one, or is
  /// parked: it lost its slot while it slept, and sleeps on.
  struct Entry {
    std::shared_ptr<StepJob> job;
    bool of_group = false;     ///< constant
    uint64_t order = 0;        ///< of submission; settles equal deadlines
    Worker* worker = nullptr;  ///< whose slot it has or is given. Lock: mutex
    bool parked = false;       ///< Lock: mutex
    bool woken = false;        ///< Wake was called since it was last looked at. Lock: mutex

    double deadline = 0;  ///< Lock: mutex while it has no worker, else of the worker's thread

    // Of the worker's thread alone:
    int slot = -1;                 ///< of the engine, once its admission has begun
    bool asleep = true;            ///< it could make no frame, and no Wake has come since
    bool restarts = false;         ///< it was parked, and is to begin anew
    double admission_s = 0;        ///< what its admission took so far
    int asked_frames = 0;          ///< of its spec
    int frames = 0;                ///< made since its admission
    Clock::time_point moved_at{};  ///< when it was admitted or last made a frame
    Clock::time_point awake_at{};  ///< since when it is not asleep
  };

  /// One engine and the thread that alone touches it.
  struct Worker {
    Impl* owner = nullptr;
    std::unique_ptr<StepEngine> engine;
    int slots = 0;  ///< the engine's, constant
    std::thread thread;
    std::condition_variable work;  ///< BeginRound has something to see

    int taken = 0;                  ///< slots given to jobs, in `inbox` or `active`. Lock: mutex
    std::vector<Entry*> inbox;      ///< given a slot by others, not yet admitted. Lock: mutex
    std::optional<FrameCost> cost;  ///< of the engine; always there
    std::atomic<int> failures = 0;  ///< of the engine, in a row
    std::atomic<int> asleep = 0;    ///< of `active`, as last gathered

    // Of the worker's thread alone. Capacities are reserved at the start: a round allocates
    // nothing.
    std::vector<Entry*> arrivals;                    ///< have a slot, not yet (all) admitted
    std::vector<std::shared_ptr<StepJob>> suspects;  ///< woken while they have no slot
    std::vector<Entry*> active;                      ///< admitted to the engine
    std::vector<Entry*> ready;                       ///< of `active`, those not asleep
    std::vector<Entry*> batch;                       ///< of `ready`, those that step
    std::vector<StepInput> inputs;
    std::vector<StepOutput> outputs;
    bool in_on_done = false;  ///< inside the OnDone of a job that has just left its slot
    Entry* heir = nullptr;    ///< submitted from inside that OnDone
  };

  static constexpr size_t kSuspects = 64;  ///< looked at in one round

  enum class Phase { kOpen, kDraining, kStopped };

  Options options;
  std::vector<std::unique_ptr<Worker>> workers;
  int group_slots = 1;  ///< that jobs of groups may hold, constant

  mutable std::mutex mutex;
  mutable std::condition_variable idle;                                ///< `live` became 0
  std::unordered_map<const StepJob*, std::unique_ptr<Entry>> entries;  ///< Lock: mutex
  std::vector<Entry*> slotless;  ///< wait or are parked. Room for all `entries`. Lock: mutex
  int groups_active = 0;         ///< jobs of groups that have a slot. Lock: mutex
  int groups_live = 0;           ///< of `entries`, those of groups. Lock: mutex
  size_t live = 0;               ///< `entries` and those inside OnDone. Lock: mutex
  uint64_t submitted = 0;        ///< Lock: mutex
  bool check_slotless = false;   ///< some of `slotless` were woken. Lock: mutex
  Phase phase = Phase::kOpen;    ///< Lock: mutex
  bool exit = false;             ///< workers end, after Phase::kStopped. Lock: mutex

  std::atomic<uint64_t> frames = 0;
  std::atomic<uint64_t> steps = 0;
  Histogram batch_sizes{{1, 2, 4, 8, 16, 32, 64, 128, 256}};
  Histogram step_seconds{Histogram::Seconds()};
  Histogram admission_seconds{Histogram::Seconds()};
  Histogram lateness_seconds{Histogram::Seconds()};

  static thread_local Worker* current;  ///< the worker whose thread this is

  // ---- scheduler_slots.cpp

  void Accept(std::span<const std::shared_ptr<StepJob>> jobs, bool of_group);
  /// The caller of these holds the mutex.
  void Place(Entry* entry);
  void GiveSlot(Entry* entry, Worker* worker);
  Entry* TakeNextWaiting(const Entry* heir);
  Worker* MostFreeWorker();
  std::unique_ptr<Entry> Extract(const StepJob* job);
  void CountOut();
  Entry* NextToPark(const Worker& worker) const;
  void CollectSuspects(Worker* worker);
  /// What follows does not.
  void PassSlotOn(Worker* worker, const Entry& left);
  void LookAtSuspects(Worker* worker);
  void ParkSleepers(Worker* worker);
  void EndWaiting(std::unique_ptr<Entry> entry, const Error& failure);

  // ---- scheduler_worker.cpp

  void Run(Worker* worker);
  bool BeginRound(Worker* worker, bool* stopped);
  void EndEverything(Worker* worker);
  void AdmitArrivals(Worker* worker);
  void LookAtArrivals(Worker* worker);
  Entry* NextToAdmit(Worker* worker);
  void GatherBatch(Worker* worker);
  void StepBatch(Worker* worker);
  bool AdmitSlice(Worker* worker, Entry* entry);
  void Leave(Worker* worker, Entry* entry, const Error* failure);
  static void FreeSlot(Worker* worker, Entry* entry);

  /// Earliest deadline first, then in order of submission.
  static bool GoesFirst(const Entry* a, const Entry* b) {
    return a->deadline != b->deadline ? a->deadline < b->deadline : a->order < b->order;
  }
  /// What it has to be compared with now, if its job says `deadline`. Nobody listens to what groups
  /// make: it is due when real time ends.
  double DueAt(const Entry& entry, double deadline, Clock::time_point now) const;
  /// Up to when a dance's work goes before that of groups.
  double RealTimeEnd(Clock::time_point now) const;
  bool InRealTime(const Entry& entry, Clock::time_point now) const;
  void SetDeadline(Entry* entry, Clock::time_point now) const;
  /// Stats of the frame that was made at `now`, before its job takes it.
  void CountLateness(const Entry& entry, Clock::time_point now);
};

}  // namespace choreo
