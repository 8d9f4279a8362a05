#include <gtest/gtest.h>

#include <fstream>

#include "model/formats/gltf/gltf.h"
#include "tests/formats/character_fixture.h"
#include "tests/support/expect_error.h"
#include "tests/support/shell.h"

namespace choreo::character_test {

using nlohmann::json;
using testing_support::CharacterRig;
using testing_support::ChildBody;
using testing_support::Glb;
using testing_support::LongLegs;
using testing_support::WriteCharacter;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

TEST_F(CharacterTest, EveryRigInEveryRestPoseDancesTheDance) {
  struct Maker {
    const char* rig;
    const char* prefix;
  };
  constexpr Maker kMakers[] = {{"Mixamo and HumanIK", "mixamorig:"},
                               {"VRM", ""},
                               {"VRoid", "J_Bip_"},
                               {"Unreal", ""},
                               {"Rigify", "DEF-"},
                               {"iClone", "CC_Base_"},
                               {"Daz Genesis 9", ""},
                               {"Biped", "Bip01 "},
                               {"CMU", ""}};
  struct RestPoses {
    const char* name;
    double down;
    bool rolled;
  };
  constexpr RestPoses kRests[] = {
      {"T-pose", 0, false}, {"A-pose", 50, false}, {"rolled", 30, true}};
  const std::pair<const char*, Skeleton> bodies[] = {
      {"child", ChildBody()}, {"adult", Smpl()}, {"long legs", LongLegs()}};
  // Each maker once with each rest pose, bodies in turn.
  size_t turn = 0;
  for (const Maker& maker : kMakers) {
    for (const RestPoses& rest : kRests) {
      const auto& [size, body] = bodies[turn++ % 3];
      WriteCharacter(folder_ / "hero.glb", {.rig = maker.rig,
                                            .prefix = maker.prefix,
                                            .body = body,
                                            .arms_down = rest.down,
                                            .rolled = rest.rolled});
      Dance("hero.glb");
      // Legs of another share of hips and thighs reach feet by other angles.
      EXPECT_LT(WorstDirection(), body == Smpl() ? 2 : 8)
          << maker.rig << ", " << rest.name << ", " << size;
    }
    ++turn;
  }
}

TEST_F(CharacterTest, ArmaturesMayBeTurnedScaledAndFaceAnywhere) {
  for (const double scale : {0.01, 3.0}) {
    for (const double facing : {0.0, 90.0, 180.0}) {
      WriteCharacter(folder_ / "hero.glb",
                     {.arms_down = 45, .rolled = true, .armature_scale = scale, .facing = facing});
      Dance("hero.glb");
      EXPECT_LT(WorstDirection(), 2) << scale << ", " << facing;
    }
  }
}

TEST_F(CharacterTest, TheNodeAboveTheBonesCarriesThemOverTheFloor) {
  WriteCharacter(folder_ / "hero.glb",
                 {.arms_down = 45, .rolled = true, .armature_scale = 0.01, .facing = 90});
  const CharacterBody body = Dance("hero.glb");
  const GltfScene usual = ReadGltfScene(folder_ / "out.glb");
  Dance("hero.glb", RootMotion::kRoot);
  const GltfScene carried = ReadGltfScene(folder_ / "out.glb");
  const auto pelvis = static_cast<size_t>(body.nodes[0]);
  const auto root = static_cast<size_t>(usual.nodes.parents[pelvis]);
  const Eigen::Affine3d rest = usual.nodes.PlaceAtRest()[root];
  for (int64_t frame = 0; frame < usual.frames; ++frame) {
    const auto a = usual.Frame(frame), b = carried.Frame(frame);
    for (const int node : body.nodes) {
      if (node < 0) continue;
      const auto at = static_cast<size_t>(node);
      EXPECT_LT((a[at].translation() - b[at].translation()).norm(), 1e-3)
          << "the dance is the same";
    }
    EXPECT_TRUE(a[root].isApprox(rest, 1e-6));
    const Eigen::Vector3d way = b[root] * rest.inverse() * Eigen::Vector3d::Zero();
    EXPECT_NEAR(way.x(), b[pelvis].translation().x(), 1e-3);
    EXPECT_NEAR(way.y(), 0, 1e-3);
    EXPECT_NEAR(way.z(), b[pelvis].translation().z(), 1e-3);
  }
}

TEST_F(CharacterTest, APelvisWithoutANodeAboveItGetsOneThatCarriesIt) {
  WriteGlb(folder_ / "hero.glb", Smpl(), smpl_);
  const CharacterBody body = Dance("hero.glb");
  const GltfScene usual = ReadGltfScene(folder_ / "out.glb");
  Dance("hero.glb", RootMotion::kRoot);
  const GltfScene carried = ReadGltfScene(folder_ / "out.glb");
  EXPECT_EQ(carried.nodes.names.back(), "root");
  const auto pelvis = static_cast<size_t>(body.nodes[0]);
  EXPECT_EQ(carried.nodes.parents[pelvis] + 1, std::ssize(carried.nodes.names));
  for (int64_t frame = 0; frame < usual.frames; ++frame) {
    EXPECT_TRUE(usual.Frame(frame)[pelvis].isApprox(carried.Frame(frame)[pelvis], 1e-4));
  }
}

TEST_F(CharacterTest, AllElseStaysByteForByte) {
  WriteCharacter(folder_ / "hero.glb", {});
  Glb hero(folder_ / "hero.glb");
  json& document = hero.document;
  document["extensionsUsed"] = {"VENDOR_hair"};
  document["extensions"]["VENDOR_hair"] = {{"strands", 1e-7}, {"name", "Ünï"}};
  document["animations"] = {
      {{"name", "wave"}, {"channels", json::array()}, {"samplers", json::array()}}};
  document["nodes"][3]["extras"]["spring"] = 3;
  hero.Write(folder_ / "hero.glb");
  Dance("hero.glb");
  Glb out(folder_ / "out.glb");
  ASSERT_EQ(out.binary.substr(0, hero.binary.size()), hero.binary);
  EXPECT_EQ(out.document["animations"].size(), 2U);
  EXPECT_EQ(out.document["animations"][0]["name"], "dance");
  EXPECT_EQ(out.document["animations"][1], document["animations"][0]);
  EXPECT_EQ(out.document["buffers"][0]["byteLength"], out.binary.size());
  for (const char* list : {"accessors", "bufferViews"}) {
    for (size_t i = 0; i < document[list].size(); ++i)
      EXPECT_EQ(out.document[list][i], document[list][i]) << list << i;
  }
  for (const char* changed : {"animations", "accessors", "bufferViews", "buffers"}) {
    out.document.erase(changed);
    document.erase(changed);
  }
  EXPECT_EQ(out.document, document);
}

TEST_F(CharacterTest, TheSameDanceGivesTheSameBytes) {
  WriteCharacter(folder_ / "hero.glb", {});
  Dance("hero.glb");
  const Glb first(folder_ / "out.glb");
  Dance("hero.glb");
  const Glb second(folder_ / "out.glb");
  EXPECT_EQ(first.document, second.document);
  EXPECT_EQ(first.binary, second.binary);
}

TEST_F(CharacterTest, PrefersVrmsTableToNames) {
  const auto table = [](const Glb& glb, bool old) {
    json bones = old ? json::array() : json::object();
    for (int node = 0; node < 24; ++node) {
      const std::string bone = NameInRig("VRM", Smpl().joint_names[static_cast<size_t>(node)]);
      if (bone.empty()) continue;
      if (old) {
        bones.push_back({{"bone", bone}, {"node", node}, {"useDefaultValues", true}});
      } else {
        bones[bone]["node"] = node;
      }
    }
    (void)glb;
    return bones;
  };
  for (const bool old : {true, false}) {
    const CharacterBody body = DanceChanged(
        [&](Glb& glb) {
          glb.document["extensions"][old ? "VRM" : "VRMC_vrm"]["humanoid"]["humanBones"] =
              table(glb, old);
        },
        {.rig = "", .arms_down = 10});
    EXPECT_EQ(body.nodes[0], 0);
    const Glb out(folder_ / "out.glb");
    EXPECT_TRUE(out.document["extensions"].contains(old ? "VRM" : "VRMC_vrm"));
  }
}

// A mesh that is called as a bone, extra joints between and below, a matrix in place of parts.
TEST_F(CharacterTest, OtherNodesAreLeftAlone) {
  DanceChanged([](Glb& glb) {
    json& nodes = glb.document["nodes"];
    nodes.push_back({{"name", "twist"}, {"children", {18}}});
    nodes[16]["children"] = {nodes.size() - 1};
    nodes.push_back({{"name", "mixamorig:Head"}, {"translation", {3, 3, 3}}});
    const json t = nodes[4]["translation"];
    nodes[4].erase("translation");
    nodes[4].erase("rotation");
    nodes[4]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, t[0], t[1], t[2], 1};
  });
  EXPECT_LT(WorstDirection(), 2);
  const Glb out(folder_ / "out.glb");
  EXPECT_FALSE(out.document["nodes"][4].contains("matrix"));
  for (const json& channel : out.document["animations"][0]["channels"])
    EXPECT_LT(channel["target"]["node"], 24);
}

TEST_F(CharacterTest, BonesThatHangElsewhereAreMovedAlong) {
  // The legs have roots of their own.
  const CharacterBody body = DanceChanged([](Glb& glb) {
    json& nodes = glb.document["nodes"];
    json& hips = nodes[0]["children"];
    const size_t armature = 25;
    for (const int leg : {1, 2}) {
      hips.erase(std::find(hips.begin(), hips.end(), leg));
      nodes[armature]["children"].push_back(leg);
      for (int axis = 0; axis < 3; ++axis) {
        nodes[leg]["translation"][axis] = nodes[leg]["translation"][axis].get<double>() +
                                          nodes[0]["translation"][axis].get<double>();
      }
    }
  });
  EXPECT_LT(WorstDirection(), 2);
  const GltfScene scene = ReadGltfScene(folder_ / "out.glb");
  const Motion danced = TransferToCharacter(smpl_, body.skeleton);
  const std::vector<Eigen::Affine3d> last = scene.Frame(scene.frames - 1);
  const Eigen::Matrix3Xd places = JointPositions(body.skeleton, danced.frames.back());
  for (size_t joint = 0; joint < body.nodes.size(); ++joint) {
    EXPECT_LT((last[static_cast<size_t>(body.nodes[joint])].translation() -
               places.col(static_cast<Eigen::Index>(joint)))
                  .norm(),
              1e-4);
  }
}

TEST_F(CharacterTest, ScalesThatDifferByAxisBendLittle) {
  DanceChanged([](Glb& glb) { glb.document["nodes"].back()["scale"] = {1.1, 0.95, 1.0}; });
  EXPECT_LT(WorstDirection(), 15);
}

TEST_F(CharacterTest, UnknownDataIsKept) {
  DanceChanged([](Glb& glb) {
    glb.document["extensionsRequired"] = {"EXT_meshopt_compression"};
    glb.document["buffers"].push_back({{"byteLength", 1 << 30}});  // where it would be unpacked
    glb.document["accessors"][0]["sparse"] = {{"count", 3}};
  });
  const Glb changed(folder_ / "changed.glb"), out(folder_ / "out.glb");
  EXPECT_EQ(out.document["buffers"][1], changed.document["buffers"][1]);
  EXPECT_EQ(out.document["accessors"][0], changed.document["accessors"][0]);
  // 22 rotations (hands' fingers are no bones of a dance) and the place of the pelvis.
  EXPECT_EQ(out.document["animations"][0]["channels"].size(), 23U);
}

TEST_F(CharacterTest, KhronosAndThreeJsAgreeWithUs) {
  const CharacterBody body =
      DanceChanged([](Glb&) {}, {.arms_down = 45, .rolled = true, .armature_scale = 0.01});
  const Motion danced = TransferToCharacter(smpl_, body.skeleton);
  const CharacterFile file(folder_ / "out.glb");
  json expected = {{"duration", 29.0 / 30}};
  for (const size_t frame : {0, 13, 28}) {
    json joints;
    const Eigen::Matrix3Xd places = JointPositions(body.skeleton, danced.frames[frame]);
    for (size_t joint = 0; joint < body.nodes.size(); ++joint) {
      const Eigen::Vector3d at = places.col(static_cast<Eigen::Index>(joint));
      joints[file.nodes().names[static_cast<size_t>(body.nodes[joint])]] = {at.x(), at.y(), at.z()};
    }
    expected["frames"].push_back({{"time", static_cast<double>(frame) / 30}, {"joints", joints}});
  }
  std::ofstream(folder_ / "expected.json") << expected;
  const Outcome outcome =
      Shell(std::string(CHOREO_TEST_DATA) + "/web/check.sh check_glb.mjs '" +
            (folder_ / "out.glb").string() + "' '" + (folder_ / "expected.json").string() + "'");
  if (outcome.code == 77) GTEST_SKIP() << outcome.said;
  EXPECT_EQ(outcome.code, 0) << outcome.said;
}

TEST_F(CharacterTest, RefusesUnusableCharacters) {
  const auto refuse = [&](const std::string& message, const std::function<void(Glb&)>& change) {
    SCOPED_TRACE(message);
    ExpectError(ErrorCode::kInvalidArgument, message, [&] { DanceChanged(change); });
  };
  refuse("changed.glb: buffers[0].uri: its data lie elsewhere",
         [](Glb& glb) { glb.document["buffers"][0]["uri"] = "hero.bin"; });
  refuse("has two parents", [](Glb& glb) { glb.document["nodes"][24]["children"] = {5}; });
  refuse("their own ancestors", [](Glb& glb) {
    glb.document["nodes"][25]["children"] = json::array();
    glb.document["nodes"][10]["children"] = {0};
  });
  refuse("there is no number 99", [](Glb& glb) { glb.document["nodes"][10]["children"] = {99}; });
  refuse("there is no number 77",
         [](Glb& glb) { glb.document["skins"][0]["joints"].push_back(77); });
  refuse("nodes[5]: has a scale of zero", [](Glb& glb) {
    glb.document["nodes"][5]["scale"] = {1, 0, 1};
  });
  refuse("m from the origin", [](Glb& glb) { glb.document["nodes"][0]["translation"][1] = 1e30; });
  refuse("nodes[3]: is not an object", [](Glb& glb) { glb.document["nodes"][3] = 7; });
  refuse("buffers[0]: is not an object", [](Glb& glb) { glb.document["buffers"][0] = 7; });
  refuse("nodes: is not a list", [](Glb& glb) { glb.document["nodes"] = "none"; });
  refuse("none of them is the pelvis", [](Glb& glb) {
    glb.document["nodes"] = json::array();
    glb.document.erase("skins");
  });
  refuse("is not a binary glTF", [](Glb& glb) { glb.document = json::array(); });
}

TEST_F(CharacterTest, RefusesInvalidFiles) {
  WriteCharacter(folder_ / "hero.glb", {});
  std::ifstream file(folder_ / "hero.glb", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto refuse = [&](const std::string& message, const std::string& content) {
    std::ofstream(folder_ / "bad.glb", std::ios::binary) << content;
    ExpectError(ErrorCode::kInvalidArgument, message, [&] { CharacterFile(folder_ / "bad.glb"); });
  };
  refuse("bad.glb: is not a binary glTF: bad header", "");
  refuse("version 1, must be 2", bytes.substr(0, 4) + std::string("\1\0\0\0", 4) + bytes.substr(8));
  refuse("a chunk of 4294967295 bytes",
         bytes.substr(0, 12) + std::string(4, '\xff') + bytes.substr(16));
  refuse("are there", bytes.substr(0, bytes.size() / 2));
  ExpectError(ErrorCode::kInvalidArgument, "no plain file", [&] { CharacterFile("/dev/zero"); });
  ExpectError(ErrorCode::kNotFound, "absent.glb", [&] { CharacterFile(folder_ / "absent.glb"); });
  const CharacterFile hero(folder_ / "hero.glb");
  const CharacterBody body = MakeCharacterBody(hero.FindBones(), hero.places());
  ExpectError(ErrorCode::kInvalidArgument, "0 frames",
              [&] { hero.WriteDance(folder_ / "out.glb", body, {}); });
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out.glb"));
}

}  // namespace choreo::character_test
