#include "studio/answers.h"

#include <filesystem>
#include <utility>

#include "client/authoring/keys/choreography.h"
#include "client/authoring/keys/photo_pose.h"
#include "client/authoring/keys/pose_library.h"
#include "client/convert.h"
#include "model/core/files/atomic_file.h"
#include "model/core/files/small_extension.h"
#include "model/formats/motion_file.h"
#include "model/motion/pose/motion_faults.h"
#include "studio/from_page.h"
#include "studio/scratch_folder.h"

namespace choreo::studio {
namespace {

/// A path in our folder with the extension of the page's file name.
std::filesystem::path PlaceFor(const ScratchFolder& folder, const std::string& name) {
  return folder.path() / ("file" + SmallExtension(name));
}

}  // namespace

std::shared_ptr<const Song> HearSongOf(const StudioContext& context, const File& file) {
  const ScratchFolder folder;
  const std::filesystem::path path = PlaceFor(folder, file.name());
  WriteFile(path, file.data());
  return std::make_shared<const Song>(HearSong(path, file.name(), context.most_seconds()));
}

Response ComposeKeys(const StudioContext& context, const Song* music, const Compose& request) {
  authoring::CompositionRequest composition{.seconds = request.seconds(), .seed = request.seed()};
  composition.named = "compose.seconds";
  composition.beats.assign(request.beats().begin(), request.beats().end());
  CheckBeats(composition.beats, "compose.beats");
  if (music && composition.beats.empty()) {
    authoring::Counts counts = authoring::CountsOf(music->music);
    composition.beats = std::move(counts.beats);
    composition.one = counts.one;
  }
  if (music) {
    composition.passages = music->music.passages;
    composition.seed ^= music->music.id;  // different songs get different poses
  }
  Response response;
  response.mutable_keyframes();
  const auto library = authoring::PosesToDance(context.model().skeleton);
  for (const client::KeyPose& key : authoring::ComposeKeys(composition, library))
    *response.mutable_keyframes()->add_keyframes() = client::ToProto(key);
  return response;
}

Response WriteClip(const StudioContext& context, const Export& request) {
  const ScratchFolder folder;
  RequireWrittenMotionFile(request.name());
  const std::filesystem::path path = PlaceFor(folder, request.name());
  const client::FinishedDance dance = FromProto(request.clip(), context.model().skeleton);
  WriteMotion(path, context.model().skeleton, dance.motion,
              dance.contacts.empty() ? nullptr : &dance.contacts);
  Response response;
  response.mutable_file()->set_name(request.name());
  response.mutable_file()->set_data(ReadFile(path));
  return response;
}

Response ReadClip(const StudioContext& context, const File& file) {
  const ScratchFolder folder;
  RequireMotionFile(file.name());
  const std::filesystem::path path = PlaceFor(folder, file.name());
  WriteFile(path, file.data());
  Motion motion;
  std::vector<std::string> notes;
  try {
    motion =
        ReadMotion(path, context.model().skeleton, OtherSkeleton::kRetarget, {.notes = &notes});
  } catch (const Error& error) {
    // The page does not know our path.
    const std::string ours = path.string(), &field = error.field();
    throw field.starts_with(ours) ? error.Of(file.name() + field.substr(ours.size())) : error;
  }
  Response response;
  Clip* clip = response.mutable_clip();
  clip->set_frame_rate(motion.fps);
  *clip->mutable_frames() = wire::ToProto(0, motion.frames, {});
  for (const std::string& note : notes) clip->add_notes(note);
  return response;
}

Response CheckClip(const StudioContext& context, const Clip& clip) {
  const Skeleton& skeleton = context.model().skeleton;
  Response response;
  Faults* faults = response.mutable_faults();
  for (const MotionFault& found : FindMotionFaults(skeleton, FromProto(clip, skeleton).motion)) {
    Fault* fault = faults->add_faults();
    fault->set_first_frame(found.first);
    fault->set_last_frame(found.last);
    fault->set_kind(std::string(found.row().name));
    fault->set_text(Describe(skeleton, found));
  }
  return response;
}

Response MakePhotoPose(const StudioContext& context, const File& landmarks) {
  Response response;
  LibraryPose* pose = response.mutable_pose();
  pose->set_id(std::filesystem::path(landmarks.name()).stem().string());
  *pose->mutable_pose() = client::ToProto(
      authoring::ParseLandmarkPose(landmarks.data(), landmarks.name(), context.model().skeleton));
  return response;
}

}  // namespace choreo::studio
