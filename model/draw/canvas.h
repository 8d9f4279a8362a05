#pragma once

#include <cairo.h>

#include <filesystem>
#include <memory>
#include <string>

#include "model/body/colour.h"
#include "model/draw/picture.h"

/// A cairo surface that frees itself, and text, for the pictures of this folder.
namespace choreo {

inline constexpr Colour kPaper = Colour::Hex(0xffffff), kInk = Colour::Hex(0x24292f);

enum class Align { kLeft, kCentre, kRight };

/// An RGB picture in memory. Not thread-safe; different canvases are independent.
class Canvas {
 public:
  /// Fills the canvas with `background`. Throws Error(kInvalidArgument) for a width or height
  /// outside 1 to kMaxPicturePixels.
  Canvas(int width, int height, const Colour& background);

  cairo_t* cr() const { return context_.get(); }
  int width() const { return width_; }

  void SetColour(const Colour& colour, double alpha = 1) const;
  /// Draws text in the current colour, vertically centred at y. Pixels.
  void Text(const std::string& text, double x, double y, double size, Align align = Align::kLeft,
            bool bold = false) const;
  double TextWidth(const std::string& text, double size, bool bold = false) const;

  /// Copies a picture with its upper left corner at (x, y), clipped to the canvas.
  void Paste(const Picture& picture, int x, int y) const;

  /// Throws Error(kInternal) if the file cannot be written.
  void WritePng(const std::filesystem::path& png) const;

 private:
  int width_, height_;
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context_;
};

}  // namespace choreo
