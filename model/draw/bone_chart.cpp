#include "model/draw/bone_chart.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "model/core/error.h"
#include "model/core/text/printable.h"
#include "model/draw/canvas.h"

namespace choreo {
namespace {

constexpr int kWidth = 1100, kMinHeight = 640;
constexpr double kBody = 460;             // pixels in the middle for the body
constexpr double kLine = 15, kEdge = 24;  // height of a line of text, and margin
constexpr double kText = 11;
constexpr size_t kMaxShownName = 36;  // bytes
constexpr Colour kQuiet = Colour::Hex(0x8f887c), kTaken = Colour::Hex(0xb3402e);

// Shortens a name, never within a character.
std::string Shown(const std::string& name) {
  std::string shown = Printable(name);
  if (shown.size() <= kMaxShownName) return shown;
  size_t end = kMaxShownName;
  while (end > 0 && (static_cast<unsigned char>(shown[end]) & 0xC0) == 0x80) --end;
  return shown.substr(0, end) + "...";
}

// The bones whose names are in the left and the right column: on their joint's side, in the joints'
// vertical order.
std::array<std::vector<ChartBone>, 2> ColumnsOf(const std::vector<ChartBone>& bones,
                                                const Eigen::AlignedBox3d& body) {
  std::array<std::vector<ChartBone>, 2> columns;
  std::vector<ChartBone> sorted = bones;
  std::ranges::stable_sort(sorted, std::greater<>(),
                           [](const ChartBone& b) { return b.place.y(); });
  for (const ChartBone& bone : sorted) {
    const double beside = bone.place.x() - body.center().x();
    const bool right = std::abs(beside) > 0.01 * body.sizes().x()
                           ? beside > 0
                           : columns[1].size() < columns[0].size();
    columns[right ? 1 : 0].push_back(bone);
  }
  return columns;
}

// Draws the names of one column and lines to their joints, whose pixels are `x` and `y`.
void DrawColumn(const Canvas& canvas, const std::vector<ChartBone>& column, bool right, int height,
                const auto& x, const auto& y) {
  cairo_t* cr = canvas.cr();
  const double edge = right ? kWidth - kEdge : kEdge;
  const auto lines = static_cast<double>(std::max<size_t>(1, column.size()));
  const double pitch = std::min((height - 2 * kEdge) / lines, 3 * kLine);
  double line = (height - pitch * (lines - 1)) / 2;
  for (const ChartBone& bone : column) {
    const bool taken = !bone.means.empty();
    const std::string text = Shown(bone.name) + (taken ? " = " + bone.means : "");
    canvas.SetColour(taken ? kTaken : kQuiet);
    canvas.Text(text, edge, line, kText, right ? Align::kRight : Align::kLeft, taken);
    const double inner = canvas.TextWidth(text, kText, taken) + 4;
    cairo_set_line_width(cr, 0.5);
    cairo_move_to(cr, right ? edge - inner : edge + inner, line);
    cairo_line_to(cr, x(bone), y(bone));
    cairo_stroke(cr);
    cairo_arc(cr, x(bone), y(bone), taken ? 4 : 2.5, 0, 2 * M_PI);
    cairo_fill(cr);
    line += pitch;
  }
}

}  // namespace

void DrawBoneChart(const std::vector<ChartBone>& bones, const std::filesystem::path& png) {
  if (bones.empty() || bones.size() > kMaxChartBones) {
    throw InvalidArgument("bones", std::to_string(bones.size()) + ", a chart shows 1 to " +
                                       std::to_string(kMaxChartBones));
  }
  Eigen::AlignedBox3d body;
  for (const ChartBone& bone : bones) body.extend(bone.place);
  const Eigen::Vector3d middle = body.center(), size = body.sizes();
  const auto columns = ColumnsOf(bones, body);
  const size_t most = std::max(columns[0].size(), columns[1].size());
  const int height =
      std::max(kMinHeight, static_cast<int>(kLine * static_cast<double>(most) + 2 * kEdge));
  const double scale =
      std::min((height - 4 * kEdge) / std::max(1e-9, size.y()), kBody / std::max(1e-9, size.x()));
  const auto x = [&](const ChartBone& bone) {
    return kWidth / 2.0 + scale * (bone.place.x() - middle.x());
  };
  const auto y = [&](const ChartBone& bone) {
    return height / 2.0 - scale * (bone.place.y() - middle.y());
  };

  const Canvas canvas(kWidth, height, kPaper);
  cairo_t* cr = canvas.cr();
  canvas.SetColour(kInk);
  cairo_set_line_width(cr, 2);
  for (const ChartBone& bone : bones) {
    if (bone.parent < 0) continue;
    const ChartBone& parent = bones[static_cast<size_t>(bone.parent)];
    cairo_move_to(cr, x(parent), y(parent));
    cairo_line_to(cr, x(bone), y(bone));
    cairo_stroke(cr);
  }
  for (const size_t side : {0, 1}) DrawColumn(canvas, columns[side], side == 1, height, x, y);
  canvas.WritePng(png);
}

}  // namespace choreo
