#pragma once

#include <string_view>

#include "model/fit/human_bones.h"

/// The table of human_bones.h. Private to this folder.
namespace choreo {

/// What Rig::limbs names.
inline constexpr std::string_view kLimbBones[] = {"hip",      "knee",  "ankle", "foot", "collar",
                                                  "shoulder", "elbow", "wrist", "hand", "eye"};

/// What one maker's rigs call their bones: of each bone the names that it may have, best first,
/// with '|' between them; spines and necks from below. '*' stands for the side, '@' for it in small
/// letters.
struct Rig {
  std::string_view name;
  std::string_view side_names[2];  ///< left, right
  struct Trunk {
    std::string_view pelvis, spine, neck, head;
  } trunk;
  std::string_view limbs[std::size(kLimbBones)];
};

inline constexpr Rig kRigs[] = {
    {kHumanIkRig,
     {"Left", "Right"},
     {"Hips", "Spine|Spine1|Spine2|Spine3|Spine4|Spine5", "Neck|Neck1|Neck2", "Head"},
     {"*UpLeg", "*Leg", "*Foot", "*ToeBase|*Toe|*Toes|*Foot_end", "*Shoulder|*Collar", "*Arm",
      "*ForeArm", "*Hand", "*HandMiddle1|*HandIndex1|*FingerBase", "*Eye"}},
    {"CMU",
     {"Left", "Right"},
     {"Hips", "LowerBack|Spine|Spine1|Spine2|Spine3", "Neck|Neck1|Neck2", "Head"},
     {"*UpLeg", "*Leg", "*Foot", "*ToeBase|*Toe|*Toes|*Foot_end", "*Shoulder|*Collar", "*Arm",
      "*ForeArm", "*Hand", "*HandMiddle1|*HandIndex1|*FingerBase", "*Eye"}},
    {"joints",
     {"Left", "Right"},
     {"Hips|Hip|Root", "Waist|Spine|Chest|Chest2|Chest3|Chest4", "Neck", "Head"},
     {"*Hip|*Thigh", "*Knee|*Shin", "*Ankle|*Foot", "*Toe|*Toes|*ToeBase|*Foot_end", "*Collar",
      "*Shoulder|*UpArm|*UpperArm", "*Elbow|*LowArm", "*Wrist|*Hand", "*HandMiddle1|*FingerBase",
      "*Eye"}},
    {"VRM",
     {"left", "right"},
     {"hips", "spine|chest|upperChest", "neck", "head"},
     {"*UpperLeg", "*LowerLeg", "*Foot", "*Toes", "*Shoulder", "*UpperArm", "*LowerArm", "*Hand",
      "*MiddleProximal|*IndexProximal", "*Eye"}},
    {"Unity",
     {"Left", "Right"},
     {"Hips", "Spine|Chest|UpperChest", "Neck", "Head"},
     {"*UpperLeg", "*LowerLeg", "*Foot", "*Toes", "*Shoulder", "*UpperArm", "*LowerArm", "*Hand",
      "*MiddleProximal|*IndexProximal", "*Eye"}},
    {"VRoid",
     {"L", "R"},
     {"C_Hips", "C_Spine|C_Chest|C_UpperChest", "C_Neck", "C_Head"},
     {"*_UpperLeg", "*_LowerLeg", "*_Foot", "*_ToeBase", "*_Shoulder", "*_UpperArm", "*_LowerArm",
      "*_Hand", "*_Middle1", "*_FaceEye"}},
    {kUnrealRig,
     {"l", "r"},
     {"pelvis", "spine_01|spine_02|spine_03|spine_04|spine_05", "neck_01|neck_02", "head"},
     {"thigh_*", "calf_*", "foot_*", "ball_*", "clavicle_*", "upperarm_*", "lowerarm_*", "hand_*",
      "middle_01_*", ""}},
    {"Rigify",
     {"L", "R"},
     {"spine", "spine.001|spine.002|spine.003", "spine.004|spine.005", "spine.006"},
     {"thigh.*", "shin.*", "foot.*", "toe.*", "shoulder.*", "upper_arm.*", "forearm.*", "hand.*",
      "f_middle.01.*", "eye.*"}},
    {"iClone",
     {"L", "R"},
     {"Hip|Pelvis|Hips", "Waist|Spine01|Spine02", "NeckTwist01|NeckTwist02|Neck", "Head"},
     {"*_Thigh", "*_Calf", "*_Foot", "*_ToeBase", "*_Clavicle", "*_Upperarm", "*_Forearm", "*_Hand",
      "*_Mid1", "*_Eye"}},
    {"Poser",
     {"l", "r"},
     {"hip", "abdomen|abdomen2|chest", "neck", "head"},
     {"*Thigh", "*Shin", "*Foot", "*Toe|*Foot_end", "*Collar", "*Shldr", "*ForeArm", "*Hand",
      "*Mid1", "@Eye"}},
    {"Daz",
     {"l", "r"},
     {"hip", "abdomenLower|abdomenUpper|chestLower|chestUpper", "neckLower|neckUpper", "head"},
     {"*ThighBend", "*Shin", "*Foot", "*Toe|*Foot_end", "*Collar", "*ShldrBend", "*ForearmBend",
      "*Hand", "*Mid1", "*Eye"}},
    {"Daz Genesis 9",
     {"l", "r"},
     {"hip", "spine1|spine2|spine3|spine4", "neck1|neck2", "head"},
     {"*_thigh", "*_shin", "*_foot", "*_toes", "*_shoulder", "*_upperarm", "*_forearm", "*_hand",
      "*_mid1", "*_eye"}},
    {"Biped",
     {"L", "R"},
     {"Pelvis", "Spine|Spine1|Spine2|Spine3", "Neck|Neck1", "Head"},
     {"* Thigh|*_Thigh", "* Calf|*_Calf", "* Foot|*_Foot", "* Toe0|*_Toe0", "* Clavicle|*_Clavicle",
      "* UpperArm|*_UpperArm", "* Forearm|*_Forearm", "* Hand|*_Hand", "* Finger2|*_Finger2", ""}},
    {"ASF",
     {"l", "r"},
     {"root", "lowerback|upperback|thorax", "lowerneck|upperneck", "head"},
     {"*femur", "*tibia", "*foot", "*toes", "*clavicle", "*humerus", "*radius", "*wrist|*hand",
      "*fingers", ""}},
    {"SMPL",
     {"left", "right"},
     {"pelvis|Pelvis", "spine1|spine2|spine3", "neck", "head"},
     {"*_hip", "*_knee", "*_ankle", "*_foot|*_toes|*_toe", "*_collar", "*_shoulder", "*_elbow",
      "*_wrist", "*_hand", "*_eye"}},
};

}  // namespace choreo
