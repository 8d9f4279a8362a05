#include "client/cli/edit/edited_report.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <sstream>

#include "client/authoring/keys/key_file.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"

namespace choreo::cli {

int64_t DanceTimes::FrameInDance(const char* field, double at_s) const {
  // A time at the very end means the last frame, as for keys of a new dance (FitIntoDance).
  const int64_t frame = Frame(at_s) == frames ? frames - 1 : Frame(at_s);
  if (frame < frames) return frame;
  throw InvalidArgument(field, Rounded(at_s) +
                                   " s is after the dance, which has its last frame at " +
                                   Rounded(Seconds(frames - 1)) + " s");
}

int64_t EditedReport::AfterHold(int64_t frame) const {
  auto key = keys().lower_bound(frame);
  for (; key != keys().end() && !key->second.holds.empty(); ++key) frame = key->first + 1;
  return frame;
}

void EditedReport::Forget(int64_t first, int64_t end) {
  const auto begin = keys().lower_bound(first), stop = keys().lower_bound(end);
  for (auto key = begin; key != stop; ++key) stale_.insert(key->first);
  file_.keys.erase(begin, stop);
}

void EditedReport::Refresh(int64_t from, int64_t to) {
  stale_.erase(stale_.upper_bound(from), stale_.lower_bound(to));
  std::erase_if(file_.warnings, [&](const client::Warning& warning) {
    const bool anew = warning.frame > from && warning.frame <= to;
    return anew || (from < 0 && warning.frame >= times_.frames);
  });
}

void EditedReport::Keep(const std::vector<client::Warning>& warnings) {
  file_.warnings.insert(file_.warnings.end(), warnings.begin(), warnings.end());
}

void EditedReport::Record(const client::KeyEdit& edit) {
  ReportKey& key = file_.keys[*edit.key.frame];
  key.hit = edit.key.hit;
  key.hands = edit.key.hands;
  set_.insert(*edit.key.frame);
  for (const client::KeyPose& held : edit.held) {
    file_.keys[*held.frame].holds = edit.key.id;
    file_.keys[*held.frame].hands = held.hands;
    set_.insert(*held.frame);
  }
}

void EditedReport::Restore(const ReportKeys& before) {
  for (const auto& [frame, key] : before) {
    ReportKey& anew = file_.keys.at(frame);
    anew.holds = key.holds;
    anew.hit = key.hit;
    anew.hands = key.hands;
  }
}

EditReach::EditReach(const EditOptions& options, const client::ModelDescription& model)
    : longest_(model.max_transition_frames - 1), takes_stale_(!options.around_s) {
  const double around_s = options.around_s.value_or(authoring::kEditAround);
  const double frames = std::round(around_s * model.fps);
  if (options.around_s && !(frames >= kMinKeyDistance && frames <= static_cast<double>(longest_))) {
    std::ostringstream message;
    message << around_s << " s, must be " << Rounded(kMinKeyDistance / model.fps) << " to "
            << Rounded(static_cast<double>(longest_) / model.fps) << " s: " << kMinKeyDistance
            << " to " << longest_ << " frames";
    throw InvalidArgument("--around", message.str());
  }
  around_ = std::min<int64_t>(longest_, std::llround(around_s * model.fps));
  const bool is_told = options.around_s || options.report.empty();
  near_ = is_told ? around_ : std::llround(authoring::kNextKeyNear * model.fps);
}

int64_t EditReach::Before(const EditedReport& report, int64_t frame) const {
  const ReportKeys& keys = report.keys();
  const auto next = keys.lower_bound(frame);
  const int64_t key = next == keys.begin() ? 0 : std::prev(next)->first;
  if (next != keys.begin() && Reaches(frame - key)) return key;
  int64_t from = frame - around_;
  if (takes_stale_) {
    const auto stale = report.stale().lower_bound(key);
    if (stale != report.stale().end() && *stale < frame) from = std::min(from, *stale - around_);
  }
  return std::max({int64_t{0}, key, from, frame - longest_});
}

int64_t EditReach::After(const EditedReport& report, int64_t frame) const {
  const ReportKeys& keys = report.keys();
  const int64_t end = report.times().frames - 1;
  const auto next = keys.upper_bound(frame);
  const int64_t key = next == keys.end() ? end : next->first;
  if (next != keys.end() && Reaches(key - frame)) return key;
  int64_t to = frame + around_;
  if (takes_stale_) {
    const auto stale = report.stale().upper_bound(key);
    if (stale != report.stale().begin() && *std::prev(stale) > frame)
      to = std::max(to, *std::prev(stale) + around_);
  }
  return std::min({end, key, to, frame + longest_});
}

EditReach::Loop EditReach::LoopOf(const ReportKeys& keys, int64_t frames) const {
  const int64_t end = frames - 1;
  const int64_t from = std::max<int64_t>(0, end - around_);
  const std::optional<int64_t> held = HeldEnd(keys);
  if (!held || *held <= from) return {from, 0};
  return {*held, *held + around_ - end};
}

}  // namespace choreo::cli
