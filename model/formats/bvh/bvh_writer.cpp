#include <cstdio>

#include "model/core/files/atomic_file.h"
#include "model/formats/bvh/bvh.h"

namespace choreo {
namespace {

void AppendNumber(std::string& text, double value) {
  char number[48];
  std::snprintf(number, sizeof(number), " %.6f", value);
  text += number;
}

void AppendJoint(const BvhFile& file, int index, int depth, std::string& text) {
  const BvhJoint& joint = file.joints[index];
  const std::string indent(2 * depth, ' ');
  text += indent;
  text += joint.end_site ? std::string("End Site") : (depth == 0 ? "ROOT " : "JOINT ") + joint.name;
  text += "\n" + indent + "{\n" + indent + "  OFFSET";
  for (int axis = 0; axis < 3; ++axis) AppendNumber(text, joint.offset[axis]);
  text += "\n";
  if (!joint.end_site) {
    text += indent + "  CHANNELS " + std::to_string(joint.channels.size());
    for (const BvhChannel channel : joint.channels) {
      text += " ";
      text += kBvhChannelNames[static_cast<int>(channel)];
    }
    text += "\n";
  }
  for (int child = index + 1; child < static_cast<int>(file.joints.size()); ++child) {
    if (file.joints[child].parent == index) AppendJoint(file, child, depth + 1, text);
  }
  text += indent + "}\n";
}

}  // namespace

std::string BvhText(const BvhFile& file) {
  std::string text = "HIERARCHY\n";
  for (int joint = 0; joint < static_cast<int>(file.joints.size()); ++joint) {
    if (file.joints[joint].parent < 0) AppendJoint(file, joint, 0, text);
  }
  text += "MOTION\nFrames: " + std::to_string(file.frames()) + "\n";
  char frame_time[64];
  std::snprintf(frame_time, sizeof(frame_time), "Frame Time: %.9f\n", file.frame_time);
  text += frame_time;
  for (int64_t frame = 0; frame < file.frames(); ++frame) {
    const size_t line = text.size();
    for (const double value : file.values.col(frame)) AppendNumber(text, value);
    text.erase(line, 1).append("\n");
  }
  return text;
}

void WriteBvh(const std::filesystem::path& path, const BvhFile& file) {
  WriteFile(path, BvhText(file));
}

}  // namespace choreo
