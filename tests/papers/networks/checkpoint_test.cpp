#include "model/papers/networks/flow_checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "model/core/error.h"
#include "tests/support/load_checkpoint.h"

namespace choreo::checkpoint_test {

using testing::HasSubstr;

class CheckpointTest : public testing::Test {
 protected:
  void SetUp() override {
    // Tests run beside each other.
    path_ = std::filesystem::path(testing::TempDir()) /
            (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
             ".safetensors");
    torch::manual_seed(2);
    FlowConfig config;
    config.flow_steps = 1;
    config.hidden = 8;
    config.condition_width = 8;
    model_ = FlowModel(config, Skeleton::Smpl24());
    hash_ = SaveCheckpoint(path_, model_, {{"data", "none: random weights of a test"}});
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::string FailureOfLoading() {
    try {
      LoadCheckpoint(path_);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path path_;
  FlowModel model_{nullptr};
  std::string hash_;
};

TEST_F(CheckpointTest, RoundTripsExactly) {
  const Checkpoint loaded = LoadCheckpoint(path_);
  EXPECT_EQ(loaded.hash, hash_);
  EXPECT_THAT(loaded.card, HasSubstr("random weights"));
  EXPECT_EQ(nlohmann::json(loaded.model->config()), nlohmann::json(model_->config()));
  EXPECT_EQ(loaded.model->skeleton().joint_names, model_->skeleton().joint_names);
  const auto expected = model_->named_parameters();
  ASSERT_FALSE(expected.is_empty());
  for (const auto& item : loaded.model->named_parameters()) {
    EXPECT_TRUE(torch::equal(item.value(), expected[item.key()])) << item.key();
  }
}

TEST_F(CheckpointTest, ATruncatedFileIsRefused) {
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 100);
  EXPECT_THAT(FailureOfLoading(), HasSubstr("truncated"));
}

TEST_F(CheckpointTest, AChangedWeightIsRefused) {
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(-2, std::ios::end);
  file.put(1);
  file.close();
  EXPECT_THAT(FailureOfLoading(), HasSubstr("content hash"));
}

TEST_F(CheckpointTest, AnotherFormatIsRefused) {
  Safetensors content = ReadSafetensors(path_);
  content.metadata["format"] = "choreo-flow-0";
  WriteSafetensors(path_, content);
  EXPECT_THAT(FailureOfLoading(), HasSubstr("choreo-flow-0"));
}

TEST_F(CheckpointTest, FormerFlowsAreRefusedByName) {
  const auto refusal_of = [this](const char* field, const nlohmann::json& value) {
    Safetensors content = ReadSafetensors(path_);
    nlohmann::json config = nlohmann::json::parse(content.metadata["config"]);
    config[field] = value;
    content.metadata["config"] = config.dump();
    content.metadata["hash"] = ContentHash(content, "hash");
    WriteSafetensors(path_, content);
    return FailureOfLoading();
  };
  EXPECT_EQ(refusal_of("recurrent", true), "");
  EXPECT_THAT(refusal_of("recurrent", false), HasSubstr("recurrent: false"));
  EXPECT_THAT(refusal_of("planner", {{"width", 160}}),
              HasSubstr("planner: networks around a planner"));
}

TEST_F(CheckpointTest, AForeignFileIsRefused) {
  std::ofstream(path_, std::ios::trunc) << "this is no checkpoint, just a line of text";
  EXPECT_THAT(FailureOfLoading(), HasSubstr("safetensors"));
  std::filesystem::remove(path_);
  EXPECT_THAT(FailureOfLoading(), HasSubstr("cannot be opened: No such file"));
}

}  // namespace choreo::checkpoint_test
