#include "client/cli/dance/stage_dance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <iterator>
#include <utility>

#include "client/authoring/notes/notes.h"
#include "client/authoring/project/formation.h"
#include "client/cli/report/report.h"
#include "client/cli/report/report_controls.h"
#include "model/core/files/atomic_file.h"
#include "model/core/files/small_extension.h"
#include "model/core/joined.h"
#include "model/core/rounded.h"
#include "model/formats/gltf/gltf.h"
#include "model/motion/rotation.h"

namespace choreo::cli {
namespace {

namespace fs = std::filesystem;

fs::path PathOf(const authoring::Dancer& dancer, const fs::path& path) {
  fs::path own = path;
  return own.replace_filename(path.stem().string() + "." + dancer.id + path.extension().string());
}

bool HoldsAll(const fs::path& out) { return SmallExtension(out) == ".glb"; }

/// A dancer's options: the dancer's own and, for the others, the common ones.
DanceOptions OwnOptions(const DanceOptions& options, const authoring::Dancer& dancer,
                        const std::string& field) {
  DanceOptions own = options;
  if (!options.end.empty()) own.after = dancer.after, own.after_name = field + ".after";
  own.way_seed = options.seed.value_or(0);
  if (dancer.seed) own.seed = dancer.seed;
  if (!dancer.keyframes.empty()) own.keys = dancer.keyframes;
  if (!dancer.style.empty()) own.style = dancer.style, own.style_name = field + ".style";
  return own;
}

bool SameDance(const DanceOptions& a, const DanceOptions& b) {
  const auto after = [](const DanceOptions& options) {
    const auto time = options.after.value_or(authoring::WrittenTime());
    return std::pair(time.amount, time.counts);
  };
  return a.seed == b.seed && a.style == b.style && a.keys == b.keys && after(a) == after(b);
}

/// A dance and its dancers.
struct Shared {
  PlannedDance plan;
  fs::path out;  ///< the output file of the first of these dancers
  Performance performance = {};

  const std::string& names() const { return plan.options.dancers_named; }
};

/// Notes on dances that are planned. Tells each once, in the end: with the names of the dancers
/// whom it is about, unless it is about all.
class PlanNotes {
 public:
  explicit PlanNotes(size_t dances) : dances_(dances) {}
  PlanNotes(const PlanNotes&) = delete;
  PlanNotes& operator=(const PlanNotes&) = delete;
  ~PlanNotes() {
    for (const auto& [line, about] : notes_) {
      const std::string names = Joined(about, std::identity());
      authoring::Note(about.size() == dances_ ? line : authoring::NoteAbout(names, line));
    }
  }

  void Add(const std::string& names, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      auto known = std::ranges::find(notes_, line, &std::pair<std::string, Names>::first);
      if (known == notes_.end()) {
        notes_.emplace_back(line, Names());
        known = std::prev(notes_.end());
      }
      if (std::ranges::find(known->second, names) == known->second.end())
        known->second.push_back(names);
    }
  }

 private:
  using Names = std::vector<std::string>;
  size_t dances_;
  std::vector<std::pair<std::string, Names>> notes_;  // lines, and names of the dances
};

/// Plans each different dance once; returns the index of each dancer's dance.
std::vector<Shared> PlanAll(const DanceOptions& options, const authoring::Dancers& stage,
                            const std::optional<authoring::Music>& music,
                            const Connection& connection, const fs::path& out,
                            std::vector<size_t>* dance_of) {
  std::vector<DanceOptions> asked;
  std::vector<fs::path> outs;
  for (size_t i = 0; i < stage.dancers.size(); ++i) {
    const authoring::Dancer& dancer = stage.dancers[i];
    DanceOptions own =
        OwnOptions(options, dancer, options.dancers + ":dancers[" + std::to_string(i) + "]");
    const auto same = std::ranges::find_if(
        asked, [&](const DanceOptions& other) { return SameDance(other, own); });
    dance_of->push_back(static_cast<size_t>(same - asked.begin()));
    if (same != asked.end()) {
      same->dancers_named += ", " + dancer.id;
      continue;
    }
    own.dancers_named = dancer.id;
    asked.push_back(std::move(own));
    outs.push_back(PathOf(dancer, out));
  }
  PlanNotes notes(asked.size());
  std::vector<Shared> dances;
  for (size_t i = 0; i < asked.size(); ++i) {
    const authoring::NotesApart apart;
    try {
      dances.push_back({Plan(asked[i], music, connection), outs[i]});
    } catch (...) {
      notes.Add(asked[i].dancers_named, apart.lines());
      throw;
    }
    notes.Add(asked[i].dancers_named, apart.lines());
  }
  return dances;
}

/// How many frames later each dancer begins.
std::vector<int64_t> DelaysOf(const DanceOptions& options, const authoring::Dancers& stage,
                              const std::vector<Shared>& dances,
                              const std::vector<size_t>& dance_of) {
  std::vector<int64_t> delays;
  for (size_t i = 0; i < stage.dancers.size(); ++i) {
    const PlannedDance& plan = dances[dance_of[i]].plan;
    const std::string field = options.dancers + ":dancers[" + std::to_string(i) + "].after";
    delays.push_back(authoring::FramesLater(stage.dancers[i].after, plan.config.known.music_beats,
                                            plan.length.fps, plan.length.frames, field));
  }
  return delays;
}

/// Delays a dance's keys and beats; drops keys after the end.
WrittenDance Later(WrittenDance written, int64_t delay) {
  const int64_t in_file = std::llround(static_cast<double>(delay) / written.fps * written.file_fps);
  written.keys = Moved(std::move(written.keys), delay, in_file);
  for (client::Warning& warning : written.warnings) warning.frame += delay;
  const auto is_over = [&](int64_t frame) { return frame >= written.figures.frames; };
  std::erase_if(written.keys, [&](const auto& key) { return is_over(key.first); });
  std::erase_if(written.warnings, [&](const client::Warning& w) { return is_over(w.frame); });
  return written;
}

/// Mirrors, delays, turns and moves a dance's controls for this dancer. `apart`: how far KeepApart
/// moved the dancer.
ControlRequest OnStage(ControlRequest controls, const authoring::Dancer& dancer, int64_t delay,
                       const Eigen::Vector3d& apart) {
  if (dancer.mirrored) controls = Mirrored(std::move(controls));
  controls = Delayed(std::move(controls), delay);
  if (!controls.root_path) return controls;
  const Eigen::Rotation2Dd turn(-dancer.facing / kDegrees);  // x, z
  for (Eigen::Vector2d& point : controls.root_path->points)
    point = turn * point + dancer.place + Eigen::Vector2d(apart.x(), apart.z());
  return controls;
}

/// Moves dancers apart if they would come too near, and prints how near they are.
void SeparateDancers(const authoring::Dancers& stage, const Skeleton& skeleton,
                     std::vector<client::FinishedDance>* dances) {
  const auto [factor, nearest, asked] =
      authoring::KeepApart(stage.dancers, stage.apart, skeleton, dances);
  if (!nearest) return;
  const auto who = [&](const authoring::NearestPair& pair) {
    return stage.dancers[pair.one].id + " and " + stage.dancers[pair.other].id;
  };
  const auto when = [&](const authoring::NearestPair& pair) {
    const double fps = dances->front().motion.fps;
    return Rounded(static_cast<double>(pair.distance.frame) / fps) + " s";
  };
  std::cout << "least distance between bodies: " << Rounded(nearest->distance.metres) << " m, "
            << who(*nearest) << " at " << when(*nearest) << '\n';
  if (asked) {
    std::cerr << "note: places are " << Rounded(factor)
              << " times as far from their middle as requested, so that bodies stay "
              << Rounded(stage.apart) << " m apart: " << who(*asked) << " would come to "
              << Rounded(asked->distance.metres) << " m at " << when(*asked) << '\n';
  }
  if (nearest->distance.metres < 0) {
    std::cerr << "warning: " << who(*nearest) << " reach " << Rounded(-nearest->distance.metres)
              << " m into each other at " << when(*nearest)
              << ": \"apart\": 0 keeps their places\n";
  }
}

}  // namespace

std::vector<fs::path> OutputsOf(const authoring::Dancers& stage, const fs::path& out) {
  if (HoldsAll(out)) return {out};
  std::vector<fs::path> outputs;
  for (const authoring::Dancer& dancer : stage.dancers) outputs.push_back(PathOf(dancer, out));
  return outputs;
}

std::vector<fs::path> ReportsOf(const authoring::Dancers& stage, const fs::path& report) {
  std::vector<fs::path> reports;
  for (const authoring::Dancer& dancer : stage.dancers)
    if (!report.empty()) reports.push_back(PathOf(dancer, report));
  return reports;
}

void DanceTogether(const DanceOptions& options, const authoring::Dancers& stage,
                   const std::optional<authoring::Music>& music, const Connection& connection,
                   const fs::path& out) {
  std::vector<size_t> dance_of;
  std::vector<Shared> shared = PlanAll(options, stage, music, connection, out, &dance_of);
  const std::vector<int64_t> delays = DelaysOf(options, stage, shared, dance_of);
  // Checks all dances before generating the first one, which takes long.
  for (Shared& dance : shared) {
    std::optional<VmcShow> none;
    dance.performance = Perform(dance.plan, connection, dance.out, &none);
  }
  for (const Shared& dance : shared)
    std::cout << dance.names() << ":\n"
              << ReportText(dance.performance.written)
              << (HoldsAll(out) ? CountFaults(dance.performance.written.faults) + "\n"
                                : FaultsText(dance.performance.written.faults, dance.out));

  const Skeleton& skeleton = shared.front().performance.dance.header.skeleton;
  std::vector<client::FinishedDance> dances;
  for (size_t i = 0; i < stage.dancers.size(); ++i) {
    const client::DanceResult& danced = shared[dance_of[i]].performance.dance;
    const double seconds = static_cast<double>(delays[i]) / danced.header.model_fps;
    dances.push_back(authoring::OnStage(skeleton, stage.dancers[i],
                                        {danced.motion, danced.contacts},
                                        std::llround(seconds * danced.motion.fps)));
  }
  std::vector<Eigen::Vector3d> places;
  for (const client::FinishedDance& dance : dances)
    places.push_back(dance.motion.frames.front().root_position);
  SeparateDancers(stage, skeleton, &dances);
  const std::vector<fs::path> outputs = OutputsOf(stage, out);
  if (HoldsAll(out)) {
    std::vector<NamedMotion> motions;
    for (size_t i = 0; i < dances.size(); ++i)
      motions.push_back({stage.dancers[i].id, dances[i].motion});
    WriteGlb(out, skeleton, motions);
  } else {
    for (size_t i = 0; i < dances.size(); ++i)
      options.bvh.Write(outputs[i], skeleton, dances[i].motion, dances[i].contacts);
  }
  const std::vector<fs::path> reports = ReportsOf(stage, options.report);
  for (size_t i = 0; i < reports.size(); ++i) {
    WrittenDance written = Later(shared[dance_of[i]].performance.written, delays[i]);
    const Eigen::Vector3d apart = dances[i].motion.frames.front().root_position - places[i];
    written.settings.controls =
        OnStage(std::move(written.settings.controls), stage.dancers[i], delays[i], apart);
    written.sketch = SketchOf(dances[i].motion, written.figures.frames, written.fps);
    written.faults = FindDanceFaults(skeleton, dances[i].motion, written.fps);
    WriteFile(reports[i], ReportJson(written));
  }
  for (const fs::path& output : outputs) std::cout << output.string() << std::endl;
  for (const Shared& dance : shared) CheckKeys(dance.performance.written);
}

}  // namespace choreo::cli
