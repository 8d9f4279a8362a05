#pragma once

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "client/authoring/fields/counts.h"
#include "client/cli/edit/edit_options.h"
#include "client/cli/report/report_file.h"
#include "client/cli/report/time_format.h"
#include "client/edit.h"

namespace choreo::cli {

/// The times of a dance: frames at the model's rate, seconds, and counts of the song.
struct DanceTimes {
  int64_t frames = 0;  ///< of the dance
  double fps = kModelFps;
  authoring::Counts counts = {};
  TimeFormat format = {};  ///< for messages

  int64_t Frame(double seconds) const { return std::llround(seconds * fps); }
  /// The frame at second `at_s`. Throws if it is after the dance's end.
  int64_t FrameInDance(const char* field, double at_s) const;
  /// The frame for a key at second `at_s` (authoring::FrameForKey). Throws as FrameInDance does.
  int64_t KeyFrame(const char* field, double at_s) const {
    return authoring::FrameForKey(FrameInDance(field, at_s));
  }
  double Seconds(int64_t frame) const { return static_cast<double>(frame) / fps; }
  /// As authoring::SecondOf, for times that are moved by counts.
  double CountedSecond(int64_t frame) const { return authoring::SecondOf(frame, fps, counts); }
  /// Parses a time, and converts it to seconds. `option`: the field of errors.
  double Second(const char* option, const std::string& time) const {
    return authoring::ParseTime(time, option).In(counts, option);
  }
};

/// A dance's report with the edits so far. Knows which keys the dance does not show yet.
class EditedReport {
 public:
  EditedReport() = default;
  EditedReport(ReportFile file, DanceTimes times)
      : file_(std::move(file)), times_(std::move(times)) {
    file_.counts = times_.counts;
  }

  const ReportFile& file() const { return file_; }
  const ReportKeys& keys() const { return file_.keys; }
  DanceSettings& settings() { return file_.settings; }
  const DanceTimes& times() const { return times_; }
  /// Frames that show keys that are removed or not yet set.
  const std::set<int64_t>& stale() const { return stale_; }
  std::string IdAt(int64_t frame) const { return keys().at(frame).id; }
  /// Whether an edit has set a key at this frame.
  bool IsSet(int64_t frame) const { return set_.contains(frame); }
  /// This frame or, if keys that hold a pose begin there, the frame after the last of them.
  int64_t AfterHold(int64_t frame) const;

  /// Removes the keys in [first, end). Their frames are stale until they are generated again.
  void Forget(int64_t first, int64_t end);
  void MarkStale(int64_t frame) { stale_.insert(frame); }
  void ClearStale() { stale_.clear(); }
  /// Drops warnings about frames that are generated again, and about the transition to `to`; in a
  /// loop also if the first frame changes. These frames are no longer stale.
  void Refresh(int64_t from, int64_t to);
  void Keep(const std::vector<client::Warning>& warnings);
  void Lengthen(int64_t frames) { times_.frames += frames; }
  void Reached(const client::KeyReached& key) { file_.keys[key.frame] = {key}; }
  /// Adds what the server does not know about keys that an edit has set.
  void Record(const client::KeyEdit& edit);
  /// Adds what the server does not know about keys that it has reached again.
  void Restore(const ReportKeys& before);

 private:
  ReportFile file_;
  DanceTimes times_;
  std::set<int64_t> set_, stale_;
};

/// How far an edit reaches: the frames around a key, or before the end, that it changes.
class EditReach {
 public:
  /// Throws Error(kInvalidArgument) for more or less around a key than one transition can have.
  EditReach(const EditOptions& options, const client::ModelDescription& model);

  /// Whether the edit of a key extends to another key that is this many frames away.
  bool Reaches(int64_t frames) const { return frames <= near_; }
  /// The last unchanged frame before an edit at `frame`: that of the previous key if it is within
  /// reach. Otherwise all stale frames after the previous key are also generated again.
  int64_t Before(const EditedReport& report, int64_t frame) const;
  /// The first unchanged frame after an edit at `frame`: that of the next key if it is within
  /// reach. Otherwise all stale frames before the next key are also generated again.
  int64_t After(const EditedReport& report, int64_t frame) const;

  /// How to close a loop: the frames after `from`, and `added` ones after the dance's end, lead
  /// back to its beginning.
  struct Loop {
    int64_t from = 0, added = 0;
  };
  Loop LoopOf(const ReportKeys& keys, int64_t frames) const;

 private:
  int64_t longest_ = 0;  // frames of a transition
  int64_t around_ = 0;   // frames that change on a side without a key within reach
  int64_t near_ = 0;     // frames within reach
  bool takes_stale_ = true;
};

}  // namespace choreo::cli
