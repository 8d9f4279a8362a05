#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/architecture/includes.h"

// Checks that includes follow the rules of docs/architecture.md.
namespace choreo::architecture_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Includes& Sources() {
  static const Includes includes(
      CHOREO_SOURCE_DIR, {"model", "network", "proto", "server", "client", "studio", "bench"});
  return includes;
}

// "model/motion/skeleton.h" -> "model/motion", "server/messages/status.h" -> "server";
// model/papers, proto/ and client/ have several modules.
std::string ModuleOf(const std::string& path) {
  size_t inner = 0;
  for (const char* deep : {"model/papers/", "model/", "proto/", "client/"}) {
    if (inner == 0 && path.starts_with(deep)) inner = std::string_view(deep).size();
  }
  if (path.starts_with("client/") && path.find('/', inner) == std::string::npos) return "client";
  const size_t end = path.find('/', inner);
  return end == std::string::npos ? "" : path.substr(0, end);
}

// What each module may include besides itself: earlier modules only.
const std::vector<std::pair<std::string, std::set<std::string>>>& Modules() {
  static const std::vector<std::pair<std::string, std::set<std::string>>> modules = [] {
    const std::string core = "model/core", audio = "model/audio", motion = "model/motion",
                      fit = "model/fit", body = "model/body", formats = "model/formats",
                      draw = "model/draw", flow = "model/flow", plan = "model/plan",
                      engine = "model/engine", networks = "model/papers/networks",
                      paper_samplers = "model/papers/samplers", samplers = "model/samplers",
                      messages = "model/messages", dance = "model/dance", wire = "proto/wire",
                      training = "model/training", paper_training = "model/papers/training",
                      metrics = "model/metrics", evaluation = "model/evaluation",
                      tables = "model/papers/tables", live = "client/live",
                      authoring = "client/authoring", cli = "client/cli";
    return std::vector<std::pair<std::string, std::set<std::string>>>{
        {core, {}},
        {audio, {core}},
        {motion, {core}},
        {fit, {core, motion}},
        {body, {core, motion}},
        {formats, {core, motion, fit, body}},
        {draw, {core, motion, body}},
        {messages, {core, motion}},
        {plan, {core, motion, messages}},
        {flow, {core, motion, messages, plan}},
        {engine, {core, motion, flow, plan}},
        {networks, {core, motion, flow}},
        {paper_samplers, {core, audio, motion, fit, plan, flow, engine, networks}},
        {samplers, {core, plan, flow, engine, paper_samplers}},
        {dance, {core, audio, motion, plan, engine, messages}},
        {training, {core, audio, motion, fit, formats, draw, flow}},
        {paper_training, {core, audio, motion, flow, networks, training}},
        {metrics, {core, audio, motion}},
        {evaluation, {core, audio, motion, draw, plan, engine, samplers, dance, training, metrics}},
        {tables, {core, motion, draw, metrics, evaluation}},
        {"model/lab",
         {core, audio, engine, samplers, training, paper_training, evaluation, tables}},
        {"network", {core}},
        {wire, {core, motion, messages, "choreo"}},
        {"server",
         {core, audio, motion, plan, engine, samplers, messages, dance, "network", wire, "choreo",
          "google"}},
        {"client", {core, motion, messages, "network", wire, "choreo", "google", "grpc"}},
        {live, {core, audio, motion, "network", "client"}},
        {authoring, {core, audio, motion, fit, body, formats, "client"}},
        {"studio",
         {core, audio, motion, formats, messages, "network", wire, "client", authoring, live,
          "choreo"}},
        {cli,
         {core, audio, motion, fit, body, formats, draw, "network", "client", live, authoring,
          "studio"}},
        {"bench",
         {core, audio, motion, formats, flow, engine, networks, paper_samplers, samplers, dance,
          plan, metrics, "server", "client", live, authoring, cli, "choreo"}},
    };
  }();
  return modules;
}

TEST(Architecture, EveryModuleIncludesLowerOnesAlone) {
  std::set<std::string> below;
  std::vector<std::string> wrong;
  for (const auto& [module, allowed] : Modules()) {
    for (const std::string& other : allowed) {
      const bool generated = other == "choreo" || other == "google" || other == "grpc";
      EXPECT_TRUE(generated || below.contains(other)) << module << " above " << other;
    }
    below.insert(module);
    for (const std::string& file : Sources().files()) {
      if (ModuleOf(file) != module) continue;
      for (const std::string& include : Sources().Of(file)) {
        if (include.starts_with('<')) continue;
        const std::string other = ModuleOf(include);
        if (other != module && !allowed.contains(other)) wrong.push_back(file + " -> " + include);
      }
    }
  }
  EXPECT_THAT(wrong, IsEmpty());
}

// "model/core" -> "core", "model/papers/tables" -> "papers_tables"; what protoc makes of proto/ is
// included by the names of its packages.
std::string DrawnAs(const std::string& module) {
  if (module == "choreo" || module == "google" || module == "grpc") return "proto";
  std::string name = module.substr(module.find('/') + 1);
  std::ranges::replace(name, '/', '_');
  return name;
}

using Arrows = std::set<std::pair<std::string, std::string>>;

// The transitive closure.
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

// The arrows of lines such as "fit & body --> formats --> draw" on the page.
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
  for (const auto& [module, others] : Modules()) {
    for (const std::string& other : others) allowed.insert({DrawnAs(other), DrawnAs(module)});
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

// A step of a way on the page: a function, and the file that has it.
struct Step {
  std::string file, function;
};

std::vector<Step> StepsOf(const std::string& line) {
  const std::regex step("`([a-z_/.]+):([A-Za-z]+)`");
  std::vector<Step> steps;
  for (std::sregex_iterator at(line.begin(), line.end(), step), end; at != end; ++at)
    steps.push_back({at->str(1), at->str(2)});
  return steps;
}

const std::string& TextOf(const std::string& file) {
  static std::map<std::string, std::string> texts;
  const auto [text, is_new] = texts.try_emplace(file);
  if (is_new) {
    std::ifstream in(std::filesystem::path(CHOREO_SOURCE_DIR) / file);
    text->second = {std::istreambuf_iterator<char>(in), {}};
  }
  return text->second;
}

// A file's text without its comments.
const std::string& CodeOf(const std::string& file) {
  static std::map<std::string, std::string> codes;
  const auto [code, is_new] = codes.try_emplace(file);
  if (is_new) code->second = std::regex_replace(TextOf(file), std::regex("//[^\n]*"), "");
  return code->second;
}

// "Push(" or, of a constructor, "FlowWindow window(" or "std::make_shared<DanceChain>(".
bool Mentions(const std::string& file, const std::string& function) {
  const std::regex mention("\\b" + function + R"((>| \w+)?\()");
  return std::regex_search(CodeOf(file), mention);
}

// The classes whose member the step's function is as its file defines it, "" for a free function.
std::set<std::string> OwnersOf(const Step& step) {
  // The line up to the name has nothing but a type and the owner; arguments and a body follow.
  const std::regex definition("(^|\n)( *)([\\w:<>,&* ]*[ &*])?((\\w+)::)?" + step.function +
                              R"(\([^;{]*\)[\w ]*(\{|:))");
  const std::regex type(R"((?:class|struct) (\w+)[^;{}]*\{)");
  const std::string& code = CodeOf(step.file);
  std::set<std::string> owners;
  for (std::sregex_iterator at(code.begin(), code.end(), definition), end; at != end; ++at) {
    std::string owner = at->str(5);
    if (at->length(2) > 0) {  // within its class, the last one that has begun
      const std::string before = code.substr(0, static_cast<size_t>(at->position()));
      for (std::sregex_iterator begun(before.begin(), before.end(), type); begun != end; ++begun)
        owner = begun->str(1);
    }
    owners.insert(owner);
  }
  return owners;
}

// Whether a header declares the function in that class, or outside all for "".
bool Declares(const std::string& header, const std::string& owner, const std::string& function) {
  if (!header.ends_with(".h") || !Mentions(header, function)) return false;
  const std::string& code = CodeOf(header);
  return owner.empty()
             ? std::regex_search(code, std::regex("\n[\\w:<>,&* ]*[ &*]" + function + "\\("))
             : std::regex_search(code, std::regex("(class|struct) " + owner + "\\b[^;{}]*\\{"));
}

// That class and those from which a header derives it: a caller may know one of these alone.
std::set<std::string> WithBases(const std::set<std::string>& headers, const std::string& owner) {
  std::set<std::string> classes = {owner};
  const std::regex derived("(class|struct) " + owner + R"(\b[^;{}:]*:([^;{}]*)\{)");
  const std::regex base(R"(public ((\w+::)*)(\w+))");
  for (const std::string& header : headers) {
    const std::string& code = CodeOf(header);
    std::smatch found;
    if (owner.empty() || !std::regex_search(code, found, derived)) continue;
    const std::string list = found.str(2);
    for (std::sregex_iterator at(list.begin(), list.end(), base), end; at != end; ++at)
      classes.insert(at->str(3));
  }
  return classes;
}

// Its functions are one call each.
constexpr const char* kFacade = "model/dance/dance_stream.h";

// Whether `caller` calls the step's function, itself or through the facade: it includes the header
// that declares it in the very class, or the free function.
bool Calls(const std::string& caller, const Step& step) {
  std::set<std::string> seen = Sources().All(caller), known = Sources().All(step.file);
  seen.insert(caller);
  known.insert(step.file);
  if (!Mentions(caller, step.function) &&
      !(seen.contains(kFacade) && Mentions(kFacade, step.function)))
    return false;
  for (const std::string& defined : OwnersOf(step)) {
    for (const std::string& owner : WithBases(known, defined)) {
      for (const std::string& header : known) {
        if (seen.contains(header) && Declares(header, owner, step.function)) return true;
      }
    }
  }
  return false;
}

// Names alone do not make a call: who does not know the class calls another's function.
TEST(Architecture, ACallNeedsTheHeaderOfItsClass) {
  const Step push{"model/dance/input/audio_feed.cpp", "Push"};
  EXPECT_EQ(OwnersOf(push), std::set<std::string>{"AudioFeed"});
  EXPECT_TRUE(Calls("model/dance/dance_chain.cpp", push));
  ASSERT_TRUE(Mentions("model/audio/music/feature_stream.cpp", "Push"));
  EXPECT_FALSE(Calls("model/audio/music/feature_stream.cpp", push)) << "it pushes to a resampler";
  EXPECT_TRUE(OwnersOf({"model/dance/dance_chain.cpp", "FlowWindow"}).empty());
}

// The page follows what is sent, from function to function, until a frame is sent.
TEST(Architecture, TheWaysOnThePageFollowTheCode) {
  const std::string& text = TextOf("docs/architecture.md");
  std::vector<std::string> counts;
  // The ways may only become shorter.
  const std::vector<std::pair<std::string, size_t>> most_files = {
      {"an audio chunk", 10}, {"a key", 10}, {"a style", 10}, {"a seed", 8}};
  for (const auto& [sent, most] : most_files) {
    std::vector<Step> way;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("| " + sent + " |") || line.starts_with("| every frame |"))
        std::ranges::copy(StepsOf(line), std::back_inserter(way));
    }
    ASSERT_GT(way.size(), 5U) << sent;
    std::set<std::string> files = {way[0].file};
    for (const Step& step : way)
      EXPECT_FALSE(OwnersOf(step).empty()) << step.file << " does not define " << step.function;
    for (size_t i = 1; i < way.size(); ++i) {
      EXPECT_TRUE(std::any_of(way.begin(), way.begin() + static_cast<std::ptrdiff_t>(i),
                              [&](const Step& before) { return Calls(before.file, way[i]); }))
          << sent << ": nothing before calls " << way[i].function << " of " << way[i].file;
      files.insert(way[i].file);
    }
    EXPECT_LE(files.size(), most) << sent;
    counts.push_back(std::to_string(files.size()));
  }
  EXPECT_THAT(text, HasSubstr("the ways have " + counts[0] + ", " + counts[1] + ", " + counts[2] +
                              " and " + counts[3] + " files"));
}

// Whatever a request's reader, a dance or a sampler includes can change bits, and so can the source
// file of each header.
TEST(Architecture, TheBuildsIdentityFollowsEverySourceThatDances) {
  std::istringstream listed(CHOREO_IDENTITY_PARTS);
  const std::set<std::string> parts{std::istream_iterator<std::string>(listed), {}};
  const std::set<std::string> known(Sources().files().begin(), Sources().files().end());
  std::vector<std::string> open = {"server/messages/read_request.cpp"};
  for (const std::string& file : known) {
    if (file.starts_with("model/dance/") || file.starts_with("model/samplers/"))
      open.push_back(file);
  }
  std::set<std::string> seen;
  std::vector<std::string> missing;
  while (!open.empty()) {
    const std::string file = open.back();
    open.pop_back();
    if (!known.contains(file) || !seen.insert(file).second) continue;
    const std::filesystem::path path = file;
    if (!parts.contains(file) && !parts.contains(path.parent_path())) missing.push_back(file);
    std::ranges::copy(Sources().Of(file), std::back_inserter(open));
    open.push_back(std::filesystem::path(path).replace_extension(".cpp"));
  }
  EXPECT_THAT(missing, IsEmpty());
  EXPECT_TRUE(seen.contains("model/papers/samplers/packed_flow.cpp"));
  EXPECT_TRUE(seen.contains("proto/wire/poses.cpp"));
}

// A large module has rooms, lowest first: a file includes its own room's headers and lower rooms'.
// Files of no room stand where "" does.
TEST(Architecture, RoomsOfAModuleIncludeLowerOnesAlone) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> modules = {
      {"model/audio/", {"signal", "decode", "beats", "music"}},
      {"model/core/", {"", "numbers", "text", "files", "running"}},
      {"model/motion/", {"", "kinematics", "floor", "pose", "controls"}},
      {"model/fit/", {"bones", "sources", "solver", ""}},
      {"model/flow/", {"priors", "window", "checkpoint", "network", ""}},
      {"model/training/", {"clips", "prepare", "trainer", "windows", "flow_matching"}},
      {"model/evaluation/", {"", "judges", "tables"}},
      {"model/dance/", {"timeline", "controls", "input", "requests", "transition", "delivery", ""}},
      {"model/formats/", {"containers", "reading", "arrays", "bvh", "gltf", ""}},
      {"client/authoring/", {"notes", "fields", "music", "keys", "controls", "project", ""}},
      {"server/", {"process", "messages", "connections", "telemetry", "settings", "calls", ""}},
      {"client/cli/", {"report", "options", "dance", "edit", "commands", ""}},
  };
  for (const auto& [module, rooms] : modules) {
    const auto level = [&](const std::string& file) {
      const std::string inner = file.substr(module.size());
      const size_t slash = inner.find('/');
      const std::string room = slash == std::string::npos ? "" : inner.substr(0, slash);
      return std::ranges::find(rooms, room) - rooms.begin();
    };
    for (const std::string& file : Sources().files()) {
      if (!file.starts_with(module)) continue;
      EXPECT_LT(level(file), std::ssize(rooms)) << file << " is in no known room";
      for (const std::string& include : Sources().Of(file)) {
        if (!include.starts_with(module)) continue;
        EXPECT_LE(level(include), level(file)) << file << " -> " << include;
      }
    }
  }
}

TEST(Architecture, EveryFileHasAModule) {
  std::vector<std::string> unassigned;
  for (const std::string& file : Sources().files()) {
    const bool known = std::ranges::any_of(
        Modules(), [&](const auto& module) { return module.first == ModuleOf(file); });
    if (!known) unassigned.push_back(file);
  }
  EXPECT_THAT(unassigned, IsEmpty());
}

// A name says one thing. Only what converts messages is called alike in both of its rooms.
TEST(Architecture, HeadersHaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const std::string& file : Sources().files()) {
    const std::string name = std::filesystem::path(file).filename();
    if (!name.ends_with(".h") || name == "convert.h") continue;
    EXPECT_TRUE(names.insert(name).second) << file;
  }
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

// Expects that no text of what servers say matches, except in the `known` files.
void ExpectUnsaid(const std::regex& what, const std::set<std::string>& known) {
  const std::regex literal(R"('\\?.'|"(\\.|[^"\\])*")");  // a character or a text
  const std::set<std::string> heard = {"model/core",   "model/audio", "model/motion",
                                       "model/body",   "model/flow",  "model/plan",
                                       "model/engine", "model/dance", "model/messages"};
  int read = 0;
  for (const std::string& file : Sources().files()) {
    if (!heard.contains(file.substr(0, file.find('/', 6))) || known.contains(file)) continue;
    ++read;
    std::istringstream lines(CodeOf(file));
    for (std::string line; std::getline(lines, line);) {
      for (std::sregex_iterator at(line.begin(), line.end(), literal), end; at != end; ++at)
        EXPECT_FALSE(std::regex_search(at->str(), what)) << file << ": " << line;
    }
  }
  EXPECT_GT(read, 100);
}

// Who calls the API knows none of our commands' options: they are for client/cli to name.
TEST(Architecture, WhatServersSayNamesNoOptions) {
  // Their options are data for the commands (ControlRow::option), or of choreod's own start.
  ExpectUnsaid(std::regex("--[a-z]"),
               {"model/motion/controls/controls.h", "model/engine/engine_choice.h"});
}

// The API names a member in its own way: proto/wire/field_path.h does so for an error's field and
// remedy, and the text has words.
TEST(Architecture, WhatTheModelSaysNamesNoMembers) {
  const std::regex name_in_a_text(R"(^(?=.* ).*(\b[A-Za-z]+_\w|[A-Z]\w*::\w|\bconfig\.))");
  // NumPy's header, and a mistake of our own code.
  ExpectUnsaid(name_in_a_text, {"model/core/files/npy.cpp", "model/core/numbers/random.cpp"});
}

// The files that a recipe of docs/extending.md has in its table.
std::set<std::string> FilesToAdd(const std::string& recipe_of) {
  const std::string& text = TextOf("docs/extending.md");
  const size_t begin = text.find("## " + recipe_of + "\n"), end = text.find("\n## ", begin);
  const std::string recipe = text.substr(begin, end - begin);
  const std::regex row(R"(\n\| [0-9]\.[^|]*\|[^`]*`([^`]*)`)");
  std::set<std::string> files;
  for (std::sregex_iterator at(recipe.begin(), recipe.end(), row), last; at != last; ++at) {
    files.insert((*at)[1]);
    EXPECT_FALSE(TextOf((*at)[1]).empty()) << (*at)[1];
  }
  return files;
}

// As the page says; toy_control_test adds one without more than these.
TEST(Architecture, AControlIsAddedInFewFiles) { EXPECT_EQ(FilesToAdd("A control").size(), 8U); }

// No other file names one that has no further use.
TEST(Architecture, ASettingIsAddedInFewFiles) {
  const std::set<std::string> files = FilesToAdd("A setting of a whole dance");
  EXPECT_EQ(files.size(), 5U);
  const std::regex named(R"(\bmusic_dynamics\b(?!\.h))");
  std::set<std::string> naming;
  for (const std::string& file : Sources().files()) {
    if (file.starts_with("model/evaluation/")) continue;  // measures what it does
    if (std::regex_search(TextOf(file), named)) naming.insert(file);
  }
  for (const std::string& file : files) {
    if (file.ends_with(".proto")) naming.insert(file);
  }
  EXPECT_EQ(naming, files);
}

// It is opaque: what somebody needs of it, the model's description states by itself.
TEST(Architecture, NobodyReadsAFingerprint) {
  const std::regex parsed(R"(fingerprint(\(\))?\.(find|substr|starts_with|ends_with|contains)\b)");
  for (const std::string& file : Sources().files())
    EXPECT_FALSE(std::regex_search(TextOf(file), parsed)) << file;
}

// Programs that use the installed client find all that its headers include.
TEST(Architecture, HeadersOfTheInstalledClientAreComplete) {
  std::ifstream rules(std::filesystem::path(CHOREO_SOURCE_DIR) / "cmake/ChoreoInstall.cmake");
  const std::string text{std::istreambuf_iterator<char>(rules), {}};
  const std::regex header(R"((client|model|network)/[a-z_/]+\.h)");
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

// LibTorch's headers take most of a build's time.
TEST(Architecture, TorchStaysInItsModules) {
  const std::set<std::string> modules = {
      "model/flow",     "model/papers/networks", "model/papers/samplers",
      "model/samplers", "model/training",        "model/papers/training",
      "bench"};
  std::set<std::string> found;
  for (const std::string& file : Sources().files()) {
    for (const std::string& include : Sources().Of(file)) {
      if (include.starts_with("<torch/") || include.starts_with("<ATen/")) {
        found.insert(ModuleOf(file));
        EXPECT_TRUE(modules.contains(ModuleOf(file))) << file << " -> " << include;
      }
    }
  }
  EXPECT_EQ(found, modules) << "a module on the list needs no torch, or the includes were not read";
}

// torch/torch.h takes twice the time of the parts that a file needs.
TEST(Architecture, FilesIncludeThePartsOfTorchThatTheyUse) {
  const Includes tests(CHOREO_SOURCE_DIR, {"tests"});
  for (const Includes* sources : {&Sources(), &tests}) {
    for (const std::string& file : sources->files())
      EXPECT_FALSE(sources->Of(file).contains("<torch/torch.h>")) << file;
  }
}

}  // namespace choreo::architecture_test
