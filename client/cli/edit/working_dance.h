#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/cli/edit/edit_options.h"
#include "client/cli/edit/edited_report.h"
#include "client/cli/options/connection.h"
#include "client/edit.h"
#include "model/motion/kinematics/canonical.h"

namespace choreo::cli {

/// A finished dance that edits change, one after another: generates its frames again, and keeps its
/// report true. The options and the connection must outlive it.
class WorkingDance {
 public:
  WorkingDance(const EditOptions& options, const Connection& connection);

  /// The settings of new frames.
  const client::EditOptions& settings() const { return settings_; }
  const EditReach& reach() const { return reach_; }
  const EditedReport& report() const { return report_; }
  EditedReport& report() { return report_; }
  const DanceTimes& times() const { return report_.times(); }
  Pose PoseAt(int64_t frame) const;
  /// The dancer's place at this frame.
  GroundFrame Here(int64_t frame) const { return GroundFrame::Of(PoseAt(frame)); }
  /// The report's keys at frames in [first, end), as danced.
  std::vector<client::KeyPose> KeysAsDanced(int64_t first, int64_t end) const;

  /// Sets a moved or new key at this second, with the keys that hold it, between its neighbours. A
  /// key beside the first frame, which earlier dances may have, comes to stand on it. `done`: what
  /// the edit does to the key, for people ("moved").
  void Set(const char* field, const std::string& done, double at_s, client::KeyEdit edit);
  /// Removes keys, none of which is the dance's first frame.
  void Free(const std::vector<int64_t>& frames, const std::string& what);
  /// Generates the frames between two others again, through the keys there. `from` and `to` as in
  /// client::Gap.
  void DanceAnew(const std::string& what, int64_t from, int64_t to);
  /// Leads back to the dance's beginning.
  void LeadBack(const EditReach::Loop& loop);
  /// Writes the dance and its report to the options' files.
  void Write() const;

 private:
  /// Prepares for new frames: names the key after them, and drops what the report says of them.
  template <class Edit>
  void Prepare(Edit* edit);
  /// Warns if a key is impossible.
  void WarnOfFaults(const client::KeyEdit& edit);
  /// Follows the report's path in an edit between two frames, if it leads there.
  void FollowPath(int64_t from, int64_t to);
  void Apply(client::EditedDance edited, const std::string& what);

  const EditOptions& options_;
  const client::Client& client_;
  EditReach reach_;
  client::EditOptions settings_;
  std::optional<ControlRequest::RootPath> path_;  // of the whole dance
  client::FinishedDance dance_;
  EditedReport report_;
};

}  // namespace choreo::cli
