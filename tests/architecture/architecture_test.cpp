#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/architecture/includes.h"

// The rules of docs/architecture.md, which includes follow.
namespace choreo::architecture_test {

using ::testing::IsEmpty;

const Includes& Sources() {
  static const Includes includes(CHOREO_SOURCE_DIR,
                                 {"model", "tls", "proto", "server", "client", "studio", "bench"});
  return includes;
}

// "model/motion/skeleton.h" -> "model/motion", "server/status.h" -> "server"; the papers' room and
// proto/ have rooms of their own.
std::string RoomOf(const std::string& path) {
  size_t inner = 0;
  for (const char* deep : {"model/papers/", "model/", "proto/"}) {
    if (inner == 0 && path.starts_with(deep)) inner = std::string_view(deep).size();
  }
  const size_t end = path.find('/', inner);
  return end == std::string::npos ? "" : path.substr(0, end);
}

// What each room may include besides itself. Arrows point down: a room names earlier ones only.
const std::vector<std::pair<std::string, std::set<std::string>>>& Rooms() {
  static const std::vector<std::pair<std::string, std::set<std::string>>> rooms = [] {
    const std::string core = "model/core", audio = "model/audio", motion = "model/motion",
                      fit = "model/fit", body = "model/body", formats = "model/formats",
                      draw = "model/draw", flow = "model/flow", plan = "model/plan",
                      engine = "model/engine", networks = "model/papers/networks",
                      paper_samplers = "model/papers/samplers", samplers = "model/samplers",
                      messages = "model/messages", dance = "model/dance", wire = "proto/wire",
                      training = "model/training", paper_training = "model/papers/training",
                      metrics = "model/metrics", evaluation = "model/evaluation",
                      tables = "model/papers/tables";
    return std::vector<std::pair<std::string, std::set<std::string>>>{
        {core, {}},
        {audio, {core}},
        {motion, {core}},
        {fit, {core, motion}},
        {body, {core, motion}},
        {formats, {core, motion, fit, body}},
        {draw, {core, motion, body}},
        {flow, {core, motion}},
        {plan, {core, motion, flow}},
        {engine, {core, motion, flow, plan}},
        {networks, {core, motion, flow}},
        {paper_samplers, {core, motion, fit, flow, engine, networks}},
        {samplers, {core, flow, engine, paper_samplers}},
        {messages, {core, motion}},
        {dance, {core, audio, motion, plan, engine, messages}},
        {training, {core, audio, motion, fit, formats, draw, flow}},
        {paper_training, {core, audio, motion, flow, networks, training}},
        {metrics, {core, audio, motion}},
        {evaluation, {core, audio, motion, draw, engine, samplers, dance, training, metrics}},
        {tables, {core, motion, draw, metrics, evaluation}},
        {"model/lab",
         {core, audio, engine, samplers, training, paper_training, evaluation, tables}},
        {"tls", {core}},
        {wire, {core, motion, messages, "choreo"}},
        {"server",
         {core, audio, motion, engine, samplers, messages, dance, "tls", wire, "choreo", "google"}},
        {"client",
         {core, audio, motion, fit, body, formats, draw, messages, "tls", wire, "choreo", "google",
          "grpc"}},
        {"studio", {core, audio, motion, formats, messages, wire, "client", "choreo"}},
        {"bench",
         {core, audio, motion, formats, flow, engine, networks, paper_samplers, samplers, dance,
          metrics, "server", "client", "choreo"}},
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
    for (const std::string& file : Sources().files()) {
      if (RoomOf(file) != room) continue;
      for (const std::string& include : Sources().Of(file)) {
        if (include.starts_with('<')) continue;
        const std::string other = RoomOf(include);
        if (other != room && !allowed.contains(other)) wrong.push_back(file + " -> " + include);
      }
    }
  }
  EXPECT_THAT(wrong, IsEmpty());
}

// "model/core" -> "core", "model/papers/tables" -> "papers_tables"; what protoc makes of proto/ is
// included by the names of its packages.
std::string DrawnAs(const std::string& room) {
  if (room == "choreo" || room == "google" || room == "grpc") return "proto";
  std::string name = room.substr(room.find('/') + 1);
  std::ranges::replace(name, '/', '_');
  return name;
}

using Arrows = std::set<std::pair<std::string, std::string>>;

// With all that follow from two in a row.
Arrows Closed(Arrows arrows) {
  for (size_t known = 0; known != arrows.size();) {
    known = arrows.size();
    for (const auto& [from, over] : Arrows(arrows)) {
      for (const auto& [second, to] : Arrows(arrows)) {
        if (second == over) arrows.insert({from, to});
      }
    }
  }
  return arrows;
}

// Of lines as "fit & body --> formats --> draw" on the page.
Arrows DrawnArrows() {
  std::ifstream page(std::filesystem::path(CHOREO_SOURCE_DIR) / "docs/architecture.md");
  const std::regex name(R"(\w+|-->)");
  Arrows arrows;
  for (std::string line; std::getline(page, line);) {
    if (line.find("-->") == std::string::npos || line.starts_with("<!--")) continue;
    std::vector<std::string> from, to;
    for (std::sregex_iterator at(line.begin(), line.end(), name), end;; ++at) {
      if (at == end || at->str() == "-->") {
        for (const std::string& one : from) {
          for (const std::string& other : to) arrows.insert({one, other});
        }
        from = std::exchange(to, {});
        if (at == end) break;
      } else {
        to.push_back(at->str());
      }
    }
  }
  return arrows;
}

TEST(Architecture, ThePictureHasTheArrows) {
  Arrows allowed;
  for (const auto& [room, others] : Rooms()) {
    for (const std::string& other : others) allowed.insert({DrawnAs(other), DrawnAs(room)});
  }
  const Arrows drawn = DrawnArrows();
  EXPECT_EQ(Closed(drawn), Closed(allowed));
  for (const auto& arrow : drawn) {
    EXPECT_TRUE(allowed.contains(arrow)) << arrow.first << " --> " << arrow.second;
    Arrows others = drawn;
    others.erase(arrow);
    EXPECT_FALSE(Closed(others).contains(arrow))
        << arrow.first << " --> " << arrow.second << " follows from the others";
  }
}

TEST(Architecture, EveryFileHasARoom) {
  std::vector<std::string> homeless;
  for (const std::string& file : Sources().files()) {
    const bool known =
        std::ranges::any_of(Rooms(), [&](const auto& room) { return room.first == RoomOf(file); });
    if (!known) homeless.push_back(file);
  }
  EXPECT_THAT(homeless, IsEmpty());
}

TEST(Architecture, TheModelKnowsNoGrpcAndNoProtobuf) {
  for (const std::string& file : Sources().files()) {
    if (!file.starts_with("model/")) continue;
    for (const std::string& include : Sources().Of(file)) {
      EXPECT_FALSE(include.starts_with("<grpc") || include.starts_with("<google/") ||
                   include.ends_with(".pb.h"))
          << file << " -> " << include;
    }
  }
}

// A stranger's program finds what our client's headers include.
TEST(Architecture, HeadersOfTheInstalledClientAreComplete) {
  std::ifstream rules(std::filesystem::path(CHOREO_SOURCE_DIR) / "cmake/ChoreoInstall.cmake");
  const std::string text{std::istreambuf_iterator<char>(rules), {}};
  const std::regex header(R"((client|model)/[a-z_/]+\.h)");
  std::set<std::string> installed;
  for (std::sregex_iterator at(text.begin(), text.end(), header), end; at != end; ++at)
    installed.insert(at->str());
  EXPECT_TRUE(installed.contains("client/choreo_client.h"));
  for (const std::string& file : installed) {
    for (const std::string& include : Sources().Of(file)) {
      if (include.starts_with('<')) continue;
      EXPECT_TRUE(installed.contains(include)) << file << " -> " << include;
    }
  }
}

// LibTorch's headers take most of a build: networks, their training, what runs them, and what draws
// the weights that benchmarks and tests run.
TEST(Architecture, TorchStaysInItsRooms) {
  const std::set<std::string> rooms = {
      "model/flow",     "model/papers/networks", "model/papers/samplers",
      "model/samplers", "model/training",        "model/papers/training",
      "bench"};
  std::set<std::string> found;
  for (const std::string& file : Sources().files()) {
    for (const std::string& include : Sources().Of(file)) {
      if (include.starts_with("<torch/") || include.starts_with("<ATen/")) {
        found.insert(RoomOf(file));
        EXPECT_TRUE(rooms.contains(RoomOf(file))) << file << " -> " << include;
      }
    }
  }
  EXPECT_EQ(found, rooms) << "a room on the list needs no torch, or the includes were not read";
}

// What stands between the network and arrival is few rules: a figure that falls short is learnt,
// and not mended with a constant.
TEST(Architecture, FewConstantsAreTunedBetweenNetworkAndArrival) {
  int constants = 0;
  // Constants of a file, options of a stage; not how often a solver goes round.
  const std::regex name(R"(\b(k[A-Z]\w*|double \w+|, \w+) = [0-9])");
  std::vector<std::string> files = {"model/flow/flow_sampler.cpp", "model/flow/plan_options.h",
                                    "model/flow/footwork_options.h",
                                    "model/engine/continuous_flow_sampler.cpp"};
  for (const std::string& file : Sources().files()) {
    if (file.starts_with("model/plan/") && file != "model/plan/arrival.cpp") files.push_back(file);
  }
  for (const std::string& file : files) {
    std::ifstream in(std::filesystem::path(CHOREO_SOURCE_DIR) / file);
    ASSERT_TRUE(in) << file;
    for (std::string line; std::getline(in, line);) {
      if (!line.starts_with("constexpr double ") && !line.starts_with("inline constexpr double ") &&
          !(file.ends_with(".h") && line.starts_with("  double ")))
        continue;
      constants +=
          static_cast<int>(std::distance(std::sregex_iterator(line.begin(), line.end(), name), {}));
    }
  }
  EXPECT_GT(constants, 5) << "none were found";
  EXPECT_LE(constants, 31);
}

}  // namespace choreo::architecture_test
