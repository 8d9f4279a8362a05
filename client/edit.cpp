#include "client/edit.h"

#include <algorithm>
#include <cmath>

#include "model/core/limits.h"
#include "model/core/rounded.h"
#include "model/motion/resample.h"
#include "model/motion/rotation.h"

namespace choreo::client {
namespace {

// If the song's energies are unknown: seconds of music before the first frame to which its energy
// is relative, as far as kMaxMusicBytes allows. Fewer than in a stream, because each edit sends
// them.
constexpr double kMusicBefore_s = 35;
constexpr double kMaxMusicBytes = 12 << 20;

/// New frames, at the model's rate, starting at `first`.
struct Part {
  int64_t first = 0;
  std::vector<Pose> poses;
  std::vector<Contacts> contacts;
};

int64_t Whole(double number) { return static_cast<int64_t>(number); }

/// A dance being edited, at the model's rate.
class Edit {
 public:
  Edit(const Client& client, const FinishedDance& dance, const EditOptions& options)
      : client_(client), options_(options) {
    result_.dance = dance;
    if (dance.motion.frames.empty()) throw InvalidArgument("dance", "has no frames");
    if (!dance.contacts.empty() && dance.contacts.size() != dance.motion.frames.size()) {
      throw InvalidArgument("dance", std::to_string(dance.contacts.size()) + " contacts, but " +
                                         std::to_string(dance.motion.frames.size()) + " frames");
    }
    const Motion& motion = dance.motion;
    poses_ = motion.fps == fps() ? motion.frames : Resample(motion, fps()).frames;
    // A file's rotation vectors may contain whole turns: sends the shortest vectors.
    const Pose unturned{{}, Eigen::Matrix3Xd::Zero(3, poses_.front().rotations.cols())};
    for (Pose& pose : poses_) MakeContinuous(pose, unturned);
  }

  double fps() const { return options_.model.fps; }
  int64_t frames() const { return static_cast<int64_t>(poses_.size()); }
  /// TransitionRequest::after of a transition to the frame before this one: servers use the first
  /// pose alone.
  std::vector<Pose> Leading(int64_t frame) const { return Poses(frame, frame + 1); }
  const Pose& pose(int64_t frame) const { return poses_[static_cast<size_t>(frame)]; }
  int64_t FrameOf(const KeyPose& key) const {
    return key.frame.value_or(std::llround(key.time_s * fps()));
  }
  /// The largest number of frames of one transition.
  int64_t longest() const { return options_.model.max_transition_frames; }

  /// Requests the transition after frame `from` (-1: from rest at the origin).
  TransitionRequest After(int64_t from, int64_t frames) const {
    TransitionRequest request = Request(from + 1, frames);
    request.config.history = Poses(from + 1 - options_.model.history_frames, from + 1);
    request.config.first_frame = from + 1;
    return request;
  }
  /// Requests a transition that continues another one.
  TransitionRequest After(const TransitionCandidate& before, int64_t frames) const {
    TransitionRequest request = Request(before.continuation.frame, frames);
    request.config.continuation = before.continuation;
    return request;
  }

  /// Returns a transition's candidates. `leads_on`: the target is a frame of the dance, whose pose
  /// needs no warning.
  std::vector<TransitionCandidate> Generate(const TransitionRequest& request, bool leads_on) {
    TransitionResult result = client_.GenerateTransition(request);
    if (leads_on)
      std::erase_if(result.warnings, [](const Warning& warning) {
        return warning.code == Warning::Code::kKeyImpossible;
      });
    std::move(result.warnings.begin(), result.warnings.end(), std::back_inserter(result_.warnings));
    return std::move(result.candidates);
  }

  /// Inserts new frames into the dance. `next` is the pose after the last of them, if any. Frames
  /// before and after stay unchanged: at the dance's own rate, the new frames are strictly between
  /// them.
  void Splice(const Part& part, const std::optional<Pose>& next) {
    Motion& motion = result_.dance.motion;
    const double rate = motion.fps / fps();
    WarnOfKnees(part);
    Motion curve{.fps = fps(), .frames = part.poses};
    int64_t start = part.first;  // of the curve
    int64_t first = 0;
    if (part.first > 0) {
      curve.frames.insert(curve.frames.begin(), pose(--start));
      first = Whole(std::floor(static_cast<double>(start) * rate + kOnFrame)) + 1;
    }
    auto end = static_cast<int64_t>(motion.frames.size());
    if (next) {
      const int64_t first_kept = part.first + static_cast<int64_t>(part.poses.size());
      curve.frames.push_back(*next);
      end = Whole(std::ceil(static_cast<double>(first_kept) * rate - kOnFrame));
    }
    if (end > static_cast<int64_t>(motion.frames.size())) {
      motion.frames.resize(static_cast<size_t>(end));
    }
    for (int64_t frame = first; frame < end; ++frame) {
      motion.frames[static_cast<size_t>(frame)] = PoseAt(
          curve, static_cast<double>(frame) / motion.fps - static_cast<double>(start) / fps());
      // The rotation vectors of the frames before may contain whole turns.
      if (frame > 0)
        MakeContinuous(motion.frames[static_cast<size_t>(frame)],
                       motion.frames[static_cast<size_t>(frame) - 1]);
    }
    SpliceContacts(part, first, end);
  }

  EditedDance TakeResult() { return std::move(result_); }
  EditedDance& result() { return result_; }

 private:
  /// [first, end), limited to existing frames.
  std::vector<Pose> Poses(int64_t first, int64_t end) const {
    first = std::clamp<int64_t>(first, 0, frames());
    end = std::clamp<int64_t>(end, first, frames());
    return {poses_.begin() + first, poses_.begin() + end};
  }

  TransitionRequest Request(int64_t first, int64_t frames) const {
    TransitionRequest request;
    request.config.model = options_.model.name;
    request.config.seed = options_.seed;
    request.config.manner = options_.manner;
    request.config.known = options_.known;
    request.config.controls = options_.controls;
    request.frames = static_cast<int>(std::min<int64_t>(frames, 1 << 30));
    SetMusic(options_.audio, options_.model, first, &request);
    return request;
  }

  /// Warns of the frame in which a knee bends furthest backwards, if it looks broken.
  void WarnOfKnees(const Part& part) {
    const Skeleton& skeleton = options_.model.skeleton;
    Warning worst;
    double furthest = kBrokenBackwards / kDegrees;
    for (const Hinge& hinge : Hinges(skeleton)) {
      if (hinge.joint != skeleton.left_knee && hinge.joint != skeleton.right_knee) continue;
      for (size_t i = 0; i < part.poses.size(); ++i) {
        const double bend = -hinge.axis.dot(part.poses[i].rotations.col(hinge.joint));
        if (bend <= furthest) continue;
        furthest = bend;
        worst.frame = part.first + static_cast<int64_t>(i);
        worst.message = skeleton.joint_names[static_cast<size_t>(hinge.joint)] + " bends " +
                        Rounded(kDegrees * bend) + " degrees backwards at frame " +
                        std::to_string(worst.frame) + "; " + Rounded(kBrokenBackwards) +
                        " look broken";
      }
    }
    if (!worst.message.empty()) result_.warnings.push_back(worst);
  }

  /// Gives each new frame of the dance the contacts of the nearest frame of `part`.
  void SpliceContacts(const Part& part, int64_t first, int64_t end) {
    result_.first_changed = first;
    result_.end_changed = end;
    std::vector<Contacts>& contacts = result_.dance.contacts;
    if (contacts.empty()) return;
    contacts.resize(result_.dance.motion.frames.size());
    for (int64_t frame = first; frame < end; ++frame) {
      const double at = static_cast<double>(frame) / result_.dance.motion.fps * fps();
      const int64_t nearest = std::clamp<int64_t>(std::llround(at) - part.first, 0,
                                                  static_cast<int64_t>(part.contacts.size()) - 1);
      contacts[static_cast<size_t>(frame)] = part.contacts[static_cast<size_t>(nearest)];
    }
  }

  const Client& client_;
  const EditOptions& options_;
  std::vector<Pose> poses_;
  EditedDance result_;
};

std::string NameOfFrame(int64_t frame) { return "frame " + std::to_string(frame); }

std::string AtLeast(const std::string& where) {
  return "at least " + std::to_string(kMinKeyDistance) + where;
}

void CheckKeyEdit(int64_t first, int64_t last, int64_t from, int64_t to, int64_t frames) {
  for (const int64_t frame : {first, last}) {
    if (frame >= 0 && frame < frames) continue;
    throw InvalidArgument("key.frame", std::to_string(frame) + " is not in the dance, [0, " +
                                           std::to_string(frames - 1) + "]");
  }
  if (first == 0 ? from != -1 : from < 0 || first - from < kMinKeyDistance) {
    throw InvalidArgument("from", std::to_string(from) + " with a key at " + NameOfFrame(first) +
                                      ": must be " +
                                      (first == 0 ? "-1" : AtLeast(" before it and in the dance")));
  }
  if (last == frames - 1 ? to != frames : to >= frames || to - last < kMinKeyDistance) {
    throw InvalidArgument(
        "to", std::to_string(to) + " with a key at " + NameOfFrame(last) + ": must be " +
                  (last == frames - 1 ? std::to_string(frames)
                                      : AtLeast(" after it and in the dance, which has ") +
                                            std::to_string(frames) + " frames"));
  }
}

/// The end of one of an edit's transitions: a pose, or none.
struct Stop {
  int64_t frame = 0;
  std::optional<KeyPose> key = {};
  bool held = false;  // the same pose as before
};

/// Adds stops without a pose where one transition cannot span the way to the next stop.
std::vector<Stop> Spanned(int64_t from, const std::vector<Stop>& stops, int64_t longest) {
  std::vector<Stop> spanned;
  for (const Stop& stop : stops) {
    const int64_t parts = (stop.frame - from + longest - 1) / longest;
    for (int64_t part = 1; part < parts; ++part)
      spanned.push_back({.frame = from + (stop.frame - from) * part / parts});
    spanned.push_back(stop);
    from = stop.frame;
  }
  return spanned;
}

/// The way from one frame to another. The end frame stays unchanged if it belongs to the dance.
struct Way {
  int64_t from = 0;
  std::vector<Stop> stops = {};  // the last one is at `to` if the dance continues there
  int64_t to = 0;
  bool leads_on = false;
};

Way WayThrough(const Edit& work, int64_t from, std::vector<Stop> stops, int64_t to,
               const std::string& to_id, const std::optional<double>& to_hit) {
  const bool leads_on = to < work.frames();
  if (leads_on)
    stops.push_back(
        {to, KeyPose{.id = to_id.empty() ? "the dance at " +
                                               Rounded(static_cast<double>(to) / work.fps()) + " s"
                                         : to_id,
                     .pose = work.pose(to),
                     .hit = to_hit}});
  return {from, Spanned(from, stops, work.longest()), to, leads_on};
}

/// Requests the transition to a stop. `before`: the transition to the previous stop.
TransitionRequest RequestFor(const Edit& work, const Way& way, size_t index,
                             const TransitionCandidate& before) {
  const Stop& stop = way.stops[index];
  const bool is_last = index + 1 == way.stops.size();
  const int64_t begin = index == 0 ? way.from : way.stops[index - 1].frame;
  TransitionRequest request = index == 0 ? work.After(way.from, stop.frame - way.from)
                                         : work.After(before, stop.frame - begin);
  request.target = stop.key;
  // Omits a path that covers none of this transition: the server would warn that it has no effect.
  auto& path = request.config.controls.root_path;
  if (path && !path->frames.empty() &&
      ((!is_last && path->frames.front() > stop.frame) ||
       (index > 0 && path->frames.back() <= begin))) {
    path.reset();
  }
  // Omits controls while a pose is held: the server would warn that they have no effect.
  if (stop.held) request.config.controls = {};
  if (is_last && way.leads_on) request.after = work.Leading(way.to + 1);
  return request;
}

/// Adds a transition's frames, and reports its keys.
void Append(const TransitionCandidate& danced, bool leads_on, Part* part, Edit* work) {
  part->poses.insert(part->poses.end(), danced.motion.frames.begin(), danced.motion.frames.end());
  part->contacts.insert(part->contacts.end(), danced.contacts.begin(), danced.contacts.end());
  if (leads_on) {  // the last frame is unchanged
    part->poses.pop_back();
    part->contacts.pop_back();
    return;
  }
  work->result().keys.insert(work->result().keys.end(), danced.report.keys.begin(),
                             danced.report.keys.end());
}

void SpliceWay(const Way& way, const Part& part, Edit* work) {
  work->Splice(part, way.leads_on ? std::optional(work->pose(way.to)) : std::nullopt);
}

EditedDance DanceThrough(Edit& work, const Way& way) {
  Part part{way.from + 1, {}, {}};
  TransitionCandidate danced;
  for (size_t i = 0; i < way.stops.size(); ++i) {
    const bool leads_on = way.leads_on && i + 1 == way.stops.size();
    danced = std::move(work.Generate(RequestFor(work, way, i, danced), leads_on).front());
    Append(danced, leads_on, &part, &work);
  }
  SpliceWay(way, part, &work);
  return work.TakeResult();
}

/// Returns candidates of the one transition that spans the way.
std::vector<EditedDance> DanceCandidates(Edit& work, const Way& way, int takes) {
  TransitionRequest request = RequestFor(work, way, 0, {});
  request.candidates = takes;
  std::vector<EditedDance> danced;
  for (const TransitionCandidate& candidate : work.Generate(request, way.leads_on)) {
    Edit take = work;
    Part part{way.from + 1, {}, {}};
    Append(candidate, way.leads_on, &part, &take);
    SpliceWay(way, part, &take);
    danced.push_back(take.TakeResult());
  }
  return danced;
}

/// Checks a gap, and returns the way across it.
Way WayAcross(const Edit& work, const Gap& gap) {
  const int64_t frames = work.frames();
  if (gap.from < -1 || gap.from > frames - 2) {
    throw InvalidArgument(
        "from", std::to_string(gap.from) + " is not in [-1, " + std::to_string(frames - 2) + "]");
  }
  if (gap.to < gap.from + 2 || gap.to > frames) {
    throw InvalidArgument("to", std::to_string(gap.to) + " is not in [" +
                                    std::to_string(gap.from + 2) + ", " + std::to_string(frames) +
                                    "]");
  }
  std::vector<Stop> stops;
  int64_t before = gap.from;
  for (const KeyPose& key : gap.keys) {
    const int64_t frame = work.FrameOf(key);
    if (frame <= before || frame >= gap.to) {
      throw InvalidArgument("keys", key.id + " at " + NameOfFrame(frame) + " is not between " +
                                        NameOfFrame(before) + " and " + NameOfFrame(gap.to));
    }
    stops.push_back({frame, key});
    before = frame;
  }
  // The end is free if no frame follows.
  if (gap.to == frames && before < frames - 1) stops.push_back({.frame = frames - 1});
  return WayThrough(work, gap.from, std::move(stops), gap.to, gap.to_id, gap.to_hit);
}

}  // namespace

void SetMusic(const Audio& song, const ModelDescription& model, int64_t first,
              TransitionRequest* request) {
  if (song.format.kind == AudioKind::kNone || !model.takes_music) return;
  if (song.format.kind == AudioKind::kFile) {
    throw InvalidArgument("audio", "is a file; only samples can be cut");
  }
  const auto channels = static_cast<int64_t>(song.format.channels);
  const int64_t total = static_cast<int64_t>(song.samples.size()) / channels;
  if (total == 0) throw InvalidArgument("audio", "has no samples");
  const auto sample = [&](double seconds) {
    return Whole(std::floor(seconds * song.format.sample_rate));
  };
  const double start = static_cast<double>(first) / model.fps;
  const double end = start + static_cast<double>(request->frames) / model.fps + kMusicBeyond_s;
  const double most_s =
      kMaxMusicBytes / static_cast<double>(channels * song.format.sample_rate * sizeof(float));
  const double before_s =
      std::clamp(most_s - (end - start), model.audio_lead_s, model.audio_lead_s + kMusicBefore_s);
  // Silence follows the song's end; clamping to the last sample has the same effect.
  const int64_t from = std::clamp<int64_t>(sample(start - before_s) - 1, 0, total - 1);
  const int64_t to = std::clamp<int64_t>(sample(end), from + 1, total);
  request->audio.format = song.format;
  request->audio_first_sample = from;
  request->audio.samples.assign(song.samples.begin() + from * channels,
                                song.samples.begin() + to * channels);
}

int64_t CountModelFrames(const FinishedDance& dance, const ModelDescription& model) {
  if (dance.motion.frames.empty()) throw InvalidArgument("dance", "has no frames");
  return Whole(std::floor(Duration(dance.motion) * model.fps + kOnFrame)) + 1;
}

EditedDance SetKey(const Client& client, const FinishedDance& dance, const EditOptions& options,
                   const KeyEdit& edit) {
  Edit work(client, dance, options);
  std::vector<Stop> stops;
  stops.push_back({work.FrameOf(edit.key), edit.key});
  for (const KeyPose& key : edit.held) {
    stops.push_back({work.FrameOf(key), key, true});
    stops.back().key->hit.reset();
    if (stops.back().frame - std::prev(stops.end(), 2)->frame < kMinKeyDistance) {
      throw InvalidArgument("key.frame", std::to_string(stops.back().frame) + " of a key that is " +
                                             "held is not " +
                                             AtLeast(" frames after the one before"));
    }
  }
  CheckKeyEdit(stops.front().frame, stops.back().frame, edit.from, edit.to, work.frames());
  return DanceThrough(
      work, WayThrough(work, edit.from, std::move(stops), edit.to, edit.to_id, edit.to_hit));
}

EditedDance DanceAnew(const Client& client, const FinishedDance& dance, const EditOptions& options,
                      const Gap& gap) {
  Edit work(client, dance, options);
  return DanceThrough(work, WayAcross(work, gap));
}

std::vector<EditedDance> DanceTakes(const Client& client, const FinishedDance& dance,
                                    const EditOptions& options, const Gap& gap, int takes) {
  Edit work(client, dance, options);
  const Way way = WayAcross(work, gap);
  if (way.stops.size() == 1) return DanceCandidates(work, way, takes);
  std::vector<EditedDance> danced;
  EditOptions next = options;
  for (; std::ssize(danced) < takes; ++next.seed)
    danced.push_back(DanceAnew(client, dance, next, gap));
  return danced;
}

EditedDance CloseLoop(const Client& client, const FinishedDance& dance, const EditOptions& options,
                      int64_t from, int64_t added) {
  Edit work(client, dance, options);
  const int64_t last = work.frames() + added - 2;
  if (added < 0 || from < 0 || from > std::min(last, work.frames() - 1)) {
    throw InvalidArgument("from", std::to_string(from) + " is not in [0, " +
                                      std::to_string(std::min(last, work.frames() - 1)) +
                                      "]: at least one frame must lead back");
  }
  // Leads back from the last frame to the first one.
  TransitionRequest request = work.After(from, work.frames() + added - from);
  request.target = {.id = "the beginning", .pose = work.pose(0)};
  request.after = work.Leading(1);
  const TransitionCandidate back = work.Generate(request, true).front();
  work.Splice({from + 1,
               {back.motion.frames.begin(), back.motion.frames.end() - 1},
               {back.contacts.begin(), back.contacts.end() - 1}},
              work.pose(0));
  return work.TakeResult();
}

}  // namespace choreo::client
