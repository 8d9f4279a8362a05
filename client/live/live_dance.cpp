#include "client/live/live_dance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>
#include <utility>
#include <variant>

#include "client/live/music_ear.h"
#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/core/text/printable.h"

namespace choreo::live {
namespace {

constexpr double kSpareSeconds = 0.05;         // for the network round trip
constexpr double kMinTransitionSeconds = 0.5;  // between poses
constexpr double kMinAheadSeconds = 0.1;       // between a pose and what is already danced
constexpr double kClockMissedSeconds = 5;      // after which a missing MIDI clock is reported
constexpr double kNoBeat_s = 0;                // of a beat that is only sent to keep others out
constexpr int kMaxNotes = 5;                   // per second
constexpr size_t kMaxNoteBytes = 300;          // bytes

void Add(const LiveFigures& figures, LiveFigures* all) {
  all->frames += figures.frames;
  all->late += figures.late;
  all->most_late_ms = std::max(all->most_late_ms, figures.most_late_ms);
  all->keys_taken += figures.keys_taken;
  all->keys_danced += figures.keys_danced;
  all->keys_refused += figures.keys_refused;
}

}  // namespace

LiveDance::LiveDance(const client::Client& client, const client::ModelDescription& model,
                     LiveOptions options, LiveObserver observer)
    : client_(client),
      model_(model),
      options_(std::move(options)),
      observer_(std::move(observer)) {}

LiveDance::~LiveDance() = default;

int64_t LiveDance::FrameAt(double seconds) const { return std::llround(seconds * model_.fps); }

void LiveDance::Run(Sound& sound, std::span<const std::unique_ptr<Cues>> cues, MidiClock* midi) {
  client::DanceConfig config = options_.config;
  config.audio = {client::AudioKind::kPcmFloat, sound.sample_rate(), sound.channels()};
  config.generate_until = 0;
  config.reject_invalid_keys = true;
  dance_ = client_.StartDance(config);
  for (const client::KeyPose& key : options_.keys)
    SendKey(key, key.frame.value_or(FrameAt(key.time_s)));
  began_ = PosePlayer::Clock::now();
  std::thread reader([this] { Read(); });
  try {
    Play(sound, cues, midi);
    RequireBegun();
  } catch (...) {
    dance_->Cancel();
    reader.join();
    throw;
  }
  reader.join();
  if (failure_) std::rethrow_exception(failure_);
  while (player_ && !player_->Shown() && observer_.go_on()) continue;
  Add(since_, &all_);
  all_.seconds = since_.seconds;
  observer_.figures(all_);
}

// Throws the failure that kept the dance from beginning, if it has not begun when the music is
// over.
void LiveDance::RequireBegun() {
  if (begun_ || over_ || !observer_.failure || !observer_.go_on()) return;
  if (const auto failure = observer_.failure()) throw *failure;
}

void LiveDance::Play(Sound& sound, std::span<const std::unique_ptr<Cues>> cues, MidiClock* midi) {
  int64_t samples = 0;
  double now = 0, shown = 0;
  bool clock_missed = midi == nullptr;
  MusicEar ear(sound.sample_rate(), sound.channels(), {.beats = options_.beats});
  // Keeps out the server's beats until the ear knows some.
  if (IsHinted()) dance_->SendBeats(std::array{kNoBeat_s, kBeatBehindMusic_s}, {}, 0);
  while (!over_ && now < options_.seconds && observer_.go_on()) {
    const std::span<const float> piece = sound.Next();
    if (piece.empty()) break;
    samples += static_cast<int64_t>(piece.size()) / sound.channels();
    now = static_cast<double>(samples) / sound.sample_rate();
    for (const auto& source : cues) {
      for (const Cue& cue : source->Take()) Follow(cue, now);
    }
    if (midi) SendBeats({.beats = midi->Take(now)}, now);
    // The ear receives all music, so that it knows the beats when the MIDI clock stops.
    MusicEar::Ahead heard = ear.Hear(piece);
    if (!midi || !midi->runs()) SendBeats(std::move(heard.beats), now);
    if (!clock_missed && (midi->runs() || now >= kClockMissedSeconds)) {
      clock_missed = true;
      if (!midi->runs())
        Note("no MIDI clock has started yet; until then beats come from the sound");
    }
    if (heard.passage) dance_->SendPassages(std::array{*heard.passage});
    granted_ = FrameAt(now + options_.look_ahead_s);
    dance_->GenerateUntil(granted_);
    dance_->SendSamples(piece);
    if (now >= shown + 1) ShowFigures(shown = std::floor(now));
  }
  since_.seconds = now;
  // The dance ends with the music; later poses are not danced.
  for (auto key = keys_.lower_bound(granted_); key != keys_.end(); ++key)
    dance_->RemoveKey(key->second);
  dance_->EndAudio();
  dance_->CompleteKeys();
}

// Sends only beats that are not too late (in the settled part) and not after the longest music.
void LiveDance::SendBeats(BeatsAhead ahead, double now) {
  ahead.Keep(now + options_.look_ahead_s, kMaxAudioSeconds);
  if (!ahead.beats.empty()) dance_->SendBeats(ahead.beats, ahead.downbeats, ahead.confidence);
}

void LiveDance::Follow(const Cue& cue, double now) {
  if (cue.pose.empty()) return TakeBack();
  if (std::ssize(sent_) >= options_.most_keys) {
    return Refuse("this dance already has all " + std::to_string(options_.most_keys) +
                  " poses that the server allows");
  }
  const auto pose = options_.poses.find(cue.pose);
  if (pose == options_.poses.end()) return Note("there is no pose \"" + cue.pose + "\"");
  const double wanted = cue.ahead_s.value_or(options_.ahead_s);
  if (!(wanted >= 0 && wanted <= kMaxAheadSeconds)) {
    return Note(cue.pose + ": " + std::to_string(wanted) + " s ahead is not in [0, " +
                std::to_string(std::lround(kMaxAheadSeconds)) + "]");
  }
  const double ahead = std::max(wanted, options_.look_ahead_s + kMinAheadSeconds);
  BeatClock clock;
  {
    const std::lock_guard lock(mutex_);
    clock = clock_;
  }
  double at = clock.AtOrAfter(now + ahead, now);
  while (const std::optional<int64_t> near = KeyNear(FrameAt(at)))
    at = clock.AtOrAfter(static_cast<double>(*near + 1) / model_.fps + kMinTransitionSeconds, now);
  if (at > now + ahead + kMaxAheadSeconds)
    return Refuse(Rounded(kMaxAheadSeconds) + " s of poses wait already");
  {
    const std::lock_guard lock(mutex_);
    ++since_.keys_taken;
  }
  client::KeyPose key;
  key.id = "cue " + std::to_string(sent_.size() + 1) + " " + cue.pose;
  key.frame = FrameAt(at);
  key.pose = pose->second;
  key.mask.root_position = false;  // the pose is reached wherever the dancer is then
  SendKey(key, *key.frame);
}

void LiveDance::SendKey(const client::KeyPose& key, int64_t frame) {
  dance_->SendKey(key);
  keys_[frame] = key.id;
  requested_.push_back(frame);
  sent_.push_back(key);
}

std::vector<client::KeyPose> LiveDance::DancedKeys() const {
  std::vector<client::KeyPose> danced;
  for (const client::KeyReached& reached : report_ ? report_->keys : reached_) {
    const auto is_it = [&](const client::KeyPose& key) { return key.id == reached.id; };
    const auto sent = std::ranges::find_if(sent_, is_it);
    if (sent == sent_.end()) {
      throw Error(
          ErrorCode::kInternal, "",
          "the server reports a key as reached that it was not sent: " + Printable(reached.id));
    }
    danced.push_back(*sent);
  }
  return danced;
}

void LiveDance::Refuse(const std::string& reason) {
  Note("no more poses are accepted: " + reason);
  const std::lock_guard lock(mutex_);
  ++since_.keys_refused;
}

// Returns the last key that would be too near to one at this frame.
std::optional<int64_t> LiveDance::KeyNear(int64_t frame) const {
  const int64_t least = FrameAt(kMinTransitionSeconds);
  const auto after = keys_.upper_bound(frame + least);
  if (after == keys_.begin() || std::prev(after)->first < frame - least) return std::nullopt;
  return std::prev(after)->first;
}

void LiveDance::TakeBack() {
  while (!requested_.empty()) {
    const auto last = keys_.find(requested_.back());
    requested_.pop_back();
    if (last == keys_.end() || last->first < granted_) continue;  // settled, so it stays
    dance_->RemoveKey(last->second);
    keys_.erase(last);
    return;
  }
  Note("no pose can be removed");
}

void LiveDance::ShowFigures(double seconds) {
  const std::lock_guard lock(mutex_);
  since_.seconds = seconds;
  since_.confidence = 0;
  since_.tempo = clock_.Period(seconds);
  if (since_.tempo) {
    since_.tempo = 60 / *since_.tempo;
    since_.confidence = clock_.confidence();
  }
  observer_.figures(since_);
  Add(std::exchange(since_, {}), &all_);
  if (notes_ > kMaxNotes) {
    observer_.note("and " + std::to_string(notes_ - kMaxNotes) + " more, not shown");
  }
  notes_ = 0;
}

void LiveDance::Read() {
  try {
    while (const std::optional<client::Message> message = dance_->Next()) Handle(*message);
  } catch (...) {
    failure_ = std::current_exception();
  }
  over_ = true;
}

void LiveDance::Handle(const client::Message& message) {
  if (const auto* header = std::get_if<client::Header>(&message)) {
    header_ = *header;
    begun_ = true;
    motion_.fps = header->fps;
    const std::chrono::duration<double> behind(header->latency_frames / header->model_fps +
                                               kPieceSeconds + kSpareSeconds);
    player_ = std::make_unique<PosePlayer>(
        header->fps, began_ + std::chrono::duration_cast<PosePlayer::Clock::duration>(behind),
        observer_.show);
  } else if (const auto* block = std::get_if<client::FrameBlock>(&message)) {
    HandleFrames(*block);
  } else if (const auto* warning = std::get_if<client::Warning>(&message)) {
    Note(Rounded(static_cast<double>(warning->frame) / header_.model_fps) +
         " s: " + warning->message);
    warnings_.push_back(*warning);
  } else if (const auto* rejected = std::get_if<client::KeyRejected>(&message)) {
    Note("key " + rejected->id + " was refused: " + rejected->reason);
    const std::lock_guard lock(mutex_);
    ++since_.keys_refused;
  } else if (const auto* resumed = std::get_if<client::Resumed>(&message)) {
    Note("lost the server (" + resumed->reason + "); " + resumed->address + " goes on");
  } else if (const auto* report = std::get_if<client::Report>(&message)) {
    report_ = *report;
  } else {
    const std::lock_guard lock(mutex_);
    const auto* beat = std::get_if<client::Beat>(&message);
    if (beat != nullptr && !(IsHinted() && beat->time_s == kNoBeat_s)) {
      clock_.Hear(*beat);
      beats_.push_back(*beat);
    }
    if (const auto* reached = std::get_if<client::KeyReached>(&message)) {
      reached_.push_back(*reached);
      ++since_.keys_danced;
    }
  }
}

void LiveDance::HandleFrames(const client::FrameBlock& block) {
  const auto now = PosePlayer::Clock::now();
  motion_.frames.insert(motion_.frames.end(), block.poses.begin(), block.poses.end());
  contacts_.insert(contacts_.end(), block.contacts.begin(), block.contacts.end());
  if (observer_.show) player_->Push(block.first_frame, block.poses);
  const std::lock_guard lock(mutex_);
  for (size_t i = 0; i < block.poses.size(); ++i) {
    const std::chrono::duration<double, std::milli> late =
        now - player_->Due(block.first_frame + static_cast<int64_t>(i));
    ++since_.frames;
    since_.late += late.count() > 0;
    since_.most_late_ms = std::max(since_.most_late_ms, late.count());
  }
}

void LiveDance::Note(const std::string& text) {
  const std::lock_guard lock(mutex_);
  // Limits notes, because anybody who reaches the OSC port can send names.
  if (++notes_ <= kMaxNotes) observer_.note(Printable(text.substr(0, kMaxNoteBytes)));
}

}  // namespace choreo::live
