#include "model/draw/contact_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/core/files/atomic_file.h"
#include "tests/draw/decoded_png.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/expect_error.h"
#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

namespace choreo::contact_sheet_test {

const Skeleton& kSmpl = Skeleton::Smpl24();
constexpr uint32_t kKeyColour = 0xd99a00;

ContactSheetOptions Small(std::vector<int64_t> keys = {}) {
  ContactSheetOptions options;
  options.title = "test";
  options.frames = 4;
  options.columns = 4;
  options.tile_width = 60;
  options.tile_height = 80;
  options.key_frames = std::move(keys);
  return options;
}

std::vector<int64_t> Shown(int64_t total, const ContactSheetOptions& options) {
  std::vector<int64_t> frames;
  for (const SheetFrame& one : ChooseSheetFrames(total, options)) {
    frames.push_back(one.key ? -one.frame : one.frame);  // keys with a minus
  }
  return frames;
}

TEST(ContactSheet, ChoosesFramesEvenlyAndKeysExactly) {
  using testing::ElementsAre;
  EXPECT_THAT(Shown(31, Small()), ElementsAre(0, 10, 20, 30));
  EXPECT_THAT(Shown(31, Small({12})), ElementsAre(0, -12, 20, 30));
  EXPECT_THAT(Shown(31, Small({12, 13, 30})), ElementsAre(0, -12, -13, 20, -30));
  EXPECT_THAT(Shown(2, Small()), ElementsAre(0, 1));
  EXPECT_THAT(Shown(1, Small()), ElementsAre(0));
  ContactSheetOptions one = Small();
  one.frames = 1;
  EXPECT_THAT(Shown(31, one), ElementsAre(0));
  ExpectError(ErrorCode::kInvalidArgument, "options.key_frames: 31, must be 0 to 30",
              [] { ChooseSheetFrames(31, Small({31})); });
}

TEST(ContactSheet, ChoosesFramesAtARate) {
  using testing::ElementsAre;
  ContactSheetOptions options = Small({6});
  options.step = 2.5;  // 12 a second at 30
  EXPECT_THAT(Shown(14, options), ElementsAre(0, 3, -6, 8, 10, 13));
  options.step = 0.5;
  ExpectError(ErrorCode::kInvalidArgument, "options.step: 0.5, must be 1 to",
              [&] { ChooseSheetFrames(31, options); });
  options.step = 1;
  ExpectError(ErrorCode::kInvalidArgument, "options.step: frames shown: 20000, must be 1 to 10000",
              [&] { ChooseSheetFrames(20'000, options); });
}

TEST(ContactSheet, SaysHowManyFramesASecondItShows) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 31, 31);
  const auto header = [&](double step) {
    ContactSheetOptions options = Small();
    options.tile_width = 200;
    options.step = step;
    DrawContactSheet({{kSmpl, motion}}, options, folder / "sheet.png");
    const DecodedPng png(folder / "sheet.png");
    return std::vector(png.pixels.begin(), png.pixels.begin() + png.width * 58);
  };
  EXPECT_EQ(header(10), header(0));  // the same four frames
  EXPECT_NE(header(5), header(10));
}

TEST(ContactSheet, HasCaptionsInPlaceOfTimes) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 31, 2);
  ContactSheetOptions options = Small();
  DrawContactSheet({{kSmpl, motion}}, options, folder / "times.png");
  options.captions = {"front", "back"};
  DrawContactSheet({{kSmpl, motion}}, options, folder / "captions.png");
  EXPECT_NE(DecodedPng(folder / "times.png").pixels, DecodedPng(folder / "captions.png").pixels);
  options.captions = {"front"};
  ExpectError(ErrorCode::kInvalidArgument, "options.captions: 1 captions for 2 frames", [&] {
    DrawContactSheet({{kSmpl, motion}}, options, folder / "x.png");
  });
}

TEST(ContactSheet, IsAPictureOfTheMotion) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 31, 31);
  DrawContactSheet({{kSmpl, motion}}, Small(), folder / "a.png");
  DrawContactSheet({{kSmpl, motion}}, Small(), folder / "again.png");
  DrawContactSheet({{kSmpl, fixtures::SmoothMotion(kSmpl, 32, 31)}}, Small(), folder / "other.png");
  DrawContactSheet({{kSmpl, motion}}, Small({12}), folder / "key.png");
  const DecodedPng a(folder / "a.png"), again(folder / "again.png"), other(folder / "other.png"),
      key(folder / "key.png");
  EXPECT_EQ(a.width, 2 * 24 + 4 * 60 + 3 * 10);
  EXPECT_GT(a.height, 80);
  EXPECT_LT(a.height, 250);
  EXPECT_GT(a.Colours(), 500u);
  EXPECT_EQ(a.pixels, again.pixels);
  EXPECT_NE(a.pixels, other.pixels);
  EXPECT_EQ(a.Count(kKeyColour), 0);
  EXPECT_GT(key.Count(kKeyColour), 200);
}

TEST(ContactSheet, LabelsKeysBelowTheirTiles) {
  const TemporaryFolder folder;
  ContactSheetOptions options = Small({0});
  options.frames = options.columns = 1;
  options.tile_width = 120;
  DrawContactSheet({{kSmpl, fixtures::SmoothMotion(kSmpl, 31, 31)}}, options, folder / "a.png");
  const DecodedPng png(folder / "a.png");
  const int bottom = png.height - 24 - 24;  // the margin, and the line below the tile
  const auto count = [&](int left, int top, int right, int end) {
    int found = 0;
    for (int y = top; y < end; ++y)
      for (int x = left; x < right; ++x) found += png.At(x, y) == kKeyColour;
    return found;
  };
  EXPECT_GT(count(24, bottom - 80, 24 + 120, bottom), 500);  // the frame
  EXPECT_EQ(count(24 + 8, bottom - 72, 24 + 112, bottom - 8), 0);
  EXPECT_GT(count(24, bottom, 24 + 120, png.height), 200);
}

TEST(ContactSheet, BreaksIntoRows) {
  const TemporaryFolder folder;
  ContactSheetOptions options = Small();
  options.columns = 2;
  DrawContactSheet({{kSmpl, fixtures::SmoothMotion(kSmpl, 31, 31)}}, options, folder / "a.png");
  const DecodedPng png(folder / "a.png");
  EXPECT_EQ(png.width, 2 * 24 + 2 * 60 + 10);
  EXPECT_GT(png.height, 160);
}

TEST(ContactSheet, PutsALongTitleOnItsOwnLineAndSpacesRows) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 32, 31);
  const auto draw = [&](const std::string& title, int width, bool apart) {
    ContactSheetOptions options = Small();
    options.frames = 32;
    options.columns = 16;
    options.tile_width = width;
    options.title = title;
    options.rows_apart = apart;
    DrawContactSheet({{kSmpl, motion}}, options, folder / "sheet.png");
    return DecodedPng(folder / "sheet.png");
  };
  const DecodedPng brief = draw("Short", 60, false);
  EXPECT_EQ(draw(std::string(90, 'W'), 60, false).height, brief.height + 26);
  // Other times below the second row, and nothing about the whole.
  const DecodedPng apart = draw("Short", 60, true);
  EXPECT_EQ(apart.height, brief.height);
  EXPECT_NE(apart.pixels, brief.pixels);
}

TEST(ContactSheet, FailedWriteKeepsTheOldFile) {
  const TemporaryFolder folder;
  WriteFile(folder / "a.png", "good");
  {
    const FullDisk full(1000);
    ExpectError(ErrorCode::kInternal, "cannot be written", [&] {
      DrawContactSheet({{kSmpl, fixtures::SmoothMotion(kSmpl, 31, 31)}}, Small(), folder / "a.png");
    });
  }
  EXPECT_EQ(std::filesystem::file_size(folder / "a.png"), 4U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(ContactSheet, RefusesWhatItCannotDraw) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 31, 3);
  ExpectError(ErrorCode::kInvalidArgument, "motion.frames: 0 frames", [&] {
    DrawContactSheet({{kSmpl, {}}}, Small(), folder / "a.png");
  });
  ContactSheetOptions tiny = Small();
  tiny.tile_width = 4;
  ExpectError(ErrorCode::kInvalidArgument, "options.tile_width: 4", [&] {
    DrawContactSheet({{kSmpl, motion}}, tiny, folder / "a.png");
  });
  ExpectError(ErrorCode::kInternal, "cannot be written", [&] {
    DrawContactSheet({{kSmpl, motion}}, Small(), folder / "absent/a.png");
  });
}

}  // namespace choreo::contact_sheet_test
