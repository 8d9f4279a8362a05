#pragma once

#include <limits>
#include <string>
#include <vector>

/// What a plot's axes are: ranges, round numbers along them, and where values lie in the picture.
namespace choreo {

/// What an axis has to hold.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void Add(double value);
  /// As long as `extent`, its middle where it was.
  void WidenTo(double extent);
  /// Never empty, never a single point; `margin` of the extent is added on both sides.
  void Settle(double margin);
};

struct Tick {
  double value;
  std::string label;
};

/// A range of values and where it lies in the picture: `from` to `to`, pixels.
class Axis {
 public:
  Axis(double low, double high, double from, double to, double tick_distance);

  double At(double value) const { return from_ + (value - low_) / (high_ - low_) * (to_ - from_); }
  const std::vector<Tick>& ticks() const { return ticks_; }

  /// Names of 0, 1, ... instead of numbers, each so far from the one before that `widest` has room.
  void Name(const std::vector<std::string>& names, double widest);

 private:
  double low_, high_, from_, to_;
  std::vector<Tick> ticks_;
};

}  // namespace choreo
