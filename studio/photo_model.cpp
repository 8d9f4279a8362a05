#include "studio/photo_model.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

namespace choreo::studio {
namespace {

// scripts/photo_model.sh has the same list.
constexpr std::string_view kFiles[] = {
    "pose.js",
    "pose_landmark_full.tflite",
    "pose_solution_packed_assets.data",
    "pose_solution_packed_assets_loader.js",
    "pose_solution_simd_wasm_bin.data",
    "pose_solution_simd_wasm_bin.js",
    "pose_solution_simd_wasm_bin.wasm",
    "pose_web.binarypb",
};

std::string_view TypeOf(std::string_view name) {
  if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
  return name.ends_with(".wasm") ? "application/wasm" : "application/octet-stream";
}

}  // namespace

PhotoModel::PhotoModel(std::filesystem::path folder)
    : folder_(std::move(folder)), is_there_(std::ranges::all_of(kFiles, [this](auto name) {
        std::error_code error;
        return std::filesystem::is_regular_file(folder_ / name, error);
      })) {}

std::optional<PhotoModel::File> PhotoModel::Read(std::string_view name) const {
  if (!is_there_ || std::ranges::find(kFiles, name) == std::end(kFiles)) return std::nullopt;
  std::error_code error;
  if (!std::filesystem::is_regular_file(folder_ / name, error)) return std::nullopt;
  std::ifstream file(folder_ / name, std::ios::binary);
  if (!file) return std::nullopt;
  return File{TypeOf(name), {std::istreambuf_iterator<char>(file), {}}};
}

}  // namespace choreo::studio
