// The log of files that were once read wrong, or refused without need. Each row has a way to make
// the file, the options of `choreo convert`, the right result, and the notes.
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "tests/formats/cases/cases.h"
#include "tests/support/expect_error.h"

namespace choreo::log_test {

using namespace cases_test;

const Eigen::Matrix3d kMirror = Eigen::Vector3d(-1, 1, 1).asDiagonal();

std::string OtherSide(const std::string& bone) {
  if (bone.starts_with("left_")) return "right_" + bone.substr(5);
  return bone.starts_with("right_") ? "left_" + bone.substr(6) : bone;
}

// The motion of a body whose mirror image moves as `Expressive` describes.
Eigen::Matrix3d Mirrored(const std::string& bone, int frame) {
  return kMirror * Expressive(OtherSide(bone), frame) * kMirror;
}

// Dances on its back: on the floor all the time.
Eigen::Matrix3d Lying(const std::string& bone, int frame) {
  if (bone == "pelvis") return About(1, 0, 0, -90);
  if (bone.ends_with("_hip")) return About(1, 0, 0, -25 + 15 * std::sin(frame * 0.3));
  return bone.ends_with("_knee") ? About(1, 0, 0, 10) : Walk(bone, frame);
}

Eigen::Matrix3d HangingArms(const std::string& bone) {
  const bool arm =
      bone.ends_with("_shoulder") || bone.ends_with("_elbow") || bone.ends_with("_wrist");
  return arm ? About(0, 0, 1, bone.starts_with("left_") ? -88 : 88) : About(0, 1, 0, 0);
}

// Channels before and after the rotations of every joint but the root, with the same values
// throughout.
BvhFile WithChannels(const BvhFile& file, const std::vector<BvhChannel>& before, double position,
                     const std::vector<BvhChannel>& after, double scale) {
  BvhFile more = file;
  std::vector<Eigen::RowVectorXd> rows;
  Eigen::Index from = 0;
  const auto constant = [&](double value) {
    rows.emplace_back(Eigen::RowVectorXd::Constant(file.frames(), value));
  };
  for (size_t i = 0; i < file.joints.size(); ++i) {
    std::vector<BvhChannel>& channels = more.joints[i].channels;
    const bool adds = !file.joints[i].end_site && file.joints[i].parent >= 0;
    for (size_t k = 0; adds && k < before.size(); ++k) constant(position);
    for (size_t k = 0; k < channels.size(); ++k) rows.emplace_back(file.values.row(from++));
    for (size_t k = 0; adds && k < after.size(); ++k) constant(scale);
    if (!adds) continue;
    channels.insert(channels.begin(), before.begin(), before.end());
    channels.insert(channels.end(), after.begin(), after.end());
  }
  more.values.resize(std::ssize(rows), file.frames());
  for (size_t row = 0; row < rows.size(); ++row)
    more.values.row(static_cast<Eigen::Index>(row)) = rows[row];
  return more;
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

BvhFile LyingOnTheFloor() {
  BvhFile file = MakeBvh({.turn = Lying});
  file.values.row(1).setConstant(12);
  return file;
}

std::string Dance(const std::function<void(GlbRigs&, int body)>& change,
                  const RigNames& names = NamesOf(kHumanIkRig), const RigTurn& turn = Expressive) {
  GlbRigs glb;
  const int body = glb.AddBody(names);
  glb.AddSkin(body);
  glb.AddAnimation("dance", body, turn, 20);
  change(glb, body);
  return glb.Bytes();
}

// All nodes below a node of the whole, which is in the note.
GlbRigs::Json& Above(GlbRigs& glb, int body) {
  const int above = glb.AddNode({{"name", "Root"}, {"children", {body}}});
  return glb.document["nodes"][static_cast<size_t>(above)];
}

// Rotations by which of their numbers are not 0, as some exporters save room.
void MakeSparse(GlbRigs& glb) {
  for (auto& sampler : glb.document["animations"][0]["samplers"]) {
    auto& accessor = glb.document["accessors"][sampler["output"].get<size_t>()];
    const size_t view = accessor["bufferView"].get<size_t>(),
                 count = accessor["count"].get<size_t>();
    std::string indices;
    for (size_t i = 0; i < count; ++i) indices += {static_cast<char>(i), 0};
    indices.resize((indices.size() + 3) / 4 * 4);
    glb.document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", glb.binary.size()}, {"byteLength", indices.size()}});
    glb.binary += indices;
    glb.document["buffers"][0]["byteLength"] = glb.binary.size();
    accessor.erase("bufferView");
    accessor["sparse"] = {
        {"count", count},
        {"indices",
         {{"bufferView", glb.document["bufferViews"].size() - 1}, {"componentType", 5123}}},
        {"values", {{"bufferView", view}}}};
  }
}

struct Row {
  const char* name;
  const char* file;
  std::string bytes;
  const char* options = "";  ///< of convert
  RigTurn right = Expressive;
  const char* says = "";  ///< a part of its note, or none
};

TEST_F(CasesTest, TheLogOfRigs) {
  const BvhFile base = MakeBvh({.turn = Expressive});
  const std::vector<BvhChannel> positions = {BvhChannel::kXPosition, BvhChannel::kYPosition,
                                             BvhChannel::kZPosition};
  const std::vector<BvhChannel> scales = {BvhChannel::kXScale, BvhChannel::kYScale,
                                          BvhChannel::kZScale};
  const RigNames mmd = [](const std::string& bone) {
    return bone == "pelvis" ? "下半身" : NameInRig("MMD", bone);
  };
  const std::vector<Row> rows = {
      {"more frames in the header than rows", "a.bvh",
       Replaced(BvhText(base), "Frames: 30", "Frames: 31"), "", Expressive,
       "says 31 frames; all 30"},
      {"six channels, places as small changes of the offsets", "a.bvh",
       BvhText(WithChannels(base, positions, 0.02, {}, 0)), "", Expressive,
       "0 or nearly so in all frames; their offsets are used"},
      {"scale channels", "a.bvh", BvhText(WithChannels(base, {}, 0, scales, 1))},
      {"arms that hang at rest", "a.bvh",
       BvhText(MakeBvh({.turn = Expressive, .zero = HangingArms}))},
      {"left-handed axes", "a.bvh", BvhText(MakeBvh({.turn = Expressive, .world = kMirror})), "",
       Mirrored, "its left and right are exchanged"},
      {"on the floor all the time", "a.bvh", BvhText(LyingOnTheFloor()), "", Lying,
       "its body lies; --up"},
      {"the same, told", "a.bvh", BvhText(LyingOnTheFloor()), "--up y", Lying},
      {"sparse accessors", "a.glb", Dance([](GlbRigs& glb, int) { MakeSparse(glb); })},
      {"a mirror above a body that is mirrored", "a.glb", Dance([](GlbRigs& glb, int body) {
         Above(glb, body)["scale"] = {-1, 1, 1};
       }),
       "", Mirrored, "its left and right are exchanged"},
      {"legs hang from MMD's lower body", "a.glb",
       Dance([](GlbRigs& glb, int body) { Above(glb, body)["name"] = "センター"; }, mmd)},
      {"bound in axes of the skin's own, and on the floor", "a.glb",
       Dance(
           [](GlbRigs& glb, int body) {
             // As if the mesh lay in an armature whose Z is up.
             const auto view = glb.document["skins"][0]["inverseBindMatrices"].get<size_t>();
             const auto offset =
                 glb.document["bufferViews"][glb.document["accessors"][view]["bufferView"]
                                                 .get<size_t>()]["byteOffset"]
                     .get<size_t>();
             Eigen::Matrix4f z_up = Eigen::Matrix4f::Identity();
             z_up.topLeftCorner<3, 3>() = About(1, 0, 0, -90).cast<float>();
             for (size_t i = 0; i < RigBody().size(); ++i) {
               Eigen::Matrix4f matrix;
               std::memcpy(matrix.data(), glb.binary.data() + offset + 64 * i, 64);
               matrix = matrix * z_up;
               std::memcpy(glb.binary.data() + offset + 64 * i, matrix.data(), 64);
             }
             // Without a key, the pelvis stands where its node does.
             auto& channels = glb.document["animations"][0]["channels"];
             channels.erase(channels.size() - 1);
             glb.document["nodes"][static_cast<size_t>(body)]["translation"] = {0, 0.12, 0};
           },
           NamesOf(kHumanIkRig), Lying),
       "", Lying, "its body lies"},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.name);
    const Read read = ReadBytes(row.file, row.bytes, Options(row.options));
    const Wrong wrong = Compare(read.motion, row.right);
    EXPECT_LT(wrong.limbs, 0.1);
    EXPECT_LT(wrong.turns, kOpen) << wrong.where;
    EXPECT_EQ(read.notes.empty(), std::string(row.says).empty()) << Said(read);
    EXPECT_TRUE(read.notes.empty() || read.Says(row.says)) << Said(read);
  }
}

TEST_F(CasesTest, AGltfThatIsText) {
  GlbRigs glb;
  const int body = glb.AddBody(NamesOf(kHumanIkRig));
  glb.AddAnimation("dance", body, Expressive, 20);
  WriteFile(folder_ / "the dance.bin", glb.binary);
  glb.document["buffers"][0]["uri"] = "the%20dance.bin";
  EXPECT_LT(Compare(ReadBytes("a.gltf", glb.document.dump()).motion, Expressive).turns, kOpen);
  std::filesystem::remove(folder_ / "the dance.bin");
  ExpectError(
      ErrorCode::kInvalidArgument,
      "a.gltf: buffers[0].uri: \"the%20dance.bin\" is not a file beside it: export it as .glb",
      [&] { ReadFile("a.gltf"); });
  for (const char* elsewhere : {"../the dance.bin", "/etc/passwd"}) {
    glb.document["buffers"][0]["uri"] = elsewhere;
    ExpectError(ErrorCode::kInvalidArgument, "is not a file beside it",
                [&] { ReadBytes("a.gltf", glb.document.dump()); });
  }
  // Four bytes of time, which are 0.
  glb.document["buffers"][0] = {{"byteLength", 4},
                                {"uri", "data:application/octet-stream;base64,AAAAAA=="}};
  ExpectError(ErrorCode::kInvalidArgument, "reaches beyond its buffer of 4 bytes",
              [&] { ReadBytes("a.gltf", glb.document.dump()); });
}

TEST_F(CasesTest, OtherFormatsGetAdvice) {
  for (const auto& [name, way] :
       {std::pair("a.fbx", "Blender imports it, and exports .glb"),
        std::pair("a.vrm", "its motions are .vrma"), std::pair("a.C3D", "solve them to .bvh")}) {
    ExpectError(ErrorCode::kInvalidArgument, way, [&] { ReadFile(name); });
  }
}

}  // namespace choreo::log_test
