#include "model/core/files/npy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "model/core/error.h"

namespace choreo::npy_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string Bytes(int version, const std::string& header, const std::string& body) {
  std::string bytes = "\x93NUMPY";
  bytes += static_cast<char>(version);
  bytes += '\0';
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) {
    bytes += static_cast<char>(header.size() >> (8 * i) & 0xff);
  }
  return bytes + header + body;
}

template <typename T>
std::string Raw(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

NpyArray Parse(const std::string& bytes) { return ParseNpy(bytes, "array"); }

std::string Refusal(const std::string& bytes) {
  try {
    Parse(bytes);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
    EXPECT_EQ(error.field(), "array");
    return error.what();
  }
  return "accepted";
}

// The output of numpy.save for numpy.arange(3, dtype='<f4'), byte for byte.
TEST(NpyTest, WritesTheSameBytesAsNumpy) {
  const std::string header =
      "{'descr': '<f4', 'fortran_order': False, 'shape': (3,), }" + std::string(60, ' ') + "\n";
  ASSERT_EQ(header.size(), 118u);
  EXPECT_EQ(SerializeNpy({{3}, std::vector<float>{0, 1, 2}}),
            Bytes(1, header, Raw<float>({0, 1, 2})));
}

TEST(NpyTest, EveryTypeAndShapeRoundTrips) {
  const NpyArray arrays[] = {
      {{}, std::vector<double>{29.97}},
      {{2, 3}, std::vector<float>{1, 2, 3, 4, 5, -6.5f}},
      {{2, 1, 2}, std::vector<int32_t>{1, -2, 3, 2'000'000'000}},
      {{4}, std::vector<int64_t>{1, 2, 3, int64_t{1} << 62}},
      {{0, 72}, std::vector<double>{}},
  };
  for (const NpyArray& array : arrays) {
    const std::string bytes = SerializeNpy(array);
    const NpyArray back = Parse(bytes);
    EXPECT_EQ(back.shape, array.shape);
    EXPECT_EQ(back.values, array.values);
    const size_t values = static_cast<size_t>(array.size()) * (array.values.index() % 2 ? 8 : 4);
    EXPECT_EQ((bytes.size() - values) % 64, 0u);
  }
}

TEST(NpyTest, FilesRoundTrip) {
  const auto path = std::filesystem::temp_directory_path() / "choreo_npy_test.npy";
  WriteNpy(path, {{2, 2}, std::vector<float>{1, 2, 3, 4}});
  EXPECT_THAT(ReadNpy(path).As<double>(), ElementsAre(1, 2, 3, 4));
  std::filesystem::remove(path);
  try {
    ReadNpy(path);
    FAIL() << "read a file that is not there";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kNotFound);
    EXPECT_THAT(error.what(), HasSubstr("choreo_npy_test.npy"));
  }
  EXPECT_THROW(WriteNpy("/nonexistent/folder/a.npy", {{1}, std::vector<float>{1}}), Error);
}

TEST(NpyTest, FortranOrderIsConvertedToCOrder) {
  // [[1, 2, 3], [4, 5, 6]], stored column by column.
  const NpyArray matrix = Parse(Bytes(1, "{'descr': '<i4', 'fortran_order': True, 'shape': (2, 3)}",
                                      Raw<int32_t>({1, 4, 2, 5, 3, 6})));
  EXPECT_THAT(matrix.As<int>(), ElementsAre(1, 2, 3, 4, 5, 6));
  // a[i][j][k] = 100 i + 10 j + k of shape (2, 2, 2).
  const NpyArray cube = Parse(Bytes(2, "{'fortran_order': True,'shape':(2,2,2,),'descr':\"<i8\", }",
                                    Raw<int64_t>({0, 100, 10, 110, 1, 101, 11, 111})));
  EXPECT_THAT(cube.As<int>(), ElementsAre(0, 1, 10, 11, 100, 101, 110, 111));
}

TEST(NpyTest, OtherKindsAndOrdersOfBytesAreRead) {
  using namespace std::string_literals;
  struct Row {
    std::string descr, bytes;
    std::vector<double> values;
  };
  for (const Row& row : std::vector<Row>{
           {"<f2", "\x00\x3c\x00\xc1"s, {1, -2.5}},
           {">f4", "\x3f\x80\x00\x00\xc0\x20\x00\x00"s, {1, -2.5}},
           {">f8", "\x3f\xf0\x00\x00\x00\x00\x00\x00\xc0\x04\x00\x00\x00\x00\x00\x00"s, {1, -2.5}},
           {"|u1", "\x1e\xff"s, {30, 255}},
           {"|i1", "\x1e\xff"s, {30, -1}},
           {"|b1", "\x01\x00"s, {1, 0}},
           {"<u2", "\x1e\x00\xff\xff"s, {30, 65535}},
           {">i2", "\x00\x1e\xff\xff"s, {30, -1}},
           {"<u4", "\x1e\x00\x00\x00\xff\xff\xff\xff"s, {30, 4294967295.0}},
       }) {
    const NpyArray array = Parse(Bytes(
        1, "{'descr': '" + row.descr + "', 'fortran_order': False, 'shape': (2,)}", row.bytes));
    EXPECT_EQ(array.As<double>(), row.values) << row.descr;
  }
}

TEST(NpyTest, ForeignAndDamagedBytesAreRefusedByName) {
  const std::string good = "{'descr': '<f4', 'fortran_order': False, 'shape': (2,), }";
  EXPECT_EQ(Refusal(Bytes(1, good, Raw<float>({1, 2}))), "accepted");
  EXPECT_THAT(Refusal(""), HasSubstr("not an .npy"));
  EXPECT_THAT(Refusal("RIFF....WAVEfmt "), HasSubstr("not an .npy"));
  EXPECT_THAT(Refusal(Bytes(4, good, Raw<float>({1, 2}))), HasSubstr("version 4"));
  EXPECT_THAT(Refusal(Bytes(1, good, Raw<float>({1}))),
              AllOf(HasSubstr("4 bytes"), HasSubstr("takes 8"), HasSubstr("truncated")));
  EXPECT_THAT(Refusal(Bytes(1, good, Raw<float>({1, 2, 3}))), HasSubstr("12 bytes"));
  EXPECT_THAT(Refusal(Bytes(1, good, "").substr(0, 40)), HasSubstr("header is truncated"));
  EXPECT_THAT(Refusal(Bytes(2, good, "").substr(0, 11)), HasSubstr("header is truncated"));
  EXPECT_THAT(Refusal(Bytes(1, "{'descr': '<c8', 'fortran_order': False, 'shape': (2,)}", "")),
              HasSubstr("'<c8'"));
  EXPECT_THAT(Refusal(Bytes(1, "{'descr': '|O', 'fortran_order': False, 'shape': (2,)}", "")),
              HasSubstr("'|O'"));
  EXPECT_THAT(Refusal(Bytes(1, "{'descr': '<f4', 'shape': (2,)}", "")), HasSubstr("missing"));
  EXPECT_THAT(
      Refusal(Bytes(1, "{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (2,)}", "")),
      HasSubstr("expected a string"));
  EXPECT_THAT(Refusal(Bytes(1, "{'descr': '<f4', 'fortran_order': False, 'shape': (-2,)}", "")),
              HasSubstr("extent"));
  EXPECT_THAT(Refusal(Bytes(1,
                            "{'descr': '<f4', 'fortran_order': False, 'shape': (4294967296, "
                            "4294967296)}",
                            "")),
              HasSubstr("too large"));
  EXPECT_THAT(Refusal(Bytes(1, "{'descr': '<f4', 'fortran_order': False, 'shape': (1,1,1,1,1)}",
                            Raw<float>({1}))),
              HasSubstr("5 dimensions"));
}

TEST(NpyTest, AShapeThatDoesNotMatchTheValuesIsRefused) {
  EXPECT_THROW(SerializeNpy({{2, 2}, std::vector<float>{1, 2, 3}}), Error);
}

}  // namespace choreo::npy_test
