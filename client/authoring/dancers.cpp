#include "client/authoring/dancers.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "client/authoring/json_fields.h"
#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/motion/rotation.h"

namespace choreo::authoring {
namespace {

using nlohmann::json;

constexpr double kMaxApart = 10;   // metres
constexpr double kFullTurn = 360;  // degrees

double NumberIn(const json& value, const std::string& field, double low, double high) {
  const double number = JsonNumber(value, field);
  if (number >= low && number <= high) return number;
  throw InvalidArgument(
      field, Shown(value) + " is not a number from " + InFull(low) + " to " + InFull(high));
}

std::string TextOf(const json& value, const std::string& field) {
  if (value.is_string() && !value.get<std::string>().empty()) return value.get<std::string>();
  throw InvalidArgument(field, Shown(value) + " is not a text");
}

/// Reads a dancer's id, which becomes part of the names of files and nodes.
std::string IdOf(const json& value, const std::string& field) {
  const std::string id = TextOf(value, field);
  for (const char c : id) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-')
      throw InvalidArgument(field, Shown(value) + " has more than letters, digits, _ and -");
  }
  return id;
}

Eigen::Vector2d PlaceOf(const json& value, const std::string& field) {
  if (!value.is_array() || value.size() != 2)
    throw InvalidArgument(field, Shown(value) + " is not a place: [x, z] in metres");
  return {NumberIn(value[0], field + "[0]", -kMaxStageRadius, kMaxStageRadius),
          NumberIn(value[1], field + "[1]", -kMaxStageRadius, kMaxStageRadius)};
}

std::vector<std::string> Keyframes(const json& value, const std::string& field,
                                   const std::filesystem::path& folder) {
  if (value.is_array() && !value.empty() && value[0].is_object())
    return {json{{"name", field.substr(0, field.rfind('.'))}, {"keyframes", value}}.dump()};
  std::vector<std::string> sources;
  const json list = value.is_array() ? value : json::array({value});
  for (const json& source : list) sources.push_back(TextOf(source, field));
  if (sources.empty()) throw InvalidArgument(field, "names none; \"none\" is a dance without");
  for (std::string& source : sources)
    if (source != "none") source = (folder / source).string();
  return sources;
}

Dancer ReadDancer(const json& value, const std::string& field, size_t number,
                  const std::filesystem::path& folder) {
  CheckMembers(
      value, field, {"id", "place", "facing", "mirrored", "after", "seed", "style", "keyframes"},
      "a dancer has place, and perhaps id, facing, mirrored, after, seed, style, keyframes");
  if (!value.contains("place")) throw InvalidArgument(field + ".place", "is missing: [x, z]");
  Dancer dancer{.id = "dancer" + std::to_string(number)};
  dancer.place = PlaceOf(value["place"], field + ".place");
  if (value.contains("id")) dancer.id = IdOf(value["id"], field + ".id");
  if (value.contains("facing") && !value["facing"].is_string())
    dancer.facing = NumberIn(value["facing"], field + ".facing", -kFullTurn, kFullTurn);
  if (value.contains("mirrored")) {
    if (!value["mirrored"].is_boolean())
      throw InvalidArgument(field + ".mirrored",
                            Shown(value["mirrored"]) + " is not true or false");
    dancer.mirrored = value["mirrored"];
  }
  if (value.contains("after")) {
    const json& after = value["after"];
    dancer.after =
        ParseTime(after.is_string() ? after.get<std::string>() : after.dump(), field + ".after");
  }
  if (value.contains("seed")) {
    if (!value["seed"].is_number_unsigned()) {
      throw InvalidArgument(field + ".seed",
                            Shown(value["seed"]) + " is not a whole number from 0 on");
    }
    dancer.seed = value["seed"];
  }
  if (value.contains("style")) dancer.style = TextOf(value["style"], field + ".style");
  if (value.contains("keyframes"))
    dancer.keyframes = Keyframes(value["keyframes"], field + ".keyframes", folder);
  return dancer;
}

/// Turns dancers who face another one by name, once all dancers are known.
void FaceEachOther(const json& list, const std::string& name, std::vector<Dancer>* dancers) {
  for (size_t i = 0; i < dancers->size(); ++i) {
    if (!list[i].contains("facing") || !list[i]["facing"].is_string()) continue;
    Dancer& dancer = (*dancers)[i];
    const auto other =
        std::ranges::find(*dancers, list[i]["facing"].get<std::string>(), &Dancer::id);
    if (other == dancers->end() || other->id == dancer.id) {
      throw InvalidArgument(name + ":dancers[" + std::to_string(i) + "].facing",
                            Shown(list[i]["facing"]) + " is none of the other dancers");
    }
    const Eigen::Vector2d way = other->place - dancer.place;
    dancer.facing = kDegrees * std::atan2(way.x(), way.y());
  }
}

}  // namespace

Dancers ParseDancers(const json& file, const std::string& name,
                     const std::filesystem::path& folder) {
  const json& list = ListIn(file, name, "dancers");
  // A project has these members and others (project_file.h).
  if (!file.contains("studio")) {
    CheckFileMembers(file, name, {"dancers", "apart", "about"},
                     "a file of dancers has dancers, and perhaps apart and about");
  }
  if (list.size() > kMaxDancers) {
    throw InvalidArgument(name + ":dancers", "are " + std::to_string(list.size()) +
                                                 ", must be up to " + std::to_string(kMaxDancers));
  }
  Dancers read{.dancers = {}, .apart = kUsuallyApart};
  if (file.contains("apart")) read.apart = NumberIn(file["apart"], name + ":apart", 0, kMaxApart);
  for (size_t i = 0; i < list.size(); ++i) {
    const std::string field = name + ":dancers[" + std::to_string(i) + "]";
    const Dancer& dancer = read.dancers.emplace_back(ReadDancer(list[i], field, i + 1, folder));
    for (size_t j = 0; j < i; ++j) {
      if (read.dancers[j].id == dancer.id)
        throw InvalidArgument(field + ".id",
                              "\"" + dancer.id + "\" is an earlier dancer's already");
      if (read.dancers[j].place == dancer.place) {
        throw InvalidArgument(field + ".place", Shown(list[i]["place"]) + " is where " +
                                                    read.dancers[j].id + " stands");
      }
    }
  }
  FaceEachOther(list, name, &read.dancers);
  return read;
}

Dancers ReadDancers(const std::filesystem::path& path) {
  const std::string name = path.string();
  return ParseDancers(ParseJson(ReadText(path, "file of dancers"), name), name, path.parent_path());
}

}  // namespace choreo::authoring
