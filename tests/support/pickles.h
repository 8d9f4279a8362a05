#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "model/core/files/npy.h"

namespace choreo {

/// The items of a dict of '<f8' numpy arrays, as Python 3 pickles them (protocol 4).
inline std::string PickledItems(const std::map<std::string, NpyArray>& arrays) {
  using namespace std::string_literals;
  const auto int32 = [](size_t value) {
    const auto bits = static_cast<int32_t>(value);
    return std::string(reinterpret_cast<const char*>(&bits), 4);
  };
  std::string pickle;
  for (const auto& [key, array] : arrays) {
    const std::vector<double> values = array.As<double>();
    pickle += "X" + int32(key.size()) + key + "cnumpy.core.multiarray\n_reconstruct\n" +
              "cnumpy\nndarray\nK\x00\x85"s + "C\x01" + "b\x87R(K\x01(";
    for (const int64_t extent : array.shape) pickle += "J" + int32(static_cast<size_t>(extent));
    pickle += "tcnumpy\ndtype\n\x8c\x02"s + "f8\x89\x88\x87R(K\x03\x8c\x01<NNNJ\xff\xff\xff\xff" +
              "J\xff\xff\xff\xffK\x00tb\x89"s + "B" + int32(8 * values.size()) +
              std::string(reinterpret_cast<const char*>(values.data()), 8 * values.size()) + "tb";
  }
  return pickle;
}

/// Writes the equivalent of pickle.dump({key: array, ...}).
inline void WritePickle(const std::filesystem::path& path,
                        const std::map<std::string, NpyArray>& arrays) {
  std::ofstream(path, std::ios::binary) << "\x80\x04}(" << PickledItems(arrays) << "u.";
}

/// Writes the equivalent of pickle.dump({name: {key: array, ...}, ...}).
inline void WritePickledDicts(const std::filesystem::path& path,
                              const std::map<std::string, std::map<std::string, NpyArray>>& dicts) {
  std::ofstream file(path, std::ios::binary);
  file << "\x80\x04}(";
  for (const auto& [name, arrays] : dicts) {
    const auto size = static_cast<int32_t>(name.size());
    file << 'X' << std::string(reinterpret_cast<const char*>(&size), 4) << name << "}("
         << PickledItems(arrays) << 'u';
  }
  file << "u.";
}

/// Writes the equivalent of pickle.dump([{key: array, ...}, ...]) or, if `within` is not empty, of
/// pickle.dump({within: [...]}).
inline void WritePickledList(const std::filesystem::path& path, const std::string& within,
                             const std::vector<std::map<std::string, NpyArray>>& dicts) {
  std::ofstream file(path, std::ios::binary);
  const auto size = static_cast<int32_t>(within.size());
  file << "\x80\x04";
  if (size > 0) file << "}(X" << std::string(reinterpret_cast<const char*>(&size), 4) << within;
  file << "](";
  for (const auto& arrays : dicts) file << "}(" << PickledItems(arrays) << 'u';
  file << (size > 0 ? "eu." : "e.");
}

}  // namespace choreo
