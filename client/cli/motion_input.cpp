#include "client/cli/motion_input.h"

#include <iostream>
#include <set>
#include <string>
#include <vector>

namespace choreo::cli {
namespace {

void Say(const std::filesystem::path& path, const std::vector<std::string>& notes) {
  static std::set<std::string> said;
  for (const std::string& note : notes) {
    const std::string line = "note: " + path.string() + ": " + note;
    if (said.insert(line).second) std::cerr << line << '\n';
  }
}

}  // namespace

SkeletonMotion ReadMotionNoting(const std::filesystem::path& path, MotionReading reading) {
  std::vector<std::string> notes;
  reading.notes = &notes;
  SkeletonMotion read = ReadMotion(path, reading);
  Say(path, notes);
  return read;
}

Motion ReadMotionNoting(const std::filesystem::path& path, const Skeleton& skeleton,
                        OtherSkeleton other) {
  std::vector<std::string> notes;
  MotionReading reading;
  reading.notes = &notes;
  Motion motion = ReadMotion(path, skeleton, other, reading);
  Say(path, notes);
  return motion;
}

}  // namespace choreo::cli
