#include "model/training/training_run.h"

#include <torch/torch.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "model/core/error.h"
#include "model/core/progress.h"

namespace choreo {
namespace {

constexpr int64_t kWarmUpSteps = 200;
constexpr double kLastRate = 0.05;  // share of the peak learning rate at the end of a stage
constexpr int kTypicalFrames = 60;
constexpr double kForget = 0.02;  // of a loss's running mean, a step

double GradientNorm(const torch::Tensor& loss, const std::vector<torch::Tensor>& parameters) {
  double square = 0;
  for (const auto& gradient :
       torch::autograd::grad({loss}, parameters, /*grad_outputs=*/{}, /*retain_graph=*/true,
                             /*create_graph=*/false, /*allow_unused=*/true)) {
    if (gradient.defined()) square += gradient.square().sum().item<double>();
  }
  return std::sqrt(square);
}

}  // namespace

int WindowsOf(int batch, int frames) {
  return std::max(8, batch * kTypicalFrames / std::max(frames, kTypicalFrames / 3));
}

double StageRate(double peak, int64_t step, int64_t steps) {
  const double warm = std::min(1.0, static_cast<double>(step + 1) / kWarmUpSteps);
  const double progress =
      static_cast<double>(step) / static_cast<double>(std::max<int64_t>(1, steps));
  return peak * warm * (kLastRate + (1 - kLastRate) * 0.5 * (1 + std::cos(M_PI * progress)));
}

TrainingRun::TrainingRun(const TrainOptions& options, std::string data_hash)
    : options_(options), data_hash_(std::move(data_hash)) {}

void TrainingRun::Open() {
  std::filesystem::create_directories(options_.run);
  if (!std::filesystem::exists(StatePath())) return;
  if (!options_.resume) {
    throw Error(ErrorCode::kFailedPrecondition, "--run",
                options_.run.string() + " holds a run already: --resume it or name another folder");
  }
  Load();
}

void TrainingRun::NameLosses(const std::vector<std::string>& names) {
  for (const std::string& name : names) losses_.terms[name];
}

void TrainingRun::Go() {
  const int64_t total = total_steps();
  ProgressBar progress("train " + options_.preset, total - step_);
  const auto start = std::chrono::steady_clock::now();
  const double seconds_before = seconds_;
  for (; step_ < total; ++step_) {
    losses_.step = step_ + 1;
    TrainStep();
    seconds_ = seconds_before +
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    progress.Advance();
    const bool stop = step_ + 1 == options_.stop_after;
    if ((step_ + 1) % options_.report_every == 0 || step_ + 1 == total) {
      Report();
    } else if (stop) {
      Save();
    }
    if (stop) return;
  }
  Finish();
}

void TrainingRun::Descend(const LossTerms& terms, const std::vector<torch::Tensor>& parameters) {
  const bool report = (step_ + 1) % options_.report_every == 0;
  torch::Tensor sum;
  for (const LossTerm& term : terms) {
    LossFigure& figure = losses_.terms[term.name];
    const double value = term.value.item<double>();
    figure.value = figure.value == 0 ? value : (1 - kForget) * figure.value + kForget * value;
    const torch::Tensor weighted = term.weight * term.value;
    if (report) figure.gradient = GradientNorm(weighted, parameters);
    sum = sum.defined() ? sum + weighted : weighted;
  }
  sum.backward();
}

void TrainingRun::Report() {
  curves_.Append(losses_, seconds_, Validate());
  curves_.Write(options_.run);
  WriteInterim();
  Save();
}

void TrainingRun::Save() {
  Safetensors state;
  Export(&state);
  state.metadata["step"] = std::to_string(step_ + 1);
  state.metadata["seconds"] = std::to_string(seconds_);
  state.metadata["data"] = data_hash_;
  state.metadata["options"] = options_.Fixed();
  state.metadata["curves"] = curves_.Serialise();
  nlohmann::json losses;
  for (const auto& [name, figure] : losses_.terms) losses[name] = {figure.value, figure.gradient};
  state.metadata["losses"] = losses.dump();
  WriteSafetensors(StatePath(), state);
}

void TrainingRun::Load() {
  const Safetensors state = ReadSafetensors(StatePath());
  if (state.metadata.at("data") != data_hash_) {
    throw Error(ErrorCode::kFailedPrecondition, StatePath().string(),
                "the run was started on other data (hash " + state.metadata.at("data") + ")");
  }
  if (state.metadata.at("options") != options_.Fixed()) {
    throw Error(ErrorCode::kFailedPrecondition, StatePath().string(),
                "the run was started as\n  " + state.metadata.at("options") + "\nnot as\n  " +
                    options_.Fixed());
  }
  Import(state);
  step_ = std::stoll(state.metadata.at("step"));
  seconds_ = std::stod(state.metadata.at("seconds"));
  curves_.Restore(state.metadata.at("curves"));
  const auto losses = nlohmann::json::parse(state.metadata.at("losses"));
  for (const auto& [name, figure] : losses.items()) {
    losses_.terms[name] = {figure.at(0), figure.at(1)};
  }
}

}  // namespace choreo
