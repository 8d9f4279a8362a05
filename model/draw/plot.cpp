#include "model/draw/plot.h"

#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/draw/canvas.h"
#include "model/draw/check_within.h"
#include "model/draw/plot_axis.h"

namespace choreo {
namespace {

constexpr double kLabelSize = 14;
constexpr double kTitleFont = 18;

constexpr Colour kGrid = Colour::Hex(0xe1e4e8);
// Distinct to colour-blind readers (Okabe and Ito 2008), without the yellow.
constexpr Colour kLines[] = {Colour::Hex(0x0072b2), Colour::Hex(0xd55e00), Colour::Hex(0x009e73),
                             Colour::Hex(0xcc79a7), Colour::Hex(0xe69f00), Colour::Hex(0x56b4e9),
                             Colour::Hex(0x000000)};

void Check(const Plot& plot) {
  CheckWithin("plot.width", plot.width, kMinPlotPixels, kMaxPlotPixels);
  CheckWithin("plot.height", plot.height, kMinPlotPixels, kMaxPlotPixels);
  for (const PlotSeries& series : plot.series) {
    if (series.x.size() != series.y.size()) {
      throw InvalidArgument("plot.series['" + series.label + "']",
                            std::to_string(series.x.size()) + " x and " +
                                std::to_string(series.y.size()) + " y values");
    }
  }
}

void DrawLine(const Canvas& canvas, double x1, double y1, double x2, double y2) {
  cairo_move_to(canvas.cr(), x1, y1);
  cairo_line_to(canvas.cr(), x2, y2);
  cairo_stroke(canvas.cr());
}

// Whether half of a line's points lie on an earlier line, on an axis of `extent`.
bool HidesAnother(const Plot& plot, size_t index, double extent) {
  if (!plot.x_names.empty()) return false;  // bars stand side by side
  const PlotSeries& line = plot.series[index];
  for (size_t i = 0; i < index; ++i) {
    const PlotSeries& earlier = plot.series[i];
    if (earlier.asked) continue;
    size_t same = 0;
    for (size_t k = 0; k < std::min(line.x.size(), earlier.x.size()); ++k) {
      const double apart = line.y[k] - earlier.y[k];
      same += line.x[k] == earlier.x[k] && std::abs(apart) < 0.005 * extent;
    }
    if (same > 0 && 2 * same >= line.x.size()) return true;
  }
  return false;
}

struct Stroke {
  Colour colour = kInk;
  bool dashed = false;
};

std::vector<Stroke> ChooseStrokes(const Plot& plot, double extent) {
  std::vector<Stroke> strokes;
  size_t number = 0;
  for (size_t i = 0; i < plot.series.size(); ++i) {
    const bool asked = plot.series[i].asked;
    number += !asked;
    Stroke stroke{.dashed = asked};
    if (number > 0) stroke.colour = kLines[(number - 1) % std::size(kLines)];
    // With more series than colours, the second round is dashed.
    if (!asked)
      stroke.dashed = (number - 1) / std::size(kLines) % 2 == 1 || HidesAnother(plot, i, extent);
    strokes.push_back(stroke);
  }
  return strokes;
}

void Select(const Canvas& canvas, const Stroke& stroke) {
  canvas.SetColour(stroke.colour);
  cairo_set_line_width(canvas.cr(), 2);
  const double dashes[] = {6, 4};
  cairo_set_dash(canvas.cr(), dashes, stroke.dashed ? 2 : 0, 0);
}

// Draws the bars of all series side by side at each x, from 0.
void DrawBars(const Canvas& canvas, const Plot& plot, const std::vector<Stroke>& strokes,
              const Axis& x_axis, const Axis& y_axis) {
  const double width = 0.8 / static_cast<double>(plot.series.size());
  for (size_t i = 0; i < plot.series.size(); ++i) {
    const PlotSeries& series = plot.series[i];
    canvas.SetColour(strokes[i].colour);
    for (size_t k = 0; k < series.x.size(); ++k) {
      if (!std::isfinite(series.x[k]) || !std::isfinite(series.y[k])) continue;
      const double left = series.x[k] - 0.4 + width * static_cast<double>(i);
      cairo_rectangle(canvas.cr(), x_axis.At(left), y_axis.At(0),
                      x_axis.At(left + width) - x_axis.At(left),
                      y_axis.At(series.y[k]) - y_axis.At(0));
      cairo_fill(canvas.cr());
    }
  }
}

void DrawSeries(const Canvas& canvas, const Plot& plot, const std::vector<Stroke>& strokes,
                const Axis& x_axis, const Axis& y_axis) {
  cairo_t* cr = canvas.cr();
  for (size_t i = 0; i < plot.series.size(); ++i) {
    const PlotSeries& series = plot.series[i];
    Select(canvas, strokes[i]);
    const bool few = series.x.size() <= 40;
    int run = 0;
    double last_x = 0, last_y = 0;
    std::vector<std::pair<double, double>> dots;
    const auto end_run = [&] {
      if (run == 1) dots.emplace_back(last_x, last_y);
      run = 0;
    };
    for (size_t k = 0; k < series.x.size(); ++k) {
      if (!std::isfinite(series.x[k]) || !std::isfinite(series.y[k])) {
        end_run();
        continue;
      }
      last_x = x_axis.At(series.x[k]), last_y = y_axis.At(series.y[k]);
      run++ ? cairo_line_to(cr, last_x, last_y) : cairo_move_to(cr, last_x, last_y);
      if (few) dots.emplace_back(last_x, last_y);
    }
    end_run();
    cairo_stroke(cr);
    for (const auto& [x, y] : dots) {
      cairo_arc(cr, x, y, 3, 0, 2 * M_PI);
      cairo_fill(cr);
    }
  }
  cairo_set_dash(cr, nullptr, 0, 0);
}

// Draws the legend below the title, on as many lines as needed, and moves `top` below them.
void DrawLegend(const Canvas& canvas, const Plot& plot, const std::vector<Stroke>& strokes,
                double left, double right, double& top) {
  constexpr double kSample = 26, kBetween = 22, kPitch = 20;
  double x = left;
  double y = top + kPitch / 2;
  for (size_t i = 0; i < plot.series.size(); ++i) {
    const double width =
        kSample + 6 + canvas.TextWidth(plot.series[i].label, kLabelSize) + kBetween;
    if (x > left && x + width > right) x = left, y += kPitch;
    Select(canvas, strokes[i]);
    if (!plot.x_names.empty()) cairo_set_line_width(canvas.cr(), 10);  // a bar's colour
    DrawLine(canvas, x, y, x + kSample, y);
    cairo_set_dash(canvas.cr(), nullptr, 0, 0);
    canvas.SetColour(kInk);
    canvas.Text(plot.series[i].label, x + kSample + 6, y, kLabelSize);
    x += width;
  }
  if (!plot.series.empty()) top = y + kPitch;
}

struct Ranges {
  Range x, y;
};

// The range of the finite values of all series.
Ranges RangesOf(const Plot& plot) {
  Ranges of;
  for (const PlotSeries& series : plot.series) {
    for (size_t k = 0; k < series.x.size(); ++k) {
      if (!std::isfinite(series.x[k]) || !std::isfinite(series.y[k])) continue;
      of.x.Add(series.x[k]);
      of.y.Add(series.y[k]);
    }
  }
  const bool bars = !plot.x_names.empty();
  if (bars) of.x.Add(-0.5), of.x.Add(static_cast<double>(plot.x_names.size()) - 0.5);
  const bool from_zero = bars || plot.from_zero;
  if (from_zero) of.y.Add(0);
  const double floor = of.y.low;
  of.x.AddMargin(plot.map ? 0.04 : 0);
  of.y.AddMargin(0.04);
  if (from_zero) of.y.low = floor;
  return of;
}

struct Area {
  double left, right, top, bottom;  // pixels
};

// The grid, both axes' ticks and their labels.
void DrawAxes(const Canvas& canvas, const Plot& plot, const Area& area, const Axis& x_axis,
              const Axis& y_axis) {
  const auto& [left, right, top, bottom] = area;
  cairo_t* cr = canvas.cr();
  cairo_set_line_width(cr, 1);
  for (const Tick& tick : y_axis.ticks()) {
    const double y = std::round(y_axis.At(tick.value)) + 0.5;
    canvas.SetColour(kGrid);
    DrawLine(canvas, left, y, right, y);
    canvas.SetColour(kInk);
    canvas.Text(tick.label, left - 8, y, kLabelSize, Align::kRight);
  }
  for (const Tick& tick : x_axis.ticks()) {
    const double x = std::round(x_axis.At(tick.value)) + 0.5;
    canvas.SetColour(kGrid);
    DrawLine(canvas, x, top, x, bottom);
    canvas.SetColour(kInk);
    DrawLine(canvas, x, bottom, x, bottom + 5);
    canvas.Text(tick.label, x, bottom + 17, kLabelSize, Align::kCentre);
  }
  canvas.SetColour(kInk);
  DrawLine(canvas, left, std::round(bottom) + 0.5, right, std::round(bottom) + 0.5);
  canvas.Text(plot.x_label, (left + right) / 2, plot.height - 20, kLabelSize, Align::kCentre);
  cairo_save(cr);
  cairo_translate(cr, 26, (top + bottom) / 2);
  cairo_rotate(cr, -M_PI / 2);
  canvas.Text(plot.y_label, 0, 0, kLabelSize, Align::kCentre);
  cairo_restore(cr);
}

double WidestText(const Canvas& canvas, const std::vector<std::string>& texts) {
  double widest = 0;
  for (const std::string& text : texts)
    widest = std::max(widest, canvas.TextWidth(text, kLabelSize));
  return widest;
}

}  // namespace

void DrawPlot(const Plot& plot, const std::filesystem::path& png) {
  Check(plot);
  auto [xs, ys] = RangesOf(plot);
  const bool bars = !plot.x_names.empty();
  const std::vector<Stroke> strokes = ChooseStrokes(plot, ys.high - ys.low);

  const Canvas canvas(plot.width, plot.height, kPaper);
  cairo_t* cr = canvas.cr();
  const double bottom = plot.height - 62, right = plot.width - 28;
  double top = 16;
  canvas.SetColour(kInk);
  if (!plot.title.empty()) {
    canvas.Text(plot.title, 24, top + kTitleFont / 2, kTitleFont, Align::kLeft, true);
    top += kTitleFont + 14;
  }
  DrawLegend(canvas, plot, strokes, 24, right, top);
  top += 10;

  Axis y_axis(ys.low, ys.high, bottom, top, 56);
  std::vector<std::string> labels;
  for (const Tick& tick : y_axis.ticks()) labels.push_back(tick.label);
  const double left = 24 + (plot.y_label.empty() ? 0 : 26) + WidestText(canvas, labels) + 8;
  if (plot.map) {
    const double unit =
        std::max((xs.high - xs.low) / (right - left), (ys.high - ys.low) / (bottom - top));
    xs.WidenTo(unit * (right - left));
    ys.WidenTo(unit * (bottom - top));
    y_axis = Axis(ys.low, ys.high, bottom, top, 56);
  }
  Axis x_axis(xs.low, xs.high, left, right, 90);
  if (bars) x_axis.Name(plot.x_names, WidestText(canvas, plot.x_names) + 8);
  DrawAxes(canvas, plot, {left, right, top, bottom}, x_axis, y_axis);

  cairo_save(cr);
  cairo_rectangle(cr, left - 4, top - 4, right - left + 8, bottom - top + 8);
  cairo_clip(cr);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  (bars ? DrawBars : DrawSeries)(canvas, plot, strokes, x_axis, y_axis);
  cairo_restore(cr);
  canvas.WritePng(png);
}

}  // namespace choreo
