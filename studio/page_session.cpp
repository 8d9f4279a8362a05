#include "studio/page_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "client/authoring/keys/key_faults.h"
#include "client/dance_call.h"
#include "model/audio/signal/pcm.h"
#include "proto/wire/convert.h"
#include "studio/answers.h"
#include "studio/company.h"
#include "studio/from_page.h"
#include "studio/page_project.h"
#include "studio/project_dance.h"

namespace choreo::studio {
namespace {

constexpr size_t kMaxDances = 8;  // simultaneous, per page

}  // namespace

PageSession::PageSession(const StudioContext& context, Send send)
    : context_(context),
      send_(std::move(send)),
      song_(context.song()),
      worker_([this] { Work(); }) {
  Response response;
  *response.mutable_welcome() = context.welcome();
  Answer(0, std::move(response));
}

PageSession::~PageSession() {
  for (auto& [call, dancing] : dances_) dancing.dance->Cancel();
  dances_.clear();
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_one();
  worker_.join();
}

void PageSession::Receive(Request request) {
  const uint32_t call = request.call();
  Reap();
  try {
    if (request.has_dance()) return StartDance(call, request.dance());
    if (request.has_live()) return ReceiveLive(call, request.live());
    if (request.has_live_beats()) return ReceiveLiveBeats(call, request.live_beats());
    if (request.has_cancel()) return EndDance(call);
  } catch (const std::exception& error) {
    EndDance(call);
    return Fail(call, error.what());
  }
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(std::move(request));
  }
  changed_.notify_one();
}

void PageSession::ReceiveLive(uint32_t call, const v1::StreamDanceRequest& request) {
  const auto found = dances_.find(call);
  if (found == dances_.end()) return;  // ended; the page may not know yet
  if (!found->second.ear) throw InvalidArgument("live", "is for dances to live music");
  switch (request.request_case()) {
    case v1::StreamDanceRequest::kKeyframe:
      SendFaults(call, {FromProto(request.keyframe(), context_.model().skeleton)});
      break;
    case v1::StreamDanceRequest::kGenerateUntil:
      found->second.granted = request.generate_until().frame();
      break;
    case v1::StreamDanceRequest::kAudio:
      ListenTo(request.audio(), &found->second);
      break;
    case v1::StreamDanceRequest::kRemoveKeyframe:
    case v1::StreamDanceRequest::kKeyframesComplete:
    case v1::StreamDanceRequest::kEndOfAudio:
      break;
    default:
      throw InvalidArgument("live", "has this setting in its project");
  }
  CallOf(*found->second.dance).Send(request);
}

void PageSession::ListenTo(const v1::Audio& audio, Dancing* dancing) {
  const std::vector<float> samples =
      ReadPcm(audio.data(), /*floats=*/true, dancing->channels, "audio.data");
  // The server refuses others.
  const bool is_sound =
      std::ranges::all_of(samples, [](float value) { return std::isfinite(value); });
  if (!is_sound) return;
  live::MusicEar::Ahead heard = dancing->ear->Hear(samples);
  // Beats of frames that may exist already would come too late.
  heard.beats.Keep(static_cast<double>(dancing->granted) / context_.model().fps, kMaxAudioSeconds);
  if (!heard.beats.beats.empty())
    dancing->dance->SendBeats(heard.beats.beats, heard.beats.downbeats, heard.beats.confidence);
  if (heard.passage) dancing->dance->SendPassages(std::array{*heard.passage});
}

void PageSession::ReceiveLiveBeats(uint32_t call, const LiveBeats& beats) {
  const live::LiveBeatHint hint = FromProto(beats);
  const auto found = dances_.find(call);
  if (found != dances_.end() && found->second.ear) found->second.ear->SetHint(hint);
}

void PageSession::SendFaults(uint32_t call, const std::vector<client::KeyPose>& keys,
                             int64_t first_frame) {
  for (const client::Warning& fault :
       authoring::KeyFaults(keys, context_.model().fps, context_.model().skeleton)) {
    if (fault.frame < first_frame) continue;
    Response response;
    *response.mutable_dance()->mutable_event() = wire::ToProto(fault, context_.model().fps);
    Answer(call, std::move(response));
  }
}

void PageSession::StartDance(uint32_t call, const Dance& request) {
  // An exception would end the dance in progress.
  if (dances_.contains(call)) return Fail(call, "dance: came twice");
  if (dances_.size() >= kMaxDances)
    throw Error(ErrorCode::kResourceExhausted, "dance",
                std::to_string(kMaxDances) + " are in progress, the most");
  // A dance to live music does not use the song.
  const bool is_live = request.has_live_music();
  const std::shared_ptr<const Song> music = is_live ? nullptr : song();
  auto [config, keys, controls] = DanceOf(context_, request.project(), music.get());
  config.history = PosesOf(request.history(), context_.model().skeleton);
  config.first_frame = request.history().first_frame();
  // The way to the first new key begins at the one before.
  const std::vector<client::KeyPose> all_keys = keys.poses;
  std::erase_if(keys.poses, [&, fps = context_.model().fps](const client::KeyPose& key) {
    return authoring::FrameOf(key, fps) < config.first_frame;
  });
  const bool hears = music && context_.model().takes_music;
  if (hears) config.audio = music->audio.format;
  std::unique_ptr<live::MusicEar> ear;
  if (is_live) {
    config.audio = FromProto(request.live_music());
    config.frames.reset();
    config.generate_until = 0;
    config.reject_invalid_keys = true;
    ear = std::make_unique<live::MusicEar>(config.audio.sample_rate, config.audio.channels);
  }
  auto dance = context_.client().StartDance(config);
  for (const client::KeyPose& key : keys.poses) dance->SendKey(key);
  if (!is_live) dance->CompleteKeys();
  if (hears) {
    dance->SendSamples(music->audio.samples);
    dance->EndAudio();
  }
  // Nothing fails from here on: every remaining call has a dance.
  Dancing& dancing = dances_[call];
  dancing.ear = std::move(ear);
  dancing.channels = config.audio.channels;
  dancing.dance = std::move(dance);
  dancing.reader = std::jthread([this, call, &dancing] { ReadDance(call, &dancing); });
  SendFaults(call, all_keys, config.first_frame);
}

void PageSession::ReadDance(uint32_t call, Dancing* dancing) {
  // Before the page hears of the end, as it may use the number again at once.
  const auto end = [&] {
    const std::lock_guard lock(mutex_);
    dancing->over = true;
  };
  try {
    while (std::optional<client::DanceCall::Answer> answer = CallOf(*dancing->dance).Next()) {
      Response response;
      if (const auto* resumed = std::get_if<client::Resumed>(&*answer)) {
        response.mutable_resumed()->set_reason(resumed->reason);
        response.mutable_resumed()->set_exact(resumed->exact);
      } else {
        *response.mutable_dance() = std::get<v1::StreamDanceResponse>(*std::move(answer));
      }
      // The page needs no continuation: the client library resumes dances.
      if (response.dance().has_continuation()) continue;
      if (response.dance().has_summary()) end();
      Answer(call, std::move(response));
    }
    end();
  } catch (const Error& error) {
    end();
    if (error.code() != ErrorCode::kCancelled) Fail(call, error.what());
  } catch (const std::exception& error) {
    end();
    Fail(call, error.what());
  }
}

void PageSession::EndDance(uint32_t call) {
  const auto found = dances_.find(call);
  if (found == dances_.end()) return;
  found->second.dance->Cancel();
  dances_.erase(found);
}

void PageSession::Reap() {
  for (auto dance = dances_.begin(); dance != dances_.end();) {
    bool over = false;
    {
      const std::lock_guard lock(mutex_);
      over = dance->second.over;
    }
    dance = over ? dances_.erase(dance) : std::next(dance);
  }
}

void PageSession::Work() {
  for (;;) {
    Request request;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stop_ || !queue_.empty(); });
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

void PageSession::Do(const Request& request) {
  const uint32_t call = request.call();
  switch (request.request_case()) {
    case Request::kSong:
      return ReceiveSong(call, request.song());
    case Request::kCompose:
      return Answer(call, ComposeKeys(context_, song().get(), request.compose()));
    case Request::kExport:
      return Answer(call, WriteClip(context_, request.export_()));
    case Request::kOpen:
      return Answer(call, ReadClip(context_, request.open()));
    case Request::kCheck:
      return Answer(call, CheckClip(context_, request.check()));
    case Request::kLandmarks:
      return Answer(call, MakePhotoPose(context_, request.landmarks()));
    case Request::kRead:
      return Answer(call, ReadProject(context_, request.read()));
    case Request::kWrite:
      return Answer(call, WriteProject(context_, request.write()));
    case Request::kRetake:
      return Answer(call, MakeTakes(context_, song().get(), request.retake()));
    case Request::kCompany:
      return Answer(call, FormCompany(context_, request.company()));
    default:
      throw InvalidArgument("request", "is not known to this studio");
  }
}

void PageSession::ReceiveSong(uint32_t call, const File& file) {
  std::shared_ptr<const Song> heard = HearSongOf(context_, file);
  Response response;
  *response.mutable_song() = heard->heard;
  {
    const std::lock_guard lock(mutex_);
    song_ = std::move(heard);
  }
  Answer(call, std::move(response));
}

std::shared_ptr<const Song> PageSession::song() const {
  const std::lock_guard lock(mutex_);
  return song_;
}

void PageSession::Answer(uint32_t call, Response response) {
  response.set_call(call);
  const std::lock_guard lock(sending_);
  send_(response);
}

void PageSession::Fail(uint32_t call, const std::string& message) {
  Response response;
  response.mutable_failure()->set_message(message);
  Answer(call, std::move(response));
}

}  // namespace choreo::studio
