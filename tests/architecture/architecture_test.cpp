#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/architecture/includes.h"

// The house's rules (docs/architecture.md), held by its includes.
namespace choreo {
namespace {

using ::testing::IsEmpty;

const Includes& House() {
  static const Includes includes(CHOREO_SOURCE_DIR, {"model", "server", "client", "bench"});
  return includes;
}

// "model/motion/skeleton.h" -> "model/motion", "server/status.h" -> "server".
std::string RoomOf(const std::string& path) {
  const bool deep = path.starts_with("model/");
  const size_t end = path.find('/', deep ? 6 : 0);
  return end == std::string::npos ? "" : path.substr(0, end);
}

// What each room may include besides itself. Arrows point down: a room names earlier ones only.
const std::vector<std::pair<std::string, std::set<std::string>>>& Rooms() {
  static const std::vector<std::pair<std::string, std::set<std::string>>> rooms = [] {
    const std::string core = "model/core", audio = "model/audio", motion = "model/motion",
                      body = "model/body", formats = "model/formats", draw = "model/draw",
                      flow = "model/flow", controllers = "model/controllers",
                      engine = "model/engine", dance = "model/dance";
    return std::vector<std::pair<std::string, std::set<std::string>>>{
        {core, {}},
        {audio, {core}},
        {motion, {core}},
        {body, {core, motion}},
        {formats, {core, motion, body}},
        {draw, {core, motion, body}},
        {flow, {core, motion}},
        {controllers, {core, motion, flow}},
        {engine, {core, motion, flow, controllers}},
        {dance, {core, audio, motion, engine}},
        {"model/training", {core, audio, motion, formats, draw, flow, controllers}},
        {"model/evaluation", {core, audio, motion, draw, engine, dance, "model/training"}},
        {"model/lab", {core, engine, "model/training", "model/evaluation"}},
        {"server", {core, audio, motion, engine, dance, "choreo", "google"}},
        {"client", {core, audio, motion, formats, draw, "choreo", "google", "grpc"}},
        {"bench",
         {core, audio, motion, formats, flow, engine, dance, "server", "client", "choreo"}},
    };
  }();
  return rooms;
}

TEST(Architecture, EveryRoomStandsAboveWhatItIncludes) {
  std::set<std::string> below;
  std::vector<std::string> wrong;
  for (const auto& [room, allowed] : Rooms()) {
    for (const std::string& other : allowed) {
      const bool generated = other == "choreo" || other == "google" || other == "grpc";
      EXPECT_TRUE(generated || below.contains(other)) << room << " above " << other;
    }
    below.insert(room);
    for (const std::string& file : House().files()) {
      if (RoomOf(file) != room) continue;
      for (const std::string& include : House().Of(file)) {
        if (include.starts_with('<')) continue;
        const std::string other = RoomOf(include);
        if (other != room && !allowed.contains(other)) wrong.push_back(file + " -> " + include);
      }
    }
  }
  EXPECT_THAT(wrong, IsEmpty());
}

TEST(Architecture, EveryFileHasARoom) {
  std::vector<std::string> homeless;
  for (const std::string& file : House().files()) {
    const bool known =
        std::ranges::any_of(Rooms(), [&](const auto& room) { return room.first == RoomOf(file); });
    if (!known) homeless.push_back(file);
  }
  EXPECT_THAT(homeless, IsEmpty());
}

TEST(Architecture, TheModelKnowsNoGrpcAndNoProtobuf) {
  for (const std::string& file : House().files()) {
    if (!file.starts_with("model/")) continue;
    for (const std::string& include : House().Of(file)) {
      EXPECT_FALSE(include.starts_with("<grpc") || include.starts_with("<google/") ||
                   include.ends_with(".pb.h"))
          << file << " -> " << include;
    }
  }
}

// LibTorch's headers take most of a build.
TEST(Architecture, FewTranslationUnitsIncludeTorch) {
  constexpr size_t kMost = 31;  // two networks, a file a part, their training and engines
  std::vector<std::string> units;
  for (const std::string& file : House().files()) {
    if (!file.ends_with(".cpp")) continue;
    const auto all = House().All(file);
    if (std::ranges::any_of(all, [](const std::string& include) {
          return include.starts_with("<torch/") || include.starts_with("<ATen/");
        })) {
      units.push_back(file);
    }
  }
  EXPECT_LE(units.size(), kMost) << ::testing::PrintToString(units);
  EXPECT_GE(units.size(), 5U) << "the includes were not read";
}

}  // namespace
}  // namespace choreo
