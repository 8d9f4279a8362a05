#pragma once

#include <array>
#include <string_view>

#include "model/fit/human_bones.h"

/// The table of human_bones.h. Private to this folder.
namespace choreo {

/// What one maker's rigs call their bones: of each bone the names that it may have, best first,
/// with
/// '|' between them; spines and necks from below. '*' stands for the side, '@' for it in small
/// letters.
struct Rig {
  std::string_view name, left, right;
  std::string_view pelvis, spine, neck, head;
  std::string_view hip, knee, ankle, toes, collar, shoulder, elbow, wrist, hand, eye;
};

inline constexpr Rig kHumanIk = {.name = kHumanIkRig,
                                 .left = "Left",
                                 .right = "Right",
                                 .pelvis = "Hips",
                                 .spine = "Spine|Spine1|Spine2|Spine3|Spine4|Spine5",
                                 .neck = "Neck|Neck1|Neck2",
                                 .head = "Head",
                                 .hip = "*UpLeg",
                                 .knee = "*Leg",
                                 .ankle = "*Foot",
                                 .toes = "*ToeBase|*Toe|*Toes|*Foot_end",
                                 .collar = "*Shoulder|*Collar",
                                 .shoulder = "*Arm",
                                 .elbow = "*ForeArm",
                                 .wrist = "*Hand",
                                 .hand = "*HandMiddle1|*HandIndex1|*FingerBase",
                                 .eye = "*Eye"};

constexpr Rig Cmu() {
  Rig rig = kHumanIk;
  rig.name = "CMU";
  rig.spine = "LowerBack|Spine|Spine1|Spine2|Spine3";
  return rig;
}

inline constexpr Rig kSmpl = {.name = "SMPL",
                              .left = "left",
                              .right = "right",
                              .pelvis = "pelvis|Pelvis",
                              .spine = "spine1|spine2|spine3",
                              .neck = "neck",
                              .head = "head",
                              .hip = "*_hip",
                              .knee = "*_knee",
                              .ankle = "*_ankle",
                              .toes = "*_foot|*_toes|*_toe",
                              .collar = "*_collar",
                              .shoulder = "*_shoulder",
                              .elbow = "*_elbow",
                              .wrist = "*_wrist",
                              .hand = "*_hand",
                              .eye = "*_eye"};

inline constexpr Rig kVrm = {.name = "VRM",
                             .left = "left",
                             .right = "right",
                             .pelvis = "hips",
                             .spine = "spine|chest|upperChest",
                             .neck = "neck",
                             .head = "head",
                             .hip = "*UpperLeg",
                             .knee = "*LowerLeg",
                             .ankle = "*Foot",
                             .toes = "*Toes",
                             .collar = "*Shoulder",
                             .shoulder = "*UpperArm",
                             .elbow = "*LowerArm",
                             .wrist = "*Hand",
                             .hand = "*MiddleProximal|*IndexProximal",
                             .eye = "*Eye"};

constexpr Rig Unity() {
  Rig rig = kVrm;
  rig.name = "Unity";
  rig.left = "Left";
  rig.right = "Right";
  rig.pelvis = "Hips";
  rig.spine = "Spine|Chest|UpperChest";
  rig.neck = "Neck";
  rig.head = "Head";
  return rig;
}

inline constexpr Rig kVroid = {.name = "VRoid",
                               .left = "L",
                               .right = "R",
                               .pelvis = "C_Hips",
                               .spine = "C_Spine|C_Chest|C_UpperChest",
                               .neck = "C_Neck",
                               .head = "C_Head",
                               .hip = "*_UpperLeg",
                               .knee = "*_LowerLeg",
                               .ankle = "*_Foot",
                               .toes = "*_ToeBase",
                               .collar = "*_Shoulder",
                               .shoulder = "*_UpperArm",
                               .elbow = "*_LowerArm",
                               .wrist = "*_Hand",
                               .hand = "*_Middle1",
                               .eye = "*_FaceEye"};

inline constexpr Rig kUnreal = {.name = kUnrealRig,
                                .left = "l",
                                .right = "r",
                                .pelvis = "pelvis",
                                .spine = "spine_01|spine_02|spine_03|spine_04|spine_05",
                                .neck = "neck_01|neck_02",
                                .head = "head",
                                .hip = "thigh_*",
                                .knee = "calf_*",
                                .ankle = "foot_*",
                                .toes = "ball_*",
                                .collar = "clavicle_*",
                                .shoulder = "upperarm_*",
                                .elbow = "lowerarm_*",
                                .wrist = "hand_*",
                                .hand = "middle_01_*",
                                .eye = ""};

inline constexpr Rig kRigify = {.name = "Rigify",
                                .left = "L",
                                .right = "R",
                                .pelvis = "spine",
                                .spine = "spine.001|spine.002|spine.003",
                                .neck = "spine.004|spine.005",
                                .head = "spine.006",
                                .hip = "thigh.*",
                                .knee = "shin.*",
                                .ankle = "foot.*",
                                .toes = "toe.*",
                                .collar = "shoulder.*",
                                .shoulder = "upper_arm.*",
                                .elbow = "forearm.*",
                                .wrist = "hand.*",
                                .hand = "f_middle.01.*",
                                .eye = "eye.*"};

inline constexpr Rig kIclone = {.name = "iClone",
                                .left = "L",
                                .right = "R",
                                .pelvis = "Hip|Pelvis|Hips",
                                .spine = "Waist|Spine01|Spine02",
                                .neck = "NeckTwist01|NeckTwist02|Neck",
                                .head = "Head",
                                .hip = "*_Thigh",
                                .knee = "*_Calf",
                                .ankle = "*_Foot",
                                .toes = "*_ToeBase",
                                .collar = "*_Clavicle",
                                .shoulder = "*_Upperarm",
                                .elbow = "*_Forearm",
                                .wrist = "*_Hand",
                                .hand = "*_Mid1",
                                .eye = "*_Eye"};

inline constexpr Rig kPoser = {.name = "Poser",
                               .left = "l",
                               .right = "r",
                               .pelvis = "hip",
                               .spine = "abdomen|abdomen2|chest",
                               .neck = "neck",
                               .head = "head",
                               .hip = "*Thigh",
                               .knee = "*Shin",
                               .ankle = "*Foot",
                               .toes = "*Toe|*Foot_end",
                               .collar = "*Collar",
                               .shoulder = "*Shldr",
                               .elbow = "*ForeArm",
                               .wrist = "*Hand",
                               .hand = "*Mid1",
                               .eye = "@Eye"};

constexpr Rig Daz() {
  Rig rig = kPoser;
  rig.name = "Daz";
  rig.spine = "abdomenLower|abdomenUpper|chestLower|chestUpper";
  rig.neck = "neckLower|neckUpper";
  rig.hip = "*ThighBend";
  rig.shoulder = "*ShldrBend";
  rig.elbow = "*ForearmBend";
  rig.eye = "*Eye";
  return rig;
}

inline constexpr Rig kDaz9 = {.name = "Daz Genesis 9",
                              .left = "l",
                              .right = "r",
                              .pelvis = "hip",
                              .spine = "spine1|spine2|spine3|spine4",
                              .neck = "neck1|neck2",
                              .head = "head",
                              .hip = "*_thigh",
                              .knee = "*_shin",
                              .ankle = "*_foot",
                              .toes = "*_toes",
                              .collar = "*_shoulder",
                              .shoulder = "*_upperarm",
                              .elbow = "*_forearm",
                              .wrist = "*_hand",
                              .hand = "*_mid1",
                              .eye = "*_eye"};

inline constexpr Rig kBiped = {.name = "Biped",
                               .left = "L",
                               .right = "R",
                               .pelvis = "Pelvis",
                               .spine = "Spine|Spine1|Spine2|Spine3",
                               .neck = "Neck|Neck1",
                               .head = "Head",
                               .hip = "* Thigh|*_Thigh",
                               .knee = "* Calf|*_Calf",
                               .ankle = "* Foot|*_Foot",
                               .toes = "* Toe0|*_Toe0",
                               .collar = "* Clavicle|*_Clavicle",
                               .shoulder = "* UpperArm|*_UpperArm",
                               .elbow = "* Forearm|*_Forearm",
                               .wrist = "* Hand|*_Hand",
                               .hand = "* Finger2|*_Finger2",
                               .eye = ""};

inline constexpr Rig kAsf = {.name = "ASF",
                             .left = "l",
                             .right = "r",
                             .pelvis = "root",
                             .spine = "lowerback|upperback|thorax",
                             .neck = "lowerneck|upperneck",
                             .head = "head",
                             .hip = "*femur",
                             .knee = "*tibia",
                             .ankle = "*foot",
                             .toes = "*toes",
                             .collar = "*clavicle",
                             .shoulder = "*humerus",
                             .elbow = "*radius",
                             .wrist = "*wrist|*hand",
                             .hand = "*fingers",
                             .eye = ""};

inline constexpr Rig kJoints = {.name = "joints",
                                .left = "Left",
                                .right = "Right",
                                .pelvis = "Hips|Hip|Root",
                                .spine = "Waist|Spine|Chest|Chest2|Chest3|Chest4",
                                .neck = "Neck",
                                .head = "Head",
                                .hip = "*Hip|*Thigh",
                                .knee = "*Knee|*Shin",
                                .ankle = "*Ankle|*Foot",
                                .toes = "*Toe|*Toes|*ToeBase|*Foot_end",
                                .collar = "*Collar",
                                .shoulder = "*Shoulder|*UpArm|*UpperArm",
                                .elbow = "*Elbow|*LowArm",
                                .wrist = "*Wrist|*Hand",
                                .hand = "*HandMiddle1|*FingerBase",
                                .eye = "*Eye"};

inline constexpr std::array kRigs = {kHumanIk, Cmu(),   kJoints, kVrm,    Unity(),
                                     kVroid,   kUnreal, kRigify, kIclone, kPoser,
                                     Daz(),    kDaz9,   kBiped,  kAsf,    kSmpl};

}  // namespace choreo
