#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "client/authoring/counts.h"
#include "client/authoring/pose_source.h"
#include "client/cli/edit/edit_options.h"
#include "client/cli/options/connection.h"
#include "client/cli/report/time_format.h"
#include "client/edit.h"
#include "model/motion/canonical.h"

namespace choreo::cli {

/// The last frame of a key and the keys that hold it.
inline int64_t LastFrame(const client::KeyEdit& edit) {
  return edit.held.empty() ? *edit.key.frame : *edit.held.back().frame;
}

/// Holds a key until a frame, with keys about as close together as those that hold it now.
void HoldUntil(int64_t last, client::KeyEdit* edit);

/// Edits the keys of a dance, one after another. The options and the connection must outlive it.
class EditSession {
 public:
  EditSession(const EditOptions& options, const Connection& connection);

  /// Parses a time, and converts it to seconds. `option`: the field of errors.
  double Second(const char* option, const std::string& time) const {
    return authoring::ParseTime(time, option).In(counts_, option);
  }

  /// Sets a key, and generates the two intervals around it again. `source` as in --key.
  void SetKey(const std::string& source, double at_s);
  /// Makes the dance end in a pose, as `choreo dance --end` does. Removes later keys.
  void End(const std::string& source);
  /// Removes a key of the report: its two intervals become one.
  void RemoveKey(const std::string& id);
  /// Moves a key of the report, with the keys that hold it, to another second, in the pose and
  /// place in which it was danced. --hold changes how long it is held.
  void MoveKey(const std::string& id, double to_s);
  /// Repeats the report's keys in [from_s, until_s) later, moved and turned to the dancer's place
  /// and facing at that time, and replaces the keys there.
  void Repeat(double from_s, double until_s, const std::string& later);
  /// Multiplies the distance in time of the report's keys in [from_s, until_s) from from_s by
  /// `times`. They keep their places on the floor and replace the keys at their new times. Leaves
  /// out keys that would be after the dance's end.
  void Stretch(double from_s, double until_s, double times);
  /// Mirrors the report's keys in [from_s, until_s), relative to the dancer's place and facing at
  /// the first of them.
  void MirrorPhrase(double from_s, double until_s);
  /// Generates the frames between two seconds again, through the keys there.
  void Retake(double from_s, double until_s);
  /// Generates the whole dance again, through its keys, with the options' settings. If only the
  /// path changes, starts at the path's beginning. If only counts change, generates nothing.
  void DanceOtherwise();
  /// Leads the last frames back to the first one. If a held pose ends the dance, adds new frames
  /// for that.
  void CloseLoop();
  /// Writes the dance and its report to the options' files.
  void Write() const;

 private:
  int64_t Frame(double seconds) const { return std::llround(seconds * edit_.model.fps); }
  /// As authoring::SecondOf, for times that are moved by counts.
  double CountedSecond(int64_t frame) const {
    return authoring::SecondOf(frame, edit_.model.fps, counts_);
  }
  double Seconds(int64_t frame) const { return static_cast<double>(frame) / edit_.model.fps; }

  void CheckKeys() const;
  void CheckAround(double seconds) const;
  /// Throws if a key at second `at_s` would be too near to `what`, at frame `other`.
  void CheckDistance(const char* field, double at_s, int64_t other, const std::string& what) const;
  /// The report's keys at frames in [first, end), as danced.
  std::vector<client::KeyPose> KeysAsDanced(int64_t first, int64_t end) const;
  /// Shortens a hold so that it ends with the dance at the latest.
  void EndWithDance(client::KeyEdit* edit) const;
  /// This frame or, if keys that hold a pose begin there, the frame after the last of them.
  int64_t AfterHold(int64_t frame) const;
  /// The report's keys in [from_s, until_s), as danced, each with all keys that hold it. Throws if
  /// there is none.
  std::vector<client::KeyEdit> Phrase(const char* field, double from_s, double until_s) const;
  /// Sets the keys of a phrase at their frames, where the dance must have no other keys.
  void SetAll(const char* field, std::span<client::KeyEdit> phrase);
  /// Reads a pose as --key names it: that of a key of the report, around the origin, or a source
  /// for ReadPose. A pose of the library goes before a key of the same name, as does a file.
  authoring::NamedPose ReadKeyPose(const std::string& source) const;
  /// Holds a key at second `at_s` for the time of --hold or, without it, as long as it is held now.
  /// `source`: the key's name in errors.
  void HoldAsAsked(const std::string& source, double at_s, client::KeyEdit* edit);
  /// Makes room for a new key and the keys that hold it: calls EndHold, MakeWay and FitHold.
  /// Returns the warnings, to be shown after the edit. Throws if this edit has already set another
  /// key at that frame.
  std::vector<client::Warning> MakeRoom(const char* field, client::KeyEdit* edit);
  /// Ends a new key's hold before the next key, and prints a note. Extends or shortens it to the
  /// end of the dance if it would end shortly before or after that.
  std::vector<client::Warning> FitHold(client::KeyEdit* edit);
  /// Ends the hold of another key if a new key at this frame is within it, and prints a note.
  /// Returns the warning, if any, to be shown after the edit.
  std::vector<client::Warning> EndHold(int64_t frame, const std::string& id);
  /// Removes keys too near in time to a new key, held from `first` to `last`, with the keys that
  /// hold them, and prints a note.
  void MakeWay(int64_t first, int64_t last, const std::string& id);
  /// Removes the dance's keys in [first, end), with all keys that hold them, to make room for
  /// others. Prints notes about those that are not in `moved`.
  void ClearWay(int64_t first, int64_t end, const std::vector<client::KeyEdit>& moved,
                const std::string& what);
  void NoteWay(int64_t frame, const std::string& what) const;
  /// The frame at second `at_s`. Throws if it is after the dance's end.
  int64_t FrameInDance(const char* field, double at_s) const;
  int64_t Around() const;
  /// Whether the edit of a key extends to another key that is this many frames away.
  bool Reaches(int64_t frames) const;
  /// The last unchanged frame before an edit at `frame`: that of the previous key if it is within
  /// reach. Otherwise all stale frames after the previous key are also generated again.
  int64_t Before(int64_t frame) const;
  /// The first unchanged frame after an edit at `frame`: that of the next key if it is within
  /// reach. Otherwise all stale frames before the next key are also generated again.
  int64_t After(int64_t frame) const;

  /// Generates the frames between two others again, through the keys there. `from` and `to` as in
  /// client::Gap.
  void DanceAnew(const std::string& what, int64_t from, int64_t to);
  /// Writes the beats of the options, if any, into the report.
  void RenameBeats();
  /// Sets a moved or new key at this second, with the keys that hold it, between its neighbours.
  void Set(const char* field, double at_s, client::KeyEdit edit);
  /// Removes keys from the report. Their frames are stale until they are generated again.
  void Forget(ReportKeys::const_iterator begin, ReportKeys::const_iterator end);
  /// Removes keys, none of which is the dance's first frame.
  void Free(const std::vector<int64_t>& frames, const std::string& id);
  std::string IdAt(int64_t frame) const { return keys_.at(frame).id; }
  /// The dancer's place at this frame.
  GroundFrame Here(int64_t frame) const;
  /// How to close a loop: the frames after `from`, and `added` ones after the dance's end, lead
  /// back to its beginning.
  struct Loop {
    int64_t from = 0, added = 0;
  };
  Loop LoopFrames() const;
  /// Warns if a key is impossible.
  void WarnOfFaults(const client::KeyEdit& edit);
  /// Drops warnings about frames that are generated again, and about the transition to `to`; in a
  /// loop also if the first frame changes. These frames are no longer stale.
  void Refresh(int64_t from, int64_t to);
  void Keep(const std::vector<client::Warning>& warnings);
  void Apply(client::EditedDance edited, const std::string& what);
  /// Follows the report's path in an edit between two frames, if it leads there.
  void FollowPath(int64_t from, int64_t to);

  const EditOptions& options_;
  const client::Client& client_;
  client::EditOptions edit_;
  std::optional<ControlRequest::RootPath> path_;  // of the whole dance
  authoring::Counts counts_;                      // of the song
  TimeFormat times_;
  int64_t longest_ = 0;
  client::FinishedDance dance_;
  int64_t frames_ = 0;  // at the model's rate
  ReportFile known_;    // with the edits
  ReportKeys& keys_ = known_.keys;
  std::set<int64_t> set_;    // frames of keys that this edit has set
  std::set<int64_t> stale_;  // frames that show keys that are removed or not yet set
};

}  // namespace choreo::cli
