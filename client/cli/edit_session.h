#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "client/cli/connection.h"
#include "client/cli/edit_options.h"
#include "client/edit.h"
#include "model/motion/canonical.h"

namespace choreo::cli {

/// A dance while its keys are changed, one after another. The options and the connection must
/// outlive it.
class EditSession {
 public:
  EditSession(const EditOptions& options, const Connection& connection);

  /// Dances the two intervals around a key anew. `source` as in --key.
  void SetKey(const std::string& source, double at_s);
  /// Takes a key of the report away: its two intervals become one.
  void RemoveKey(const std::string& id);
  /// Takes a key of the report, and what holds it, to another second, as it is danced.
  void MoveKey(const std::string& id, double to_s);
  /// Sets the keys of the report in [from_s, until_s) once more, so much later, moved and turned to
  /// where the dancer is then. Those that stood there make way.
  void Repeat(double from_s, double until_s, const std::string& later);
  /// Leads the last frames back into the first; behind a pose that is held at the end, new ones.
  void CloseLoop();
  /// The dance, and the report of what is known of it, where the options want them.
  void Write() const;

 private:
  int64_t Frame(double seconds) const { return std::llround(seconds * edit_.model.fps); }
  double Seconds(int64_t frame) const { return static_cast<double>(frame) / edit_.model.fps; }

  void CheckKeys() const;
  void CheckAround(double seconds) const;
  /// Throws where a key at this second would be too near to `what` at this frame.
  void CheckDistance(const char* field, double at_s, int64_t other, const std::string& what) const;
  /// Throws where a pose that is held from one frame to another meets the next key, or the end.
  void CheckRoom(const char* field, double at_s, int64_t first, int64_t last) const;
  /// The frame of this second; throws where it is behind the dance.
  int64_t FrameInDance(const char* field, double at_s) const;
  int64_t Around() const;
  /// How far the edit of a key may reach at most, in frames.
  int64_t Reach() const;
  /// The last frame before a key that stays, and the first behind it: those of other keys, where
  /// they are known and near enough.
  int64_t Before(int64_t frame) const;
  int64_t Behind(int64_t frame) const;

  /// Sets what is moved or new at this second, from `edit.key` to the last of `edit.held`, between
  /// its neighbours.
  void Set(const char* field, double at_s, client::KeyEdit edit);
  /// Takes keys away, of which none is the dance's first frame.
  void Free(const std::vector<int64_t>& frames, const std::string& id);
  std::string IdAt(int64_t frame) const { return keys_.at(frame)["id"].get<std::string>(); }
  /// Where the dancer is at this frame.
  GroundFrame Here(int64_t frame) const;
  /// The frames behind `from`, and `added` ones behind the dance, lead back to its beginning.
  struct Loop {
    int64_t from = 0, added = 0;
  };
  Loop LoopFrames() const;
  /// Warns of a key that no body could dance where it is set.
  void WarnOfFaults(const client::KeyEdit& edit);
  /// What was said of frames that are danced anew, and of the way to `to`: of a loop, too, where
  /// the first frame is another one now.
  void DropWarnings(int64_t from, int64_t to);
  void Take(client::EditedDance edited, const std::string& what);

  const EditOptions& options_;
  const client::Client& client_;
  client::EditOptions edit_;
  int64_t longest_ = 0;
  client::FinishedDance dance_;
  int64_t frames_ = 0;  // at the model's rate
  KnownDance known_;    // of the report and of the edits
  ReportKeys& keys_ = known_.keys;
};

}  // namespace choreo::cli
