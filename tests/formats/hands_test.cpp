#include <gtest/gtest.h>

#include <map>

#include "model/fit/bones/finger_bones.h"
#include "tests/formats/character_fixture.h"

namespace choreo::hands_test {

using nlohmann::json;
using testing_support::Glb;
using testing_support::WriteCharacter;

constexpr const char* kFingers[] = {"Thumb", "Index", "Middle", "Ring", "Pinky"};

/// How a maker names the bones of fingers; `*` is the side, `#` the finger, `@` that in lower case.
struct Maker {
  const char* rig;
  const char* prefix;
  const char* sides[2];
  const char* bones[3];
  const char* last_finger = "Pinky";
};
constexpr Maker kMakers[] = {
    {"Mixamo and HumanIK", "mixamorig:", {"Left", "Right"}, {"*Hand#1", "*Hand#2", "*Hand#3"}},
    {"VRM", "", {"left", "right"}, {"*#Proximal", "*#Intermediate", "*#Distal"}, "Little"},
    {"Unreal", "", {"l", "r"}, {"@_01_*", "@_02_*", "@_03_*"}},
    {"Rigify", "DEF-", {"L", "R"}, {"f_@.01.*", "f_@.02.*", "f_@.03.*"}}};

std::string NameOf(const Maker& maker, int side, const std::string& finger, int bone) {
  std::string name = maker.prefix;
  std::string said = finger == "Pinky" ? maker.last_finger : finger;
  for (const char c : std::string(maker.bones[bone])) {
    if (c == '*') {
      name += maker.sides[side];
    } else if (c == '#') {
      name += said;
    } else if (c == '@') {
      for (const char letter : said) name += static_cast<char>(std::tolower(letter));
    } else {
      name += c;
    }
  }
  return name;
}

class HandsTest : public CharacterTest {
 protected:
  // A character whose hands have fingers, flat as in a T-pose, in frames of their own.
  void WriteWithFingers(const Maker& maker, double arms_down, bool rolled) {
    WriteCharacter(
        folder_ / "bare.glb",
        {.rig = maker.rig, .prefix = maker.prefix, .arms_down = arms_down, .rolled = rolled});
    Glb glb(folder_ / "bare.glb");
    const CharacterFile bare(folder_ / "bare.glb");
    const HumanBones bones = bare.FindBones();
    const std::vector<Eigen::Affine3d> rest = bare.nodes().PlaceAtRest();
    for (int side = 0; side < 2; ++side) {
      const std::string name = side == 0 ? "left_" : "right_";
      const int elbow = bones.Find(name + "elbow"), wrist = bones.Find(name + "wrist");
      const Eigen::Vector3d at = rest[wrist].translation();
      const Eigen::Vector3d ahead = (at - rest[elbow].translation()).normalized();
      // Palms down as in a T-pose: thumbs are in front.
      const Eigen::Vector3d front = Eigen::Vector3d::UnitZ();
      ahead_[side] = ahead;
      // What the doll has for a hand is no finger.
      const int own = bones.Find(name + "hand");
      if (own >= 0) glb.document["nodes"][own]["name"] = name + "hand";
      palm_[side] = side == 0 ? ahead.cross(front) : front.cross(ahead);
      for (int finger = 0; finger < 5; ++finger) {
        const bool is_thumb = finger == 0;
        const Eigen::Vector3d way =
            is_thumb ? Eigen::Vector3d(ahead + 0.9 * front).normalized() : ahead;
        Eigen::Vector3d place =
            at + (is_thumb ? Eigen::Vector3d(0.02 * ahead + 0.03 * front)
                           : Eigen::Vector3d(0.09 * ahead + (0.03 - 0.02 * (finger - 1)) * front));
        int parent = wrist;
        Eigen::Affine3d above = rest[wrist];
        for (int bone = 0; bone < 3; ++bone) {
          const Eigen::Affine3d frame(
              Eigen::Translation3d(place) *
              Eigen::AngleAxisd(0.3 * (bone + finger), Eigen::Vector3d(1, 2, -1).normalized()));
          const Eigen::Affine3d local = above.inverse() * frame;
          const std::vector<double> translation(local.translation().begin(),
                                                local.translation().end());
          const Eigen::Vector4d turn = Eigen::Quaterniond(local.rotation()).coeffs();
          json& nodes = glb.document["nodes"];
          nodes.push_back({{"name", NameOf(maker, side, kFingers[finger], bone)},
                           {"translation", translation},
                           {"rotation", std::vector<double>(turn.begin(), turn.end())}});
          nodes[parent]["children"].push_back(nodes.size() - 1);
          parent = static_cast<int>(nodes.size()) - 1;
          above = frame;
          place += (is_thumb ? 0.03 : 0.035) * way;
        }
      }
    }
    glb.Write(folder_ / "hero.glb");
  }

  // Where the last bone of each finger begins, from its knuckle, in the hand's frame: by name,
  // {out of the palm, ahead, to the front}.
  std::map<std::string, Eigen::Vector3d> Tips(const Maker& maker, HandPose pose) {
    const CharacterFile file(folder_ / "hero.glb");
    const HumanBones bones = file.FindBones();
    const CharacterBody body = MakeCharacterBody(bones, file.places());
    file.WriteDance(folder_ / "out.glb", body, TransferToCharacter(smpl_, body.skeleton),
                    CurlFingers(file.rig(), bones, pose));
    const GltfScene scene = ReadGltfScene(folder_ / "out.glb");
    const std::vector<Eigen::Affine3d> rest = file.nodes().PlaceAtRest();
    std::map<std::string, Eigen::Vector3d> tips;
    for (const int64_t frame : {int64_t{0}, scene.frames - 1}) {
      const std::vector<Eigen::Affine3d> now = scene.Frame(frame);
      for (int side = 0; side < 2; ++side) {
        const int wrist = bones.Find(side == 0 ? "left_wrist" : "right_wrist");
        const Eigen::Affine3d back = rest[wrist] * now[wrist].inverse();
        for (const char* finger : kFingers) {
          const auto at = [&](int bone) -> Eigen::Vector3d {
            const auto& names = scene.nodes.names;
            const auto node =
                std::ranges::find(names, NameOf(maker, side, finger, bone)) - names.begin();
            return back * now[static_cast<size_t>(node)].translation();
          };
          const Eigen::Vector3d way = at(2) - at(0);
          const Eigen::Vector3d tip(palm_[side].dot(way), ahead_[side].dot(way), way.z());
          const std::string name = std::to_string(side) + finger;
          if (frame > 0) {
            EXPECT_LT((tip - tips[name]).norm(), 1e-5) << "fingers keep their pose";
          }
          tips[name] = tip;
        }
      }
    }
    return tips;
  }

  Eigen::Vector3d palm_[2], ahead_[2];
};

TEST_F(HandsTest, FingersOfKnownRigsBendTowardsThePalm) {
  for (const Maker& maker : kMakers) {
    for (const auto& [down, rolled] : {std::pair(0.0, false), {45.0, true}}) {
      SCOPED_TRACE(maker.rig + std::string(rolled ? ", rolled" : ""));
      WriteWithFingers(maker, down, rolled);
      auto open = Tips(maker, HandPose::kOpen), relaxed = Tips(maker, HandPose::kRelaxed),
           fist = Tips(maker, HandPose::kFist), point = Tips(maker, HandPose::kPoint);
      for (const char* finger : kFingers) {
        const bool is_thumb = finger == std::string("Thumb");
        for (int side = 0; side < 2; ++side) {
          const std::string name = std::to_string(side) + finger;
          EXPECT_GT(open[name][0], -1e-6) << name << ": nothing bends back";
          EXPECT_GT(relaxed[name][0], open[name][0] + (is_thumb ? 1e-4 : 0.01)) << name;
          if (is_thumb) {
            EXPECT_GT(fist[name][0], relaxed[name][0] + 1e-4) << name;
            continue;
          }
          // How far they are from the middle of the hand.
          const auto away = [&](auto& tips) {
            return std::hypot(tips[name][0], tips[name][1] + 0.045);
          };
          EXPECT_LT(away(relaxed), away(open)) << name;
          EXPECT_LT(away(fist), 0.6 * away(relaxed)) << name;
          const bool points = finger == std::string("Index");
          EXPECT_LT((point[name] - (points ? open : fist)[name]).norm(), 0.01) << name;
        }
        // Left mirrors right.
        if (down == 0) {
          for (auto* tips : {&relaxed, &fist}) {
            EXPECT_LT(
                ((*tips)[std::string("0") + finger] - (*tips)[std::string("1") + finger]).norm(),
                2e-3)
                << finger;
          }
        }
      }
    }
  }
}

TEST_F(HandsTest, HandsMoveFromKeyToKey) {
  WriteWithFingers(kMakers[0], 0, false);
  const CharacterFile file(folder_ / "hero.glb");
  const HumanBones bones = file.FindBones();
  const std::vector<CurledBone> open = CurlFingers(file.rig(), bones, HandPose::kOpen);
  const std::vector<CurledBone> fist = CurlFingers(file.rig(), bones, HandPose::kFist);
  const std::vector<HandKey> keys = {{0.1, HandPose::kOpen}, {0.3, HandPose::kFist}};
  const auto moved = CurlFingers(file.rig(), bones, keys, 5, 10);
  ASSERT_EQ(moved.size(), fist.size());
  const auto angle = [](const std::vector<CurledBone>& of, int node) {
    const auto bone = std::ranges::find(of, node, &CurledBone::node);
    return bone == of.end() ? 0 : bone->angles.front();
  };
  for (const CurledBone& bone : moved) {
    ASSERT_EQ(bone.angles.size(), 5U);
    const double from = angle(open, bone.node), to = angle(fist, bone.node);
    const double expected[] = {from, from, (from + to) / 2, to, to};
    for (size_t frame = 0; frame < 5; ++frame)
      EXPECT_NEAR(bone.angles[frame], expected[frame], 1e-9);
  }
  // In the file they turn by as much.
  const CharacterBody body = MakeCharacterBody(bones, file.places());
  Motion still = smpl_;
  still.frames.assign(5, smpl_.frames.front());
  still.fps = 10;
  file.WriteDance(folder_ / "out.glb", body, TransferToCharacter(still, body.skeleton), moved);
  const GltfScene scene = ReadGltfScene(folder_ / "out.glb");
  ASSERT_EQ(scene.frames, 5);
  const int node = moved.front().node;
  const auto turn = [&](int64_t frame) {
    return Eigen::Quaterniond(scene.Frame(frame)[static_cast<size_t>(node)].rotation());
  };
  EXPECT_LT(turn(0).angularDistance(turn(1)), 1e-4);
  EXPECT_GT(turn(1).angularDistance(turn(2)), 0.2);
  EXPECT_NEAR(turn(1).angularDistance(turn(2)), turn(2).angularDistance(turn(3)), 1e-3);
}

TEST_F(HandsTest, RigsWithoutFingersAndRestingHandsAreUnchanged) {
  WriteCharacter(folder_ / "hero.glb", {});
  const CharacterFile bare(folder_ / "hero.glb");
  EXPECT_TRUE(CurlFingers(bare.rig(), bare.FindBones(), HandPose::kFist).empty());
  WriteWithFingers(kMakers[0], 0, false);
  const CharacterFile file(folder_ / "hero.glb");
  EXPECT_TRUE(CurlFingers(file.rig(), file.FindBones(), HandPose::kRest).empty());
  EXPECT_EQ(CurlFingers(file.rig(), file.FindBones(), HandPose::kFist).size(), 30U);
}

}  // namespace choreo::hands_test
