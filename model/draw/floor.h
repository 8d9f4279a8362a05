#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/body/lanes.h"
#include "model/draw/floor_light.h"
#include "model/draw/picture.h"
#include "model/draw/tone.h"
#include "model/draw/view.h"

namespace choreo {

/// Draws the floor y = 0 around the middle of a view, with a grid that is fixed in the world and
/// fades into the background. Immutable; thread-safe.
class Floor {
 public:
  /// Keeps references to `camera` and `light`. Colours are linear.
  Floor(const View& view, const Camera& camera, const FloorLight& light, int width, int height,
        const Eigen::Vector3f& floor, const Eigen::Vector3f& background);

  /// Draws a row of the picture as `width` rgb pixels. Returns how many pixels show only the
  /// floor's own colour; they are copied, which is faster than computing each.
  int DrawRow(int y, uint8_t* rgb) const;
  /// The linear colour at a point of the picture, averaged over `size` pixels.
  Eigen::Vector3f At(const Eigen::Array2f& pixel, float size) const;

 private:
  // The floor positions (x, z) of a picture row. The camera does not tilt sideways, so they are
  // evenly spaced on a line.
  struct Line {
    Eigen::Vector2f middle, step;  // at the picture's middle, and per pixel
  };
  struct Row {
    bool is_seen;  // below the horizon
    float size;
    Line here, next;  // `next`: the row `size` pixels below
  };
  Row RowAt(float y, float size) const;
  // Whether columns [from, to] of a row show only the floor's own colour.
  bool IsPlain(const Row& row, float from, float to) const;
  Lanes Light(const Row& row, Lane from_middle) const;

  const Camera& camera_;
  const FloorLight& light_;
  Tone tone_;
  int width_;
  float half_width_;
  Eigen::Vector2f middle_;  // of the visible part
  float reach_;             // of the floor around it, metres
  Eigen::Vector3f floor_, background_;
  std::vector<uint8_t> plain_row_, background_row_;  // of one colour
};

}  // namespace choreo
