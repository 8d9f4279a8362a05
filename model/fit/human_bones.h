#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

/// The names that rigs give to a human body's bones, known only here.
namespace choreo {

/// The bones that the joints of a rig are.
struct HumanBones {
  std::string_view rig;  ///< the naming that matched, such as "Mixamo and HumanIK"
  /// Joint index by bone: "pelvis", "spine1", "spine2", ..., "neck", "neck2", ..., "head", and with
  /// "left_" or "right_" in front: hip, knee, ankle, foot (the toes), collar, shoulder, elbow,
  /// wrist, hand (where the fingers begin), eye. Holds only bones that the rig has.
  std::map<std::string, int> bones;

  /// The bone's joint index, or -1.
  int Find(const std::string& bone) const;
  /// spine1, spine2, ... and neck, neck2, ..., if present, from below.
  std::vector<std::string> Spine() const;
  std::vector<std::string> Neck() const;
};

/// Chooses the rig whose names match most, under any common prefix ("mixamorig:Hips"); of duplicate
/// names the first counts. Omits bones that are missing. Knows the names of MotionBuilder
/// (HumanIK), Mixamo, LAFAN1, CMU, VRM and VRoid, Unity, Unreal's mannequin, Rigify, iClone
/// (CC_Base_), Daz and Poser, 3ds Max's Biped, ASF, LeftHip-LeftKnee-LeftAnkle, Bandai Namco,
/// DeepMotion, OptiTrack, iPi, Blender's metarig, MakeHuman, MMD (Japanese and English), Rokoko,
/// Xsens, ARKit, Kinect, Cats, mocopi, Maya's Advanced Skeleton, Second Life, and SMPL. If none
/// matches a whole body, tries again without the most common ending ("Hips_jnt"), separators,
/// capitals and the numbers that exporters append ("Hips_012"). Of several whole bodies ("A:Hips",
/// "B:Hips") takes the one of which more `moves`, if given, [names]. Pure.
HumanBones FindHumanBones(const std::vector<std::string>& names,
                          const std::vector<bool>& moves = {});

/// All bones that HumanBones may hold, up to spine6 and neck3.
const std::vector<std::string>& AllHumanBones();

/// A rig's name of a bone, without prefix, or "". `rig` is a HumanBones::rig.
std::string NameInRig(std::string_view rig, const std::string& bone);

/// Bones required on both sides.
inline constexpr const char* kNeededLimbBones[] = {"hip",      "knee",  "ankle",
                                                   "shoulder", "elbow", "wrist"};

/// Every HumanBones::rig.
std::vector<std::string_view> AllRigNames();

inline constexpr std::string_view kHumanIkRig = "Mixamo and HumanIK";
inline constexpr std::string_view kUnrealRig = "Unreal";
inline constexpr std::string_view kVrmRig = "VRM";

}  // namespace choreo
