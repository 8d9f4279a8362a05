#include "client/authoring/keys/motion_input.h"

#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "client/authoring/notes/notes.h"

namespace choreo::authoring {
namespace {

void Say(const std::filesystem::path& path, const std::vector<std::string>& notes,
         bool of_convert) {
  static std::mutex mutex;  // the studio's pages read files concurrently
  static std::set<std::string> shown;
  const std::lock_guard lock(mutex);
  for (const std::string& note : notes) {
    std::string line = "note: " + path.string() + ": " + note;
    // Searches after the path, which may contain " --".
    const size_t option =
        of_convert ? std::string::npos : line.find(" --", line.size() - note.size());
    if (option != std::string::npos) line.insert(option, " choreo convert");
    if (shown.insert(line).second) Note(line);
  }
}

}  // namespace

SkeletonMotion ReadMotionNoting(const std::filesystem::path& path, MotionReading reading) {
  std::vector<std::string> notes;
  reading.notes = &notes;
  SkeletonMotion read = ReadMotion(path, reading);
  Say(path, notes, true);
  return read;
}

SkeletonMotion ReadMotionNoting(const std::filesystem::path& path) {
  std::vector<std::string> notes;
  SkeletonMotion read = ReadMotion(path, {.notes = &notes});
  Say(path, notes, false);
  return read;
}

Motion ReadMotionNoting(const std::filesystem::path& path, const Skeleton& skeleton,
                        OtherSkeleton other) {
  std::vector<std::string> notes;
  MotionReading reading;
  reading.notes = &notes;
  Motion motion = ReadMotion(path, skeleton, other, reading);
  Say(path, notes, false);
  return motion;
}

}  // namespace choreo::authoring
