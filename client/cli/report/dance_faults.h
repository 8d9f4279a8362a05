#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "client/cli/report/dance_settings.h"
#include "client/cli/report/time_format.h"
#include "model/motion/pose/motion_faults.h"

namespace choreo::cli {

/// A fault of a finished dance, in words.
struct DanceFault {
  MotionFault fault;  ///< at the rate of the report
  std::string joint_name;
  std::string message;
};

/// Finds the faults of a motion of any rate, in frames at `fps`.
std::vector<DanceFault> FindDanceFaults(const Skeleton& skeleton, const Motion& motion, double fps);

/// Each fault for programs: kind, frames, seconds and, if known, counts, joint, worst value, limit.
nlohmann::ordered_json FaultsJson(const std::vector<DanceFault>& faults, const TimeFormat& times);
/// A line each: "9c, 4.2 s to 4.6 s: left_foot: the foot slides 18 cm while it is on the floor".
std::string FaultLines(const std::vector<DanceFault>& faults, const TimeFormat& times);
/// One line, which says how many there are, without an end.
std::string CountFaults(const std::vector<DanceFault>& faults);
/// The last line about a dance: how many faults it has, and the command that lists them.
std::string FaultsText(const std::vector<DanceFault>& faults, const std::filesystem::path& dance);

/// The counts of a report's beats, or of a song from `start_s` on; without a name, of the report's
/// song. None without a song.
authoring::Counts CountsOf(const DanceSettings& settings, const std::filesystem::path& report,
                           std::string song = "", double start_s = 0);

}  // namespace choreo::cli
