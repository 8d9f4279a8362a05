#include "server/calls/frame_budget.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "model/plan/takes.h"
#include "server/messages/refusal.h"

namespace choreo {
namespace {

/// Time to make a transition's frames, if possible.
constexpr double kTransitionSeconds = 10;

std::string Percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

}  // namespace

void FrameBudget::ReserveDance(const void* call, const SampleQueue& model,
                               const std::string& caller) {
  Reserve(call, {&model, caller, model.model().fps, true});
}

void FrameBudget::ReserveTransition(const void* call, const SampleQueue& model,
                                    const std::string& caller, int frames) {
  double frames_per_second = frames / kTransitionSeconds;
  const FrameShares shares = this->shares();
  const double most = std::min(shares.of_all, shares.of_lone_caller) / 2;
  const double load = model.LoadOf(frames_per_second);
  if (load > most) frames_per_second *= most / load;
  Reserve(call, {&model, caller, frames_per_second, false, model.LoadOf(frames)});
}

double FrameBudget::SecondsToRoom() const {
  const std::lock_guard lock(mutex_);
  std::optional<Seconds> least;
  for (const auto& [call, charge] : charges_) {
    if (charge.dances) continue;
    const Seconds left = charge.ends - time_.Now();
    least = std::min(left, least.value_or(left));
  }
  return least ? std::max(0.0, least->count()) : 0;
}

FrameBudget::Seconds FrameBudget::TimeFor(double work) const {
  constexpr double kLeastFree = 0.1;
  double danced = 0;
  Seconds before(0);
  for (const auto& [call, charge] : charges_) {
    if (charge.dances) {
      danced += LoadOf(charge);
    } else {
      before = std::max<Seconds>(before, charge.ends - time_.Now());
    }
  }
  return before + Seconds(work / std::max(kLeastFree, 1 - danced));
}

void FrameBudget::Reserve(const void* call, Charge charge) {
  const FrameShares shares = this->shares();
  const double of_caller = MostOf(shares, charge.caller, LoadOf(charge));
  const std::lock_guard lock(mutex_);
  const auto require = [&](const std::string* caller, double most) {
    const double taken = LoadOf(caller), load = LoadOf(caller, &charge);
    if (taken == 0 || load <= most) return;
    throw Refused(caller ? Refusal::kLoadOfPeer : Refusal::kLoad,
                  "the server is busy: " + (caller ? *caller + " has " : "calls have ") +
                      Percent(taken) + " of its time, with this one it would be " + Percent(load) +
                      ", of at most " + Percent(most) + (caller ? " for one caller" : ""));
  };
  if (shares.of_all <= 1) {
    require(nullptr, MostOfAll(shares, &charge));
    require(&charge.caller, of_caller);
  }
  if (!charge.dances) {
    only_danced_ = false;
    charge.ends = time_.Now() + std::chrono::duration_cast<Clock::duration>(TimeFor(charge.work));
  }
  charges_.emplace(call, std::move(charge));
}

void FrameBudget::GiveBack(const void* call) noexcept {
  const std::lock_guard lock(mutex_);
  charges_.erase(call);
}

bool FrameBudget::OnlyDanced() {
  const std::lock_guard lock(mutex_);
  const bool none =
      std::ranges::all_of(charges_, [](const auto& one) { return one.second.dances; });
  return std::exchange(only_danced_, none) && none;
}

std::map<std::string, double> FrameBudget::loads() const {
  const std::lock_guard lock(mutex_);
  std::map<std::string, double> loads;
  for (const auto& [call, charge] : charges_) loads[charge.model->model().name] += LoadOf(charge);
  return loads;
}

double FrameBudget::LoadOf(const Charge& charge) const {
  const double engine = charge.model->LoadOf(charge.frames_per_second);
  return charge.dances && serving_ ? engine + serving_->LoadOf(charge.frames_per_second) : engine;
}

double FrameBudget::LoadOf(const std::string* caller, const Charge* more) const {
  // Sums frames first and multiplies by their cost afterwards, so that equal calls add up exactly.
  std::map<const SampleQueue*, double> frames;
  double danced = 0;
  const auto add = [&](const Charge& charge) {
    frames[charge.model] += charge.frames_per_second;
    if (charge.dances) danced += charge.frames_per_second;
  };
  for (const auto& [call, charge] : charges_) {
    if (!caller || charge.caller == *caller) add(charge);
  }
  if (more) add(*more);
  double load = serving_ ? serving_->LoadOf(danced) : 0;
  for (const auto& [model, of_model] : frames) load += model->LoadOf(of_model);
  return load;
}

double FrameBudget::MostOfAll(const FrameShares& shares, const Charge* more) const {
  double costliest = 0;
  const auto add = [&](const Charge& charge) {
    if (charge.dances)
      costliest = std::max(costliest, charge.model->LoadOf(charge.frames_per_second));
  };
  for (const auto& [call, charge] : charges_) add(charge);
  if (more) add(*more);
  return std::min(shares.of_all, 1 - (kMaxTakes - 1) * costliest);
}

double FrameBudget::MostOf(const FrameShares& shares, const std::string& caller,
                           double cost) const {
  if (!has_rival_ || !has_rival_(caller)) return shares.of_lone_caller;
  return std::min(shares.of_caller, shares.of_all - cost);
}

FrameShares FrameBudget::shares() const {
  const std::lock_guard lock(mutex_);
  return shares_;
}

void FrameBudget::SetShares(const FrameShares& shares) {
  const std::lock_guard lock(mutex_);
  shares_ = shares;
}

double FrameBudget::utilisation() const {
  const FrameShares shares = this->shares();
  if (shares.of_all > 1) return 0;
  struct Sum {
    double load = 0, largest = 0;
    void Add(double more) {
      load += more;
      largest = std::max(largest, more);
    }
    double OfMost(double most) const { return load + largest > most ? 1 : load / most; }
  };
  Sum all;
  std::map<std::string, Sum> of_caller;
  double most_of_all = 0;
  {
    const std::lock_guard lock(mutex_);
    most_of_all = MostOfAll(shares);
    for (const auto& [call, charge] : charges_) {
      const double load = LoadOf(charge);
      all.Add(load);
      of_caller[charge.caller].Add(load);
    }
  }
  double most = all.load > 0 ? all.OfMost(most_of_all) : 0;
  for (const auto& [caller, sum] : of_caller) {
    if (sum.load > 0) most = std::max(most, sum.OfMost(MostOf(shares, caller, sum.largest)));
  }
  return most;
}

}  // namespace choreo
