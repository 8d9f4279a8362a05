#include "studio/studio_context.h"

#include <algorithm>

#include "client/authoring/keys/key_file.h"
#include "client/authoring/keys/pose_library.h"
#include "client/authoring/project/dancers.h"
#include "client/convert.h"
#include "client/describe_styles.h"
#include "model/audio/beats/beat_hint.h"
#include "model/core/files/atomic_file.h"
#include "model/core/hit.h"
#include "model/core/limits.h"
#include "model/formats/motion_file.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/motion/kinematics/joint_angles.h"
#include "model/motion/kinematics/kinematics.h"
#include "studio/scratch_folder.h"

namespace choreo::studio {
namespace {

/// The body on the page, the same as in all other pictures.
std::string BodyAtRest(const Skeleton& skeleton) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "body.glb";
  WriteMotion(path, skeleton, {.frames = {RestPose(skeleton)}});
  return ReadFile(path);
}

JointTurn TurnOf(const Skeleton& skeleton, int joint) {
  JointTurn turn;
  Eigen::Index part = 0;
  WeighBodyParts(skeleton).col(joint).maxCoeff(&part);
  turn.set_part(static_cast<v1::BodyPart>(v1::BODY_PART_TRUNK + static_cast<int>(part)));
  for (const Hinge& hinge : Hinges(skeleton)) {
    if (hinge.joint == joint) turn.mutable_hinge()->Assign(hinge.axis.begin(), hinge.axis.end());
  }
  const AngleRange range = RangeOf(skeleton, joint);
  turn.set_low(range.low);
  turn.set_high(range.high);
  return turn;
}

Limits LimitsOf(double song_s) {
  Limits limits;
  limits.set_song_s(song_s);
  limits.set_slowest_tempo(kSlowestHint);
  limits.set_fastest_tempo(kFastestHint);
  limits.set_hit(kMaxHit);
  limits.set_key_distance(kMinKeyDistance);
  limits.set_hold_step_s(authoring::kHoldStep);
  limits.set_hold_s(authoring::kMaxHoldSeconds);
  limits.set_dancers(authoring::kMaxDancers);
  limits.set_stage_m(authoring::kMaxStageRadius);
  limits.set_usual_apart_m(authoring::kUsuallyApart);
  limits.set_usual_music_dynamics(kDefaultDynamics);
  limits.set_usual_variation(kDefaultVariation);
  limits.set_usual_hit(authoring::kUsualHit);
  limits.set_too_near_s(authoring::kTooNear);
  limits.set_way_from_hold_s(authoring::kWayFromHold);
  limits.set_edit_around_s(authoring::kEditAround);
  limits.set_next_key_near_s(authoring::kNextKeyNear);
  return limits;
}

}  // namespace

StudioContext::StudioContext(const client::Options& server, const std::filesystem::path& song,
                             const std::filesystem::path& photo_model)
    : client_(server), server_(client_.GetServerInfo()), photo_model_(photo_model) {
  const Skeleton& skeleton = model().skeleton;
  welcome_.set_version(server_.version);
  *welcome_.mutable_model() = wire::ToProto(model());
  *welcome_.mutable_limits() = LimitsOf(most_seconds());
  std::vector<authoring::LibraryPose> poses = authoring::PosesFor(skeleton);
  const auto stance = [](const authoring::LibraryPose& pose) {
    return std::ranges::find(authoring::PoseTags(), pose.tags.front());
  };
  std::ranges::stable_sort(poses, {}, stance);
  for (const authoring::LibraryPose& pose : poses) {
    LibraryPose* added = welcome_.add_poses();
    added->set_id(pose.id);
    added->set_stance(pose.tags.front());
    added->set_description(pose.description);
    *added->mutable_pose() = client::ToProto(pose.pose);
  }
  for (int joint = 0; joint < skeleton.joints(); ++joint)
    *welcome_.add_turns() = TurnOf(skeleton, joint);
  welcome_.set_styles_shown(client::DescribeStyles(model().style_figures));
  welcome_.set_body(BodyAtRest(skeleton));
  welcome_.set_reads_photos(photo_model_.is_there());
  if (song.empty()) return;
  song_ = std::make_shared<const Song>(HearSong(song, song.string(), most_seconds()));
  welcome_.mutable_song()->set_name(song.filename().string());
  welcome_.mutable_song()->set_data(ReadFile(song));
  *welcome_.mutable_heard() = song_->heard;
}

}  // namespace choreo::studio
