#include "model/engine/scheduler.h"

#include "model/engine/scheduler_impl.h"

namespace choreo {

Scheduler::Scheduler(std::vector<std::unique_ptr<StepEngine>> engines, Options options)
    : impl_(std::make_unique<Impl>()) {
  if (engines.empty()) throw InvalidArgument("engines", "is empty; at least 1 is needed");
  const auto check = [](const char* field, int64_t value, int64_t least) {
    if (value >= least) return;
    throw InvalidArgument(field, std::to_string(value) + " is below " + std::to_string(least));
  };
  check("max_waiting", options.max_waiting, 0);
  check("max_batch", options.max_batch, 1);
  check("max_admissions", options.max_admissions, 1);
  check("max_sleep", options.max_sleep.count(), 0);
  check("bulk_yields", options.bulk_yields.count(), 0);
  impl_->options = options;
  int slots_of_all = 0;
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
    const int together = std::min(worker->engine->batch(), worker->slots);
    worker->cost.emplace(worker->engine->cost(), std::clamp(together, 1, options.max_batch));
    if (worker->slots < 1) {
      throw InvalidArgument("engines[" + std::to_string(i) + "]", "has no slots");
    }
    const auto slots = static_cast<size_t>(worker->slots);
    for (auto* list :
         {&worker->inbox, &worker->arrivals, &worker->active, &worker->ready, &worker->batch}) {
      list->reserve(slots);
    }
    worker->suspects.reserve(Impl::kSuspects);
    worker->inputs.reserve(slots);
    worker->outputs.resize(slots);
    slots_of_all += worker->slots;
    impl_->workers.push_back(std::move(worker));
  }
  impl_->group_slots = std::max(1, slots_of_all / 2);
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

void Scheduler::Submit(std::shared_ptr<StepJob> job) { impl_->Accept({&job, 1}, false); }

void Scheduler::SubmitGroup(std::vector<std::shared_ptr<StepJob>> jobs) {
  impl_->Accept(jobs, true);
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
  // A job without a slot is everyone's: the first worker that comes looks at it.
  impl_->check_slotless = true;
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
  for (const Impl::Entry* entry : impl_->slotless) ++(entry->parked ? stats.parked : stats.waiting);
  for (const auto& worker : impl_->workers) {
    stats.active += worker->taken;
    stats.slots += worker->slots;
    stats.asleep += worker->asleep.load(std::memory_order_relaxed);
    stats.failures = std::max(stats.failures, worker->failures.load(std::memory_order_relaxed));
  }
  return stats;
}

double Scheduler::LoadOf(double frames_per_second) const {
  const auto workers = static_cast<double>(impl_->workers.size());
  double load = 0;
  for (const auto& worker : impl_->workers) {
    load += worker->cost->LoadOf(frames_per_second / workers, model().fps) / workers;
  }
  return load;
}

Scheduler::Histograms Scheduler::histograms() const {
  return {.batch = impl_->batch_sizes.snapshot(),
          .step_s = impl_->step_seconds.snapshot(),
          .admission_s = impl_->admission_seconds.snapshot(),
          .lateness_s = impl_->lateness_seconds.snapshot()};
}

}  // namespace choreo
