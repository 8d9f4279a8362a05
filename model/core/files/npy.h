#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace choreo {

/// A NumPy array, read from and written to `.npy` files or members of an `.npz`. Readers accept
/// format versions 1 to 3, floats of 2, 4 and 8 bytes, integers and booleans, either byte order, 0
/// to 4 dimensions, and C or Fortran order. They widen values to the next of float32, float64,
/// int32 and int64. Writers use version 1.0. In memory, values are in C order (last index fastest).
struct NpyArray {
  using Values = std::variant<std::vector<float>, std::vector<double>, std::vector<int32_t>,
                              std::vector<int64_t>>;

  std::vector<int64_t> shape;  ///< empty for a scalar
  Values values;

  int64_t size() const;  ///< the product of the shape
  /// The values converted to T by static_cast.
  template <typename T>
  std::vector<T> As() const {
    return std::visit([](const auto& held) { return std::vector<T>(held.begin(), held.end()); },
                      values);
  }
};

/// The descr of arrays of pickled Python objects.
inline constexpr std::string_view kNpyObjects = "|O";

/// An array of any type, as stored in a file.
struct NpyParts {
  std::string descr;  ///< the value type, such as "<f4"
  bool fortran_order = false;
  std::vector<int64_t> shape;
  std::string_view values = {};  ///< bytes
};

/// Parses the header. The result's `values` point into `bytes`. Throws Error(kInvalidArgument)
/// whose field is `name` if there is no .npy header.
NpyParts SplitNpy(std::string_view bytes, const std::string& name);
/// The inverse of SplitNpy. Always writes C order.
std::string JoinNpy(const NpyParts& parts);

/// Converts the values. Throws Error(kInvalidArgument) whose field is `name` if the type is not
/// readable (see NpyArray) or the bytes do not match the shape.
NpyArray ReadNpyParts(const NpyParts& parts, const std::string& name);
/// SplitNpy, then ReadNpyParts.
NpyArray ParseNpy(std::string_view bytes, const std::string& name);
/// Throws what ParseNpy throws, and Error(kNotFound) if the file cannot be opened.
NpyArray ReadNpy(const std::filesystem::path& path);

/// Throws Error(kInvalidArgument) if the number of values is not the product of the shape.
std::string SerializeNpy(const NpyArray& array);
/// Throws what SerializeNpy throws, and Error(kInternal) if the file cannot be written.
void WriteNpy(const std::filesystem::path& path, const NpyArray& array);

}  // namespace choreo
