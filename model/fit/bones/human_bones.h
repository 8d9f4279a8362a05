#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

/// Recognises the bones of a human body by the names that common rigs give them.
namespace choreo {

/// The bones of a body, as joints of a rig.
struct HumanBones {
  std::string_view rig;  ///< the naming that matched, such as "Mixamo and HumanIK"
  /// Joint index by bone: "pelvis", "spine1", "spine2", ..., "neck", "neck2", ..., "head", and with
  /// "left_" or "right_" in front: hip, knee, ankle, foot (the toes), collar, shoulder, elbow,
  /// wrist, hand (where the fingers begin), eye. Holds only bones that the rig has.
  std::map<std::string, int> bones;

  /// The bone's joint index, or -1.
  int Find(const std::string& bone) const;
  /// The present bones of spine1, spine2, ... and of neck, neck2, ..., from below.
  std::vector<std::string> Spine() const;
  std::vector<std::string> Neck() const;
};

/// Chooses the rig whose names match most, under any common prefix ("mixamorig:Hips"). Of duplicate
/// names, the first counts. Omits missing bones. Knows the names of MotionBuilder (HumanIK),
/// Mixamo, LAFAN1, CMU, VRM and VRoid, Unity, Unreal's mannequin, Rigify, iClone (CC_Base_), Daz
/// and Poser, 3ds Max's Biped, ASF, LeftHip-LeftKnee-LeftAnkle, Bandai Namco, DeepMotion,
/// OptiTrack, iPi, Blender's metarig, MakeHuman, MMD (Japanese and English), Rokoko, Xsens, ARKit,
/// Kinect, Cats, mocopi, Maya's Advanced Skeleton, Second Life, and SMPL. If no rig matches a whole
/// body, tries again without the most common ending ("Hips_jnt"), separators, capitals and the
/// numbers that exporters append ("Hips_012"). Of several whole bodies ("A:Hips", "B:Hips"), takes
/// the one with more names in `moves` [names], if given. Pure.
HumanBones FindHumanBones(const std::vector<std::string>& names,
                          const std::vector<bool>& moves = {});

/// All bones that HumanBones may hold, up to spine6 and neck3.
const std::vector<std::string>& AllHumanBones();

/// A rig's name for a bone, without prefix, or "". `rig` is a HumanBones::rig.
std::string NameInRig(std::string_view rig, const std::string& bone);

/// The bones that a body needs on both sides.
inline constexpr const char* kNeededLimbBones[] = {"hip",      "knee",  "ankle",
                                                   "shoulder", "elbow", "wrist"};

/// All values of HumanBones::rig.
std::vector<std::string_view> AllRigNames();

inline constexpr std::string_view kHumanIkRig = "Mixamo and HumanIK";
inline constexpr std::string_view kUnrealRig = "Unreal";
inline constexpr std::string_view kVrmRig = "VRM";

}  // namespace choreo
