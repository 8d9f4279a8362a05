#include "model/core/files/safetensors.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"

namespace choreo {
namespace {

static_assert(std::endian::native == std::endian::little, "safetensors are little-endian");

// A real checkpoint's header is a few tens of KiB; a longer one means a foreign or damaged file.
constexpr uint64_t kMaxHeaderBytes = 16U << 20U;

int64_t ElementCount(const std::vector<int64_t>& shape) {
  int64_t count = 1;
  for (const int64_t extent : shape) {
    if (extent < 0 || (extent > 0 && count > (int64_t{1} << 40) / extent)) return -1;
    count *= extent;
  }
  return count;
}

// Storing smaller tensors as bfloat16 saves too little.
constexpr size_t kMinHalved = 4096;

// Whether every value is exact in bfloat16, the upper half of a float.
bool IsBfloat16(const NamedTensor& tensor) {
  return tensor.data.size() >= kMinHalved && std::ranges::all_of(tensor.data, [](float value) {
           return (std::bit_cast<uint32_t>(value) & 0xFFFFU) == 0;
         });
}

std::vector<uint16_t> UpperHalves(const std::vector<float>& values) {
  std::vector<uint16_t> halves;
  for (const float value : values)
    halves.push_back(static_cast<uint16_t>(std::bit_cast<uint32_t>(value) >> 16U));
  return halves;
}

class SafetensorsReader {
 public:
  explicit SafetensorsReader(const std::filesystem::path& path)
      : name_(path.string()), file_(path, std::ios::binary) {
    if (!file_) {
      throw Error(ErrorCode::kNotFound, name_,
                  "cannot be opened: " + std::generic_category().message(errno));
    }
    file_bytes_ = std::filesystem::file_size(path);
  }

  Safetensors Read() {
    const std::string header = ReadHeader();
    Safetensors content;
    try {
      const nlohmann::json entries = nlohmann::json::parse(header);
      for (const auto& [name, entry] : entries.items()) {
        if (name == "__metadata__") {
          content.metadata = entry.get<std::map<std::string, std::string>>();
        } else {
          content.tensors.emplace(name, ReadTensor(name, entry));
        }
      }
    } catch (const nlohmann::json::exception& error) {
      throw Failure(std::string("its header is not the expected JSON (") + error.what() + ")");
    }
    return content;
  }

 private:
  Error Failure(const std::string& why) const {
    return InvalidArgument(name_, "not a usable safetensors file: " + why);
  }

  std::string ReadHeader() {
    uint64_t bytes = 0;
    if (!file_.read(reinterpret_cast<char*>(&bytes), 8)) throw Failure("shorter than 8 bytes");
    if (bytes > kMaxHeaderBytes || bytes + 8 > file_bytes_) {
      throw Failure("header of " + std::to_string(bytes) + " bytes in a file of " +
                    std::to_string(file_bytes_));
    }
    std::string header(bytes, '\0');
    file_.read(header.data(), static_cast<std::streamsize>(bytes));
    data_begin_ = 8 + bytes;
    return header;
  }

  NamedTensor ReadTensor(const std::string& name, const nlohmann::json& entry) {
    const bool halved = entry.at("dtype") == "BF16";
    if (!halved && entry.at("dtype") != "F32")
      throw Failure("tensor " + name + " is neither F32 nor BF16");
    const size_t width = halved ? sizeof(uint16_t) : sizeof(float);
    NamedTensor tensor;
    tensor.shape = entry.at("shape").get<std::vector<int64_t>>();
    const auto begin = entry.at("data_offsets").at(0).get<uint64_t>();
    const auto end = entry.at("data_offsets").at(1).get<uint64_t>();
    const int64_t count = ElementCount(tensor.shape);
    const uint64_t data_bytes = file_bytes_ - data_begin_;
    if (count < 0 || begin > end || end > data_bytes ||
        end - begin != static_cast<uint64_t>(count) * width) {
      throw Failure("tensor " + name + " at bytes " + std::to_string(begin) + " to " +
                    std::to_string(end) + " of " + std::to_string(data_bytes) +
                    " does not fit its shape (truncated?)");
    }
    Occupy(name, begin, end);
    tensor.data.resize(static_cast<size_t>(count));
    file_.seekg(static_cast<std::streamoff>(data_begin_ + begin));
    std::vector<uint16_t> halves(halved ? tensor.data.size() : 0);
    file_.read(halved ? reinterpret_cast<char*>(halves.data())
                      : reinterpret_cast<char*>(tensor.data.data()),
               static_cast<std::streamsize>(end - begin));
    for (size_t i = 0; i < halves.size(); ++i)
      tensor.data[i] = std::bit_cast<float>(static_cast<uint32_t>(halves[i]) << 16U);
    if (!file_) throw Failure("tensor " + name + " can't be read");
    return tensor;
  }

  // Refuses a tensor that overlaps the one before it or the one after it.
  void Occupy(const std::string& name, uint64_t begin, uint64_t end) {
    if (begin == end) return;
    const auto after = occupied_.lower_bound(begin);
    if ((after != occupied_.end() && after->first < end) ||
        (after != occupied_.begin() && std::prev(after)->second > begin)) {
      throw Failure("tensor " + name + " at bytes " + std::to_string(begin) + " to " +
                    std::to_string(end) + " overlaps another one");
    }
    occupied_.emplace(begin, end);
  }

  const std::string name_;
  std::ifstream file_;
  uint64_t file_bytes_ = 0, data_begin_ = 0;
  std::map<uint64_t, uint64_t> occupied_;  // ranges of the tensors so far: begin to end
};

}  // namespace

const NamedTensor& Safetensors::Get(const std::string& name,
                                    const std::vector<int64_t>& shape) const {
  const auto found = tensors.find(name);
  if (found == tensors.end()) throw InvalidArgument(name, "the file has no such tensor");
  if (found->second.shape != shape)
    throw InvalidArgument(name, "its shape does not fit the configuration");
  return found->second;
}

void RoundToBfloat16(NamedTensor* tensor) {
  for (float& value : tensor->data) {
    const auto bits = std::bit_cast<uint32_t>(value);
    if (std::isnan(value)) continue;
    // Rounds ties to even.
    value = std::bit_cast<float>((bits + 0x7FFFU + ((bits >> 16U) & 1U)) & 0xFFFF0000U);
  }
}

Safetensors ReadSafetensors(const std::filesystem::path& path) {
  return SafetensorsReader(path).Read();
}

void WriteSafetensors(const std::filesystem::path& path, const Safetensors& content) {
  nlohmann::json header;
  if (!content.metadata.empty()) header["__metadata__"] = content.metadata;
  uint64_t offset = 0;
  for (const auto& [name, tensor] : content.tensors) {
    const bool halved = IsBfloat16(tensor);
    const uint64_t bytes = tensor.data.size() * (halved ? sizeof(uint16_t) : sizeof(float));
    header[name] = {{"dtype", halved ? "BF16" : "F32"},
                    {"shape", tensor.shape},
                    {"data_offsets", {offset, offset + bytes}}};
    offset += bytes;
  }
  std::string text = header.dump();
  text.append((8 - text.size() % 8) % 8, ' ');  // tensors start 8-byte aligned
  const uint64_t header_bytes = text.size();

  AtomicFile beside(path);
  std::ofstream file(beside.partial(), std::ios::binary);
  const auto write = [&](const auto& values) {
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(values[0])));
  };
  file.write(reinterpret_cast<const char*>(&header_bytes), 8);
  write(text);
  for (const auto& [name, tensor] : content.tensors) {
    if (IsBfloat16(tensor)) {
      write(UpperHalves(tensor.data));
    } else {
      write(tensor.data);
    }
  }
  file.close();
  if (!file) throw Error(ErrorCode::kInternal, path.string(), "can't be written (disk full?)");
  beside.Commit();
}

std::string ContentHash(const Safetensors& content, const std::string& without) {
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  const auto add = [&](const void* data, size_t bytes) {
    const uint64_t length = bytes;  // lengths keep neighbouring fields apart
    XXH3_128bits_update(&state, &length, sizeof(length));
    XXH3_128bits_update(&state, data, bytes);
  };
  for (const auto& [key, value] : content.metadata) {
    if (key == without) continue;
    add(key.data(), key.size());
    add(value.data(), value.size());
  }
  for (const auto& [name, tensor] : content.tensors) {
    add(name.data(), name.size());
    add(tensor.shape.data(), tensor.shape.size() * sizeof(int64_t));
    add(tensor.data.data(), tensor.data.size() * sizeof(float));
  }
  const XXH128_hash_t hash = XXH3_128bits_digest(&state);
  char hex[33];
  std::snprintf(hex, sizeof(hex), "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return hex;
}

}  // namespace choreo
