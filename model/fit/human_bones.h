#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

/// What rigs call the bones of a human body: the only place that knows such names.
namespace choreo {

/// Which joint of a rig is which bone.
struct HumanBones {
  std::string_view rig;  ///< whose names they are, as in "Mixamo and HumanIK"
  /// Index by what the bone is: "pelvis", "spine1", "spine2", ... as many as there are, "neck",
  /// "neck2", ..., "head", and with "left_" or "right_" before: hip, knee, ankle, foot (the toes),
  /// collar, shoulder, elbow, wrist, hand (where the fingers begin), eye. Those that it has.
  std::map<std::string, int> bones;

  /// Its index, or -1.
  int Find(const std::string& bone) const;
  /// Of spine1, spine2, ... and neck, neck2, ... those it has, from below.
  std::vector<std::string> Spine() const;
  std::vector<std::string> Neck() const;
};

/// The rig of whose names most are there, with any prefix that all of them share
/// ("mixamorig:Hips"); where a name is there twice, the first. Bones that are not there are left
/// out. Known are MotionBuilder's (HumanIK), Mixamo's, LAFAN1's and CMU's names, VRM's and VRoid's,
/// Unity's, Unreal's mannequin, Rigify's, iClone's (CC_Base_), Daz's and Poser's, 3ds Max's Biped,
/// ASF's, LeftHip-LeftKnee-LeftAnkle, Bandai Namco's, DeepMotion's, OptiTrack's, iPi's, Blender's
/// metarig, MakeHuman's, MMD's (Japanese and English), Rokoko's, Xsens', ARKit's, Kinect's, Cats',
/// mocopi's, Maya's Advanced Skeleton, Second Life's, and SMPL's. Where none of them is whole, the
/// same without what ends most names ("Hips_jnt"), separators, capitals and the numbers that
/// exporters append ("Hips_012"). Of several whole bodies ("A:Hips", "B:Hips") the one of which
/// more `moves`, where that is given, [names]. Pure.
HumanBones FindHumanBones(const std::vector<std::string>& names,
                          const std::vector<bool>& moves = {});

/// All that HumanBones may hold: up to spine6 and neck3.
const std::vector<std::string>& AllHumanBones();

/// What a rig calls a bone, without a prefix; empty where it has none. `rig` is a HumanBones::rig.
std::string NameInRig(std::string_view rig, const std::string& bone);

/// Of both sides: nobody dances without them.
inline constexpr const char* kNeededLimbBones[] = {"hip",      "knee",  "ankle",
                                                   "shoulder", "elbow", "wrist"};

/// Every HumanBones::rig.
std::vector<std::string_view> AllRigNames();

inline constexpr std::string_view kHumanIkRig = "Mixamo and HumanIK";
inline constexpr std::string_view kUnrealRig = "Unreal";
inline constexpr std::string_view kVrmRig = "VRM";

}  // namespace choreo
