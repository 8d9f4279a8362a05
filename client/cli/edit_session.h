#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/cli/connection.h"
#include "client/cli/control_options.h"
#include "client/cli/report_keys.h"
#include "client/edit.h"
#include "model/motion/canonical.h"

namespace choreo::cli {

/// What `choreo edit` was asked.
struct EditOptions {
  ServerOptions server;
  std::string dance;
  std::vector<std::string> keys;
  std::vector<double> at_s;
  std::vector<std::pair<std::string, double>> moves;  ///< keys of the report, and seconds
  std::vector<std::string> removed;                   ///< keys of the report
  bool in_place = false;
  bool allow_bends = false;
  bool loop = false;
  std::optional<double> around_s;
  std::string song;
  double song_start_s = 0;
  std::string report;
  std::string new_report;
  std::optional<uint64_t> seed;
  std::optional<double> temperature;
  std::optional<double> music_dynamics;
  std::optional<double> variation;
  std::string style;
  ControlOptions controls;
  std::string model;
  std::string out;
};

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
  /// Leads the last frames back into the first; behind a pose that is held at the end, new ones.
  void CloseLoop();
  /// The dance, and the report of what is known of it, where the options want them.
  void Write() const;

 private:
  int64_t Frame(double seconds) const { return std::llround(seconds * edit_.model.fps); }
  double Seconds(int64_t frame) const { return static_cast<double>(frame) / edit_.model.fps; }

  void ReadKeys();
  void CheckKeys() const;
  void CheckAround(double seconds) const;
  /// Throws where a key at this second would be too near to `what` at this frame.
  void CheckDistance(const char* field, double at_s, int64_t other, const std::string& what) const;
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
  int64_t frames_ = 0;                     // at the model's rate
  ReportKeys keys_;                        // those known
  std::vector<client::Warning> warnings_;  // of the report and of the edits
};

}  // namespace choreo::cli
