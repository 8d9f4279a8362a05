#pragma once

#include <cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

namespace choreo {

/// A decoded PNG.
struct DecodedPng {
  int width = 0, height = 0;
  std::vector<uint32_t> pixels;  ///< [height, width] 0xRRGGBB

  explicit DecodedPng(const std::filesystem::path& path) {
    cairo_surface_t* surface = cairo_image_surface_create_from_png(path.c_str());
    EXPECT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS) << path;
    width = cairo_image_surface_get_width(surface);
    height = cairo_image_surface_get_height(surface);
    const unsigned char* data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    for (int y = 0; y < height; ++y) {
      const auto* row = reinterpret_cast<const uint32_t*>(data + ptrdiff_t{y} * stride);
      for (int x = 0; x < width; ++x) pixels.push_back(row[x] & 0xffffff);
    }
    cairo_surface_destroy(surface);
  }

  uint32_t At(int x, int y) const { return pixels[static_cast<size_t>(y) * width + x]; }
  int Count(uint32_t colour) const {
    return static_cast<int>(std::count(pixels.begin(), pixels.end(), colour));
  }
  size_t Colours() const { return std::set<uint32_t>(pixels.begin(), pixels.end()).size(); }
};

}  // namespace choreo
