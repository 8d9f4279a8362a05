#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace choreo {

/// A node's animation, in glTF's number formats.
struct GltfTrack {
  int node = -1;
  std::vector<float> turns;   ///< x y z w, frame after frame, or one for all frames
  std::vector<float> places;  ///< x y z, frame after frame; empty if the node stays in place

  /// Adds a frame's rotation, with the quaternion's sign nearer to the frame before: readers
  /// interpolate linearly.
  void AddTurn(Eigen::Quaterniond turn);
  void AddPlace(const Eigen::Vector3d& place);
};

/// Extends a glTF document and its binary data. Not thread-safe. Private to this folder.
class GltfBuilder {
 public:
  using Json = nlohmann::ordered_json;

  GltfBuilder(Json document, std::string_view binary);

  /// The list with this name, created if missing. Throws Error(kInvalidArgument), naming it, if the
  /// member is no list.
  Json& List(const char* name);

  /// Adds an accessor with its own view of packed elements, and returns its index. `type`: such as
  /// "VEC3". `bounds`: adds min and max. `target`: the view's, 0 for none.
  template <typename T>
  size_t Add(std::span<const T> values, std::string_view type, bool bounds = false,
             int target = 0) {
    static_assert(std::is_unsigned_v<T> || std::is_same_v<T, float>);
    constexpr int kComponent = std::is_same_v<T, float> ? 5126
                               : sizeof(T) == 4         ? 5125
                               : sizeof(T) == 2         ? 5123
                                                        : 5121;
    const size_t index =
        AddBytes({reinterpret_cast<const char*>(values.data()), values.size_bytes()}, kComponent,
                 values.size() / Width(type), type, target);
    if (bounds) {
      using Columns = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
      const auto width = static_cast<Eigen::Index>(Width(type));
      SetBounds(Eigen::Map<const Columns>(values.data(), width, std::ssize(values) / width)
                    .template cast<double>());
    }
    return index;
  }

  /// Adds an animation, "dance", before all others. Its extras hold `fps`. Skips tracks without a
  /// node.
  void AddDance(double fps, size_t frames, const std::vector<GltfTrack>& tracks);

  /// Returns the whole file, followed by the chunks in `others`. Throws what JoinGlb throws.
  std::string Join(std::string_view others = {});

 private:
  static size_t Width(std::string_view type);
  size_t AddBytes(std::string_view bytes, int component, size_t count, std::string_view type,
                  int target);
  void SetBounds(const Eigen::MatrixXd& values);

  Json document_;
  std::string binary_;
};

}  // namespace choreo
