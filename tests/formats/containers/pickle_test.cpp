#include "model/formats/containers/pickle.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::pickle_test {

using namespace std::string_literals;

/// Written by Python 3.11 with NumPy 1.24:
///   table = np.arange(12, dtype='<f8').reshape(3, 4) / 8
///   pickle.dumps({'table': table, 'fortran': np.asfortranarray(np.arange(6, dtype='<f4')
///     .reshape(2, 3)), 'scaling': np.array([93.5], dtype='<f4'), 'counts': np.array([-1, 300,
///     1 << 40], dtype='<i8'), 'loss': 0.25, 'frames': -70000, 'same': table}, protocol)
std::filesystem::path ByNumpy(int protocol) {
  return std::filesystem::path(CHOREO_TEST_DATA) / "pickles" /
         ("protocol" + std::to_string(protocol) + ".pkl");
}

std::string Bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

NpzArchive Parse(const std::string& bytes) { return ParsePickledArrays(bytes, "a.pkl"); }

void Refused(const std::string& bytes, const std::string& part) {
  ExpectError(ErrorCode::kInvalidArgument, part, [&] { Parse(bytes); });
  ExpectError(ErrorCode::kInvalidArgument, "a.pkl: opcode 0x", [&] { Parse(bytes); });
}

TEST(PickleTest, ReadsWhatNumpyPickled) {
  for (const int protocol : {0, 1, 2, 3, 4, 5}) {
    const NpzArchive arrays = Parse(Bytes(ByNumpy(protocol)));
    const NpyArray table = arrays.Array("table");
    EXPECT_EQ(table.shape, (std::vector<int64_t>{3, 4}));
    const auto& values = std::get<std::vector<double>>(table.values);
    for (size_t i = 0; i < 12; ++i) EXPECT_EQ(values.at(i), static_cast<double>(i) / 8);
    EXPECT_EQ(arrays.Array("same").As<double>(), values);
    const NpyArray fortran = arrays.Array("fortran");
    EXPECT_EQ(fortran.shape, (std::vector<int64_t>{2, 3}));
    EXPECT_EQ(std::get<std::vector<float>>(fortran.values), (std::vector<float>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(arrays.Array("scaling").As<double>(), std::vector<double>{93.5});
    EXPECT_EQ(std::get<std::vector<int64_t>>(arrays.Array("counts").values),
              (std::vector<int64_t>{-1, 300, int64_t{1} << 40}));
    EXPECT_EQ(arrays.Array("loss").As<double>(), std::vector<double>{0.25});
    EXPECT_EQ(arrays.Array("frames").As<int64_t>(), std::vector<int64_t>{-70000});
    EXPECT_TRUE(arrays.Array("frames").shape.empty());
  }
}

/// pickle.dumps({'smpl_scaling': np.float32(93.5), 'smpl_loss': np.float64(0.25), 'frames':
/// np.int64(-70000)}, protocol), as some of AIST++'s files hold them.
TEST(PickleTest, ReadsNumbersThatNumpyPickled) {
  for (const char* protocol : {"0", "2", "4"}) {
    const NpzArchive numbers = Parse(Bytes(std::filesystem::path(CHOREO_TEST_DATA) / "pickles" /
                                           ("scalars" + std::string(protocol) + ".pkl")));
    EXPECT_EQ(numbers.Array("smpl_scaling").As<double>(), std::vector<double>{93.5});
    EXPECT_EQ(numbers.Array("smpl_loss").As<double>(), std::vector<double>{0.25});
    EXPECT_EQ(numbers.Array("frames").As<int64_t>(), std::vector<int64_t>{-70000});
    EXPECT_TRUE(numbers.Array("frames").shape.empty());
  }
}

TEST(PickleTest, RunsNoCode) {
  const TemporaryFolder folder;
  const std::filesystem::path made = folder / "made";
  const std::string command = "touch " + made.string();
  const std::string argument =
      "X" + std::string{static_cast<char>(command.size()), 0, 0, 0} + command;
  Refused("\x80\x02" + "cposix\nsystem\n"s + argument + "\x85R.",
          "opcode 0x63 at byte 2: it names 'posix.system'");
  Refused("\x80\x04\x8c\x08"s + "builtins" + "\x8c\x04" + "eval" + "\x93" + argument + "\x85R.",
          "opcode 0x93 at byte 18: it names 'builtins.eval'");
  // What is known is not called in other ways, either.
  Refused("\x80\x02" + "cnumpy\nndarray\n"s + argument + "\x85R.", "a call of 'numpy.ndarray'");
  Refused("\x80\x02" + "c_codecs\nencode\n"s + argument + "U\x03zip\x86R.", "_codecs.encode");
  EXPECT_FALSE(std::filesystem::exists(made));
  // INST, OBJ, NEWOBJ, NEWOBJ_EX, PERSID, BINPERSID, EXT1 to EXT4, NEXT_BUFFER.
  for (const char opcode : "io\x81\x92PQ\x82\x83\x84\x97"s) {
    Refused("\x80\x04(}"s + opcode + "posix\nsystem\n.", " at byte 4: is not read");
  }
}

/// dict(fps=30, gender='f', betas=None, names=['a', 'b'], more={'k': 1}, poses=[3.5]), and that in
/// an array of objects, as numpy.save(path, dict) writes it, of which the array's own header is
/// cut.
TEST(PickleTest, OmitsNonArrays) {
  const std::string dict =
      "}(U\x03"
      "fpsK\x1eU\x06genderU\x01"
      "fU\x05"
      "betasNU\x05names](U\x01"
      "aU\x01"
      "beU\x04more}U\x01kK\x01sU\x05poses]G\x40\x0c\0\0\0\0\0\0au"s;
  const std::string objects =
      "cnumpy.core.multiarray\n_reconstruct\ncnumpy\nndarray\nK\0\x85"
      "C\x01"
      "b\x87R(K\x01)cnumpy\ndtype\nX\x02\0\0\0O8\x89\x88\x87R(K\x03X\x01\0\0\0|"
      "NNNJ\xff\xff\xff\xffJ"
      "\xff\xff\xff\xffK\x3ftb\x89]"s +
      dict + "atb.";
  for (const std::string& bytes : {"\x80\x02" + dict + ".", "\x80\x03" + objects}) {
    const NpzArchive arrays = Parse(bytes);
    EXPECT_EQ(arrays.Array("fps").As<double>(), std::vector<double>{30});
    EXPECT_EQ(arrays.Array("poses").As<double>(), std::vector<double>{3.5});
    EXPECT_EQ(arrays.Text("gender"), "f");
    EXPECT_FALSE(arrays.Has("betas") || arrays.Has("names") || arrays.Has("more"));
  }
  Refused(
      "\x80\x02}U\x01k](K\x01K\x01"
      "es."s,
      "'k' is a list of several arrays");
}

/// dict(fps=30, gender='f', poses=np.array([1.5, -2])), as Python 2 writes bytes and numbers.
TEST(PickleTest, ReadsWhatPython2Wrote) {
  const NpzArchive arrays = Parse(R"((dp0
S'fps'
p1
I30
sS"gender"
S'f\x6f\'\n'
sS'many'
L123456789012345678901234567890L
sS'few'
L-7L
sS'loss'
F-0.25
sS'names'
(lp2
S'a'
asS'poses'
cnumpy.core.multiarray
_reconstruct
(cnumpy
ndarray
(I0
tS'b'
tR(I1
(I2
tcnumpy
dtype
(S'f8'
I00
I01
tR(I3
S'<'
NNNI-1
I-1
I0
tbI00
S'\x00\x00\x00\x00\x00\x00\xf8?\x00\x00\x00\x00\x00\x00\x00\xc0'
tbsg1
I31
s.)");
  EXPECT_EQ(arrays.Array("fps").As<double>(), std::vector<double>{31});
  EXPECT_EQ(arrays.Text("gender"), "fo'\n");
  EXPECT_FALSE(arrays.Has("many"));
  EXPECT_EQ(arrays.Array("few").As<double>(), std::vector<double>{-7});
  EXPECT_EQ(arrays.Array("loss").As<double>(), std::vector<double>{-0.25});
  EXPECT_EQ(arrays.Array("poses").As<double>(), (std::vector<double>{1.5, -2}));
  Refused("(dS'a\\q'\n", "no text follows");
  Refused("(dVa\\u12\n", "no text follows");
  Refused("(dI1x\n", "no number follows");
  Refused("(dg5\n.", "nothing was stored as 5");
}

TEST(PickleTest, ReadsLongNumbers) {
  const NpzArchive numbers = Parse(
      "\x80\x02}(U\x01"
      "a\x8a\x05\0\0\0\0\xffU\x01"
      "b\x8a\0U\x01"
      "c\x8a\x09"
      "123456789u."s);
  EXPECT_EQ(numbers.Array("a").As<int64_t>(), std::vector<int64_t>{-(int64_t{1} << 32)});
  EXPECT_EQ(numbers.Array("b").As<int64_t>(), std::vector<int64_t>{0});
  EXPECT_FALSE(numbers.Has("c"));
}

TEST(PickleTest, ReadsDictsOfOtherClassesAndKeys) {
  const NpzArchive arrays = Parse(
      "\x80\x02"
      "ccollections\ndefaultdict\nc__builtin__\ndict\n\x85RK\x07"
      "ccollections\nOrderedDict\n)RU\x01kK\x05ss."s);
  EXPECT_EQ(arrays.Nested("7").Array("k").As<int64_t>(), std::vector<int64_t>{5});
}

TEST(PickleTest, OnlyDictsOfArraysAndNumbers) {
  Refused("", "not a pickle of protocol 0 to 5");
  Refused("}", "the file ends within it");
  Refused("no pickle", "not a pickle of protocol 0 to 5");
  Refused("\x80\x06}.", "not a pickle of protocol 0 to 5");
  Refused("\x80\x02)."s, "expected a dict");
  Refused("\x80\x02."s, "nothing on the stack");
  Refused("\x80\x02}u."s, "no mark on the stack");
  Refused("\x80\x02})K\x02s."s, "expected a text");
  Refused("\x80\x02}h\x05."s, "nothing was stored as 5");
  const std::string whole = Bytes(ByNumpy(4));
  std::string other = whole;
  other.replace(other.find("\x8c\x01<"), 3, "\x8c\x01=");
  Refused(other, "values of the order '=' of bytes");
  other = whole;
  const size_t extent = other.find("K\x03K\x04\x86");
  ASSERT_NE(extent, std::string::npos);
  other.replace(extent, 2, "G\xe1\x40\x40\x40\x40\x40\x40\x40");  // -4.7e160
  Refused(other, "a number that is not whole");
  other = whole;
  other.replace(other.find("f8"), 2, "c8");
  ExpectError(ErrorCode::kInvalidArgument, "a.pkl: values of type '<c8'", [&] { Parse(other); });
}

TEST(PickleTest, SmallFilesStaySmall) {
  Refused("\x80\x02" + std::string(5000, 'N'), "more than 4096 operations");
  // The bytes of 32 numbers, stored once and made into array after array.
  std::string bytes = "\x80\x02T\x00\x01\x00\x00"s + std::string(256, '\0') + "q\x01";
  bytes +=
      "cnumpy\ndtype\nU\x02"
      "f8\x85Rq\x02"
      "cnumpy.core.numeric\n_frombuffer\nq\x03"s;
  const std::string array =
      "h\x03(h\x01h\x02K\x20\x85U\x01"
      "CtR"s;
  EXPECT_EQ(Parse(bytes + "}U\x01k" + array + "s.").Array("k").size(), 32);
  Refused(bytes + "}U\x01k" + array + array + "s.", "more values than the file has");
}

TEST(PickleTest, DamagedFilesAreRefusedOrRead) {
  for (const int protocol : {0, 2, 4, 5}) {
    const std::string whole = Bytes(ByNumpy(protocol));
    for (size_t size = 0; size < whole.size(); ++size)
      EXPECT_THROW(Parse(whole.substr(0, size)), Error) << protocol << ' ' << size;
    for (size_t at = 0; at < whole.size(); ++at) {
      for (const int change : {1, 0x80, 0x55}) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ change);
        try {
          Parse(damaged);
        } catch (const Error&) {
        }
      }
    }
  }
}

}  // namespace choreo::pickle_test
