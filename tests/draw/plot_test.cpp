#include "model/draw/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/draw/decoded_png.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::plot_test {

constexpr uint32_t kFirstLine = 0x0072b2;
constexpr uint32_t kSecondLine = 0xd55e00;

Plot Example() {
  Plot plot{.title = "Losses",
            .x_label = "step",
            .y_label = "nats",
            .series = {},
            .width = 640,
            .height = 400};
  PlotSeries falling{.label = "training", .x = {}, .y = {}};
  PlotSeries level{.label = "validation", .x = {}, .y = {}};
  for (int i = 0; i <= 100; ++i) {
    falling.x.push_back(i);
    falling.y.push_back(std::exp(-i / 20.0));
    level.x.push_back(i);
    level.y.push_back(0.5);
  }
  plot.series = {falling, level};
  return plot;
}

// Rows with a line's own colour, in one column.
std::vector<int> Rows(const DecodedPng& png, int x, uint32_t colour) {
  std::vector<int> rows;
  for (int y = 100; y < png.height; ++y) {
    if (png.At(x, y) == colour) rows.push_back(y);
  }
  return rows;
}

TEST(Plot, DrawsEachLineWhereItsValuesAre) {
  const TemporaryFolder folder;
  DrawPlot(Example(), folder / "a.png");
  const DecodedPng png(folder / "a.png");
  EXPECT_EQ(png.width, 640);
  EXPECT_EQ(png.height, 400);
  EXPECT_GT(png.Count(0xffffff), 640 * 400 / 2);
  EXPECT_GT(png.Count(kFirstLine), 200);
  EXPECT_GT(png.Count(kSecondLine), 200);
  // The falling line ends below the level one.
  const std::vector<int> falling = Rows(png, 560, kFirstLine), level = Rows(png, 560, kSecondLine);
  ASSERT_FALSE(falling.empty());
  ASSERT_FALSE(level.empty());
  EXPECT_GT(falling.front(), level.back() + 40);
}

TEST(Plot, OmitsPointsThatAreNotFinite) {
  const TemporaryFolder folder;
  Plot plot = Example();
  plot.series.resize(1);
  DrawPlot(plot, folder / "whole.png");
  for (int i = 40; i < 80; ++i) plot.series[0].y[i] = std::numeric_limits<double>::quiet_NaN();
  DrawPlot(plot, folder / "gap.png");
  const DecodedPng whole(folder / "whole.png"), gap(folder / "gap.png");
  EXPECT_LT(gap.Count(kFirstLine), whole.Count(kFirstLine) - 100);
  EXPECT_GT(gap.Count(kFirstLine), 50);
}

TEST(Plot, DrawsNoneOrOneValue) {
  const TemporaryFolder folder;
  DrawPlot(Plot{}, folder / "nothing.png");
  EXPECT_EQ(DecodedPng(folder / "nothing.png").width, 1000);
  for (const double value : {0.0, 1e-9, -3e7}) {
    Plot plot;
    plot.series = {{"one", {5}, {value}}};
    DrawPlot(plot, folder / "one.png");
    EXPECT_GT(DecodedPng(folder / "one.png").Count(kFirstLine), 5) << value;
  }
}

TEST(Plot, DrawsRequestsDashedInTheColourOfResults) {
  const TemporaryFolder folder;
  Plot plot = Example();
  DrawPlot(plot, folder / "both.png");
  plot.series[1].asked = true;
  DrawPlot(plot, folder / "asked.png");
  const DecodedPng both(folder / "both.png"), asked(folder / "asked.png");
  EXPECT_EQ(asked.Count(kSecondLine), 0);
  EXPECT_GT(asked.Count(kFirstLine), both.Count(kFirstLine) + 100);
  // Ahead of all others it has none's.
  std::swap(plot.series[0], plot.series[1]);
  DrawPlot(plot, folder / "first.png");
  EXPECT_LT(DecodedPng(folder / "first.png").Count(kFirstLine), asked.Count(kFirstLine) - 100);
}

TEST(Plot, DashesALineOverAnEqualOne) {
  const TemporaryFolder folder;
  Plot plot = Example();
  plot.series[0].y = plot.series[1].y;
  DrawPlot(plot, folder / "a.png");
  const DecodedPng png(folder / "a.png");
  EXPECT_GT(png.Count(kFirstLine), 200);
  EXPECT_GT(png.Count(kSecondLine), 200);
}

TEST(Plot, TheAxisCanBeginAtZero) {
  const TemporaryFolder folder;
  Plot plot;
  plot.series = {{"low", {0, 1}, {1, 1}}, {"middle", {0, 1}, {1.4, 1.4}}, {"high", {0, 1}, {2, 2}}};
  const auto apart = [&] {
    DrawPlot(plot, folder / "a.png");
    const DecodedPng png(folder / "a.png");
    return Rows(png, 500, kFirstLine).front() - Rows(png, 500, kSecondLine).back();
  };
  EXPECT_GT(apart(), 150);
  plot.from_zero = true;
  EXPECT_LT(apart(), 110);
}

TEST(Plot, BarsAreSideBySideFromZero) {
  const TemporaryFolder folder;
  Plot plot;
  plot.x_names = {"one song", "another song", "a third"};
  plot.series = {{"low", {0, 1}, {5, 5}}, {"high", {0, 1}, {10, NAN}}, {"highest", {2}, {20}}};
  DrawPlot(plot, folder / "bars.png");
  const DecodedPng png(folder / "bars.png");
  // Columns and rows of a colour, without the legend.
  const auto extent = [&](uint32_t colour) {
    int columns = 0, tallest = 0;
    for (int x = 0; x < png.width; ++x) {
      const auto rows = static_cast<int>(Rows(png, x, colour).size());
      columns += rows > 0, tallest = std::max(tallest, rows);
    }
    return std::pair(columns, tallest);
  };
  const auto [low_width, low] = extent(kFirstLine);
  const auto [high_width, high] = extent(kSecondLine);
  EXPECT_NEAR(low_width, 2 * high_width, 6);  // one of the high ones is not there
  EXPECT_NEAR(2 * low, high, 4);
  EXPECT_GT(high, 200);
}

TEST(Plot, OmitsNamesThatWouldOverlap) {
  const TemporaryFolder folder;
  Plot plot;
  plot.series = {{"one", {0}, {1}}};
  const auto dark = [&](size_t count) {
    plot.x_names = std::vector<std::string>(count, "the name of a song");
    DrawPlot(plot, folder / "names.png");
    return DecodedPng(folder / "names.png").Count(0x24292f);
  };
  EXPECT_LT(dark(200), 2 * dark(5));
}

TEST(Plot, MapsHaveEqualScalesOnBothAxes) {
  const TemporaryFolder folder;
  Plot plot;
  plot.series = {{"square", {0, 1, 1, 0, 0}, {0, 0, 1, 1, 0}}};
  plot.map = true;
  DrawPlot(plot, folder / "map.png");
  const DecodedPng png(folder / "map.png");
  int left = png.width, right = 0, top = png.height, bottom = 0;
  for (int y = 45; y < png.height; ++y) {  // below the legend
    for (int x = 0; x < png.width; ++x) {
      if (png.At(x, y) != kFirstLine) continue;
      left = std::min(left, x), right = std::max(right, x);
      top = std::min(top, y), bottom = std::max(bottom, y);
    }
  }
  EXPECT_NEAR(right - left, bottom - top, 3);
  EXPECT_GT(right - left, 200);
}

TEST(Plot, RefusesWhatItCannotDraw) {
  const TemporaryFolder folder;
  Plot plot = Example();
  plot.series[1].y.pop_back();
  ExpectError(ErrorCode::kInvalidArgument, "plot.series['validation']: 101 x and 100 y",
              [&] { DrawPlot(plot, folder / "a.png"); });
  Plot small;
  small.width = 10;
  ExpectError(ErrorCode::kInvalidArgument, "plot.width: 10",
              [&] { DrawPlot(small, folder / "a.png"); });
  ExpectError(ErrorCode::kInternal, "cannot be written",
              [&] { DrawPlot(Example(), folder / "absent/a.png"); });
}

}  // namespace choreo::plot_test
