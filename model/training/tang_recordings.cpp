#include <algorithm>
#include <fstream>

#include "model/core/error.h"
#include "model/core/npy.h"
#include "model/training/recordings.h"

namespace choreo {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kFps = 25;
constexpr double kMetresPerUnit = 0.01;
constexpr double kCutoffHz = 8;        // interpolated frames and jitter; dance steps stay below
constexpr double kTimeScale = 1.0125;  // waltz and rumba lock to their music here
// Cha-chas, rumbas and waltzes have 0.04 to 0.34 of the power there, tangos less than 0.01.
constexpr double kLeastBeatPower = 0.02;

struct Metre {
  double beat_frames;
  int per_bar;
  double pulse_frames;  // the period at which dancers of this metre are fast and slow
};
constexpr Metre kFourFour = {12.5, 4, 25};
constexpr Metre kWaltz = {48.4 / 3, 3, 48.4};

// The music of this name, of whatever format; empty: none.
fs::path MusicOf(fs::path path) {
  for (const char* extension : {".ogg", ".wav", ".mp3"}) {
    if (fs::exists(path.replace_extension(extension))) return path;
  }
  return {};
}

bool IsWaltz(const std::string& name) { return name.starts_with("DANCE_W"); }

// Joint j of frame f stands at place(f, j).
PositionClip Positions(const std::vector<std::string>& names, int64_t frames,
                       const std::function<Eigen::Vector3d(int64_t, int)>& place) {
  PositionClip clip;
  clip.fps = kFps;
  clip.joint_names = names;
  const auto joints = static_cast<int>(names.size());
  for (int64_t f = 0; f < frames; ++f) {
    Eigen::Matrix3Xd positions(3, joints);
    for (int j = 0; j < joints; ++j) positions.col(j) = place(f, j);
    clip.frames.push_back(positions * kMetresPerUnit);
  }
  return clip;
}

// The rows of a file of shape [frames, rows, 3].
struct Rows {
  int64_t frames;
  int rows;
  std::vector<double> values;
  Eigen::Vector3d operator()(int64_t frame, int row) const {
    return Eigen::Vector3d(values.data() + (frame * rows + row) * 3);
  }
};

Rows ReadRows(const fs::path& path, int rows) {
  const NpyArray array = ReadNpy(path);
  if (array.shape.size() != 3 || array.shape[1] != rows || array.shape[2] != 3) {
    throw InvalidArgument(path.string(),
                          "its shape is not [frames, " + std::to_string(rows) + ", 3]");
  }
  return {array.shape[0], rows, array.As<double>()};
}

Recording Tang(const std::string& name, SourceMapping mapping, double time_scale) {
  Recording recording;
  recording.name = name;
  recording.mapping = std::move(mapping);
  recording.tilted_floor = true;
  recording.expects_music = true;
  recording.cutoff_hz = kCutoffHz;
  recording.time_scale = time_scale;
  return recording;
}

Recording Tang2018(const std::string& name, const PrepareOptions& options) {
  const bool locked = IsWaltz(name) || name.starts_with("DANCE_R");
  return Tang(name, Tang2018Source(),
              ForClip(options.time_scales, name, locked ? kTimeScale : 1.0));
}

}  // namespace

Recording ReadTang2018Npy(const fs::path& path, const PrepareOptions& options) {
  Recording recording = Tang2018(path.stem().string(), options);
  const Rows rows = ReadRows(path, 1 + static_cast<int>(Tang2018JointNames().size()));
  recording.positions =
      Positions(Tang2018JointNames(), rows.frames,
                [&](int64_t f, int j) -> Eigen::Vector3d { return rows(f, 0) + rows(f, j + 1); });
  recording.music = MusicOf(path);
  return recording;
}

Recording ReadTang2018Folder(const fs::path& folder, const PrepareOptions& options) {
  Recording recording = Tang2018(folder.filename().string(), options);
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
  recording.positions = Positions(
      Tang2018JointNames(), static_cast<int64_t>(std::min(center.size(), joints.size())),
      [&](int64_t f, int j) -> Eigen::Vector3d {
        const auto frame = static_cast<size_t>(f);
        return point(center.at(frame)) + point(joints.at(frame).at(static_cast<size_t>(j)));
      });
  recording.music = MusicOf(folder / "audio");
  recording.music_start_s = load(folder / "config.json").at("start_position").get<double>() / kFps;
  return recording;
}

Recording ReadTang61(const fs::path& path, const PrepareOptions& options) {
  const std::string name = path.stem().string();
  Recording recording = Tang(name, Tang61Source(), ForClip(options.time_scales, name, 1.0));
  const Rows rows = ReadRows(path, static_cast<int>(Tang61JointNames().size()));
  recording.positions = Positions(Tang61JointNames(), rows.frames, rows);
  recording.music = MusicOf(path);
  const Metre& metre = IsWaltz(name) ? kWaltz : kFourFour;
  if (SpeedPowerAt(recording.positions, metre.pulse_frames / kFps) >= kLeastBeatPower) {
    recording.beats = {.period_s = metre.beat_frames / kFps * recording.time_scale,
                       .per_bar = metre.per_bar};
  }
  return recording;
}

}  // namespace choreo
