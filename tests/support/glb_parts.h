#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace choreo::testing_support {

/// The parts of a .glb: header, JSON chunk, binary chunk.
struct Glb {
  nlohmann::json document;
  std::string binary;

  explicit Glb(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const auto word = [&](size_t at) {
      uint32_t value;
      std::memcpy(&value, bytes.data() + at, 4);
      return value;
    };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(4), 2u);
    EXPECT_EQ(word(8), bytes.size());
    const uint32_t length = word(12);
    document = nlohmann::json::parse(bytes.substr(20, length));
    if (bytes.size() > 28 + length) binary = bytes.substr(28 + length);
  }

  void Write(const std::filesystem::path& path) const {
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::ofstream file(path, std::ios::binary);
    const auto word = [&](size_t value) {
      const auto narrow = static_cast<uint32_t>(value);
      file.write(reinterpret_cast<const char*>(&narrow), 4);
    };
    file << "glTF";
    word(2), word(28 + text.size() + binary.size()), word(text.size());
    file << "JSON" << text;
    word(binary.size());
    file << std::string("BIN\0", 4) << binary;
  }

  /// The elements of a float accessor.
  std::vector<float> Floats(int accessor) const {
    const nlohmann::json& one = document["accessors"][accessor];
    const nlohmann::json& view = document["bufferViews"][one["bufferView"].get<int>()];
    std::vector<float> values(view["byteLength"].get<size_t>() / sizeof(float));
    std::memcpy(values.data(), binary.data() + view.value("byteOffset", size_t{0}),
                values.size() * sizeof(float));
    return values;
  }
  int Node(const std::string& name) const {
    const nlohmann::json& nodes = document["nodes"];
    for (size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i].value("name", "") == name) return static_cast<int>(i);
    return -1;
  }
};

}  // namespace choreo::testing_support
