#pragma once

#include <map>
#include <string>

namespace choreo {

/// Mixamo's names of SMPL's joints.
inline const std::map<std::string, std::string> kMixamoNames = {{"pelvis", "Hips"},
                                                                {"left_hip", "LeftUpLeg"},
                                                                {"left_knee", "LeftLeg"},
                                                                {"left_ankle", "LeftFoot"},
                                                                {"left_foot", "LeftToeBase"},
                                                                {"right_hip", "RightUpLeg"},
                                                                {"right_knee", "RightLeg"},
                                                                {"right_ankle", "RightFoot"},
                                                                {"right_foot", "RightToeBase"},
                                                                {"spine1", "Spine"},
                                                                {"spine2", "Spine1"},
                                                                {"spine3", "Spine2"},
                                                                {"neck", "Neck"},
                                                                {"head", "Head"},
                                                                {"left_collar", "LeftShoulder"},
                                                                {"left_shoulder", "LeftArm"},
                                                                {"left_elbow", "LeftForeArm"},
                                                                {"left_wrist", "LeftHand"},
                                                                {"right_collar", "RightShoulder"},
                                                                {"right_shoulder", "RightArm"},
                                                                {"right_elbow", "RightForeArm"},
                                                                {"right_wrist", "RightHand"},
                                                                {"left_hand", "LeftHandMiddle1"},
                                                                {"right_hand", "RightHandMiddle1"}};

}  // namespace choreo
