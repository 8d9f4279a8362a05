#include "model/training/prepare/recordings.h"

#include <algorithm>
#include <memory>

#include "model/core/error.h"
#include "model/fit/solver/bone_normaliser.h"
#include "model/fit/sources/tang2018_skeleton.h"
#include "model/formats/arrays/amass_npz.h"
#include "model/formats/bvh/bvh.h"

namespace choreo {
namespace {

namespace fs = std::filesystem;

// Fits sources to a skeleton made from all of them. Skips unreadable recordings, which are named
// later, when they are read.
std::vector<RecordingSource> OnNativeSkeleton(const std::vector<RecordingSource>& sources) {
  std::vector<PositionClip> clips;
  for (const RecordingSource& source : sources) {
    try {
      PositionClip clip = source.read().positions;
      CheckClip(clip);
      clips.push_back(std::move(clip));
    } catch (const std::exception&) {
    }
  }
  const auto native = std::make_shared<const NativeTang2018>(MeasureTang2018(clips));
  std::vector<RecordingSource> fitted;
  for (const RecordingSource& source : sources) {
    fitted.push_back({source.name, [source, native] {
                        Recording recording = source.read();
                        recording.mapping = native->mapping;
                        recording.skeleton = native->skeleton;
                        return recording;
                      }});
  }
  return fitted;
}

}  // namespace

Recording ReadBvhRecording(const std::filesystem::path& path, const std::string& name,
                           const PrepareOptions& options) {
  Recording recording;
  const BvhFile bvh = ReadBvh(path);
  recording.positions = BvhToPositions(bvh, 1.0);
  recording.positions.fps = ForClip(options.frame_rates, name, bvh.fps());
  recording.mapping = BvhSource(recording.positions);
  // A BVH does not state its unit. The length of the dancer's legs distinguishes centimetres from
  // inches.
  const BoneNormaliser normaliser(recording.skeleton, recording.mapping,
                                  recording.positions.joint_names);
  const double scale = normaliser.Measure(recording.positions).scale;
  for (auto& frame : recording.positions.frames) frame *= scale;
  recording.time_scale = ForClip(options.time_scales, name, 1.0);
  return recording;
}

double ForClip(const std::vector<std::pair<std::string, double>>& values, const std::string& name,
               double otherwise) {
  for (const auto& [prefix, value] : values) {
    if (name.starts_with(prefix)) return value;
  }
  return otherwise;
}

std::vector<RecordingSource> ListRecordings(const PrepareOptions& options) {
  if (options.native_skeleton && options.layout != "tang2018") {
    throw InvalidArgument("--native-skeleton",
                          "is for tang2018, '" + options.layout + "' is fitted to SMPL's skeleton");
  }
  if (!fs::is_directory(options.input)) {
    throw Error(ErrorCode::kNotFound, options.input.string(), "no such folder");
  }
  if (options.layout == "aist") return ListAistRecordings(options);
  if (options.layout == "lafan1") return ListLafan1Recordings(options);
  std::vector<RecordingSource> sources;
  for (const auto& entry : fs::recursive_directory_iterator(options.input)) {
    const fs::path path = entry.path();
    if (options.layout == "tang2018") {
      if (path.extension() == ".npy") {
        sources.push_back({path.stem().string(), [=] { return ReadTang2018Npy(path, options); }});
      } else if (path.filename() == "skeletons.json") {
        const fs::path folder = path.parent_path();
        sources.push_back(
            {folder.filename().string(), [=] { return ReadTang2018Folder(folder, options); }});
      }
    } else if (options.layout == "tang61" && path.extension() == ".npy") {
      sources.push_back({path.stem().string(), [=] { return ReadTang61(path, options); }});
    } else if (options.layout == "bvh" && path.extension() == ".bvh") {
      // Sub-folders become part of the name: salsa/01.bvh is salsa_01.
      const fs::path relative = fs::relative(path, options.input);
      std::string name = path.stem().string();
      if (name.size() > 4 && name.ends_with("-BVH")) name.resize(name.size() - 4);
      const std::string parent = relative.parent_path().filename().string();
      if (!parent.empty() && parent != "bvh") name = parent + "_" + name;
      sources.push_back({name, [=] { return ReadBvhRecording(path, name, options); }});
    } else if (options.layout == "amass" && path.extension() == ".npz") {
      const std::string name = path.parent_path().filename().string() + "_" + path.stem().string();
      sources.push_back({name, [=] {
                           Recording recording;
                           recording.motion = ReadSmplMotion(NpzArchive::Read(path));
                           return recording;
                         }});
    }
  }
  if (sources.empty()) {
    throw Error(ErrorCode::kNotFound, options.input.string(),
                "nothing of layout '" + options.layout + "' here");
  }
  std::ranges::sort(sources, {}, &RecordingSource::name);
  const auto twice = std::ranges::adjacent_find(sources, {}, &RecordingSource::name);
  if (twice != sources.end()) {
    throw InvalidArgument(options.input.string(),
                          "two recordings would both become '" + twice->name + ".clip'");
  }
  return options.native_skeleton ? OnNativeSkeleton(sources) : sources;
}

nlohmann::ordered_json SplitsOf(const PrepareOptions& options) {
  if (options.layout == "aist") return AistSplits(options);
  if (options.layout == "lafan1") return Lafan1Splits(options);
  return {};
}

}  // namespace choreo
