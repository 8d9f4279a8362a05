#include "client/authoring/project/dancers.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "client/authoring/fields/json_fields.h"
#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/motion/rotation.h"

namespace choreo::authoring {
namespace {

using nlohmann::json;

constexpr double kMaxApart = 10;   // metres
constexpr double kFullTurn = 360;  // degrees

void RequireIn(double number, const std::string& field, double low, double high) {
  if (number >= low && number <= high) return;
  throw InvalidArgument(
      field, InFull(number) + " is not a number from " + InFull(low) + " to " + InFull(high));
}

std::string FieldOfDancer(const std::string& name, size_t i) {
  return name + ":dancers[" + std::to_string(i) + "]";
}

std::string TextOf(const json& value, const std::string& field) {
  if (value.is_string() && !value.get<std::string>().empty()) return value.get<std::string>();
  throw InvalidArgument(field, Shown(value) + " is not a text");
}

/// Checks a dancer's id, which becomes part of the names of files and nodes.
void CheckId(const std::string& id, const std::string& field) {
  if (id.empty()) throw InvalidArgument(field, "is empty");
  for (const char c : id) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-')
      throw InvalidArgument(field, Shown(json(id)) + " has more than letters, digits, _ and -");
  }
}

Eigen::Vector2d PlaceOf(const json& value, const std::string& field) {
  if (!value.is_array() || value.size() != 2)
    throw InvalidArgument(field, Shown(value) + " is not a place: [x, z] in metres");
  return {JsonNumber(value[0], field + "[0]"), JsonNumber(value[1], field + "[1]")};
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
  if (value.contains("id")) dancer.id = TextOf(value["id"], field + ".id");
  if (value.contains("facing") && !value["facing"].is_string())
    dancer.facing = JsonNumber(value["facing"], field + ".facing");
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
      throw InvalidArgument(FieldOfDancer(name, i) + ".facing",
                            Shown(list[i]["facing"]) + " is none of the other dancers");
    }
    const Eigen::Vector2d way = other->place - dancer.place;
    dancer.facing = kDegrees * std::atan2(way.x(), way.y());
  }
}

}  // namespace

void CheckDancers(const Dancers& stage, const std::string& name) {
  const std::vector<Dancer>& dancers = stage.dancers;
  RequireIn(stage.apart, name + ":apart", 0, kMaxApart);
  if (dancers.size() > kMaxDancers) {
    throw InvalidArgument(name + ":dancers", "are " + std::to_string(dancers.size()) +
                                                 ", must be up to " + std::to_string(kMaxDancers));
  }
  for (size_t i = 0; i < dancers.size(); ++i) {
    const std::string& id = dancers[i].id;
    const Eigen::Vector2d& place = dancers[i].place;
    const std::string field = FieldOfDancer(name, i);
    CheckId(id, field + ".id");
    RequireIn(dancers[i].facing, field + ".facing", -kFullTurn, kFullTurn);
    for (int axis = 0; axis < 2; ++axis)
      RequireIn(place[axis], field + ".place[" + std::to_string(axis) + "]", -kMaxStageRadius,
                kMaxStageRadius);
    for (size_t j = 0; j < i; ++j) {
      if (dancers[j].id == id)
        throw InvalidArgument(field + ".id", "\"" + id + "\" is an earlier dancer's already");
      if (dancers[j].place == place) {
        throw InvalidArgument(field + ".place", "[" + InFull(place.x()) + "," + InFull(place.y()) +
                                                    "] is where " + dancers[j].id + " stands");
      }
    }
  }
}

Dancers ParseDancers(const json& file, const std::string& name,
                     const std::filesystem::path& folder) {
  const json& list = ListIn(file, name, "dancers");
  // A project has these members and others (project_file.h).
  if (!file.contains("studio")) {
    CheckFileMembers(file, name, {"dancers", "apart", "about"},
                     "a file of dancers has dancers, and perhaps apart and about");
  }
  Dancers read;
  if (file.contains("apart")) read.apart = JsonNumber(file["apart"], name + ":apart");
  for (size_t i = 0; i < list.size(); ++i)
    read.dancers.push_back(ReadDancer(list[i], FieldOfDancer(name, i), i + 1, folder));
  CheckDancers(read, name);
  FaceEachOther(list, name, &read.dancers);
  return read;
}

Dancers ReadDancers(const std::filesystem::path& path) {
  const std::string name = path.string();
  return ParseDancers(ParseJson(ReadText(path, "file of dancers"), name), name, path.parent_path());
}

}  // namespace choreo::authoring
