#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "model/core/error.h"
#include "model/core/npy.h"
#include "model/formats/amass_npz.h"
#include "model/motion/tang2018_skeleton.h"
#include "model/training/aist_recordings.h"
#include "model/training/bvh_recording.h"
#include "model/training/lafan1_recordings.h"
#include "model/training/prepare.h"

/// The layouts that `choreo-lab prepare` knows, each turned into Recordings.
namespace choreo {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kTangFps = 25;
constexpr double kTangMetresPerUnit = 0.01;
constexpr double kTangCutoffHz = 8;        // interpolated frames and jitter; dance steps stay below
constexpr double kTangTimeScale = 1.0125;  // waltz and rumba lock to their music here

fs::path FirstExisting(const std::vector<fs::path>& candidates) {
  for (const auto& path : candidates) {
    if (fs::exists(path)) return path;
  }
  return {};
}

// One row for the world's centre, then one for each joint relative to it.
int TangRows() { return 1 + static_cast<int>(Tang2018JointNames().size()); }

PositionClip TangPositions(int64_t frames,
                           const std::function<Eigen::Vector3d(int64_t, int)>& row) {
  PositionClip clip;
  clip.fps = kTangFps;
  clip.joint_names = Tang2018JointNames();
  const auto joints = static_cast<int>(clip.joint_names.size());
  for (int64_t f = 0; f < frames; ++f) {
    Eigen::Matrix3Xd positions(3, joints);
    for (int j = 0; j < joints; ++j) positions.col(j) = row(f, 0) + row(f, j + 1);
    clip.frames.push_back(positions * kTangMetresPerUnit);
  }
  return clip;
}

Recording Tang(const std::string& name, const PrepareOptions& options) {
  Recording recording;
  recording.name = name;
  recording.mapping = Tang2018Source();
  recording.tilted_floor = true;
  recording.expects_music = true;
  recording.cutoff_hz = kTangCutoffHz;
  const bool locked = name.rfind("DANCE_W", 0) == 0 || name.rfind("DANCE_R", 0) == 0;
  recording.time_scale = ForClip(options.time_scales, name, locked ? kTangTimeScale : 1.0);
  return recording;
}

// NAME.npy [frames, rows, 3] beside NAME.ogg (.wav, .mp3), which begins with the motion.
Recording ReadTangNpy(const fs::path& path, const PrepareOptions& options) {
  Recording recording = Tang(path.stem().string(), options);
  const NpyArray array = ReadNpy(path);
  const int rows = TangRows();
  if (array.shape.size() != 3 || array.shape[1] != rows || array.shape[2] != 3) {
    throw InvalidArgument(path.string(),
                          "its shape is not [frames, " + std::to_string(rows) + ", 3]");
  }
  const std::vector<double> values = array.As<double>();
  recording.positions = TangPositions(array.shape[0], [&](int64_t f, int r) {
    return Eigen::Vector3d(values.data() + (f * rows + r) * 3);
  });
  recording.music = FirstExisting({fs::path(path).replace_extension(".ogg"),
                                   fs::path(path).replace_extension(".wav"),
                                   fs::path(path).replace_extension(".mp3")});
  return recording;
}

// The public layout: NAME/skeletons.json, config.json (the dance's start and end frame within the
// music), audio.mp3.
Recording ReadTangFolder(const fs::path& folder, const PrepareOptions& options) {
  Recording recording = Tang(folder.filename().string(), options);
  const auto load = [](const fs::path& path) {
    std::ifstream file(path);
    if (!file) throw Error(ErrorCode::kNotFound, path.string(), "no such file");
    return json::parse(file);
  };
  const json skeletons = load(folder / "skeletons.json");
  const json& center = skeletons.at("center");
  const json& joints = skeletons.at("skeletons");
  const auto point = [](const json& p) {
    return Eigen::Vector3d(p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>());
  };
  recording.positions = TangPositions(
      static_cast<int64_t>(std::min(center.size(), joints.size())), [&](int64_t f, int r) {
        const auto frame = static_cast<size_t>(f);
        return r == 0 ? point(center.at(frame))
                      : point(joints.at(frame).at(static_cast<size_t>(r - 1)));
      });
  recording.music =
      FirstExisting({folder / "audio.mp3", folder / "audio.wav", folder / "audio.ogg"});
  recording.music_start_s =
      load(folder / "config.json").at("start_position").get<double>() / kTangFps;
  return recording;
}

Recording ReadAmassRecording(const fs::path& path, const std::string& name) {
  Recording recording;
  recording.name = name;
  recording.motion = ReadSmplMotion(NpzArchive::Read(path));
  return recording;
}

// Sources that are fitted to the skeleton of them all. Recordings that can't be read are left out
// here, and named when it is their turn.
std::vector<RecordingSource> OnNativeSkeleton(const std::vector<RecordingSource>& sources) {
  std::vector<PositionClip> clips;
  for (const RecordingSource& source : sources) {
    try {
      PositionClip clip = source.read().positions;
      ValidateClip(clip);
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

double ForClip(const std::vector<std::pair<std::string, double>>& values, const std::string& name,
               double otherwise) {
  for (const auto& [prefix, value] : values) {
    if (name.rfind(prefix, 0) == 0) return value;
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
        sources.push_back({path.stem().string(), [=] { return ReadTangNpy(path, options); }});
      } else if (path.filename() == "skeletons.json") {
        const fs::path folder = path.parent_path();
        sources.push_back(
            {folder.filename().string(), [=] { return ReadTangFolder(folder, options); }});
      }
    } else if (options.layout == "bvh" && path.extension() == ".bvh") {
      // Files of sub-folders are told apart by the folder: salsa/01.bvh is salsa_01.
      const fs::path relative = fs::relative(path, options.input);
      std::string name = path.stem().string();
      if (name.size() > 4 && name.ends_with("-BVH")) name.resize(name.size() - 4);
      const std::string parent = relative.parent_path().filename().string();
      if (!parent.empty() && parent != "bvh") name = parent + "_" + name;
      sources.push_back({name, [=] { return ReadBvhRecording(path, name, options); }});
    } else if (options.layout == "amass" && path.extension() == ".npz") {
      const std::string name = path.parent_path().filename().string() + "_" + path.stem().string();
      sources.push_back({name, [=] { return ReadAmassRecording(path, name); }});
    }
  }
  if (sources.empty()) {
    throw Error(ErrorCode::kNotFound, options.input.string(),
                "nothing of layout '" + options.layout + "' here");
  }
  std::sort(sources.begin(), sources.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  const auto twice =
      std::adjacent_find(sources.begin(), sources.end(),
                         [](const auto& a, const auto& b) { return a.name == b.name; });
  if (twice != sources.end()) {
    throw InvalidArgument(options.input.string(),
                          "two recordings would both become '" + twice->name + ".clip'");
  }
  return options.native_skeleton ? OnNativeSkeleton(sources) : sources;
}

}  // namespace choreo
