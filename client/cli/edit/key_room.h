#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/cli/edit/edited_report.h"

/// Makes room for keys, and for those that hold them, among the other keys of a dance.
namespace choreo::cli {

/// The last frame of a key and the keys that hold it.
inline int64_t LastFrame(const client::KeyEdit& edit) {
  return edit.held.empty() ? *edit.key.frame : *edit.held.back().frame;
}

/// Holds a key until a frame, with keys about as close together as those that hold it now.
void HoldUntil(int64_t last, client::KeyEdit* edit);

/// Throws if a key at second `at_s` would be too near to `what`, at frame `other`.
void CheckDistance(const DanceTimes& times, const char* field, double at_s, int64_t other,
                   const std::string& what);

/// Ends the hold of another key if a new key at this frame is within it, and prints a note.
/// Returns the warning, if any, to be kept after the edit.
std::vector<client::Warning> EndHold(int64_t frame, const std::string& id, EditedReport* report);

/// Removes the dance's keys in [first, end), with all keys that hold them, to make room for
/// others. Prints notes about those that are not in `moved`.
void ClearWay(int64_t first, int64_t end, const std::vector<client::KeyEdit>& moved,
              const std::string& what, EditedReport* report);

/// Makes room for a new key and the keys that hold it: ends holds, removes keys that are too near,
/// and fits its own hold in. Prints notes, and returns the warnings, to be kept after the edit.
/// Throws if an edit has already set another key at that frame.
std::vector<client::Warning> MakeRoom(const char* field, client::KeyEdit* edit,
                                      EditedReport* report);

}  // namespace choreo::cli
