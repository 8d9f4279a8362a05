#include "client/cli/asked.h"

#include "client/authoring/json_fields.h"
#include "model/core/error.h"

namespace choreo::cli {
namespace {

using nlohmann::ordered_json;

template <typename Report, typename AskedFor, typename Visit>
void VisitMembers(Report& report, AskedFor& asked, const Visit& visit) {
  visit(report, "model", asked.model);
  visit(report, "seed", asked.seed);
  visit(report, "temperature", asked.temperature);
  visit(report, "music_dynamics", asked.music_dynamics);
  visit(report, "variation", asked.variation);
  visit(report, "style", asked.style);
  visit(report, "song", asked.song);
  visit(report, "song_start", asked.song_start_s);
  visit(report, "music_beats", asked.beats);
  visit(report, "music_downbeats", asked.downbeats);
}

struct MemberWriter {
  template <typename Value>
  void operator()(ordered_json& report, const char* member, const Value& value) const {
    if (value != Value()) report[member] = value;
  }
  template <typename Value>
  void operator()(ordered_json& report, const char* member,
                  const std::optional<Value>& value) const {
    if (value) report[member] = *value;
  }
};

struct MemberReader {
  const std::string& name;

  template <typename Value>
  void operator()(const ordered_json& report, const char* member, Value& value) const {
    if (!report.contains(member)) return;
    try {
      report[member].get_to(value);
    } catch (const nlohmann::json::exception&) {
      throw InvalidArgument(name + ":" + member,
                            authoring::Shown(report[member]) + " is not what a report says there");
    }
  }
  template <typename Value>
  void operator()(const ordered_json& report, const char* member,
                  std::optional<Value>& value) const {
    if (report.contains(member)) (*this)(report, member, value.emplace());
  }
};

}  // namespace

void Asked::WriteTo(ordered_json* report) const { VisitMembers(*report, *this, MemberWriter()); }

Asked Asked::ReadFrom(const ordered_json& report, const std::string& name) {
  Asked asked;
  VisitMembers(report, asked, MemberReader{name});
  return asked;
}

Asked Asked::From(double seconds) const {
  Asked later = *this;
  if (!song.empty()) later.song_start_s += seconds;
  for (std::vector<double>* times : {&later.beats, &later.downbeats}) {
    for (double& time : *times) time -= seconds;
    std::erase_if(*times, [](double time) { return time < 0; });
  }
  return later;
}

}  // namespace choreo::cli
