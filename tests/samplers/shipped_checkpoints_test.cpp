#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "model/samplers/samplers.h"
#include "tests/samplers/sampled.h"
#include "tests/support/load_checkpoint.h"

// The properties of every checkpoint in model/checkpoints, with any network.
namespace choreo::shipped_checkpoints_test {

constexpr std::uintmax_t kMaxBytes = 16'000'000;  // bytes

std::map<std::string, std::filesystem::path> Shipped() {
  std::map<std::string, std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(CHOREO_SOURCE_DIR) / "model/checkpoints")) {
    if (entry.path().extension() == ".safetensors") files[entry.path().stem()] = entry.path();
  }
  return files;
}

TEST(ShippedCheckpoints, AreSmallBearTheirNamesAndCardsAndDance) {
  const auto files = Shipped();
  ASSERT_TRUE(files.contains("default") && files.contains("free"));
  for (const auto& [name, path] : files) {
    SCOPED_TRACE(name);
    EXPECT_LE(std::filesystem::file_size(path), kMaxBytes);
    const auto sampler = MakeSampler(path, {});
    EXPECT_EQ(sampler->model().name, name);
    const auto card = nlohmann::json::parse(sampler->model().card);
    EXPECT_THAT(card.at("command").get<std::string>(), testing::HasSubstr("--seed"));
    EXPECT_NE(card.at("data").at("hash"), "");
    for (const Pose& pose : SampleNow(*sampler, RandomSpec(sampler->model(), 3, 30)).poses)
      EXPECT_TRUE(pose.rotations.allFinite() && pose.root_position.allFinite());
  }
}

// What it draws, x -> z -> x in float32.
TEST(ShippedCheckpoints, PaperFsFlowIsInvertible) {
  const torch::NoGradGuard no_grad;
  torch::manual_seed(2);
  const Checkpoint checkpoint = LoadCheckpoint(Shipped().at("paper-f"));
  FlowModel model = checkpoint.model;
  CouplingFlow flow = model->flow();
  constexpr int64_t kDances = 4, kFrames = 40;
  const int64_t condition = model->config().condition_width + 3 + 3 * model->skeleton().joints();
  const torch::Tensor told = torch::randn({kDances, kFrames, condition});
  const auto inverse = model->InverseWeights();
  const auto draw = [&](const torch::Tensor& z) {
    FlowState state = flow->InitialState(kDances);
    std::vector<torch::Tensor> x;
    for (int64_t t = 0; t < kFrames; ++t)
      x.push_back(flow->Inverse(z.narrow(1, t, 1), told.narrow(1, t, 1), inverse, &state, nullptr));
    return torch::cat(x, 1);
  };
  const torch::Tensor x = draw(torch::randn({kDances, kFrames, model->feature_width()}));
  FlowState state = flow->InitialState(kDances);
  torch::Tensor log_det = torch::zeros({kDances, kFrames});
  const torch::Tensor z = flow->Forward(x, told, &state, &log_det);
  EXPECT_GT((z - x).abs().mean().item<double>(), 0.5);  // it has learnt something
  EXPECT_LE((draw(z) - x).abs().max().item<double>(), 1e-4);
}

TEST(ShippedCheckpoints, TheFreeOneNamesFreeDataAlone) {
  const auto sampler = MakeSampler(Shipped().at("free"), {});
  nlohmann::json card = nlohmann::json::parse(sampler->model().card);
  for (; true; card = nlohmann::json(card["from"]["card"])) {  // and all that it went on from
    const auto& terms = card.at("data").at("clips_by_terms");
    EXPECT_FALSE(terms.empty());
    for (const auto& [of, clips] : terms.items())
      EXPECT_THAT(of, testing::HasSubstr("CMU Graphics Lab Motion Capture Database"));
    if (!card.contains("from")) break;
  }
}

TEST(ShippedCheckpoints, LicenceCoversPretrainedModels) {
  const auto sampler = MakeSampler(Shipped().at("default"), {});
  nlohmann::json card = nlohmann::json::parse(sampler->model().card);
  int runs = 0;
  for (; true; ++runs) {
    for (const auto& [of, clips] : card.at("data").at("clips_by_terms").items())
      EXPECT_THAT(sampler->model().licence, testing::HasSubstr(of));
    if (!card.contains("from")) break;
    card = nlohmann::json(card.at("from").at("card"));
  }
  EXPECT_GT(runs, 1);
}

}  // namespace choreo::shipped_checkpoints_test
