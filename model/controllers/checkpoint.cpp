#include "model/controllers/checkpoint.h"

#include <torch/torch.h>

#include <nlohmann/json.hpp>

#include "model/controllers/random_controllers.h"
#include "model/core/error.h"
#include "model/flow/checkpoint.h"
#include "model/motion/skeleton_json.h"

namespace choreo {
namespace {

// Raised when the meaning of a stored tensor or field changes.
constexpr const char* kFormat = "choreo-controllers-1";
constexpr const char* kHashKey = "hash";

}  // namespace

bool HoldsControllers(const Safetensors& content) {
  const auto format = content.metadata.find("format");
  return format != content.metadata.end() && format->second.starts_with("choreo-controllers-");
}

ControllersCheckpoint ParseControllers(const Safetensors& content, const std::string& name) {
  const auto meta = [&](const std::string& key) -> const std::string& {
    const auto found = content.metadata.find(key);
    if (found == content.metadata.end()) {
      throw InvalidArgument(name, "not a choreo checkpoint: it has no '" + key + "'");
    }
    return found->second;
  };
  if (meta("format") != kFormat) {
    throw InvalidArgument(
        name, "format '" + meta("format") + "', but this build reads '" + kFormat + "'");
  }
  ControllersCheckpoint checkpoint;
  checkpoint.card = meta("card");
  checkpoint.hash = meta(kHashKey);
  const std::string actual = ContentHash(content, kHashKey);
  if (actual != checkpoint.hash) {
    throw InvalidArgument(name, "content hash " + actual + ", but the file states " +
                                    checkpoint.hash + ": it is damaged or was edited");
  }
  try {
    checkpoint.model =
        ControllersModel(nlohmann::json::parse(meta("config")).get<ControllersConfig>(),
                         SkeletonFromJson(meta("skeleton")));
    checkpoint.median_factors =
        nlohmann::json::parse(meta("median_factors")).get<std::array<double, kBodyParts>>();
  } catch (const std::exception& error) {  // of the JSON or of the skeleton in it
    throw InvalidArgument(name, std::string("its configuration can't be read: ") + error.what());
  }
  ImportTensors(content, "", checkpoint.model.get());
  checkpoint.model->eval();
  return checkpoint;
}

std::string SaveControllers(const std::filesystem::path& path, ControllersModel& model,
                            const std::array<double, kBodyParts>& median_factors,
                            const nlohmann::json& card) {
  Safetensors content;
  ExportTensors(*model, "", &content);
  content.metadata = {{"format", kFormat},
                      {"config", nlohmann::json(model->config()).dump()},
                      {"skeleton", SkeletonToJson(model->skeleton())},
                      {"median_factors", nlohmann::json(median_factors).dump()},
                      {"card", card.dump()}};
  const std::string hash = ContentHash(content, kHashKey);
  content.metadata[kHashKey] = hash;
  WriteSafetensors(path, content);
  return hash;
}

void WriteRandomControllers(const std::filesystem::path& path, const ControllersConfig& config,
                            const Skeleton& skeleton, uint64_t seed) {
  torch::manual_seed(seed);
  ControllersModel model(config, skeleton);
  torch::NoGradGuard no_grad;
  for (auto& parameter : model->parameters()) {
    // What starts as zero would hide everything before it.
    if (!parameter.any().item<bool>()) parameter.copy_(0.05 * torch::randn_like(parameter));
  }
  const int64_t others = skeleton.joints() - 1;
  model->SetNormalisation(torch::zeros({others, 3}), torch::full({others, 3}, 0.1),
                          torch::full({kBodyParts}, 0.01));
  SaveControllers(path, model, {0.01, 0.02, 0.02, 0.015, 0.015},
                  {{"licence", "none: random weights"}});
}

}  // namespace choreo
