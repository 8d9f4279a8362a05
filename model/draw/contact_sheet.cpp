#include "model/draw/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "model/body/doll.h"
#include "model/core/error.h"
#include "model/draw/canvas.h"
#include "model/draw/check_within.h"

namespace choreo {
namespace {

constexpr int kMargin = 24;
constexpr int kGap = 10;
constexpr int kHeader = 58;
constexpr int kLabel = 24;  // below each tile
constexpr double kFont = 13;
constexpr double kCorner = 8;

constexpr Colour kFaint = Colour::Hex(0x85807a);
const FrameStyle kPlain,
    kKeyPose = {.background = Colour::Hex(0xfff6dd), .floor = Colour::Hex(0xf3e4b8)};

void RoundedRectangle(const Canvas& canvas, double x, double y, double width, double height,
                      double corner) {
  cairo_t* cr = canvas.cr();
  cairo_new_sub_path(cr);
  cairo_arc(cr, x + width - corner, y + corner, corner, -M_PI / 2, 0);
  cairo_arc(cr, x + width - corner, y + height - corner, corner, 0, M_PI / 2);
  cairo_arc(cr, x + corner, y + height - corner, corner, M_PI / 2, M_PI);
  cairo_arc(cr, x + corner, y + corner, corner, M_PI, 1.5 * M_PI);
  cairo_close_path(cr);
}

std::string TimeText(double seconds) {
  char text[32];
  const int minutes = static_cast<int>(seconds / 60);
  if (minutes > 0) {
    std::snprintf(text, sizeof(text), "%d:%05.2f", minutes, seconds - 60 * minutes);
  } else {
    std::snprintf(text, sizeof(text), "%.2f s", seconds);
  }
  return text;
}

// The number of frames shown at even distances, apart from keys.
int64_t EvenFrames(int64_t total, const ContactSheetOptions& options) {
  if (options.step == 0) return std::min<int64_t>(options.frames, total);
  return 1 + static_cast<int64_t>(static_cast<double>(total - 1) / options.step);
}

int64_t EvenFrame(int64_t i, int64_t count, int64_t total, double step) {
  if (step > 0) return std::llround(step * static_cast<double>(i));
  return count == 1 ? 0 : (i * (total - 1) + (count - 1) / 2) / (count - 1);
}

// "24 shown, 2.4 a second".
std::string ShownText(int64_t total, double fps, const ContactSheetOptions& options) {
  const int64_t count = EvenFrames(total, options);
  const double step = options.step > 0 ? options.step
                                       : static_cast<double>(total - 1) /
                                             static_cast<double>(std::max<int64_t>(count - 1, 1));
  char text[64];
  std::snprintf(text, sizeof(text), "%lld shown, %.3g a second", static_cast<long long>(count),
                step > 0 ? fps / step : fps);
  return text;
}

// Facts and a legend, drawn to the right of the title, or below a long one.
struct Header {
  std::string facts;
  std::vector<std::pair<Colour, std::string>> legend;

  static constexpr double kTitleFont = 20, kDot = 32;  // with its margins
  static constexpr int kLine = 26;

  Header(int64_t frames, double fps, const ContactSheetOptions& options) {
    if (!options.rows_apart && options.captions.empty()) {
      char text[160];
      std::snprintf(text, sizeof(text), "%s   %lld frames at %g fps   %s",
                    TimeText(static_cast<double>(frames) / fps).c_str(),
                    static_cast<long long>(frames), fps, ShownText(frames, fps, options).c_str());
      facts = text;
    }
    legend = {{kLeftColour, "left"}, {kRightColour, "right"}};
    if (!options.key_frames.empty()) legend.emplace_back(kKeyColour, "key pose");
  }

  double Width(const Canvas& canvas) const {
    double width = canvas.TextWidth(facts, kFont);
    for (const auto& [colour, text] : legend) width += canvas.TextWidth(text, kFont) + kDot;
    return width;
  }
  // Whether a title leaves no room beside it on a sheet of this width.
  bool Wraps(const Canvas& canvas, const std::string& title, int width) const {
    return kMargin + canvas.TextWidth(title, kTitleFont, true) + kDot + Width(canvas) + kMargin >
           width;
  }

  void Draw(const Canvas& canvas, const std::string& title, bool wraps) const {
    double y = kMargin + 10;
    canvas.SetColour(kInk);
    canvas.Text(title, kMargin, y, kTitleFont, Align::kLeft, true);
    if (wraps) y += kLine;
    double x = wraps ? kMargin : canvas.width() - kMargin - Width(canvas);
    canvas.SetColour(kFaint);
    canvas.Text(facts, x, y, kFont);
    x += canvas.TextWidth(facts, kFont);
    // On a line of its own, the first dot is at the margin if there are no facts.
    if (wraps && facts.empty()) x -= 22 - 5;
    for (const auto& [colour, text] : legend) {
      x += 22;
      canvas.SetColour(colour);
      cairo_arc(canvas.cr(), x, y, 5, 0, 2 * M_PI);
      cairo_fill(canvas.cr());
      x += 10;
      canvas.SetColour(kFaint);
      canvas.Text(text, x, y, kFont);
      x += canvas.TextWidth(text, kFont);
    }
  }
};

void DrawTile(const Canvas& canvas, const Picture& picture, int x, int y, const SheetFrame& shown,
              const std::string& caption, bool numbered) {
  cairo_t* cr = canvas.cr();
  canvas.Paste(picture, x, y);
  // Rounds the corners by painting over the outside.
  cairo_rectangle(cr, x, y, picture.width, picture.height);
  RoundedRectangle(canvas, x, y, picture.width, picture.height, kCorner);
  cairo_set_fill_rule(cr, CAIRO_FILL_RULE_EVEN_ODD);
  canvas.SetColour(kPaper);
  cairo_fill(cr);

  const double text_y = y + picture.height + kLabel / 2.0 + 1;
  if (shown.key) {
    RoundedRectangle(canvas, x + 1.5, y + 1.5, picture.width - 3, picture.height - 3,
                     kCorner - 1.5);
    canvas.SetColour(kKeyColour);
    cairo_set_line_width(cr, 3);
    cairo_stroke(cr);
  }
  canvas.SetColour(shown.key ? kInk : kFaint);
  canvas.Text(caption, x + 4, text_y, kFont, Align::kLeft, shown.key);
  double right = x + picture.width - 4;
  if (numbered) {
    const std::string number = std::to_string(shown.frame);
    canvas.SetColour(kFaint);
    canvas.Text(number, right, text_y, kFont - 2, Align::kRight);
    right -= canvas.TextWidth(number, kFont - 2) + 4;
  }
  // The badge is beside the caption, where it hides no dancer. A narrow tile has only its frame.
  const double badge = x + 12 + canvas.TextWidth(caption, kFont, true);
  const double width = canvas.TextWidth("key", kFont - 1, true) + 12;
  if (!shown.key || badge + width > right) return;
  RoundedRectangle(canvas, badge, text_y - 9, width, 18, 6);
  canvas.SetColour(kKeyColour);
  cairo_fill(cr);
  canvas.SetColour(kPaper);
  canvas.Text("key", badge + 6, text_y, kFont - 1, Align::kLeft, true);
}

}  // namespace

std::vector<SheetFrame> ChooseSheetFrames(int64_t total, const ContactSheetOptions& options) {
  CheckWithin("options.frames", options.frames, 1, kMaxSheetFrames);
  if (options.step != 0) CheckWithin("options.step", options.step, 1, kMaxSheetFrames);
  const int64_t count = EvenFrames(total, options);
  CheckWithin("options.step: frames shown", static_cast<double>(count), 1, kMaxSheetFrames);
  std::vector<int64_t> places;
  std::map<int64_t, bool> chosen;  // frame -> whether it is a key
  for (int64_t i = 0; i < count; ++i) {
    places.push_back(EvenFrame(i, count, total, options.step));
    chosen.emplace(places.back(), false);
  }
  for (const int64_t key : options.key_frames) {
    if (key < 0 || key >= total) {
      throw InvalidArgument("options.key_frames",
                            std::to_string(key) + ", must be 0 to " + std::to_string(total - 1));
    }
    const auto nearest = std::ranges::min_element(
        places, {}, [key](int64_t place) { return std::abs(place - key); });
    chosen.erase(*nearest);
  }
  for (const int64_t key : options.key_frames) chosen[key] = true;
  std::vector<SheetFrame> frames;
  for (const auto& [frame, key] : chosen) frames.push_back({frame, key});
  return frames;
}

void DrawContactSheet(const Scene& scene, const ContactSheetOptions& options,
                      const std::filesystem::path& png) {
  CheckScene(scene);
  const int64_t frames = CountFrames(scene);
  const double fps = scene.front().motion.fps;
  const bool captioned = !options.captions.empty();
  if (captioned && std::ssize(options.captions) != frames) {
    throw InvalidArgument("options.captions", std::to_string(options.captions.size()) +
                                                  " captions for " + std::to_string(frames) +
                                                  " frames");
  }
  CheckWithin("options.columns", options.columns, 1, kMaxSheetColumns);
  CheckWithin("options.tile_width", options.tile_width, 16, 4096);
  CheckWithin("options.tile_height", options.tile_height, 16, 4096);
  const std::vector<SheetFrame> shown = ChooseSheetFrames(frames, options);
  const int columns = std::min(options.columns, static_cast<int>(shown.size()));
  const int rows = (static_cast<int>(shown.size()) + columns - 1) / columns;
  const int width = 2 * kMargin + columns * (options.tile_width + kGap) - kGap;
  const Header heading(frames, fps, options);
  const bool wraps = heading.Wraps(Canvas(1, 1, kPaper), options.title, width);
  const int header = kHeader + (wraps ? Header::kLine : 0);
  const Canvas canvas(width, header + kMargin + rows * (options.tile_height + kLabel), kPaper);
  heading.Draw(canvas, options.title, wraps);

  Picture picture{.width = options.tile_width, .height = options.tile_height, .rgb = {}};
  std::vector<FramedScene> framed;
  for (const SheetFrame& one : shown) framed.push_back({one.frame, MiddleOf(scene, one.frame)});
  const std::vector<View> views = ViewsOf(
      scene, framed, static_cast<double>(options.tile_width) / options.tile_height, options.side);
  for (size_t i = 0; i < shown.size(); ++i) {
    DrawFrame(DollsAt(scene, shown[i].frame), views[i], shown[i].key ? kKeyPose : kPlain, picture);
    const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
    const int64_t since = options.rows_apart ? shown[i - static_cast<size_t>(column)].frame : 0;
    const std::string caption =
        captioned ? options.captions[static_cast<size_t>(shown[i].frame)]
                  : TimeText(options.first_s + static_cast<double>(shown[i].frame - since) / fps);
    DrawTile(canvas, picture, kMargin + column * (options.tile_width + kGap),
             header + row * (options.tile_height + kLabel), shown[i], caption,
             !options.rows_apart && !captioned);
  }
  canvas.WritePng(png);
}

}  // namespace choreo
