#include <cstdio>
#include <sstream>

#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/formats/bvh.h"

namespace choreo {
namespace {

void AppendNumber(std::string& text, double value) {
  char number[48];
  std::snprintf(number, sizeof(number), " %.6f", value);
  text += number;
}

void CheckShape(const BvhFile& file) {
  int64_t channels = 0;
  for (size_t i = 0; i < file.joints.size(); ++i) {
    const BvhJoint& joint = file.joints[i];
    if (i == 0 ? joint.parent != -1 : joint.parent < 0 || joint.parent >= static_cast<int>(i)) {
      throw InvalidArgument("joints[" + std::to_string(i) + "].parent",
                            std::to_string(joint.parent) + ", must be that of an earlier joint");
    }
    channels += static_cast<int64_t>(joint.channels.size());
  }
  if (file.joints.empty()) throw InvalidArgument("joints", "0 joints, at least 1 is needed");
  if (file.values.rows() != channels) {
    throw InvalidArgument("values", std::to_string(file.values.rows()) + " rows for " +
                                        std::to_string(channels) + " channels");
  }
}

// Depth first; the order of the channels in a line is that of the joints' blocks, which is why the
// joints themselves have to stand in that order.
void AppendJoint(const BvhFile& file, int index, int depth, int& next, std::string& text) {
  if (index != next++) {
    throw InvalidArgument("joints[" + std::to_string(index) + "]",
                          "must stand directly behind its parent's earlier descendants");
  }
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
    if (file.joints[child].parent == index) AppendJoint(file, child, depth + 1, next, text);
  }
  text += indent + "}\n";
}

}  // namespace

void WriteBvh(std::ostream& out, const BvhFile& file) {
  CheckShape(file);
  std::string text = "HIERARCHY\n";
  int next = 0;
  AppendJoint(file, 0, 0, next, text);
  text += "MOTION\nFrames: " + std::to_string(file.frames()) + "\n";
  char frame_time[64];
  std::snprintf(frame_time, sizeof(frame_time), "Frame Time: %.9f\n", file.frame_time);
  text += frame_time;
  std::string line;
  for (int64_t frame = 0; frame < file.frames(); ++frame) {
    line.clear();
    for (const double value : file.values.col(frame)) AppendNumber(line, value);
    text.append(line, line.empty() ? 0 : 1).append("\n");
  }
  out << text;
}

void WriteBvh(const std::filesystem::path& path, const BvhFile& file) {
  std::ostringstream text;
  WriteBvh(text, file);
  WriteFile(path, text.view());
}

}  // namespace choreo
