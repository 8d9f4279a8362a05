#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <thread>

#include "model/core/error.h"
#include "model/flow/checkpoint/checkpoint.h"
#include "model/training/clips/clip_statistics.h"
#include "model/training/flow_matching/flow_matching.h"
#include "model/training/flow_matching/flow_statistics.h"
#include "model/training/flow_matching/flow_training.h"
#include "model/training/trainer/trainer.h"
#include "model/training/trainer/training_run.h"
#include "model/training/windows/window_clips.h"
#include "model/training/windows/window_figures.h"

namespace choreo {
namespace {

// Adapts another model's weights to the styles of `model`: a style that both have keeps its
// weights, a new one begins at zero.
void KeepStyles(const std::vector<std::string>& before, const ContinuousFlowImpl& model,
                Safetensors* weights) {
  const std::vector<std::string>& styles = model.config().styles;
  if (styles == before) return;
  // Measured again for this data.
  ExportTensor("energy_prior", model.named_buffers()["energy_prior"], weights);
  const std::string name = "condition_in.weight";  // its inputs end with style, then time
  const torch::Tensor to = torch::zeros_like(model.named_parameters()[name]);
  NamedTensor& held = weights->tensors.at(name);
  const torch::Tensor from = torch::from_blob(held.data.data(), held.shape);
  const int64_t first = WholeFeatures(model.skeleton(), model.config()) - std::ssize(styles);
  const int64_t time = to.size(1) - first - std::ssize(styles);
  to.narrow(1, 0, first).copy_(from.narrow(1, 0, first));
  for (int64_t i = 0; i < std::ssize(styles); ++i) {
    const auto found = std::ranges::find(before, styles[i]);
    if (found != before.end())
      to.select(1, first + i).copy_(from.select(1, first + (found - before.begin())));
  }
  to.narrow(1, first + std::ssize(styles), time)
      .copy_(from.narrow(1, first + std::ssize(before), time));
  ExportTensor(name, to, weights);
}

class FlowMatchingRun : public TrainingRun {
 public:
  FlowMatchingRun(const TrainOptions& options, const TrainingClips& clips,
                  const FlowTraining& training)
      : TrainingRun(options, clips),
        training_(training),
        device_(options.device),
        train_(clips.train),
        validation_(clips.validation) {
    ContinuousFlowConfig config;
    if (!options.name.empty()) config.name = options.name;
    config.styles = train_.styles();
    config.median_factors = MedianFactors(train_.tracks());
    model_ = ContinuousFlow(config, train_.skeleton());
    if (!options.from.empty()) {
      const auto base = ParseContinuousFlow(ReadSafetensors(options.from), options.from.string());
      StartFrom(base);
      if (options.keep_statistics && base.model->config().styles != config.styles)
        throw InvalidArgument("--keep-statistics", "the recordings have other styles than --from");
      config.median_factors = base.model->config().median_factors;
      model_ = ContinuousFlow(config, train_.skeleton());
      ExportTensors(*base.model, "", &from_);
      KeepStyles(base.model->config().styles, *model_, &from_);
      ImportTensors(from_, "", model_.get());
    }
    model_->to(device_);
    average_ = ContinuousFlow(config, train_.skeleton());
    average_->to(device_);
    average_->eval();
    Open(model_.get());
  }

 protected:
  // A resumed run restores this from its state.
  void Prepare() override {
    if (!options().keep_statistics) Measure();
    const FlowModelParts parts = model_->Parts();
    if (parts.prior.usual().facing == 0)
      model_->SetFacing(MeasureUsualPose(train_.skeleton(), train_.tracks()).facing);
    if (!parts.turns.known()) model_->SetTurns(MeasureTurns(train_.skeleton(), KeyedRequests()));
    if (!parts.curve.known())
      model_->SetCurve(MeasureCurve(train_.tracks(), model_->config().median_factors));
    matching_ = std::make_unique<FlowMatching>(model_);
    Copy(1);
  }

  void TrainStep() override {
    // Each batch has its own random numbers, so the result does not depend on how many are drawn
    // ahead.
    const size_t ahead = std::max(2U, std::thread::hardware_concurrency()) - 1;
    while (drawn_.size() < ahead) {
      const int64_t at = step() + std::ssize(drawn_);
      drawn_.push_back(std::async(std::launch::async, [this, at] { return Draw(at); }));
    }
    const WindowBatch batch = drawn_.front().get();
    drawn_.pop_front();
    Descend(matching_->Losses(model_, batch.To(device_)));
  }

  WindowBatch Draw(int64_t step) const {
    Random random = RandomOf(step);
    const int most = train_.Longest(model_->config().history_frames);
    const int frames = std::min(DrawLength(&random), most);
    WindowClips::Variation variation = training_.shares;
    variation.tempo = options().tempo;
    if (random.Uniform() < training_.no_labels)
      variation.beats = variation.path = variation.style = 0;
    int window = frames, to_key = frames;
    const double kind = random.Uniform();
    if (kind < training_.no_key) {
      variation.no_key = 1;
      window = to_key = std::min(std::max(frames, training_.no_key_frames), most);
    } else if (kind < training_.no_key + training_.far_key) {
      window = std::min(training_.far_frames, most);
      const auto nearer = static_cast<int>(random.Integer(0, training_.far_places));
      to_key = std::min(kSightFrames - training_.far_step * nearer, most);
    }
    return train_.Draw(matching_->parts(), WindowsOf(options().batch, window), window, to_key,
                       variation, &random);
  }

  void AfterStep() override {
    Copy(1 - std::min(training_.average, (1.0 + step()) / (10.0 + step())));
  }

  NamedFigures Validate() override {
    const torch::NoGradGuard no_grad;
    const auto network = MakeTorchFlowNetwork(Blended(), device_);
    return CompareWindows(*network, matching_->parts(), validation_, training_.validation_windows);
  }

  void Export(Safetensors* state) const override {
    TrainingRun::Export(state);
    ExportTensors(*average_, "average.", state);
  }
  void Import(const Safetensors& state) override {
    TrainingRun::Import(state);
    ImportTensors(state, "average.", average_.get());
    matching_ = std::make_unique<FlowMatching>(model_);
  }

  std::string SaveModel(const std::filesystem::path& path, const nlohmann::json& card) override {
    ContinuousFlow blended = Blended();
    blended->SetResponse(Response(blended));
    Safetensors weights;
    ExportTensors(*blended, "", &weights);
    for (auto& [name, tensor] : weights.tensors) {
      // Stores weights as bfloat16, in half the bytes and with the same figures. The prior stays
      // exact.
      if (name.ends_with(".weight")) RoundToBfloat16(&tensor);
    }
    return SaveContinuousFlow(path, blended, weights, card);
  }
  std::string Limits() const override {
    return "Trained on windows of up to " + std::to_string(training_.lengths.back()) +
           " frames at 30 fps; longer transitions are cut. It hears beats, not sounds. Feet slide "
           "without footwork. What the data lacks (lying, acrobatics, props, partners) it "
           "can't do.";
  }

 private:
  int DrawLength(Random* random) const {
    const auto which = random->Integer(0, std::ssize(training_.lengths));
    return training_.lengths[static_cast<size_t>(which)];
  }

  // Moves the average towards the weights by `share` of the difference.
  void Copy(double share) {
    const torch::NoGradGuard no_grad;
    const auto from = model_->parameters(), to = average_->parameters();
    for (size_t i = 0; i < from.size(); ++i) to[i].lerp_(from[i], share);
    for (size_t i = 0; i < model_->buffers().size(); ++i)
      average_->buffers()[i].copy_(model_->buffers()[i]);
  }

  // Measures the prior first: white coordinates need it, and their mixing needs its scaled powers.
  void Measure() {
    const int dimensions = 3 + 3 * train_.skeleton().joints();
    const Eigen::MatrixXd covariance =
        VelocityCovariance(train_.skeleton(), train_.tracks(), MotionPrior::kLags);
    const UsualPose usual = MeasureUsualPose(train_.skeleton(), train_.tracks());
    const auto set = [&](const VariancePowers& powers, const WindowStatistics& windows) {
      model_->SetPrior(covariance, powers, windows.mixing, windows.spread, usual);
    };
    const WindowStatistics none = {Eigen::MatrixXd::Identity(dimensions, dimensions),
                                   Eigen::VectorXd::Ones(dimensions)};
    set({}, none);
    const VariancePowers powers =
        MeasureVariancePowers(model_->Parts().prior, StatisticsBatches(1));
    set(powers, none);
    set(powers, MeasureWindows(StatisticsBatches(training_.shares.energy)));
    std::vector<WindowRequest> of_all_lengths;
    for (const int frames : training_.energy_frames) {
      for (WindowBatch& batch : StatisticsBatches(1, frames))
        std::ranges::move(batch.requests, std::back_inserter(of_all_lengths));
    }
    model_->SetEnergy(MeasureEnergy(model_->Parts(), of_all_lengths));
    model_->SetTurns({});
    model_->SetCurve({});
  }

  // The moving average, blended with the initial weights by the option `blend`.
  ContinuousFlow Blended() const {
    const torch::NoGradGuard no_grad;
    Safetensors weights;
    ExportTensors(*average_, "", &weights);
    const auto blend = static_cast<float>(options().blend);
    for (const auto& parameter : average_->named_parameters()) {
      if (blend == 1) break;
      std::vector<float>& trained = weights.tensors.at(parameter.key()).data;
      const std::vector<float>& before = from_.tensors.at(parameter.key()).data;
      std::ranges::transform(trained, before, trained.begin(),
                             [&](float to, float at) { return std::lerp(at, to, blend); });
    }
    ContinuousFlow blended(average_->config(), average_->skeleton());
    ImportTensors(weights, "", blended.get());
    blended->to(device_);
    blended->eval();
    return blended;
  }

  EnergyResponse Response(const ContinuousFlow& model) const {
    FlowModelParts parts = model->Parts();
    parts.response = {};
    std::vector<WindowRequest> requests;
    for (uint32_t i = 0; i < static_cast<uint32_t>(training_.response_batches); ++i) {
      Random random(kValidationSeed, i + 1);
      const int frames = std::min(60, validation_.Longest(parts.config.history_frames));
      WindowBatch batch =
          validation_.Draw(parts, training_.measured_windows, frames, frames,
                           {.no_key = i % 2 == 0 ? 0.0 : 1.0, .energy = 1}, &random);
      for (WindowRequest& request : batch.requests) {
        request.controls[kVelocityFactors].requested.assign(kBodyParts, true);
        requests.push_back(std::move(request));
      }
    }
    const torch::NoGradGuard no_grad;
    return MeasureResponse(parts, *MakeTorchFlowNetwork(model, device_), requests);
  }

  // Uses many windows, because dancers seldom turn far.
  std::vector<WindowRequest> KeyedRequests() const {
    std::vector<WindowRequest> requests;
    for (uint32_t i = 0; i < static_cast<uint32_t>(training_.turn_batches); ++i) {
      Random random(options().seed + 4, i + 1);
      const int frames =
          std::min(DrawLength(&random), train_.Longest(model_->config().history_frames));
      WindowBatch batch = train_.Draw(model_->Parts(), training_.measured_windows, frames, frames,
                                      {.mirror = 0.5, .tempo = options().tempo}, &random);
      std::ranges::move(batch.requests, std::back_inserter(requests));
    }
    return requests;
  }

  std::vector<WindowBatch> StatisticsBatches(double energy, int most = 60) const {
    const int frames = std::min(most, train_.Longest(model_->config().history_frames));
    std::vector<WindowBatch> batches;
    for (int i = 0; i < training_.prior_batches; ++i) {
      Random random(options().seed + 3, static_cast<uint32_t>(i + 1));
      batches.push_back(train_.Draw(
          model_->Parts(), training_.measured_windows, frames, frames,
          {.mirror = 0.5, .no_key = i % 3 == 0 ? 1.0 : 0.0, .energy = energy, .style = 1},
          &random));
    }
    return batches;
  }

  FlowTraining training_;
  torch::Device device_;
  WindowClips train_, validation_;
  ContinuousFlow model_{nullptr}, average_{nullptr};
  Safetensors from_;  // the weights that the run started with
  std::unique_ptr<FlowMatching> matching_;
  std::deque<std::future<WindowBatch>> drawn_;  // for this step and later ones; destroyed first
};

}  // namespace

void TrainContinuousFlow(const TrainOptions& options) { TrainContinuousFlow(options, {}); }

void TrainContinuousFlow(const TrainOptions& options, const FlowTraining& training) {
  TrainBy<FlowMatchingRun>(options, training);
}

}  // namespace choreo
