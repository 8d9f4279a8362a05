#pragma once

#include <string>
#include <vector>

namespace choreo::authoring {

inline constexpr int kMaxBeatsInBar = 16;  ///< people count no further

/// A beat that somebody wrote down.
struct WrittenBeat {
  double second = 0;
  int count = 0;  ///< in its bar, from 1 on; 0: unknown
};

/// Throws Error(kInvalidArgument) unless a beat is at least a row of onsets later, in seconds, than
/// the one before it.
void RequireGap(double before, double beat, const std::string& field);

/// Reads a file of beats, ascending: per beat a line with its second and, if known, its count. A #
/// begins a comment. Leaves out those before second `from`. Throws Error(kNotFound), or
/// Error(kInvalidArgument) whose field is "beats" or a line of the file.
std::vector<WrittenBeat> ReadBeatFile(const std::string& path, double from = 0);

}  // namespace choreo::authoring
