#include "model/formats/containers/npz.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <fstream>
#include <iterator>

#include "tests/formats/numpy.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::npz_test {

const std::filesystem::path kByNumpy =
    std::filesystem::path(CHOREO_TEST_DATA) / "amass_by_numpy.npz";

std::string Bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

NpzArchive Example() {
  NpzArchive npz;
  npz.SetArray("table", {{2, 3}, std::vector<double>{1, 2, 3, 4, 5, 6.5}});
  npz.SetArray("floats", {{2}, std::vector<float>{0.25f, -3}});
  npz.SetArray("count", {{}, std::vector<int64_t>{int64_t{1} << 40}});
  npz.SetArray("none", {{0, 72}, std::vector<double>{}});
  npz.SetText("gender", "neutral");
  npz.SetText("title", "Für Élise 🎹");
  npz.SetText("empty", "");
  return npz;
}

TEST(Npz, RoundTrips) {
  const TemporaryFolder folder;
  Example().Write(folder / "a.npz");
  const NpzArchive npz = NpzArchive::Read(folder / "a.npz");
  const NpyArray table = npz.Array("table");
  EXPECT_EQ(table.shape, (std::vector<int64_t>{2, 3}));
  EXPECT_EQ(std::get<std::vector<double>>(table.values), (std::vector<double>{1, 2, 3, 4, 5, 6.5}));
  EXPECT_EQ(std::get<std::vector<float>>(npz.Array("floats").values),
            (std::vector<float>{0.25f, -3}));
  EXPECT_EQ(std::get<std::vector<int64_t>>(npz.Array("count").values)[0], int64_t{1} << 40);
  EXPECT_TRUE(npz.Array("count").shape.empty());
  EXPECT_EQ(npz.Array("none").shape, (std::vector<int64_t>{0, 72}));
  EXPECT_EQ(npz.Text("gender"), "neutral");
  EXPECT_EQ(npz.Text("title"), "Für Élise 🎹");
  EXPECT_EQ(npz.Text("empty"), "");
}

TEST(Npz, EqualContentGivesEqualBytesAndReplacesTheFile) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.npz") << "something else that was here before";
  Example().Write(folder / "a.npz");
  Example().Write(folder / "b.npz");
  EXPECT_GT(Bytes(folder / "a.npz").size(), 1000u);
  EXPECT_EQ(Bytes(folder / "a.npz"), Bytes(folder / "b.npz"));
  // Every member has the date 1 January 1980, 0:00 (in DOS format).
  EXPECT_EQ(Bytes(folder / "a.npz").substr(10, 4), std::string("\0\0\x21\0", 4));
}

TEST(Npz, ReadsWhatNumpyCompressed) {
  const NpzArchive npz = NpzArchive::Read(kByNumpy);
  const NpyArray poses = npz.Array("poses");
  ASSERT_EQ(poses.shape, (std::vector<int64_t>{3, 156}));
  const std::vector<double> values = poses.As<double>();
  for (int frame = 0; frame < 3; ++frame) {
    for (int column = 0; column < 156; ++column) {
      EXPECT_NEAR(values[156 * frame + column], 0.01 * (frame + 1) * std::sin(column + 1), 1e-15);
    }
  }
  // Stored in Fortran order.
  const std::vector<double> trans = npz.Array("trans").As<double>();
  EXPECT_DOUBLE_EQ(trans[3], 0.1);
  EXPECT_DOUBLE_EQ(trans[4], -0.2);
  EXPECT_EQ(npz.Text("gender"), "female");
  EXPECT_EQ(npz.Text("subject"), "Zoe");
  // A pickled array does no harm until it is read.
  EXPECT_TRUE(npz.Has("markers"));
  ExpectError(ErrorCode::kInvalidArgument, "markers", [&] { npz.Array("markers"); });
}

TEST(Npz, NumpyReadsIt) {
  if (!HaveNumpy()) GTEST_SKIP() << "no python3 with numpy here";
  const TemporaryFolder folder;
  Example().Write(folder / "a.npz");
  EXPECT_EQ(RunNumpy(folder / "a.npz",
                     "d = np.load(path)\n"
                     "print(sorted(d.keys()))\n"
                     "print(d['table'].dtype, d['table'].tolist(), d['floats'].dtype, "
                     "d['floats'].tolist())\n"
                     "print(int(d['count']), d['none'].shape, str(d['gender']), "
                     "ascii(str(d['title'])), repr(str(d['empty'])))\n"),
            "['count', 'empty', 'floats', 'gender', 'none', 'table', 'title']\n"
            "float64 [[1.0, 2.0, 3.0], [4.0, 5.0, 6.5]] float32 [0.25, -3.0]\n"
            "1099511627776 (0, 72) neutral 'F\\xfcr \\xc9lise \\U0001f3b9' ''\n");
}

TEST(Npz, NamesMissingAndMistypedArrays) {
  const NpzArchive npz = NpzArchive::Read(kByNumpy);
  ExpectError(ErrorCode::kInvalidArgument, "has no array 'rotations'",
              [&] { npz.Array("rotations"); });
  ExpectError(ErrorCode::kInvalidArgument, "mocap_framerate", [&] { npz.Array("rotations"); });
  ExpectError(ErrorCode::kInvalidArgument, "is not a text", [&] { npz.Text("trans"); });
  ExpectError(ErrorCode::kInvalidArgument, "gender", [&] { npz.Array("gender"); });
  NpzArchive other;
  ExpectError(ErrorCode::kInvalidArgument, "UTF-8", [&] { other.SetText("name", "\xff"); });
}

TEST(Npz, RefusesInvalidFiles) {
  const TemporaryFolder folder;
  ExpectError(ErrorCode::kNotFound, "nowhere.npz",
              [&] { NpzArchive::Read(folder / "nowhere.npz"); });
  std::ofstream(folder / "text.npz") << "this is no zip archive, however long it may be";
  ExpectError(ErrorCode::kInvalidArgument, "text.npz",
              [&] { NpzArchive::Read(folder / "text.npz"); });

  Example().Write(folder / "a.npz");
  const std::string whole = Bytes(folder / "a.npz");
  // Any truncation loses the directory at the end.
  for (const double part : {0.1, 0.5, 0.9, 0.999}) {
    std::ofstream(folder / "cut.npz", std::ios::binary)
        << whole.substr(0, static_cast<size_t>(part * static_cast<double>(whole.size())));
    ExpectError(ErrorCode::kInvalidArgument,
                "cut.npz: not a readable npz: Not a zip archive; it may be cut off",
                [&] { NpzArchive::Read(folder / "cut.npz"); });
  }
  // A changed bit of an array's values, which the checksum reveals.
  std::string flipped = whole;
  const double value = 6.5;
  const size_t at = whole.find(std::string(reinterpret_cast<const char*>(&value), sizeof(value)));
  ASSERT_NE(at, std::string::npos);
  flipped[at] = static_cast<char>(flipped[at] ^ 4);
  std::ofstream(folder / "flip.npz", std::ios::binary) << flipped;
  ExpectError(ErrorCode::kInvalidArgument, "damaged",
              [&] { NpzArchive::Read(folder / "flip.npz"); });
}

TEST(Npz, NamesAnUnwritablePath) {
  const TemporaryFolder folder;
  ExpectError(ErrorCode::kInternal, "cannot be written",
              [&] { Example().Write(folder / "absent/a.npz"); });
}

}  // namespace choreo::npz_test
