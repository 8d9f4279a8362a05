#include <exception>

#include "model/core/threads.h"
#include "model/engine/scheduler_impl.h"

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
    LookAtSuspects(worker);
    ParkSleepers(worker);
    AdmitArrivals(worker);
    GatherBatch(worker);
    if (!worker->batch.empty()) StepBatch(worker);
  }
}

// Blocks until there is something to do, and takes over what others left under the mutex. False:
// end.
bool Scheduler::Impl::BeginRound(Worker* worker, bool* stopped) {
  std::unique_lock lock(mutex);
  for (;;) {
    worker->arrivals.insert(worker->arrivals.end(), worker->inbox.begin(), worker->inbox.end());
    worker->inbox.clear();
    bool any_awake = false;
    for (Entry* entry : worker->active) {
      if (std::exchange(entry->woken, false) && std::exchange(entry->asleep, false)) {
        entry->awake_at = Clock::now();
      }
      any_awake |= !entry->asleep;
    }
    *stopped = phase == Phase::kStopped;
    if (*stopped) {
      if (!worker->arrivals.empty() || !worker->active.empty() || !slotless.empty()) return true;
      if (exit) return false;
      worker->work.wait(lock);
      continue;
    }
    if (check_slotless) CollectSuspects(worker);
    if (any_awake || !worker->arrivals.empty() || !worker->suspects.empty()) return true;
    const Entry* sleeper = NextToPark(*worker);
    if (sleeper == nullptr) {
      worker->work.wait(lock);
    } else if (worker->work.wait_until(lock, sleeper->moved_at + options.max_sleep) ==
               std::cv_status::timeout) {
      return true;
    }
  }
}

void Scheduler::Impl::EndEverything(Worker* worker) {
  const Error stopping(ErrorCode::kUnavailable, "", "the scheduler is stopped");
  while (!worker->active.empty()) Leave(worker, worker->active.back(), &stopping);
  while (!worker->arrivals.empty()) Leave(worker, worker->arrivals.back(), &stopping);
  for (;;) {
    std::unique_ptr<Entry> entry;
    {
      std::lock_guard lock(mutex);
      if (slotless.empty()) return;
      entry = Extract(slotless.back()->job.get());
      slotless.pop_back();
    }
    EndWaiting(std::move(entry), stopping);
  }
}

void Scheduler::Impl::AdmitArrivals(Worker* worker) {
  for (int slices = 0; slices < options.max_admissions;) {
    LookAtArrivals(worker);
    Entry* next = NextToAdmit(worker);
    if (next == nullptr) return;
    if (AdmitSlice(worker, next)) ++slices;
  }
}

// Who is cancelled leaves, however far its admission is. Since when the others could dance, but
// for their admission, counts for lateness.
void Scheduler::Impl::LookAtArrivals(Worker* worker) {
  for (size_t i = 0; i < worker->arrivals.size();) {
    Entry* entry = worker->arrivals[i];
    if (entry->job->Cancelled()) {
      const Error cancelled(ErrorCode::kCancelled, "", "cancelled");
      Leave(worker, entry, &cancelled);  // another stands at i now, or none
      continue;
    }
    if (!entry->of_group && entry->asleep) {
      entry->asleep = !entry->job->Ready();
      if (entry->asleep) entry->awake_at = Clock::now();
    }
    ++i;
  }
}

// The arrival that is due first; null: none, or bulk alone while a dance can go on.
Scheduler::Impl::Entry* Scheduler::Impl::NextToAdmit(Worker* worker) {
  if (worker->arrivals.empty()) return nullptr;
  const Clock::time_point now = Clock::now();
  for (Entry* entry : worker->arrivals) SetDeadline(entry, now);
  Entry* first = *std::ranges::min_element(worker->arrivals, GoesFirst);
  const auto can_go_on = [&](const Entry* entry) {
    return !entry->asleep && InRealTime(*entry, now);
  };
  return first->of_group && std::ranges::any_of(worker->active, can_go_on) ? nullptr : first;
}

void Scheduler::Impl::GatherBatch(Worker* worker) {
  const auto limit = static_cast<size_t>(std::min(options.max_batch, worker->engine->batch()));
  worker->ready.clear();
  for (size_t i = 0; i < worker->active.size();) {
    Entry* entry = worker->active[i];
    if (entry->job->Cancelled()) {
      const Error cancelled(ErrorCode::kCancelled, "", "cancelled");
      Leave(worker, entry, &cancelled);  // another stands at i now, or none
      continue;
    }
    if (!entry->asleep) worker->ready.push_back(entry);
    ++i;
  }
  const Clock::time_point now = Clock::now();
  const auto in_real_time = [&](const Entry* entry) { return InRealTime(*entry, now); };
  if (std::ranges::any_of(worker->ready, in_real_time)) {
    std::erase_if(worker->ready, [](const Entry* entry) { return entry->of_group; });
  }
  if (worker->ready.size() > limit) {
    for (Entry* entry : worker->ready) SetDeadline(entry, now);
    std::ranges::sort(worker->ready, GoesFirst);
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
      Leave(worker, entry, &failure);
      continue;
    }
    if (entry->asleep) continue;
    input.slot = entry->slot;
    worker->inputs.push_back(input);
    worker->batch.push_back(entry);
  }
  const auto asleep = std::ranges::count_if(worker->active, &Entry::asleep);
  worker->asleep.store(static_cast<int>(asleep), std::memory_order_relaxed);
}

void Scheduler::Impl::StepBatch(Worker* worker) {
  const size_t size = worker->batch.size();
  const Clock::time_point begin = Clock::now();
  try {
    worker->engine->Step(worker->inputs, std::span(worker->outputs).first(size));
  } catch (...) {
    // Some of them may have advanced and some not: none can go on.
    const Error failure = CurrentError();
    worker->failures.fetch_add(1, std::memory_order_relaxed);
    for (Entry* entry : worker->batch) Leave(worker, entry, &failure);
    return;
  }
  worker->failures.store(0, std::memory_order_relaxed);
  const Clock::time_point end = Clock::now();
  const double took = std::chrono::duration<double>(end - begin).count();
  worker->cost->AddStep(static_cast<int>(size), took);
  step_seconds.Add(took);
  batch_sizes.Add(static_cast<double>(size));
  steps.fetch_add(1, std::memory_order_relaxed);
  frames.fetch_add(size, std::memory_order_relaxed);
  for (size_t i = 0; i < size; ++i) {
    Entry* entry = worker->batch[i];
    entry->moved_at = end;
    ++entry->frames;
    CountLateness(*entry, end);
    try {
      if (!entry->job->OnFrame(worker->outputs[i])) Leave(worker, entry, nullptr);
    } catch (...) {
      const Error failure = CurrentError();
      Leave(worker, entry, &failure);
    }
  }
}

// ---- One job's way ------------------------------------------------------------------------------

// Starts a job in the place that it was given, or goes on with it; false if it is refused, and has
// left.
bool Scheduler::Impl::AdmitSlice(Worker* worker, Entry* entry) {
  bool in_engine = false;
  try {
    if (std::exchange(entry->restarts, false)) entry->job->OnRestart();
    const TransitionSpec* spec = entry->slot < 0 ? &entry->job->spec() : nullptr;
    const Clock::time_point begin = Clock::now();
    in_engine = true;
    if (spec != nullptr) {
      entry->slot = worker->engine->BeginAdmission(*spec);
      entry->asked_frames = spec->frames;
    }
    const bool more = worker->engine->ContinueAdmission(entry->slot);
    in_engine = false;
    entry->moved_at = Clock::now();
    entry->admission_s += std::chrono::duration<double>(entry->moved_at - begin).count();
    if (more) return true;
    admission_seconds.Add(entry->admission_s);
    if (entry->of_group) worker->cost->AddTransition(entry->admission_s, entry->asked_frames);
    // Nobody has to be told that it is ready: its first input is asked for.
    if (std::exchange(entry->asleep, false)) entry->awake_at = entry->moved_at;
    std::erase(worker->arrivals, entry);
    worker->active.push_back(entry);
    return true;
  } catch (...) {
    const Error failure = CurrentError();
    // A spec that is refused is its job's fault; anything else that goes wrong is the engine's.
    if (in_engine && failure.code() == ErrorCode::kInternal) worker->failures.fetch_add(1);
    Leave(worker, entry, &failure);
    return false;
  }
}

void Scheduler::Impl::FreeSlot(Worker* worker, Entry* entry) {
  worker->engine->Release(std::exchange(entry->slot, -1));
  std::erase(worker->active, entry);
  const double admission_s = std::exchange(entry->admission_s, 0);
  const int frames = std::exchange(entry->frames, 0);
  // What a dance asked for and never took was its to pay for. Bulk that ends early takes nothing
  // from dances, so it makes their frames no dearer.
  if (!entry->of_group) worker->cost->AddTransition(admission_s, frames);
}

// Frees a job's slot, tells the job, and passes the slot on.
void Scheduler::Impl::Leave(Worker* worker, Entry* entry, const Error* failure) {
  std::erase(worker->arrivals, entry);
  if (entry->slot >= 0) FreeSlot(worker, entry);
  std::unique_ptr<Entry> own;
  {
    std::lock_guard lock(mutex);
    own = Extract(entry->job.get());
  }
  worker->in_on_done = true;
  own->job->OnDone(failure);
  worker->in_on_done = false;
  own->job.reset();
  PassSlotOn(worker, *own);
}

}  // namespace choreo
