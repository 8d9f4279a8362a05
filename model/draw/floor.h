#pragma once

#include <Eigen/Core>

#include "model/body/lanes.h"
#include "model/draw/floor_light.h"
#include "model/draw/picture.h"
#include "model/draw/tone.h"
#include "model/draw/view.h"

namespace choreo {

/// The floor y = 0 around what a view shows, as its camera sees it: with a grid that the world
/// fixes, fading into the background.
class Floor {
 public:
  /// Keeps `camera` and `light`. Colours are linear.
  Floor(const View& view, const Camera& camera, const FloorLight& light, int width, int height,
        const Eigen::Vector3f& floor, const Eigen::Vector3f& background);

  /// A row of the picture as rgb bytes, `width` of them.
  void DrawRow(int y, uint8_t* rgb) const;
  /// A point of the picture as light falls on `size` pixels around it.
  Eigen::Vector3f At(const Eigen::Array2f& pixel, float size) const;

 private:
  // Where the points of a row of the picture lie on the floor, x and z: the camera does not lean to
  // a side, so that they lie on a line, evenly spaced.
  struct Line {
    Eigen::Vector2f middle, step;  // at the picture's middle, and from pixel to pixel
  };
  struct Row {
    bool is_seen;  // below the horizon
    float size;
    Line here, next;  // `next`: the row `size` pixels below
  };
  Row RowAt(float y, float size) const;
  Lanes Light(const Row& row, Lane from_middle) const;

  const Camera& camera_;
  const FloorLight& light_;
  Tone tone_;
  int width_;
  float half_width_;
  Eigen::Vector2f middle_;  // of what is seen
  float reach_;             // of the floor around it, metres
  Eigen::Vector3f floor_, background_;
  uint8_t background_bytes_[3];
};

}  // namespace choreo
