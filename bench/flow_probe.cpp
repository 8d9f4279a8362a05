#include "bench/flow_probe.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/core/files/safetensors.h"
#include "model/core/numbers/random.h"
#include "model/motion/skeleton_json.h"
#include "model/papers/samplers/packed_flow.h"

namespace choreo {
namespace {

constexpr int kRows = 3, kFrames = 3;

NamedTensor Zeros(std::vector<int64_t> shape) {
  int64_t count = 1;
  for (const int64_t extent : shape) count *= extent;
  return {std::move(shape), std::vector<float>(static_cast<size_t>(count))};
}

NamedTensor Normal(Random* random, std::vector<int64_t> shape, float size) {
  NamedTensor tensor = Zeros(std::move(shape));
  random->FillNormal(tensor.data);
  for (float& value : tensor.data) value *= size;
  return tensor;
}

/// A row of a tensor [kRows, ...].
std::span<float> Row(NamedTensor& tensor, int row) {
  const size_t width = tensor.data.size() / kRows;
  return {tensor.data.data() + static_cast<size_t>(row) * width, width};
}

}  // namespace

void WriteFlowProbe(const std::filesystem::path& checkpoint, const std::filesystem::path& out) {
  Safetensors model = ReadSafetensors(checkpoint);
  const auto config = nlohmann::json::parse(model.metadata.at("config")).get<FlowConfig>();
  const Skeleton skeleton = SkeletonFromJson(model.metadata.at("skeleton"));
  const PackedKernels& kernels = *PackedKernelsHere().front();
  const auto flow = std::make_shared<PackedFlow>(model, config, skeleton, kernels, kernels);
  const int width = flow->width;
  std::vector<PackedStepper> steppers;
  Random random(11);
  Safetensors probe;
  NamedTensor& condition = probe.tensors["static_condition"] =
      Normal(&random, {kRows, kFrames, flow->key_width}, 0.5F);
  for (int row = 0; row < kRows; ++row) {
    steppers.emplace_back(flow).StartTransition(
        Eigen::Map<const Eigen::MatrixXf>(Row(condition, row).data(), flow->key_width, kFrames));
  }
  for (int frame = 0; frame < kFrames; ++frame) {
    const std::string number = "." + std::to_string(frame);
    const auto add = [&](const char* name, NamedTensor tensor) -> NamedTensor& {
      return probe.tensors[name + number] = std::move(tensor);
    };
    NamedTensor& past = add("past", Normal(&random, {kRows, config.history_frames, width}, 0.1F));
    NamedTensor& audio =
        add("audio", Normal(&random, {kRows, config.history_frames + 1, config.audio_features}, 1));
    NamedTensor& has_audio = add("has_audio", Zeros({kRows}));
    NamedTensor& noise = add("noise", Zeros({kRows, width}));
    NamedTensor& features = add("features", Zeros({kRows, width}));
    NamedTensor& log_likelihood = add("log_likelihood", Zeros({kRows}));
    for (int row = 0; row < kRows; ++row) {
      has_audio.data[static_cast<size_t>(row)] = row == 1 ? 0.0F : 1.0F;
      const TransitionNoise drawn = {
          .seed = 11, .candidate = static_cast<uint32_t>(row), .temperature = 0.5};
      FlowFrame made = {.frame = frame,
                        .past = Row(past, row),
                        .audio = Row(audio, row),
                        .has_audio = row != 1,
                        .noise = &drawn,
                        .features = Row(features, row)};
      made.FillNoise(Row(noise, row));
      steppers[static_cast<size_t>(row)].Step(&made);
      log_likelihood.data[static_cast<size_t>(row)] = made.log_likelihood.value();
    }
  }
  WriteSafetensors(out, probe);
}

}  // namespace choreo
