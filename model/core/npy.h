#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace choreo {

/// NumPy's `.npy` arrays, in files and in memory (the members of an `.npz`). Reads format versions
/// 1 to 3, floats of 2, 4 and 8 bytes, integers and booleans, of either byte order, 0 to 4
/// dimensions, C or Fortran order; holds them as the next larger of float32, float64, int32 and
/// int64; writes version 1.0 in C order. Values are held in C order (last index fastest), whatever
/// the file's order was. Not shared between threads while it changes.
struct NpyArray {
  using Values = std::variant<std::vector<float>, std::vector<double>, std::vector<int32_t>,
                              std::vector<int64_t>>;

  std::vector<int64_t> shape;  ///< empty: one number
  Values values;

  int64_t size() const;  ///< product of the shape
  /// The values as T, converted as static_cast does.
  template <typename T>
  std::vector<T> As() const {
    return std::visit([](const auto& held) { return std::vector<T>(held.begin(), held.end()); },
                      values);
  }
};

/// The type of values that are a pickle of Python's objects.
inline constexpr std::string_view kNpyObjects = "|O";

/// An array of any kind, as it lies in a file.
struct NpyParts {
  std::string descr;  ///< the type of its values, as in "<f4"
  bool fortran_order = false;
  std::vector<int64_t> shape;
  std::string_view values = {};  ///< bytes
};

/// The values of `parts` point into `bytes`. Throws Error(kInvalidArgument) whose field is `name`
/// for what does not begin as such a file does.
NpyParts SplitNpy(std::string_view bytes, const std::string& name);
/// The inverse, in C order.
std::string JoinNpy(const NpyParts& parts);

/// Throws Error(kInvalidArgument) whose field is `name` for values that are none of the above, that
/// are too few for the shape, or that go on after it.
NpyArray ReadNpyParts(const NpyParts& parts, const std::string& name);
/// Both: an array in a file's bytes.
NpyArray ParseNpy(std::string_view bytes, const std::string& name);
/// As ParseNpy; Error(kNotFound) where the file cannot be opened.
NpyArray ReadNpy(const std::filesystem::path& path);

/// Throws Error(kInvalidArgument) where the number of values is not the product of the shape.
std::string SerializeNpy(const NpyArray& array);
/// As SerializeNpy; Error(kInternal) where the file cannot be written.
void WriteNpy(const std::filesystem::path& path, const NpyArray& array);

}  // namespace choreo
