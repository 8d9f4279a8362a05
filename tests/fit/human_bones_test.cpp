#include "model/fit/bones/human_bones.h"

#include <gtest/gtest.h>

#include <sstream>

namespace choreo::human_bones_test {

std::vector<std::string> Words(const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> out;
  for (std::string word; words >> word;) {
    for (char& letter : word) letter = letter == '~' ? ' ' : letter;
    out.push_back(word);
  }
  return out;
}

struct KnownRig {
  const char* rig;
  // Pelvis, left hip, knee, ankle, toes, collar, shoulder, elbow, wrist, the right ones, spine from
  // below, neck, head; then what is none of these.
  const char* bones;
  int spine;
  const char* others;
};

class HumanBonesTest : public testing::TestWithParam<KnownRig> {};

TEST_P(HumanBonesTest, KnowsTheNamesOfItsRig) {
  const std::vector<std::string> bones = Words(GetParam().bones);
  std::vector<std::string> names = Words(GetParam().others);
  names.insert(names.end(), bones.begin(), bones.end());
  const HumanBones found = FindHumanBones(names);
  EXPECT_EQ(found.rig, GetParam().rig);
  std::vector<std::string> meant = {"pelvis"};
  for (const std::string side : {"left_", "right_"}) {
    for (const char* bone :
         {"hip", "knee", "ankle", "foot", "collar", "shoulder", "elbow", "wrist"})
      meant.push_back(side + bone);
  }
  for (int i = 1; i <= GetParam().spine; ++i) meant.push_back("spine" + std::to_string(i));
  meant.emplace_back("neck");
  meant.emplace_back("head");
  ASSERT_EQ(meant.size(), bones.size());
  for (size_t i = 0; i < meant.size(); ++i) {
    const int node = found.Find(meant[i]);
    ASSERT_GE(node, 0) << meant[i];
    EXPECT_EQ(names[static_cast<size_t>(node)], bones[i]) << meant[i];
  }
  EXPECT_EQ(std::ssize(found.Spine()), GetParam().spine);
}

INSTANTIATE_TEST_SUITE_P(
    Rigs, HumanBonesTest,
    testing::Values(
        KnownRig{"Mixamo and HumanIK",
                 "mixamorig:Hips mixamorig:LeftUpLeg mixamorig:LeftLeg mixamorig:LeftFoot "
                 "mixamorig:LeftToeBase mixamorig:LeftShoulder mixamorig:LeftArm "
                 "mixamorig:LeftForeArm mixamorig:LeftHand mixamorig:RightUpLeg mixamorig:RightLeg "
                 "mixamorig:RightFoot mixamorig:RightToeBase mixamorig:RightShoulder "
                 "mixamorig:RightArm mixamorig:RightForeArm mixamorig:RightHand mixamorig:Spine "
                 "mixamorig:Spine1 mixamorig:Spine2 mixamorig:Neck mixamorig:Head",
                 3,
                 "Armature mixamorig:HeadTop_End mixamorig:LeftToe_End mixamorig:LeftHandThumb1"},
        // As three.js writes them.
        KnownRig{"Mixamo and HumanIK",
                 "mixamorigHips mixamorigLeftUpLeg mixamorigLeftLeg mixamorigLeftFoot "
                 "mixamorigLeftToeBase mixamorigLeftShoulder mixamorigLeftArm mixamorigLeftForeArm "
                 "mixamorigLeftHand mixamorigRightUpLeg mixamorigRightLeg mixamorigRightFoot "
                 "mixamorigRightToeBase mixamorigRightShoulder mixamorigRightArm "
                 "mixamorigRightForeArm mixamorigRightHand mixamorigSpine mixamorigSpine1 "
                 "mixamorigSpine2 mixamorigNeck mixamorigHead",
                 3, "Armature"},
        KnownRig{"CMU",
                 "Hips LeftUpLeg LeftLeg LeftFoot LeftToeBase LeftShoulder LeftArm LeftForeArm "
                 "LeftHand RightUpLeg RightLeg RightFoot RightToeBase RightShoulder RightArm "
                 "RightForeArm RightHand LowerBack Spine Spine1 Neck Head",
                 3, "LHipJoint RHipJoint Neck1 LeftFingerBase LThumb"},
        KnownRig{"Unreal",
                 "pelvis thigh_l calf_l foot_l ball_l clavicle_l upperarm_l lowerarm_l hand_l "
                 "thigh_r calf_r foot_r ball_r clavicle_r upperarm_r lowerarm_r hand_r spine_01 "
                 "spine_02 spine_03 spine_04 spine_05 neck_01 head",
                 5,
                 "root ik_foot_root ik_foot_l ik_foot_r ik_hand_l thigh_twist_01_l calf_twist_01_l "
                 "upperarm_twist_01_l neck_02"},
        KnownRig{"Rigify",
                 "DEF-spine DEF-thigh.L DEF-shin.L DEF-foot.L DEF-toe.L DEF-shoulder.L "
                 "DEF-upper_arm.L DEF-forearm.L DEF-hand.L DEF-thigh.R DEF-shin.R DEF-foot.R "
                 "DEF-toe.R DEF-shoulder.R DEF-upper_arm.R DEF-forearm.R DEF-hand.R DEF-spine.001 "
                 "DEF-spine.002 DEF-spine.003 DEF-spine.004 DEF-spine.006",
                 3,
                 "ORG-spine ORG-thigh.L ORG-shin.L ORG-foot.L ORG-upper_arm.L ORG-forearm.L "
                 "ORG-hand.L DEF-thigh.L.001 DEF-spine.005 thigh_fk.L"},
        KnownRig{"VRM",
                 "hips leftUpperLeg leftLowerLeg leftFoot leftToes leftShoulder leftUpperArm "
                 "leftLowerArm leftHand rightUpperLeg rightLowerLeg rightFoot rightToes "
                 "rightShoulder rightUpperArm rightLowerArm rightHand spine chest upperChest neck "
                 "head",
                 3, "root leftMiddleProximal leftEye"},
        KnownRig{"VRoid",
                 "J_Bip_C_Hips J_Bip_L_UpperLeg J_Bip_L_LowerLeg J_Bip_L_Foot J_Bip_L_ToeBase "
                 "J_Bip_L_Shoulder J_Bip_L_UpperArm J_Bip_L_LowerArm J_Bip_L_Hand J_Bip_R_UpperLeg "
                 "J_Bip_R_LowerLeg J_Bip_R_Foot J_Bip_R_ToeBase J_Bip_R_Shoulder J_Bip_R_UpperArm "
                 "J_Bip_R_LowerArm J_Bip_R_Hand J_Bip_C_Spine J_Bip_C_Chest J_Bip_C_UpperChest "
                 "J_Bip_C_Neck J_Bip_C_Head",
                 3, "Root J_Sec_Hair1_01 J_Adj_L_FaceEye"},
        KnownRig{"iClone",
                 "CC_Base_Hip CC_Base_L_Thigh CC_Base_L_Calf CC_Base_L_Foot CC_Base_L_ToeBase "
                 "CC_Base_L_Clavicle CC_Base_L_Upperarm CC_Base_L_Forearm CC_Base_L_Hand "
                 "CC_Base_R_Thigh CC_Base_R_Calf CC_Base_R_Foot CC_Base_R_ToeBase "
                 "CC_Base_R_Clavicle CC_Base_R_Upperarm CC_Base_R_Forearm CC_Base_R_Hand "
                 "CC_Base_Waist CC_Base_Spine01 CC_Base_Spine02 CC_Base_NeckTwist01 CC_Base_Head",
                 3,
                 "RL_BoneRoot CC_Base_Pelvis CC_Base_L_ThighTwist01 CC_Base_L_ToeBaseShareBone "
                 "CC_Base_NeckTwist02 CC_Base_L_KneeShareBone CC_Base_L_Mid1"},
        KnownRig{"Poser",
                 "hip lThigh lShin lFoot lToe lCollar lShldr lForeArm lHand rThigh rShin rFoot "
                 "rToe rCollar rShldr rForeArm rHand abdomen chest neck head",
                 2, "lButtock leftEye lThumb1"},
        KnownRig{"Daz",
                 "hip lThighBend lShin lFoot lToe lCollar lShldrBend lForearmBend lHand "
                 "rThighBend rShin rFoot rToe rCollar rShldrBend rForearmBend rHand abdomenLower "
                 "abdomenUpper chestLower chestUpper neckLower head",
                 4, "pelvis lThighTwist lMetatarsals lShldrTwist lForearmTwist neckUpper"},
        KnownRig{"Daz Genesis 9",
                 "hip l_thigh l_shin l_foot l_toes l_shoulder l_upperarm l_forearm l_hand r_thigh "
                 "r_shin r_foot r_toes r_shoulder r_upperarm r_forearm r_hand spine1 spine2 spine3 "
                 "spine4 neck1 head",
                 4, "Genesis9 pelvis neck2 l_thightwist1"},
        KnownRig{"Biped",
                 "Bip01~Pelvis Bip01~L~Thigh Bip01~L~Calf Bip01~L~Foot Bip01~L~Toe0 "
                 "Bip01~L~Clavicle Bip01~L~UpperArm Bip01~L~Forearm Bip01~L~Hand Bip01~R~Thigh "
                 "Bip01~R~Calf Bip01~R~Foot Bip01~R~Toe0 Bip01~R~Clavicle Bip01~R~UpperArm "
                 "Bip01~R~Forearm Bip01~R~Hand Bip01~Spine Bip01~Spine1 Bip01~Neck Bip01~Head",
                 2, "Bip01 Bip01~Footsteps"},
        KnownRig{"ASF",
                 "root lfemur ltibia lfoot ltoes lclavicle lhumerus lradius lwrist rfemur rtibia "
                 "rfoot rtoes rclavicle rhumerus rradius rwrist lowerback upperback thorax "
                 "lowerneck head",
                 3, "lhipjoint lhand lthumb upperneck"},
        KnownRig{"joints",
                 "Hips LeftHip LeftKnee LeftAnkle LeftToe LeftCollar LeftShoulder LeftElbow "
                 "LeftWrist RightHip RightKnee RightAnkle RightToe RightCollar RightShoulder "
                 "RightElbow RightWrist Chest Chest2 Neck Head",
                 2, ""},
        KnownRig{"SMPL",
                 "pelvis left_hip left_knee left_ankle left_foot left_collar left_shoulder "
                 "left_elbow left_wrist right_hip right_knee right_ankle right_foot right_collar "
                 "right_shoulder right_elbow right_wrist spine1 spine2 spine3 neck head",
                 3, "left_hand"}),
    [](const auto& rig) {
      std::string name = rig.param.rig + std::to_string(rig.index);
      std::erase(name, ' ');
      return name;
    });

TEST(HumanBones, NamesABoneAsTheRigDoes) {
  EXPECT_EQ(NameInRig(kHumanIkRig, "left_foot"), "LeftToeBase");
  EXPECT_EQ(NameInRig(kHumanIkRig, "spine2"), "Spine1");
  EXPECT_EQ(NameInRig(kUnrealRig, "right_hand"), "middle_01_r");
  EXPECT_EQ(NameInRig("Poser", "left_eye"), "leftEye");
  EXPECT_EQ(NameInRig(kUnrealRig, "left_eye"), "");
  EXPECT_EQ(NameInRig(kUnrealRig, "tail"), "");
}

TEST(HumanBones, MeaninglessNamesAreNoBones) {
  EXPECT_TRUE(FindHumanBones({"bone", "bone", "", "Box001"}).bones.empty());
  EXPECT_TRUE(FindHumanBones({}).bones.empty());
}

}  // namespace choreo::human_bones_test
