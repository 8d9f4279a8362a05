#include <cmath>
#include <limits>

#include "model/engine/scheduler_impl.h"

/// Who has a slot, who waits for one, and who has to give his up.
namespace choreo {
namespace {

double Seconds(std::chrono::steady_clock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

double DeadlineOf(const StepJob& job) {
  const double deadline = job.NextDeadline();
  return std::isnan(deadline) ? std::numeric_limits<double>::infinity() : deadline;
}

}  // namespace

double Scheduler::Impl::RealTimeEnd(Clock::time_point now) const {
  return Seconds(now) + std::chrono::duration<double>(options.bulk_yields).count();
}

double Scheduler::Impl::DueAt(const Entry& entry, double deadline, Clock::time_point now) const {
  return entry.of_group ? std::max(deadline, RealTimeEnd(now)) : deadline;
}

bool Scheduler::Impl::InRealTime(const Entry& entry, Clock::time_point now) const {
  return !entry.of_group && DeadlineOf(*entry.job) <= RealTimeEnd(now);
}

void Scheduler::Impl::SetDeadline(Entry* entry, Clock::time_point now) const {
  entry->deadline = DueAt(*entry, DeadlineOf(*entry->job), now);
}

void Scheduler::Impl::CountLateness(const Entry& entry, Clock::time_point now) {
  if (entry.of_group) return;
  const double due = std::max(DeadlineOf(*entry.job), Seconds(entry.awake_at));
  lateness_seconds.Add(std::max(0.0, Seconds(now) - due));
}

Scheduler::Impl::Worker* Scheduler::Impl::MostFreeWorker() {
  const auto free = [](const auto& worker) { return worker->slots - worker->taken; };
  const auto most =
      std::ranges::max_element(workers, [&](auto& a, auto& b) { return free(a) < free(b); });
  return free(*most) > 0 ? most->get() : nullptr;
}

std::unique_ptr<Scheduler::Impl::Entry> Scheduler::Impl::Extract(const StepJob* job) {
  auto node = entries.extract(job);
  if (node.mapped()->of_group) --groups_live;
  return std::move(node.mapped());
}

void Scheduler::Impl::CountOut() {
  if (--live == 0) idle.notify_all();
}

// All are taken or none.
void Scheduler::Impl::Accept(std::span<const std::shared_ptr<StepJob>> jobs, bool of_group) {
  std::vector<std::unique_ptr<Entry>> own;
  for (const auto& job : jobs) {
    if (job == nullptr) throw InvalidArgument("job", "is null");
    own.push_back(std::make_unique<Entry>());
    own.back()->job = job;
    own.back()->of_group = of_group;
    own.back()->deadline = DeadlineOf(*job);
    own.back()->awake_at = Clock::now();
  }
  Worker* here = current;
  const bool inherits = !of_group && here != nullptr && here->owner == this && here->in_on_done &&
                        here->heir == nullptr;

  std::lock_guard lock(mutex);
  if (phase == Phase::kStopped || (phase == Phase::kDraining && !inherits)) {
    throw Error(ErrorCode::kUnavailable, "", "the scheduler takes no new jobs");
  }
  for (const auto& job : jobs) {
    if (entries.contains(job.get())) throw InvalidArgument("job", "is submitted already");
  }
  const int count = static_cast<int>(jobs.size());
  if (of_group && groups_live + count > group_slots + options.max_waiting) {
    throw Error(ErrorCode::kResourceExhausted, "",
                std::to_string(groups_live) +
                    " transitions are in progress or wait already; with " + std::to_string(count) +
                    " more there would be more than " +
                    std::to_string(group_slots + options.max_waiting));
  }
  slotless.reserve(entries.size() + jobs.size());
  entries.reserve(entries.size() + jobs.size());
  for (auto& owned : own) {
    Entry* entry = owned.get();
    entry->order = submitted++;
    entries.emplace(entry->job.get(), std::move(owned));
    ++live;
    if (of_group) ++groups_live;
    if (inherits) {
      entry->worker = here;
      here->heir = entry;
    } else {
      Place(entry);
    }
  }
}

// Into a free slot, if there is one for its kind; else it waits.
void Scheduler::Impl::Place(Entry* entry) {
  Worker* worker = entry->of_group && groups_active >= group_slots ? nullptr : MostFreeWorker();
  if (worker == nullptr) {
    slotless.push_back(entry);
    // Those whose jobs sleep begin to look at the clock.
    for (const auto& other : workers) other->work.notify_one();
    return;
  }
  GiveSlot(entry, worker);
  ++worker->taken;
  worker->inbox.push_back(entry);
  worker->work.notify_one();
}

void Scheduler::Impl::GiveSlot(Entry* entry, Worker* worker) {
  entry->worker = worker;
  if (entry->of_group) ++groups_active;
}

// Of those who wait and may have a slot the one that is due first, unless the heir is due earlier.
Scheduler::Impl::Entry* Scheduler::Impl::TakeNextWaiting(const Entry* heir) {
  if (phase == Phase::kStopped) return nullptr;
  const Clock::time_point now = Clock::now();
  auto next = slotless.end();
  for (auto at = slotless.begin(); at != slotless.end(); ++at) {
    (*at)->deadline = DueAt(**at, (*at)->deadline, now);
    const bool may = !(*at)->parked && !((*at)->of_group && groups_active >= group_slots);
    if (may && (next == slotless.end() || GoesFirst(*at, *next))) next = at;
  }
  if (next == slotless.end() || (heir != nullptr && GoesFirst(heir, *next))) return nullptr;
  Entry* entry = *next;
  slotless.erase(next);
  return entry;
}

// The slot of a job that has left goes to its heir or to who waits.
void Scheduler::Impl::PassSlotOn(Worker* worker, const Entry& left) {
  std::lock_guard lock(mutex);
  CountOut();
  if (left.of_group) --groups_active;
  Entry* heir = std::exchange(worker->heir, nullptr);
  Entry* next = TakeNextWaiting(heir);
  if (next == nullptr) {
    next = std::exchange(heir, nullptr);
  } else {
    GiveSlot(next, worker);
  }
  if (next == nullptr) {
    --worker->taken;
  } else {
    worker->arrivals.push_back(next);
  }
  if (heir == nullptr) return;
  heir->worker = nullptr;
  Place(heir);
}

void Scheduler::Impl::CollectSuspects(Worker* worker) {
  check_slotless = false;
  for (Entry* entry : slotless) {
    if (!entry->woken) continue;
    if (worker->suspects.size() == kSuspects) {
      check_slotless = true;  // the rest in the next round
      return;
    }
    entry->woken = false;
    worker->suspects.push_back(entry->job);
  }
}

// Of those who were woken while they had no slot: who was cancelled ends, who is ready waits for
// one again.
void Scheduler::Impl::LookAtSuspects(Worker* worker) {
  for (const std::shared_ptr<StepJob>& job : worker->suspects) {
    const bool cancelled = job->Cancelled();
    if (!cancelled && !job->Ready()) continue;
    const double deadline = DeadlineOf(*job);
    std::unique_ptr<Entry> cancelled_entry;
    {
      std::lock_guard lock(mutex);
      // In the meantime another worker may have taken it; then it is that worker's.
      const auto at =
          std::ranges::find_if(slotless, [&](const Entry* other) { return other->job == job; });
      if (at == slotless.end()) continue;
      Entry* entry = *at;
      if (cancelled) {
        slotless.erase(at);
        cancelled_entry = Extract(job.get());
      } else if (entry->parked) {
        slotless.erase(at);
        entry->parked = false;
        entry->deadline = deadline;
        entry->awake_at = Clock::now();
        Place(entry);
      }
    }
    if (cancelled_entry) {
      EndWaiting(std::move(cancelled_entry),
                 Error(ErrorCode::kCancelled, "", "cancelled while waiting"));
    }
  }
  worker->suspects.clear();
}

// Of the jobs that sleep, and in whose place another could go on, the one that has slept longest;
// null: none. Whoever it is, TakeNextWaiting then has somebody for its slot.
Scheduler::Impl::Entry* Scheduler::Impl::NextToPark(const Worker& worker) const {
  if (phase == Phase::kStopped) return nullptr;
  bool dance_waits = false, group_waits = false;
  for (const Entry* entry : slotless) {
    if (!entry->parked) (entry->of_group ? group_waits : dance_waits) = true;
  }
  if (!dance_waits && !group_waits) return nullptr;
  Entry* longest = nullptr;
  for (Entry* entry : worker.active) {
    if (!entry->asleep || entry->woken) continue;
    const int other_groups = groups_active - (entry->of_group ? 1 : 0);
    if (!dance_waits && other_groups >= group_slots) continue;
    if (longest == nullptr || entry->moved_at < longest->moved_at) longest = entry;
  }
  return longest;
}

// Jobs that have slept for too long make room for those who wait.
void Scheduler::Impl::ParkSleepers(Worker* worker) {
  for (;;) {
    Entry* sleeper = nullptr;
    {
      std::lock_guard lock(mutex);
      sleeper = NextToPark(*worker);
      if (sleeper == nullptr || Clock::now() - sleeper->moved_at < options.max_sleep) return;
      if (sleeper->of_group) --groups_active;
      Entry* next = TakeNextWaiting(nullptr);
      GiveSlot(next, worker);
      worker->arrivals.push_back(next);
    }
    FreeSlot(worker, sleeper);
    sleeper->asleep = false;
    sleeper->restarts = true;
    std::lock_guard lock(mutex);
    sleeper->worker = nullptr;
    sleeper->parked = true;
    check_slotless |= sleeper->woken;
    slotless.push_back(sleeper);
  }
}

void Scheduler::Impl::EndWaiting(std::unique_ptr<Entry> entry, const Error& failure) {
  entry->job->OnDone(&failure);
  entry.reset();
  std::lock_guard lock(mutex);
  CountOut();
}

}  // namespace choreo
