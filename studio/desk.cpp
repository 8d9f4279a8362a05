#include "studio/desk.h"

#include <fstream>
#include <type_traits>
#include <utility>

#include "client/cli/choreography.h"
#include "client/cli/key_faults.h"
#include "client/cli/key_file.h"
#include "client/cli/photo_pose.h"
#include "client/cli/pose_library.h"
#include "client/convert.h"
#include "client/edit.h"
#include "model/formats/motion_file.h"
#include "studio/from_page.h"
#include "studio/scratch_folder.h"
#include "studio/to_page.h"

namespace choreo::studio {
namespace {

constexpr size_t kMostDances = 8;  // at once, of one page

/// A file in a folder of ours by the page's name for it, of which only the extension is believed.
std::filesystem::path PlaceFor(const ScratchFolder& folder, const std::string& name) {
  return folder.path() / ("file" + SmallExtension(name));
}

void Write(const std::filesystem::path& path, const std::string& data) {
  std::ofstream file(path, std::ios::binary);
  file << data;
  if (!file.flush()) throw Error(ErrorCode::kInternal, path.string(), "cannot be written");
}

/// What an error says of a file of ours, by the page's name for it.
std::string Named(const std::string& message, const std::string& path, const std::string& name) {
  const size_t at = message.find(path);
  return at == std::string::npos ? message : std::string(message).replace(at, path.size(), name);
}

}  // namespace

Desk::Desk(const House& house, Send send)
    : house_(house), send_(std::move(send)), song_(house.song()), worker_([this] { Work(); }) {
  Response response;
  *response.mutable_welcome() = house.welcome();
  Answer(0, std::move(response));
}

Desk::~Desk() {
  for (auto& [call, dancing] : dances_) dancing.dance->Cancel();
  dances_.clear();
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  asked_.notify_one();
  worker_.join();
}

void Desk::Take(Request request) {
  const uint32_t call = request.call();
  Reap();
  try {
    if (request.has_dance()) return TakeDance(call, request.dance());
    if (request.has_cancel()) return EndDance(call);
  } catch (const std::exception& error) {
    EndDance(call);
    return Fail(call, error.what());
  }
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(std::move(request));
  }
  asked_.notify_one();
}

void Desk::TakeDance(uint32_t call, const v1::StreamDanceRequest& request) {
  const auto found = dances_.find(call);
  if (request.has_config()) {
    if (found != dances_.end()) throw InvalidArgument("config", "came twice");
    return StartDance(call, request.config());
  }
  if (found == dances_.end()) return;  // it is over, which the page may not have heard yet
  client::RemoteDance& dance = *found->second.dance;
  switch (request.request_case()) {
    case v1::StreamDanceRequest::kKeyframe: {
      const client::KeyPose key = FromProto(request.keyframe(), house_.model().skeleton);
      if (found->second.is_live)
        TellFaults(call, {key});
      else
        found->second.keys.push_back(key);
      return dance.SendKey(key);
    }
    case v1::StreamDanceRequest::kRemoveKeyframe:
      return dance.RemoveKey(request.remove_keyframe().id());
    case v1::StreamDanceRequest::kControls:
      return dance.SendControls(FromProto(request.controls()));
    case v1::StreamDanceRequest::kGenerateUntil:
      return dance.GenerateUntil(request.generate_until().frame());
    case v1::StreamDanceRequest::kKeyframesComplete:
      TellFaults(call, std::exchange(found->second.keys, {}));
      return dance.CompleteKeys();
    case v1::StreamDanceRequest::kAudio:
      return dance.SendSamples(SamplesOf(request.audio()));
    case v1::StreamDanceRequest::kEndOfAudio:
      return dance.EndAudio();
    default:
      throw InvalidArgument("dance", "beats come from the studio, not from the page");
  }
}

void Desk::TellFaults(uint32_t call, const std::vector<client::KeyPose>& keys) {
  for (const client::Warning& fault :
       cli::KeyFaults(keys, house_.model().fps, house_.model().skeleton)) {
    Response response;
    *response.mutable_dance() = ToProto(fault);
    Answer(call, std::move(response));
  }
}

void Desk::StartDance(uint32_t call, const v1::DanceConfig& request) {
  if (dances_.size() >= kMostDances)
    throw Error(ErrorCode::kResourceExhausted, "dance",
                std::to_string(kMostDances) + " are in progress, the most");
  client::DanceConfig config = FromProto(request, house_.model().skeleton);
  // Who sends the music as it sounds is not danced to the song.
  const bool is_live = config.audio.kind != client::AudioKind::kNone;
  const std::shared_ptr<const Song> music = is_live ? nullptr : song();
  const bool hears = music && house_.model().takes_music;
  if (music) config.music_beats = cli::BeatsBefore(music->music, music->heard.seconds());
  if (hears) config.audio = music->audio.format;
  auto dance = house_.client().StartDance(config);
  if (hears) {
    dance->SendSamples(music->audio.samples);
    dance->EndAudio();
  }
  // Whatever fails before, no call is left that has no dance.
  Dancing& dancing = dances_[call];
  dancing.is_live = is_live;
  dancing.dance = std::move(dance);
  dancing.reader = std::jthread([this, call, &dancing] { ReadDance(call, &dancing); });
}

void Desk::ReadDance(uint32_t call, Dancing* dancing) {
  try {
    while (const std::optional<client::Message> message = dancing->dance->Next()) {
      Response response;
      std::visit(
          [&](const auto& said) {
            if constexpr (std::is_same_v<std::decay_t<decltype(said)>, client::Resumed>) {
              response.mutable_resumed()->set_reason(said.reason);
              response.mutable_resumed()->set_exact(said.exact);
            } else {
              *response.mutable_dance() = ToProto(said);
            }
          },
          *message);
      Answer(call, std::move(response));
    }
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kCancelled) Fail(call, error.what());
  }
  const std::lock_guard lock(mutex_);
  dancing->over = true;
}

void Desk::EndDance(uint32_t call) {
  const auto found = dances_.find(call);
  if (found == dances_.end()) return;
  found->second.dance->Cancel();
  dances_.erase(found);
}

void Desk::Reap() {
  for (auto dance = dances_.begin(); dance != dances_.end();) {
    bool over = false;
    {
      const std::lock_guard lock(mutex_);
      over = dance->second.over;
    }
    dance = over ? dances_.erase(dance) : std::next(dance);
  }
}

void Desk::Work() {
  for (;;) {
    Request request;
    {
      std::unique_lock lock(mutex_);
      asked_.wait(lock, [this] { return stop_ || !queue_.empty(); });
      if (stop_) return;
      request = std::move(queue_.front());
      queue_.pop_front();
    }
    try {
      Do(request);
    } catch (const std::exception& error) {
      Fail(request.call(), error.what());
    }
  }
}

void Desk::Do(const Request& request) {
  const uint32_t call = request.call();
  switch (request.request_case()) {
    case Request::kSong:
      return HearSongOf(call, request.song());
    case Request::kTransition:
      return Transition(call, request.transition());
    case Request::kCompose:
      return ComposeKeys(call, request.compose());
    case Request::kExport:
      return WriteClip(call, request.export_());
    case Request::kOpen:
      return ReadClip(call, request.open());
    case Request::kLandmarks:
      return MakePhotoPose(call, request.landmarks());
    case Request::kKeys:
      return ReadKeys(call, request.keys());
    default:
      throw InvalidArgument("request", "is none that this studio knows");
  }
}

void Desk::HearSongOf(uint32_t call, const File& file) {
  const ScratchFolder folder;
  const std::filesystem::path path = PlaceFor(folder, file.name());
  Write(path, file.data());
  auto heard = std::make_shared<const Song>(HearSong(path, file.name(), house_.most_seconds()));
  Response response;
  *response.mutable_song() = heard->heard;
  {
    const std::lock_guard lock(mutex_);
    song_ = std::move(heard);
  }
  Answer(call, std::move(response));
}

void Desk::Transition(uint32_t call, const v1::GenerateTransitionRequest& asked) {
  client::TransitionRequest request = FromProto(asked, house_.model().skeleton);
  const std::shared_ptr<const Song> music = song();
  if (music) {
    const int64_t first = request.config.continuation ? request.config.continuation->frame
                                                      : request.config.first_frame;
    client::SetMusic(music->audio, house_.model(), first, &request);
    request.config.music_beats = cli::BeatsBefore(music->music, music->heard.seconds());
  }
  client::TransitionResult made = house_.client().GenerateTransition(request);
  if (request.target) {
    const int64_t first = request.config.continuation ? request.config.continuation->frame
                                                      : request.config.first_frame;
    const client::KeyPose key{.id = request.target_id,
                              .frame = first + request.frames - 1,
                              .pose = *request.target,
                              .mask = request.target_mask};
    for (client::Warning& fault :
         cli::KeyFaults(std::vector{key}, house_.model().fps, house_.model().skeleton))
      made.warnings.push_back(std::move(fault));
  }
  for (v1::GenerateTransitionResponse& part : ToProto(made)) {
    Response response;
    *response.mutable_transition() = std::move(part);
    Answer(call, std::move(response));
  }
}

void Desk::ComposeKeys(uint32_t call, const Compose& request) {
  cli::CompositionRequest composition{.seconds = request.seconds(), .seed = request.seed()};
  composition.named = "compose.seconds";
  if (const std::shared_ptr<const Song> music = song())
    composition.beats = music->music.track.Seconds();
  Response response;
  response.mutable_keyframes();
  const auto library = cli::PosesToDance(house_.model().skeleton);
  for (const client::KeyPose& key : cli::ComposeKeys(composition, library))
    *response.mutable_keyframes()->add_keyframes() = client::ToProto(key);
  Answer(call, std::move(response));
}

void Desk::WriteClip(uint32_t call, const Export& request) {
  const ScratchFolder folder;
  RequireMotionFile(request.name());
  const std::filesystem::path path = PlaceFor(folder, request.name());
  const client::FinishedDance dance = FromProto(request.clip(), house_.model().skeleton);
  WriteMotion(path, house_.model().skeleton, dance.motion,
              dance.contacts.empty() ? nullptr : &dance.contacts);
  Response response;
  response.mutable_file()->set_name(request.name());
  response.mutable_file()->set_data(ReadBytes(path));
  Answer(call, std::move(response));
}

void Desk::ReadClip(uint32_t call, const File& file) {
  const ScratchFolder folder;
  RequireMotionFile(file.name());
  const std::filesystem::path path = PlaceFor(folder, file.name());
  Write(path, file.data());
  client::FinishedDance dance;
  try {
    dance.motion = ReadMotion(path, house_.model().skeleton);
  } catch (const Error& error) {
    throw Error(error.code(), "", Named(error.what(), path.string(), file.name()));
  }
  Response response;
  *response.mutable_clip() = ToProto(dance);
  Answer(call, std::move(response));
}

void Desk::MakePhotoPose(uint32_t call, const File& landmarks) {
  Response response;
  LibraryPose* pose = response.mutable_pose();
  pose->set_id(std::filesystem::path(landmarks.name()).stem().string());
  *pose->mutable_pose() = client::ToProto(
      cli::ParseLandmarkPose(landmarks.data(), landmarks.name(), house_.model().skeleton));
  Answer(call, std::move(response));
}

void Desk::ReadKeys(uint32_t call, const File& file) {
  Response response;
  response.mutable_keyframes();
  for (const client::KeyPose& key :
       cli::ParseKeyFile(file.data(), file.name(), house_.model().skeleton))
    *response.mutable_keyframes()->add_keyframes() = client::ToProto(key);
  Answer(call, std::move(response));
}

std::shared_ptr<const Song> Desk::song() const {
  const std::lock_guard lock(mutex_);
  return song_;
}

void Desk::Answer(uint32_t call, Response response) {
  response.set_call(call);
  const std::lock_guard lock(sending_);
  send_(response);
}

void Desk::Fail(uint32_t call, const std::string& message) {
  Response response;
  response.mutable_failure()->set_message(message);
  Answer(call, std::move(response));
}

}  // namespace choreo::studio
