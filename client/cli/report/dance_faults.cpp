#include "client/cli/report/dance_faults.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "client/authoring/music/music.h"
#include "model/core/rounded.h"

namespace choreo::cli {

std::vector<DanceFault> FindDanceFaults(const Skeleton& skeleton, const Motion& motion,
                                        double fps) {
  std::vector<DanceFault> faults;
  for (MotionFault fault : FindMotionFaults(skeleton, motion)) {
    const std::string message = Describe(skeleton, fault);
    fault = AtRate(fault, motion.fps, fps);
    faults.push_back({fault, skeleton.joint_names[static_cast<size_t>(fault.joint)], message});
  }
  return faults;
}

nlohmann::ordered_json FaultsJson(const std::vector<DanceFault>& faults, const TimeFormat& times) {
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  auto list = nlohmann::ordered_json::array();
  for (const auto& [fault, joint, message] : faults) {
    nlohmann::ordered_json& one = list.emplace_back();
    one["kind"] = fault.row().name;
    one["frame"] = fault.first;
    one["last_frame"] = fault.last;
    one["time"] = rounded(times.Second(fault.first));
    one["until"] = rounded(times.Second(fault.last));
    if (const auto count = times.Count(fault.first)) one["count"] = rounded(*count);
    one["joint"] = joint;
    one["worst"] = rounded(fault.worst);
    one["limit"] = fault.row().limit;
    one["unit"] = fault.row().unit;
    one["message"] = message;
  }
  return list;
}

std::string FaultLines(const std::vector<DanceFault>& faults, const TimeFormat& times) {
  std::string lines;
  for (const auto& [fault, joint, message] : faults) {
    lines += times.Of(fault.first);
    if (fault.last > fault.first) lines += " to " + Rounded(times.Second(fault.last)) + " s";
    lines += ": " + message + "\n";
  }
  return lines;
}

std::string CountFaults(const std::vector<DanceFault>& faults) {
  std::vector<MotionFault> found;
  for (const DanceFault& one : faults) found.push_back(one.fault);
  return CountMotionFaults(found);
}

std::string FaultsText(const std::vector<DanceFault>& faults, const std::filesystem::path& dance) {
  const std::string count = CountFaults(faults);
  return (faults.empty() ? count : count + "; choreo check " + dance.string() + " lists them") +
         "\n";
}

authoring::Counts CountsOf(const DanceSettings& settings, const std::filesystem::path& report,
                           std::string song, double start_s) {
  if (!settings.beats.empty()) return authoring::CountsFrom(settings.beats, settings.downbeats);
  settings.FillSong(report, !song.empty(), "there are no counts", &song, &start_s);
  if (song.empty()) return {};
  return authoring::CountsOf(
      authoring::ReadMusic(song, std::numeric_limits<double>::infinity(), start_s));
}

}  // namespace choreo::cli
