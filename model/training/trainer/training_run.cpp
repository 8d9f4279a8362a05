#include "model/training/trainer/training_run.h"

#include <torch/autograd.h>
#include <torch/nn/module.h>
#include <torch/utils.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>
#include <utility>

#include "model/core/grid.h"
#include "model/flow/checkpoint/checkpoint.h"

namespace choreo {
namespace {

constexpr int64_t kWarmUpSteps = 200;
constexpr double kLastRate = 0.05;  // share of the peak learning rate at the end
constexpr double kForget = 0.02;    // decay of a loss's running mean, per step

// Warm-up, then a cosine to a twentieth of the peak.
double RateAt(double peak, int64_t step, int64_t steps) {
  const double warm = std::min(1.0, static_cast<double>(step + 1) / kWarmUpSteps);
  const double progress = static_cast<double>(step) / std::max<int64_t>(1, steps);
  return peak * warm * (kLastRate + (1 - kLastRate) * 0.5 * (1 + std::cos(M_PI * progress)));
}

// Options by name, parsed from the text of TrainOptions::Fixed; flags have empty values.
std::map<std::string, std::string> OptionsOf(const std::string& text) {
  std::map<std::string, std::string> options;
  std::istringstream words(text);
  std::string option;
  for (std::string word; words >> word;) {
    if (word.starts_with("--")) {
      options[option = word];
    } else {
      options[option] = word;
    }
  }
  return options;
}

// Whether a run with the options `before` may be resumed with `now`. Earlier versions also wrote
// unused options at their defaults.
bool IsSameRun(const std::string& before, const std::string& now) {
  const auto started = OptionsOf(before), requested = OptionsOf(now);
  for (const auto& [option, value] : requested) {
    const auto found = started.find(option);
    if (found == started.end() || found->second != value) return false;
  }
  return std::ranges::all_of(started, [&](const auto& item) {
    return !item.second.empty() || requested.contains(item.first);
  });
}

}  // namespace

int WindowsOf(int batch, int frames) {
  return std::max(8, batch * kTypicalFrames / std::max(frames, kTypicalFrames / 3));
}

TrainingRun::TrainingRun(const TrainOptions& options, const TrainingClips& clips)
    : options_(options), train_(clips.train), data_hash_(HashOfClips(clips.train)) {
  torch::manual_seed(options.seed);
}

void TrainingRun::Open(torch::nn::Module* network) {
  network_ = network;
  adam_ = std::make_unique<Adam>(*network);
  std::filesystem::create_directories(options_.run);
  if (!std::filesystem::exists(StatePath())) return;
  if (!options_.resume) {
    throw Error(ErrorCode::kFailedPrecondition, "--run",
                options_.run.string() + " holds a run already: --resume it or name another folder");
  }
  Load();
}

void TrainingRun::Export(Safetensors* state) const {
  ExportTensors(*network_, "model.", state);
  adam_->Export(state);
}

void TrainingRun::Import(const Safetensors& state) {
  ImportTensors(state, "model.", network_);
  adam_->Import(state);
}

void TrainingRun::Go() {
  const int64_t total = options_.steps;
  const int64_t last = options_.stop_after > 0 ? std::min(options_.stop_after, total) : total;
  ProgressBar progress("train " + options_.preset, std::max<int64_t>(last - step_, 0));
  const auto start = std::chrono::steady_clock::now();
  const double seconds_before = seconds_;
  if (step_ == 0) Prepare();
  for (; step_ < last; ++step_) {
    torch::manual_seed(options_.seed + static_cast<uint64_t>(step_) * 1000003);
    adam_->ZeroGrad();
    TrainStep();
    adam_->Step(RateAt(options_.rate, step_, total), options_.clip);
    AfterStep();
    seconds_ = seconds_before +
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    progress.Advance();
    if ((step_ + 1) % options_.report_every == 0 || step_ + 1 == total) {
      Report(&progress);
    } else if (step_ + 1 == last) {
      Save();
    }
  }
  if (last < total) return;
  if (hash_.empty()) {  // all steps were already done
    figures_ = Validate();
    WriteCheckpoint();
  }
  std::printf("checkpoint %s, content hash %s\n",
              (options_.run / "checkpoint.safetensors").string().c_str(), hash_.c_str());
}

void TrainingRun::Descend(const LossTerms& terms) {
  const bool report = (step_ + 1) % options_.report_every == 0;
  torch::Tensor sum;
  for (const LossTerm& term : terms) {
    LossFigure& figure = losses_[term.name];
    const double value = term.value.item<double>();
    figure.value = figure.value == 0 ? value : (1 - kForget) * figure.value + kForget * value;
    const torch::Tensor weighted = term.weight * term.value;
    if (report) {
      figure.gradient = NormOf(torch::autograd::grad(
          {weighted}, network_->parameters(), /*grad_outputs=*/{}, /*retain_graph=*/true,
          /*create_graph=*/false, /*allow_unused=*/true));
    }
    sum = sum.defined() ? sum + weighted : weighted;
  }
  sum.backward();
}

void TrainingRun::Report(ProgressBar* progress) {
  figures_ = Validate();
  std::string line = "step " + std::to_string(step_ + 1);
  for (const auto& [name, value] : figures_) {
    char text[64];
    std::snprintf(text, sizeof(text), " %s %.3f", name.c_str(), value);
    line += text;
  }
  progress->Print(line);
  curves_.Append(step_ + 1, seconds_, losses_, figures_);
  curves_.Write(options_.run);
  WriteCheckpoint();
  Save();
}

nlohmann::json TrainingRun::Card() const {
  std::map<std::string, int> sources, terms;
  int64_t frames = 0;
  for (const PreparedClip& clip : train_) {
    frames += std::ssize(clip.motion.frames);
    ++sources[clip.source];
    const auto stated = clip.notes.find("terms");
    ++terms[stated == clip.notes.end() ? "not stated" : stated->second];
  }
  // The terms of the base model apply, too.
  std::map<std::string, int> all_terms = terms;
  for (nlohmann::json base = base_; base.is_object() && base.contains("card");
       base = base.at("card").value("from", nlohmann::json())) {
    const auto data = base.at("card").value("data", nlohmann::json::object());
    const auto bound = data.value("clips_by_terms", nlohmann::json::object());
    for (const auto& [of, count] : bound.items())
      all_terms[of] = std::max(all_terms[of], count.get<int>());
  }
  std::string licence = "as the recordings that it was trained on allow:";
  for (const auto& [of, count] : all_terms)
    licence += " [" + std::to_string(count) + " clips] " + of + ";";
  nlohmann::json names = nlohmann::json::array();
  for (const auto& folder : options_.data) names.push_back(folder.filename().string());
  licence.back() = '.';
  nlohmann::json card = {{"preset", options_.preset},
                         {"data",
                          {{"names", names},
                           {"clips_by_layout", sources},
                           {"clips_by_terms", terms},
                           {"frames", frames},
                           {"hash", data_hash_}}},
                         {"licence", licence},
                         {"command", options_.Command()},
                         {"validation", std::map(figures_.begin(), figures_.end())},
                         {"limits", Limits()}};
  if (!base_.is_null()) card["from"] = base_;
  return card;
}

std::string TrainingRun::BaseHash() const {
  return base_.is_null() ? "" : base_.at("hash").get<std::string>();
}

void TrainingRun::WriteCheckpoint() {
  hash_ = SaveModel(options_.run / "checkpoint.safetensors", Card());
}

void TrainingRun::Save() {
  Safetensors state;
  Export(&state);
  state.metadata["step"] = std::to_string(step_ + 1);
  state.metadata["seconds"] = std::to_string(seconds_);
  state.metadata["data"] = data_hash_;
  state.metadata["from"] = BaseHash();
  state.metadata["options"] = options_.Fixed();
  state.metadata["curves"] = curves_.Serialise();
  nlohmann::json losses;
  for (const auto& [name, figure] : losses_) losses[name] = {figure.value, figure.gradient};
  state.metadata["losses"] = losses.dump();
  WriteSafetensors(StatePath(), state);
}

void TrainingRun::Load() {
  const Safetensors state = ReadSafetensors(StatePath());
  if (state.metadata.at("data") != data_hash_) {
    throw Error(ErrorCode::kFailedPrecondition, StatePath().string(),
                "the run was started on other data (hash " + state.metadata.at("data") + ")");
  }
  // Compares hashes, because most checkpoints share a name.
  const auto from = state.metadata.find("from");
  const std::string base = from == state.metadata.end() ? "" : from->second;
  if (base != BaseHash()) {
    throw Error(ErrorCode::kFailedPrecondition, StatePath().string(),
                "the run was started from another checkpoint" +
                    (base.empty() ? " or from none" : " (hash " + base + ")"));
  }
  if (!IsSameRun(state.metadata.at("options"), options_.Fixed())) {
    throw Error(ErrorCode::kFailedPrecondition, StatePath().string(),
                "the run was started as\n  " + state.metadata.at("options") + "\nnot as\n  " +
                    options_.Fixed());
  }
  Import(state);
  step_ = std::stoll(state.metadata.at("step"));
  seconds_ = std::stod(state.metadata.at("seconds"));
  curves_.Restore(state.metadata.at("curves"));
  const auto losses = nlohmann::json::parse(state.metadata.at("losses"));
  for (const auto& [name, figure] : losses.items()) losses_[name] = {figure.at(0), figure.at(1)};
}

}  // namespace choreo
