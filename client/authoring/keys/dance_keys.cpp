#include "client/authoring/keys/dance_keys.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string_view>

#include "client/authoring/keys/key_file.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"

namespace choreo::authoring {
namespace {

/// For keys in order of time: maps each held key's index to the indices of the keys that hold its
/// pose.
std::map<size_t, std::vector<size_t>> HoldsOf(const DanceKeys& keys) {
  std::map<std::string, size_t> index_of;  // by place
  for (size_t i = 0; i < keys.places.size(); ++i) {
    if (!IsHeld(keys.places[i])) index_of[keys.places[i]] = i;
  }
  std::map<size_t, std::vector<size_t>> holds;
  for (size_t i = 0; i < keys.places.size(); ++i) {
    if (!IsHeld(keys.places[i])) continue;
    const auto held = index_of.find(FieldOf(keys.places[i], ""));
    if (held != index_of.end()) holds[held->second].push_back(i);
  }
  return holds;
}

void EndHoldsBeforeKeys(double fps, DanceKeys* keys) {
  const auto frame_of = [&](size_t i) { return FrameOf(keys->poses[i], fps); };
  std::set<size_t> dropped;
  for (const auto& [held, holding] : HoldsOf(*keys)) {
    size_t next = held + 1;
    while (next < keys->poses.size() && IsHeld(keys->places[next])) ++next;
    const int64_t was = frame_of(holding.back());
    if (next == keys->poses.size() || frame_of(next) > was) continue;
    const int64_t most = frame_of(next) - std::llround(kWayFromHold * fps);
    int64_t now = frame_of(held);
    for (const size_t i : holding) {
      if (frame_of(i) > most)
        dropped.insert(i);
      else
        now = frame_of(i);
    }
    keys->warnings.push_back(
        {.frame = frame_of(next),
         .message = DescribeHoldEnd(keys->poses[held].id, now, was, keys->poses[next].id,
                                    frame_of(next), fps)});
  }
  for (auto i = dropped.rbegin(); i != dropped.rend(); ++i) {
    keys->poses.erase(keys->poses.begin() + static_cast<std::ptrdiff_t>(*i));
    keys->places.erase(keys->places.begin() + static_cast<std::ptrdiff_t>(*i));
  }
}

/// A key's moment, as it was written: "at 2 s", "at frame 60".
std::string WrittenMoment(const client::KeyPose& key) {
  return key.frame ? "at frame " + std::to_string(*key.frame) : "at " + Rounded(key.time_s) + " s";
}

/// A key as people wrote it. The last one of a hold is the hold's end.
std::string Spoken(const client::KeyPose& key, const std::string& place) {
  if (!IsHeld(place)) return "key \"" + key.id + '"';
  return "the end of the hold of key \"" + key.id.substr(0, key.id.rfind(kHeldStep)) + '"';
}

/// The last of the keys from `index` on that hold the same pose; `index` itself for other keys.
size_t EndOfHold(const DanceKeys& keys, size_t index) {
  if (!IsHeld(keys.places[index])) return index;
  while (index + 1 < keys.places.size() && keys.places[index + 1] == keys.places[index]) ++index;
  return index;
}

/// Throws for a key after the dance's end.
void RequireInDance(const DanceLength& length, const std::string& place,
                    const client::KeyPose& key) {
  const int64_t frame = FrameOf(key, length.fps);
  if (frame < length.frames || (!key.frame && frame == length.frames)) return;
  throw InvalidArgument(FieldOf(place, key.frame ? ".frame" : ".time"),
                        Spoken(key, place) + ' ' + DescribeAfterEnd(frame, length));
}

/// Throws for keys that are too near each other, which the server would refuse only once the dance
/// has begun.
void RequireApart(const DanceKeys& keys, double fps) {
  for (size_t i = 1; i < keys.poses.size(); ++i) {
    const client::KeyPose &before = keys.poses[i - 1], &key = keys.poses[i];
    if (FrameOf(key, fps) - FrameOf(before, fps) >= kMinKeyDistance) continue;
    throw InvalidArgument(FieldOf(keys.places[i], key.frame ? ".frame" : ".time"),
                          "key \"" + key.id + "\" " + WrittenMoment(key) + " is closer than " +
                              std::to_string(kMinKeyDistance) + " frames (" +
                              Rounded(kMinKeyDistance / fps) + " s) to key \"" + before.id + "\" " +
                              WrittenMoment(before));
  }
}

}  // namespace

bool IsNoKeys(const std::vector<std::string>& sources) {
  const bool none = std::ranges::find(sources, kNoKeys) != sources.end();
  if (none && sources.size() > 1)
    throw InvalidArgument("keyframes",
                          "none cannot be combined with " + sources[sources[0] == kNoKeys]);
  return none;
}

std::vector<std::string> KeySources(const std::vector<std::string>& sources) {
  return IsNoKeys(sources) ? std::vector<std::string>{} : sources;
}

std::string DescribeAfterEnd(int64_t frame, const DanceLength& length) {
  const auto at = [&](int64_t count) {
    return Rounded(static_cast<double>(count) / length.fps) + " s";
  };
  return "at " + at(frame) + " is after the dance's end: its last frame is at " +
         at(length.frames - 1);
}

int64_t FrameOf(const client::KeyPose& key, double fps) {
  return key.frame.value_or(std::llround(key.time_s * fps));
}

void FitIntoDance(const DanceLength& length, DanceKeys* keys) {
  for (size_t i = 0; i < keys->poses.size(); ++i) {
    const size_t end = EndOfHold(*keys, i);
    RequireInDance(length, keys->places[end], keys->poses[end]);
    client::KeyPose& key = keys->poses[i];
    const int64_t frame = FrameOf(key, length.fps);
    if (frame == length.frames) key.frame = length.frames - 1;
    if (FrameForKey(frame) != frame) key.frame = FrameForKey(frame);
  }
}

std::string DescribeHoldEnd(const std::string& held, int64_t now, int64_t was,
                            const std::string& key, int64_t key_frame, double fps) {
  const auto at = [&](int64_t frame) { return Rounded(static_cast<double>(frame) / fps) + " s"; };
  return "key \"" + held + "\" is held up to " + at(now) + ", not " + at(was) + ": the key \"" +
         key + "\" comes at " + at(key_frame);
}

std::string HeldKey(const DanceKeys& keys, size_t index) {
  if (!IsHeld(keys.places[index])) return "";
  const auto held = std::ranges::find(keys.places, FieldOf(keys.places[index], ""));
  return keys.poses[static_cast<size_t>(held - keys.places.begin())].id;
}

DanceKeys ByTime(DanceKeys keys, double fps) {
  std::vector<size_t> order(keys.poses.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(order, {}, [&](size_t i) { return FrameOf(keys.poses[i], fps); });
  DanceKeys sorted;
  for (const size_t i : order) {
    sorted.poses.push_back(std::move(keys.poses[i]));
    sorted.places.push_back(std::move(keys.places[i]));
  }
  EndHoldsBeforeKeys(fps, &sorted);
  return sorted;
}

DanceKeys ReadDanceKeys(const std::vector<std::string>& sources, const DanceLength& length,
                        const Skeleton& skeleton, const Counts& counts) {
  DanceKeys read;
  std::map<std::string, std::string> place_of;  // by id
  for (const std::string& source : sources) {
    std::vector<std::string> places;
    std::vector<client::KeyPose> keys = ReadKeys(source, skeleton, &places, counts);
    for (size_t i = 0; i < keys.size(); ++i) {
      const std::string& place = places[i];
      const auto [same, is_new] = place_of.emplace(keys[i].id, place);
      if (!is_new) {
        throw InvalidArgument(FieldOf(place, ".id"),
                              "\"" + keys[i].id + "\" stands for " + same->second + " already");
      }
      read.poses.push_back(std::move(keys[i]));
      read.places.push_back(place);
    }
  }
  FitIntoDance(length, &read);
  DanceKeys keys = ByTime(std::move(read), length.fps);
  RequireApart(keys, length.fps);
  return keys;
}

Error InTermsOf(const DanceKeys& keys, const Error& error) {
  constexpr std::string_view kPrefix = "keyframes[";
  const std::string& field = error.field();
  if (!field.starts_with(kPrefix)) return error;
  size_t index = 0;
  const char* end = field.data() + field.size();
  const auto [close, code] = std::from_chars(field.data() + kPrefix.size(), end, index);
  if (code != std::errc() || close == end || *close != ']' || index >= keys.poses.size())
    return error;
  const std::string message = std::string(error.what()).substr(field.size() + 2);
  return {error.code(), FieldOf(keys.places[index], std::string(close + 1, end)),
          "key \"" + keys.poses[index].id + "\": " + message};
}

}  // namespace choreo::authoring
