#include <iconv.h>

#include <string>
#include <vector>

#include "tests/formats/cases/cases.h"
#include "tests/support/expect_error.h"

namespace choreo::cases_test {

TEST_F(CasesTest, BvhAsOtherToolsWriteIt) {
  const BvhFile file = MakeBvh({});
  const std::string good = BvhText(file);
  const Motion base = ReadBytes("base.bvh", good).motion;
  const auto replaced = [&](std::string from, const std::string& to) {
    std::string text = good;
    for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
    EXPECT_NE(text, good) << from;
    return text;
  };
  std::u16string wide(good.begin(), good.end());
  const auto utf16 = [&](bool big, const std::string& mark) {
    std::string bytes = mark;
    for (const char16_t unit : wide) {
      const char low = static_cast<char>(unit & 0xff), high = static_cast<char>(unit >> 8);
      bytes += big ? std::string{high, low} : std::string{low, high};
    }
    return bytes;
  };
  struct Row {
    const char* name;
    std::string bytes;
    std::string says;
  };
  for (const Row& row : std::vector<Row>{
           {"less", replaced("Frames: 30", "Frames: 29"), "says 29 frames; all 30"},
           {"nospace", replaced("Frames: 30", "Frames:30"), ""},
           {"nocolon", replaced("Frames: 30", "Frames 30"), ""},
           {"space before", replaced("Frame Time:", "Frame Time :"), ""},
           {"EndSite", replaced("End Site", "EndSite"), ""},
           {"named end", replaced("End Site", "End Site Nub"), ""},
           {"small", replaced("End Site", "end site"), ""},
           {"commas", replaced(".", ","), ""},
           {"comments", "# made by hand\n" + replaced("MOTION", "// frames\nMOTION # all"), ""},
           {"BOM", "\xEF\xBB\xBF" + good, ""},
           {"UTF-16 LE", utf16(false, "\xFF\xFE"), ""},
           {"UTF-16 BE", utf16(true, "\xFE\xFF"), ""},
           {"UTF-16", utf16(false, ""), ""},
           {"blank lines", replaced("\n", "\r\n\r\n"), ""},
           {"DOS's end of a file", good + "\r\n\x1a" + std::string(300, '\0'), ""},
           {"no rate", replaced("Frame Time: 0.033333333", "Frame Time: 0"), "states no rate"},
       }) {
    SCOPED_TRACE(row.name);
    const Read read = ReadBytes("a.bvh", row.bytes);
    EXPECT_LT(WorstJoint(base, read.motion), 1e-4);
    EXPECT_EQ(read.motion.fps, 30);
    EXPECT_EQ(read.notes.empty(), row.says.empty()) << Said(read);
    EXPECT_TRUE(row.says.empty() || read.Says(row.says)) << Said(read);
  }
  const std::string slow = replaced("Frame Time: 0.033333333", "Frame Time: 0");
  EXPECT_EQ(ReadBytes("a.bvh", slow, {.fps = 120}).motion.fps, 120);
}

// Our own files are read unchanged, unless options state their axes or units.
TEST_F(CasesTest, OwnFilesFollowTheOptions) {
  Motion motion;
  motion.fps = 30;
  for (int frame = 0; frame < 20; ++frame) {
    Pose pose = RestPose(kSmpl);
    pose.rotations.col(kSmpl.left_hip) << -0.02 * frame, 0, 0;
    pose.rotations.col(0) << M_PI, 0, 0;  // on its head
    motion.frames.push_back(pose);
  }
  const auto turned = [](const Read& read) {
    return read.motion.frames[10].rotations.col(0).norm() * kDegrees;
  };
  for (const auto& [name, up] :
       {std::pair("a.bvh", "-y"), std::pair("a.glb", "-y"), std::pair("a.npz", "-z")}) {
    SCOPED_TRACE(name);
    WriteMotion(folder_ / name, kSmpl, motion);
    EXPECT_NEAR(turned(ReadFile(name)), 180, 1e-3);
    EXPECT_LT(turned(ReadFile(name, {.up = up})), kOpen);
  }
}

// As MMD's converters write it: 頭 and 右腕 are bytes of Shift-JIS.
TEST_F(CasesTest, NamesInOtherCodePages) {
  const RigNames mmd = [](const std::string& bone) {
    return bone == "pelvis" ? "下半身" : NameInRig("MMD", bone);
  };
  const std::string text = BvhText(MakeBvh({.names = mmd}));
  const Motion base = ReadBytes("base.bvh", text).motion;
  const iconv_t converter = iconv_open("CP932", "UTF-8");
  std::string from = text, bytes(2 * text.size(), '\0');
  char *in = from.data(), *out = bytes.data();
  size_t left = from.size(), room = bytes.size();
  ASSERT_EQ(iconv(converter, &in, &left, &out, &room), 0U);
  iconv_close(converter);
  bytes.resize(bytes.size() - room);
  EXPECT_LT(WorstJoint(base, ReadBytes("a.bvh", bytes).motion), 1e-9);
  // Of the West: names that mean nothing have a way out that names them.
  std::string western = BvhText(MakeBvh({.names = [](const std::string& bone) {
    return "Kn\xF6" + std::to_string(RigIndex(bone));
  }}));
  try {
    ReadBytes("b.bvh", western);
    FAIL();
  } catch (const UnknownBones& error) {
    EXPECT_EQ(error.rig().names[0], "Knö0");
  }
}

TEST_F(CasesTest, OnePoseNeedsNoFrameTime) {
  BvhRig rig;
  rig.frames = 1;
  std::string text = BvhText(MakeBvh(rig));
  text.replace(text.find("Frame Time: "), 23, "Frame Time: 0.000000");
  const Read read = ReadBytes("a.bvh", text);
  EXPECT_EQ(read.motion.frames.size(), 1U);
  EXPECT_TRUE(read.notes.empty()) << Said(read);
}

TEST_F(CasesTest, SixChannelsThatAreZeroLeaveTheOffsets) {
  const BvhFile file = MakeBvh({});
  WriteBvh(folder_ / "base.bvh", file);
  BvhFile six = file;
  Eigen::Index rows = 0, row = 0;
  for (BvhJoint& joint : six.joints) {
    if (joint.parent >= 0 && !joint.end_site) {
      joint.channels.insert(joint.channels.begin(), {BvhChannel::kXPosition, BvhChannel::kYPosition,
                                                     BvhChannel::kZPosition});
    }
    rows += std::ssize(joint.channels);
  }
  six.values.setZero(rows, file.frames());
  Eigen::Index from = 0;
  for (const BvhJoint& joint : six.joints) {
    const Eigen::Index count = joint.end_site ? 0 : joint.parent < 0 ? 6 : 3;
    row += std::ssize(joint.channels) - count;
    six.values.middleRows(row, count) = file.values.middleRows(from, count);
    row += count, from += count;
  }
  const Read read = ReadBytes("a.bvh", BvhText(six));
  EXPECT_TRUE(read.Says("their offsets are used")) << Said(read);
  EXPECT_LT(WorstJoint(ReadFile("base.bvh").motion, read.motion), 1e-4);
  BvhFile flat = file;
  for (BvhJoint& joint : flat.joints) joint.offset.setZero();
  WriteBvh(folder_ / "flat.bvh", flat);
  ExpectError(ErrorCode::kInvalidArgument, "flat.bvh: bones: its legs have no length",
              [&] { ReadFile("flat.bvh"); });
}

}  // namespace choreo::cases_test
