#include "model/core/files/safetensors.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::safetensors_test {

class SafetensorsTest : public testing::Test {
 protected:
  // A file of four floats with two tensors of these bytes.
  void Write(int a_begin, int a_end, int b_begin, int b_end) const {
    const auto entry = [](const char* name, int begin, int end) {
      return std::string("\"") + name + R"(":{"dtype":"F32","shape":[)" +
             std::to_string((end - begin) / 4) + R"(],"data_offsets":[)" + std::to_string(begin) +
             ',' + std::to_string(end) + "]}";
    };
    const std::string header =
        '{' + entry("a", a_begin, a_end) + ',' + entry("b", b_begin, b_end) + '}';
    const uint64_t bytes = header.size();
    const std::array<float, 4> data = {1, 2, 3, 4};
    std::ofstream file(path_, std::ios::binary);
    file.write(reinterpret_cast<const char*>(&bytes), 8) << header;
    file.write(reinterpret_cast<const char*>(data.data()), sizeof(data));
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "tensors";
};

TEST_F(SafetensorsTest, RoundTrips) {
  const Safetensors content = {
      {{"none", {{0, 3}, {}}}, {"one", {{1}, {7}}}, {"two", {{2, 2}, {1, 2, 3, 4}}}},
      {{"key", "value"}}};
  WriteSafetensors(path_, content);
  const Safetensors read = ReadSafetensors(path_);
  EXPECT_EQ(read.metadata, content.metadata);
  ASSERT_EQ(read.tensors.size(), 3U);
  for (const auto& [name, tensor] : content.tensors) {
    EXPECT_EQ(read.tensors.at(name).shape, tensor.shape) << name;
    EXPECT_EQ(read.tensors.at(name).data, tensor.data) << name;
  }
  EXPECT_EQ(ContentHash(read), ContentHash(content));
}

TEST_F(SafetensorsTest, Bfloat16ValuesTakeHalfTheBytes) {
  std::vector<float> fits(5001), exact(5001);
  for (size_t i = 0; i < fits.size(); ++i) {
    fits[i] = static_cast<float>(i % 200) * 0.25F - 20;
    exact[i] = 0.1F * static_cast<float>(i);
  }
  const Safetensors content = {{{"exact", {{5001}, exact}}, {"fits", {{5001}, fits}}}, {}};
  WriteSafetensors(path_, content);
  EXPECT_LT(std::filesystem::file_size(path_), 5001 * 6 + 300);
  const Safetensors read = ReadSafetensors(path_);
  EXPECT_EQ(read.tensors.at("fits").data, fits);
  EXPECT_EQ(read.tensors.at("exact").data, exact);
  EXPECT_EQ(ContentHash(read), ContentHash(content));
}

TEST_F(SafetensorsTest, TensorsMayBeInAnyOrder) {
  Write(8, 16, 0, 8);
  EXPECT_EQ(ReadSafetensors(path_).tensors.at("a").data, (std::vector<float>{3, 4}));
  Write(0, 16, 8, 8);  // an empty one lies nowhere
  EXPECT_EQ(ReadSafetensors(path_).tensors.at("b").data, std::vector<float>());
}

TEST_F(SafetensorsTest, OverlappingTensorsAreRefused) {
  const int overlaps[][4] = {{0, 8, 4, 12}, {4, 12, 0, 8}, {0, 16, 4, 8},
                             {4, 8, 0, 16}, {0, 8, 0, 8},  {4, 8, 4, 16}};
  for (const auto& [a, a_end, b, b_end] : overlaps) {
    Write(a, a_end, b, b_end);
    ExpectError(ErrorCode::kInvalidArgument, "tensor b at bytes", [&] { ReadSafetensors(path_); });
    ExpectError(ErrorCode::kInvalidArgument, "overlaps", [&] { ReadSafetensors(path_); });
  }
}

}  // namespace choreo::safetensors_test
