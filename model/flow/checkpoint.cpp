#include "model/flow/checkpoint.h"

#include <torch/torch.h>

#include <nlohmann/json.hpp>

#include "model/core/error.h"

namespace choreo {
namespace {

// Raised when the meaning of a stored tensor or field changes.
constexpr const char* kFormat = "choreo-flow-1";
constexpr const char* kHashKey = "hash";

}  // namespace

nlohmann::json SkeletonToJson(const Skeleton& skeleton) {
  nlohmann::json offsets = nlohmann::json::array();
  for (int j = 0; j < skeleton.joints(); ++j) {
    offsets.push_back({skeleton.offsets(0, j), skeleton.offsets(1, j), skeleton.offsets(2, j)});
  }
  return {{"name", skeleton.name},
          {"joint_names", skeleton.joint_names},
          {"parents", skeleton.parents},
          {"offsets_m", offsets},
          {"pelvis_height_m", skeleton.pelvis_height},
          {"hips", {skeleton.left_hip, skeleton.right_hip}},
          {"knees", {skeleton.left_knee, skeleton.right_knee}},
          {"shoulders", {skeleton.left_shoulder, skeleton.right_shoulder}},
          {"elbows", {skeleton.left_elbow, skeleton.right_elbow}},
          {"feet", skeleton.feet}};
}

Skeleton SkeletonFromJson(const nlohmann::json& json) {
  Skeleton skeleton;
  json.at("name").get_to(skeleton.name);
  json.at("joint_names").get_to(skeleton.joint_names);
  json.at("parents").get_to(skeleton.parents);
  const auto& offsets = json.at("offsets_m");
  skeleton.offsets.resize(3, static_cast<Eigen::Index>(offsets.size()));
  for (size_t j = 0; j < offsets.size(); ++j) {
    for (size_t axis = 0; axis < 3; ++axis) {
      skeleton.offsets(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(j)) =
          offsets[j].at(axis).get<double>();
    }
  }
  json.at("pelvis_height_m").get_to(skeleton.pelvis_height);
  const auto pair = [&](const char* key, int* left, int* right) {
    *left = json.at(key).at(0).get<int>();
    *right = json.at(key).at(1).get<int>();
  };
  pair("hips", &skeleton.left_hip, &skeleton.right_hip);
  pair("knees", &skeleton.left_knee, &skeleton.right_knee);
  pair("shoulders", &skeleton.left_shoulder, &skeleton.right_shoulder);
  pair("elbows", &skeleton.left_elbow, &skeleton.right_elbow);
  json.at("feet").get_to(skeleton.feet);
  skeleton.Validate();
  return skeleton;
}

void ExportTensors(const torch::nn::Module& module, const std::string& prefix,
                   Safetensors* content) {
  const auto add = [&](const std::string& name, const torch::Tensor& value) {
    const torch::Tensor dense = value.detach().to(torch::kCPU, torch::kFloat32).contiguous();
    NamedTensor tensor;
    tensor.shape = dense.sizes().vec();
    tensor.data.assign(dense.data_ptr<float>(), dense.data_ptr<float>() + dense.numel());
    content->tensors[prefix + name] = std::move(tensor);
  };
  for (const auto& item : module.named_parameters()) add(item.key(), item.value());
  for (const auto& item : module.named_buffers()) add(item.key(), item.value());
}

void ImportTensors(const Safetensors& content, const std::string& prefix,
                   torch::nn::Module* module) {
  torch::NoGradGuard no_grad;
  const auto take = [&](const std::string& name, torch::Tensor value) {
    const auto found = content.tensors.find(prefix + name);
    if (found == content.tensors.end()) {
      throw InvalidArgument(prefix + name, "the file has no such tensor");
    }
    const NamedTensor& tensor = found->second;
    if (tensor.shape != value.sizes().vec()) {
      throw InvalidArgument(prefix + name, "its shape does not fit the configuration");
    }
    value.copy_(
        torch::from_blob(const_cast<float*>(tensor.data.data()), tensor.shape, torch::kFloat32));
  };
  for (auto& item : module->named_parameters()) take(item.key(), item.value());
  for (auto& item : module->named_buffers()) take(item.key(), item.value());
}

std::string SaveCheckpoint(const std::filesystem::path& path, FlowModel& model,
                           const nlohmann::json& card) {
  Safetensors content;
  ExportTensors(*model, "", &content);
  content.metadata = {{"format", kFormat},
                      {"config", nlohmann::json(model->config()).dump()},
                      {"skeleton", SkeletonToJson(model->skeleton()).dump()},
                      {"card", card.dump()}};
  const std::string hash = ContentHash(content, kHashKey);
  content.metadata[kHashKey] = hash;
  WriteSafetensors(path, content);
  return hash;
}

Checkpoint LoadCheckpoint(const std::filesystem::path& path) {
  const Safetensors content = ReadSafetensors(path);
  const auto meta = [&](const std::string& key) -> const std::string& {
    const auto found = content.metadata.find(key);
    if (found == content.metadata.end()) {
      throw InvalidArgument(path.string(), "not a choreo checkpoint: it has no '" + key + "'");
    }
    return found->second;
  };
  if (meta("format") != kFormat) {
    throw InvalidArgument(
        path.string(), "format '" + meta("format") + "', but this build reads '" + kFormat + "'");
  }
  Checkpoint checkpoint;
  checkpoint.card = meta("card");
  checkpoint.hash = meta(kHashKey);
  const std::string actual = ContentHash(content, kHashKey);
  if (actual != checkpoint.hash) {
    throw InvalidArgument(path.string(), "content hash " + actual + ", but the file states " +
                                             checkpoint.hash + ": it is damaged or was edited");
  }
  try {
    checkpoint.model = FlowModel(nlohmann::json::parse(meta("config")).get<FlowConfig>(),
                                 SkeletonFromJson(nlohmann::json::parse(meta("skeleton"))));
  } catch (const nlohmann::json::exception& error) {
    throw InvalidArgument(path.string(),
                          std::string("its configuration can't be read: ") + error.what());
  }
  ImportTensors(content, "", checkpoint.model.get());
  checkpoint.model->eval();
  return checkpoint;
}

}  // namespace choreo
