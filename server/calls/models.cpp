#include "server/calls/models.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <set>
#include <utility>

#include "model/core/error.h"
#include "model/core/programs.h"

namespace choreo {
namespace {

void Add(const Models::Figures& more, Models::Figures* to) {
  SampleQueue::Stats& stats = to->stats;
  stats.workers += more.stats.workers;
  stats.active += more.stats.active;
  stats.waiting += more.stats.waiting;
  stats.frames += more.stats.frames;
  stats.transitions += more.stats.transitions;
  stats.failures = std::max(stats.failures, more.stats.failures);
  stats.cpu_seconds += more.stats.cpu_seconds;
  stats.bulk_share = std::max(stats.bulk_share, more.stats.bulk_share);
  to->histograms.slice_s += more.histograms.slice_s;
  to->histograms.transition_s += more.histograms.transition_s;
  to->histograms.lateness_s += more.histograms.lateness_s;
}

void AddTo(std::map<std::string, Models::Figures>& all, const std::string& name,
           const Models::Figures& more) {
  const auto [at, is_new] = all.try_emplace(name, more);
  if (!is_new) Add(more, &at->second);
}

Models::Figures FiguresOf(const SampleQueue& queue) { return {queue.stats(), queue.histograms()}; }

}  // namespace

Models::Entry::Entry(std::unique_ptr<SampleQueue> one)
    : queue(std::move(one)),
      use(queue.get(), [unused = unused](SampleQueue* /*owned*/) { *unused = true; }) {}

Models::Models(std::vector<std::unique_ptr<SampleQueue>> models) {
  std::vector<std::string> names;
  for (const auto& model : models) names.push_back(model->model().name);
  Set(names, std::move(models));
}

void Models::Set(const std::vector<std::string>& names,
                 std::vector<std::unique_ptr<SampleQueue>> fresh) {
  if (names.empty()) throw InvalidArgument("models", "a server needs at least one");
  std::vector<Entry> made;
  for (auto& queue : fresh) made.emplace_back(std::move(queue));
  const std::lock_guard lock(mutex_);
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!seen.insert(name).second) {
      throw InvalidArgument("models", "two have the name \"" + name + '"');
    }
    if (std::ranges::find(made, name, &Entry::name) == made.end() &&
        std::ranges::find(served_, name, &Entry::name) == served_.end()) {
      throw InvalidArgument("models", "none has the name \"" + name + '"');
    }
  }
  std::vector<Entry> next;
  next.reserve(names.size());
  former_.reserve(former_.size() + served_.size());
  for (const std::string& name : names) {
    auto* from = &made;
    auto at = std::ranges::find(made, name, &Entry::name);
    if (at == made.end()) {
      from = &served_;
      at = std::ranges::find(served_, name, &Entry::name);
    }
    next.push_back(std::move(*at));
    from->erase(at);
  }
  for (Entry& entry : served_) {
    entry.use.reset();
    former_.push_back(std::move(entry));
  }
  served_ = std::move(next);
}

void Models::FreeUnused() {
  std::vector<Entry> ended;  // destroyed after the lock is released: a queue joins its threads
  const std::lock_guard lock(mutex_);
  ended.reserve(former_.size());
  for (auto at = former_.begin(); at != former_.end();) {
    if (!*at->unused) {
      ++at;
      continue;
    }
    Figures last = FiguresOf(*at->queue);
    last.stats.workers = last.stats.failures = 0;
    last.stats.bulk_share = 0;
    AddTo(past_, at->name(), last);
    spdlog::info("model \"{}\", fingerprint {}: no dance uses it any more; it is unloaded",
                 at->name(), at->queue->model().fingerprint);
    ended.push_back(std::move(*at));
    at = former_.erase(at);
  }
  std::erase_if(past_, [this](const auto& model) {
    const auto has_name = [&](const Entry& entry) { return entry.name() == model.first; };
    return std::ranges::none_of(served_, has_name) && std::ranges::none_of(former_, has_name);
  });
}

Models::Use Models::Find(const std::string& name, const std::string& field) const {
  const std::lock_guard lock(mutex_);
  std::string known;
  for (const Entry& entry : served_) {
    if (name.empty() || entry.name() == name) return entry.use;
    known += (known.empty() ? "\"" : ", \"") + entry.name() + '"';
  }
  if (name == kFormerControls) {
    spdlog::warn("{}: \"{}\" is the first model's former name; it takes controls, too", field,
                 name);
    return served_.front().use;
  }
  throw Error(ErrorCode::kNotFound, field, "no model \"" + name + "\"; this server has " + known);
}

std::vector<Models::Use> Models::served() const {
  const std::lock_guard lock(mutex_);
  std::vector<Use> served;
  for (const Entry& entry : served_) served.push_back(entry.use);
  return served;
}

std::map<std::string, Models::Figures> Models::figures() const {
  const std::lock_guard lock(mutex_);
  std::map<std::string, Figures> all = past_;
  for (const auto* entries : {&served_, &former_}) {
    for (const Entry& entry : *entries) AddTo(all, entry.name(), FiguresOf(*entry.queue));
  }
  return all;
}

int Models::transitions() const {
  int count = 0;
  for (const auto& [name, figures] : this->figures()) {
    count += figures.stats.active + figures.stats.waiting;
  }
  return count;
}

}  // namespace choreo
