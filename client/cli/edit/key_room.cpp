#include "client/cli/edit/key_room.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <set>

#include "client/authoring/keys/dance_keys.h"
#include "client/authoring/keys/key_file.h"
#include "client/cli/report/report.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"

namespace choreo::cli {
namespace {

/// Least seconds for a visible return from a held pose into the dance.
constexpr double kLeastAfterHold = 1;

void NoteWay(const EditedReport& report, int64_t frame, const std::string& what) {
  std::cerr << "note: key \"" << report.IdAt(frame) << "\" at " << report.times().format.Of(frame)
            << " makes way for " << what << '\n';
}

/// Removes keys too near in time to a new key, held from `first` to `last`, with the keys that
/// hold them, and prints a note.
void MakeWay(int64_t first, int64_t last, const std::string& id, EditedReport* report) {
  const ReportKeys& keys = report->keys();
  const int64_t near = report->times().Frame(authoring::kTooNear);
  std::vector<int64_t> gone;
  for (auto key = keys.lower_bound(std::max<int64_t>(0, first - near + 1));
       key != keys.end() && key->first < last + near; ++key) {
    const bool stays = key->first != first && (key->first == 0 || report->IsSet(key->first));
    if (!stays) gone.push_back(key->first);
  }
  for (const int64_t frame : gone) {
    if (!keys.contains(frame)) continue;  // it held a key that was removed
    NoteWay(*report, frame,
            '"' + id + "\": " +
                (frame == first ? "it stands there"
                                : "it is less than " + Rounded(authoring::kTooNear) + " s away"));
    report->Forget(frame, report->AfterHold(frame + 1));
  }
}

/// Ends a new key's hold before the next key, and prints a note. Extends or shortens it to the
/// end of the dance if it would end shortly before or after that.
std::vector<client::Warning> FitHold(const EditedReport& report, client::KeyEdit* edit) {
  if (edit->held.empty()) return {};
  const DanceTimes& times = report.times();
  const int64_t first = *edit->key.frame;
  const int64_t was = LastFrame(*edit);
  const auto next = report.keys().upper_bound(first);
  if (next == report.keys().end()) {
    const int64_t end = times.frames - 1;
    if (times.frames - was >= times.Frame(kLeastAfterHold)) return {};
    HoldUntil(end, edit);
    if (std::abs(end - was) > 1) {
      std::cerr << "note: key \"" << edit->key.id << "\" is held to the end, "
                << Rounded(times.Seconds(end)) << " s, not " << Rounded(times.Seconds(was))
                << " s\n";
    }
    return {};
  }
  if (next->first > was) return {};
  HoldUntil(next->first - times.Frame(authoring::kWayFromHold), edit);
  const client::Warning warning{
      .frame = next->first,
      .message = authoring::DescribeHoldEnd(edit->key.id, LastFrame(*edit), was, next->second.id,
                                            next->first, times.fps)};
  ShowWarnings({warning}, times.format);
  return {warning};
}

}  // namespace

void HoldUntil(int64_t last, client::KeyEdit* edit) {
  const int64_t before = LastFrame(*edit) - *edit->key.frame;
  const int64_t frames = last - *edit->key.frame;
  const auto count = static_cast<int64_t>(edit->held.size());
  const int64_t needed = frames < kMinKeyDistance ? 0 : (frames * count + before / 2) / before;
  edit->held.resize(static_cast<size_t>(needed), edit->held.front());
  for (int64_t i = 0; i < needed; ++i)
    edit->held[static_cast<size_t>(i)].frame = *edit->key.frame + frames * (i + 1) / needed;
}

void CheckDistance(const DanceTimes& times, const char* field, double at_s, int64_t other,
                   const std::string& what) {
  const int64_t distance = std::abs(times.Frame(at_s) - other);
  if (distance >= kMinKeyDistance) return;
  throw InvalidArgument(field, Rounded(at_s) + " s lies " + std::to_string(distance) +
                                   " frame from " + what + " at " + Rounded(times.Seconds(other)) +
                                   " s, must be at least " + std::to_string(kMinKeyDistance) +
                                   " frames from it");
}

std::vector<client::Warning> EndHold(int64_t frame, const std::string& id, EditedReport* report) {
  const ReportKeys& keys = report->keys();
  const DanceTimes& times = report->times();
  const auto next = keys.lower_bound(frame);
  if (next == keys.begin() || next == keys.end() || next->second.holds.empty()) return {};
  auto held = std::prev(next);
  while (held != keys.begin() && !held->second.holds.empty()) --held;
  const int64_t end = report->AfterHold(frame);
  const auto dropped =
      keys.upper_bound(std::max(held->first, frame - times.Frame(authoring::kWayFromHold)));
  const client::Warning warning{
      .frame = frame,
      .message = authoring::DescribeHoldEnd(held->second.id, std::prev(dropped)->first, end - 1, id,
                                            frame, times.fps)};
  report->Forget(dropped->first, end);
  ShowWarnings({warning}, times.format);
  return {warning};
}

void ClearWay(int64_t first, int64_t end, const std::vector<client::KeyEdit>& moved,
              const std::string& what, EditedReport* report) {
  std::set<int64_t> leave;
  for (const client::KeyEdit& edit : moved) leave.insert(*edit.key.frame);
  first = report->AfterHold(first);
  end = report->AfterHold(end);
  const auto stop = report->keys().lower_bound(end);
  for (auto key = report->keys().lower_bound(first); key != stop; ++key) {
    // Prints one line for a held pose and all keys that hold it.
    if (!leave.contains(key->first) && key->second.holds.empty())
      NoteWay(*report, key->first, what);
  }
  report->Forget(first, end);
}

std::vector<client::Warning> MakeRoom(const char* field, client::KeyEdit* edit,
                                      EditedReport* report) {
  const int64_t first = *edit->key.frame;
  const std::string& id = edit->key.id;
  if (report->IsSet(first) && report->keys().contains(first)) {
    throw InvalidArgument(field, Rounded(report->times().Seconds(first)) + " s for \"" + id +
                                     "\" is where this edit sets \"" + report->IdAt(first) +
                                     "\" already");
  }
  std::vector<client::Warning> warnings = EndHold(first, id, report);
  MakeWay(first, first, id, report);
  const std::vector<client::Warning> fitted = FitHold(*report, edit);
  warnings.insert(warnings.end(), fitted.begin(), fitted.end());
  MakeWay(first, LastFrame(*edit), id, report);
  return warnings;
}

}  // namespace choreo::cli
