#include "model/draw/canvas.h"

#include <algorithm>
#include <cstring>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"

namespace choreo {
namespace {

void SelectFont(cairo_t* cr, double size, bool bold) {
  cairo_select_font_face(cr, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, size);
}

}  // namespace

Canvas::Canvas(int width, int height, const Colour& background)
    : width_(width),
      height_(height),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height),
               cairo_surface_destroy),
      context_(cairo_create(surface_.get()), cairo_destroy) {
  if (width < 1 || width > kMaxPicturePixels || height < 1 || height > kMaxPicturePixels) {
    throw InvalidArgument("picture", std::to_string(width) + " x " + std::to_string(height) +
                                         " pixels, each must be 1 to " +
                                         std::to_string(kMaxPicturePixels));
  }
  if (const cairo_status_t status = cairo_status(cr()); status != CAIRO_STATUS_SUCCESS)
    throw Error(ErrorCode::kInternal, "picture", cairo_status_to_string(status));
  SetColour(background);
  cairo_paint(cr());
}

void Canvas::SetColour(const Colour& colour, double alpha) const {
  cairo_set_source_rgba(cr(), colour.r, colour.g, colour.b, alpha);
}

void Canvas::Text(const std::string& text, double x, double y, double size, Align align,
                  bool bold) const {
  const double width = align == Align::kLeft ? 0 : TextWidth(text, size, bold);
  SelectFont(cr(), size, bold);
  cairo_font_extents_t font;
  cairo_font_extents(cr(), &font);
  const double left = align == Align::kCentre ? x - width / 2 : x - width;
  cairo_move_to(cr(), left, y + (font.ascent - font.descent) / 2);
  cairo_show_text(cr(), text.c_str());
  cairo_new_path(cr());
}

double Canvas::TextWidth(const std::string& text, double size, bool bold) const {
  SelectFont(cr(), size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(cr(), text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::Paste(const Picture& picture, int x, int y) const {
  cairo_surface_flush(surface_.get());
  unsigned char* data = cairo_image_surface_get_data(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  for (int row = std::max(0, -y); row < picture.height && y + row < height_; ++row) {
    for (int column = std::max(0, -x); column < picture.width && x + column < width_; ++column) {
      const uint8_t* rgb = &picture.rgb[3 * (static_cast<size_t>(row) * picture.width + column)];
      // Pixels of CAIRO_FORMAT_RGB24 are 0x00RRGGBB in native byte order.
      const uint32_t pixel = uint32_t{rgb[0]} << 16 | uint32_t{rgb[1]} << 8 | rgb[2];
      std::memcpy(data + static_cast<ptrdiff_t>(y + row) * stride + 4 * (x + column), &pixel, 4);
    }
  }
  cairo_surface_mark_dirty(surface_.get());
}

void Canvas::WritePng(const std::filesystem::path& png) const {
  AtomicFile file(png);
  const cairo_status_t status = cairo_surface_write_to_png(surface_.get(), file.partial().c_str());
  if (status != CAIRO_STATUS_SUCCESS) {
    throw Error(ErrorCode::kInternal, png.string(),
                std::string("cannot be written: ") + cairo_status_to_string(status));
  }
  file.Commit();
}

}  // namespace choreo
