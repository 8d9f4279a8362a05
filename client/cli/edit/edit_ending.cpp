// Sets the pose in which a finished dance ends.
#include "client/authoring/ending.h"
#include "client/authoring/key_faults.h"
#include "client/authoring/key_file.h"
#include "client/authoring/pose_source.h"
#include "client/cli/edit/edit_session.h"
#include "model/motion/canonical.h"

namespace choreo::cli {

void EditSession::End(const std::string& source) {
  const authoring::NamedPose named = authoring::ReadPose(source, edit_.model.skeleton, counts_);
  if (named.has_place && !options_.allow_bends)
    authoring::RefuseBends({{named.key}, {source}}, edit_.model.skeleton);
  const double last_s = Seconds(frames_ - 1);
  client::KeyEdit edit;
  edit.key = authoring::Ending(named, counts_.beats, {frames_, edit_.model.fps});
  const double begin_s = edit.key.time_s;
  if (!named.has_place)
    edit.key.pose = GroundFrame{.origin = Here(*edit.key.frame).origin}.ToWorld(named.key.pose);
  authoring::RefuseHeldInAir(named.key, last_s - begin_s, "--end", edit_.model.skeleton);
  edit.held = authoring::Holding(&edit.key, last_s - begin_s, "--end");
  for (client::KeyPose& held : edit.held) held.frame = Frame(held.time_s);
  // Ends a hold that reaches into the transition to the pose.
  const std::vector<client::Warning> ended = EndHold(*edit.key.frame, edit.key.id);
  ClearWay(*edit.key.frame - Frame(authoring::kWayFromHold) + 1, frames_, {}, "the ending");
  Set("--end", begin_s, std::move(edit));
  Keep(ended);
}

}  // namespace choreo::cli
