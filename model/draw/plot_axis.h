#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

/// A plot's axes: ranges of values, ticks at round numbers, and positions in the picture.
namespace choreo {

/// The range of values on an axis.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void Add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// Widens to `extent` about its middle.
  void WidenTo(double extent) {
    const double extra = std::max(0.0, extent - (high - low)) / 2;
    low -= extra, high += extra;
  }
  /// Makes the range neither empty nor a single point, and adds `margin` times the extent on both
  /// sides.
  void AddMargin(double margin) {
    if (!(low <= high)) low = 0, high = 1;
    if (high - low < 1e-9 * std::max(1e-6, std::abs(high))) {
      const double half = std::max(std::abs(high) * 0.1, 1e-6);
      low -= half, high += half;
    }
    const double extra = (high - low) * margin;
    low -= extra, high += extra;
  }
};

struct Tick {
  double value;
  std::string label;
};

/// An axis with values from `low` to `high`, drawn from pixel `from` to pixel `to`, with a tick
/// every `tick_distance` pixels or more.
class Axis {
 public:
  Axis(double low, double high, double from, double to, double tick_distance)
      : low_(low), high_(high), from_(from), to_(to) {
    const double raw = (high - low) / std::max(2.0, std::abs(to - from) / tick_distance);
    const double power = std::pow(10, std::floor(std::log10(raw)));
    double step = 10 * power;
    for (const double nice : {5.0, 2.0, 1.0}) {
      if (nice * power >= raw * 0.999) step = nice * power;
    }
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
      ticks_.push_back({k * step, Number(k * step, step)});
  }

  double At(double value) const { return from_ + (value - low_) / (high_ - low_) * (to_ - from_); }
  const std::vector<Tick>& ticks() const { return ticks_; }

  /// Labels 0, 1, ... with names in place of numbers, leaving room for `widest` pixels each.
  void Name(const std::vector<std::string>& names, double widest) {
    const auto stride = static_cast<size_t>(std::ceil(widest / (At(1) - At(0))));
    ticks_.clear();
    for (size_t i = 0; i < names.size(); i += std::max<size_t>(1, stride))
      ticks_.push_back({static_cast<double>(i), names[i]});
  }

 private:
  static std::string Number(double value, double step) {
    char text[32];
    const double size = std::abs(value);
    if (size != 0 && (size >= 1e6 || size < 1e-4)) {
      std::snprintf(text, sizeof(text), "%.3g", value);
    } else {
      const int digits = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
      std::snprintf(text, sizeof(text), "%.*f", digits, value == 0 ? 0.0 : value);
    }
    return text;
  }

  double low_, high_, from_, to_;
  std::vector<Tick> ticks_;
};

}  // namespace choreo
