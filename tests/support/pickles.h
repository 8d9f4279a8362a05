#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "model/core/npy.h"

namespace choreo {

/// Writes what pickle.dump({key: numpy array of '<f8', ...}) of Python 3 would mean (protocol 4).
inline void WritePickle(const std::filesystem::path& path,
                        const std::map<std::string, NpyArray>& arrays) {
  using namespace std::string_literals;
  const auto int32 = [](size_t value) {
    const auto bits = static_cast<int32_t>(value);
    return std::string(reinterpret_cast<const char*>(&bits), 4);
  };
  std::string pickle = "\x80\x04}("s;
  for (const auto& [key, array] : arrays) {
    const std::vector<double> values = array.As<double>();
    pickle += "X" + int32(key.size()) + key + "cnumpy.core.multiarray\n_reconstruct\n" +
              "cnumpy\nndarray\nK\x00\x85"s + "C\x01" + "b\x87R(K\x01(";
    for (const int64_t extent : array.shape) pickle += "J" + int32(static_cast<size_t>(extent));
    pickle += "tcnumpy\ndtype\n\x8c\x02"s + "f8\x89\x88\x87R(K\x03\x8c\x01<NNNJ\xff\xff\xff\xff" +
              "J\xff\xff\xff\xffK\x00tb\x89"s + "B" + int32(8 * values.size()) +
              std::string(reinterpret_cast<const char*>(values.data()), 8 * values.size()) + "tb";
  }
  std::ofstream(path, std::ios::binary) << pickle << "u.";
}

}  // namespace choreo
