#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "client/authoring/counts.h"
#include "client/cli/connection.h"
#include "client/cli/edit_options.h"
#include "client/cli/told_times.h"
#include "client/edit.h"
#include "model/motion/canonical.h"

namespace choreo::cli {

/// The last frame of a key with what holds it.
inline int64_t LastFrame(const client::KeyEdit& edit) {
  return edit.held.empty() ? *edit.key.frame : *edit.held.back().frame;
}

/// Holds a key until a frame, by keys about as close together as those that hold it now.
void HoldUntil(int64_t last, client::KeyEdit* edit);

/// A dance and edits of its keys, one after another. The options and the connection must outlive
/// it.
class EditSession {
 public:
  EditSession(const EditOptions& options, const Connection& connection);

  /// The second of a time as written.
  double Second(const char* option, const std::string& time) const {
    return authoring::ParseTime(time, option).In(counts_, option);
  }

  /// Dances the two intervals around a key again. `source` as in --key.
  void SetKey(const std::string& source, double at_s);
  /// Lets the dance end in a pose, as `choreo dance --end` does; later keys make way.
  void End(const std::string& source);
  /// Removes a key of the report: its two intervals become one.
  void RemoveKey(const std::string& id);
  /// Moves a key of the report, with what holds it, to another second, as danced; --hold changes
  /// how long it is held.
  void MoveKey(const std::string& id, double to_s);
  /// Repeats the report's keys in [from_s, until_s) later, moved and turned to where the dancer is
  /// then, replacing the keys there.
  void Repeat(double from_s, double until_s, const std::string& later);
  /// Sets the report's keys in [from_s, until_s) `times` as far from from_s, where they stand on
  /// the floor, replacing the keys there. Leaves out those that would come after the dance.
  void Stretch(double from_s, double until_s, double times);
  /// Mirrors the report's keys in [from_s, until_s), relative to the dancer's place and facing at
  /// the first of them.
  void MirrorPhrase(double from_s, double until_s);
  /// Dances the frames between two seconds anew, through the keys there.
  void Retake(double from_s, double until_s);
  /// Dances the whole dance anew as the options say, through its keys; with another path alone,
  /// from where that begins.
  void DanceOtherwise();
  /// Leads the last frames back to the first; after a held pose at the end, adds new ones.
  void CloseLoop();
  /// Writes the dance and its report, as the options say.
  void Write() const;

 private:
  int64_t Frame(double seconds) const { return std::llround(seconds * edit_.model.fps); }
  double Seconds(int64_t frame) const { return static_cast<double>(frame) / edit_.model.fps; }

  void CheckKeys() const;
  void CheckAround(double seconds) const;
  /// Throws if a key at this second would be too near to `what` at this frame.
  void CheckDistance(const char* field, double at_s, int64_t other, const std::string& what) const;
  /// The report's keys at frames in [first, end), as danced.
  std::vector<client::KeyPose> KeysAsDanced(int64_t first, int64_t end) const;
  /// Ends a hold with the dance at the latest.
  void EndWithDance(client::KeyEdit* edit) const;
  /// This frame, or the one after what holds a key from there on.
  int64_t AfterHold(int64_t frame) const;
  /// The report's keys in [from_s, until_s), as danced, each with all that holds it; at least one.
  std::vector<client::KeyEdit> Phrase(const char* field, double from_s, double until_s) const;
  /// Sets the keys of a phrase at their present places; the dance has no others there.
  void SetAll(const char* field, std::span<client::KeyEdit> phrase);
  /// Holds a key at this second, with what holds it, as long as --hold says, or else as it is
  /// held. `source`: its name in errors.
  void HoldAsAsked(const std::string& source, double at_s, client::KeyEdit* edit);
  /// Makes room for a new key and what holds it: EndHold, MakeWay, FitHold. Returns the warnings,
  /// for after the edit. Throws for a frame where this edit has set another key.
  std::vector<client::Warning> MakeRoom(const char* field, client::KeyEdit* edit);
  /// Ends a new key's hold before the next key, and says so; lets it last to the end of the dance
  /// if it would end shortly before or after that.
  std::vector<client::Warning> FitHold(client::KeyEdit* edit);
  /// Ends the hold of another key if a new key at this frame falls into it, and says so. Returns
  /// the warning, if any, for after the edit.
  std::vector<client::Warning> EndHold(int64_t frame, const std::string& id);
  /// Removes keys too near in time to a new key, held from `first` to `last`, with what holds them,
  /// and says so.
  void MakeWay(int64_t first, int64_t last, const std::string& id);
  /// Removes the dance's keys in [first, end), with all that holds them, for others, and names
  /// those that are not `moved`.
  void ClearWay(int64_t first, int64_t end, const std::vector<client::KeyEdit>& moved,
                const std::string& what);
  void NoteWay(int64_t frame, const std::string& what) const;
  /// The frame of this second; throws if it is after the dance.
  int64_t FrameInDance(const char* field, double at_s) const;
  int64_t Around() const;
  /// Whether the edit of a key reaches up to another one so many frames away.
  bool Reaches(int64_t frames) const;
  /// An edit at `frame` dances the frames between these two anew. They are the neighbouring keys'
  /// frames if these are within reach. Else all stale frames up to the neighbours lie between them.
  int64_t Before(int64_t frame) const;
  int64_t After(int64_t frame) const;

  /// Dances the frames between two others anew, through the keys there; `to`: as in client::Gap.
  void DanceAnew(const std::string& what, int64_t from, int64_t to);
  /// Sets a moved or new key at this second, from `edit.key` to the last of `edit.held`, between
  /// its neighbours.
  void Set(const char* field, double at_s, client::KeyEdit edit);
  /// Takes keys out of the report; their frames are stale until they are danced again.
  void Forget(ReportKeys::const_iterator begin, ReportKeys::const_iterator end);
  /// Removes keys, none of which is the dance's first frame.
  void Free(const std::vector<int64_t>& frames, const std::string& id);
  std::string IdAt(int64_t frame) const { return keys_.at(frame)["id"].get<std::string>(); }
  /// The dancer's place at this frame.
  GroundFrame Here(int64_t frame) const;
  /// A loop: the frames after `from`, and `added` ones after the dance, lead back to its beginning.
  struct Loop {
    int64_t from = 0, added = 0;
  };
  Loop LoopFrames() const;
  /// Warns of an impossible key.
  void WarnOfFaults(const client::KeyEdit& edit);
  /// Drops warnings about frames that are danced again, and about the way to `to`: in a loop also
  /// if the first frame changes. These frames are no longer stale.
  void Refresh(int64_t from, int64_t to);
  void Keep(const std::vector<client::Warning>& warnings);
  void Take(client::EditedDance edited, const std::string& what);
  /// Follows the report's path in an edit between two frames, if it leads there.
  void FollowPath(int64_t from, int64_t to);

  const EditOptions& options_;
  const client::Client& client_;
  client::EditOptions edit_;
  std::optional<ControlRequest::RootPath> path_;  // of the whole dance
  authoring::Counts counts_;                      // of the song
  ToldTimes told_;
  int64_t longest_ = 0;
  client::FinishedDance dance_;
  int64_t frames_ = 0;  // at the model's rate
  KnownDance known_;    // from the report and the edits
  ReportKeys& keys_ = known_.keys;
  std::set<int64_t> set_;    // frames of keys that this edit has set
  std::set<int64_t> stale_;  // frames that show keys which are gone or are yet to be set
};

}  // namespace choreo::cli
