#include <algorithm>
#include <fstream>

#include "model/core/error.h"
#include "model/core/files/npy.h"
#include "model/training/prepare/recordings.h"

namespace choreo {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kFps = 25;
constexpr double kMetresPerUnit = 0.01;
constexpr double kCutoffHz = 8;        // removes interpolated frames and jitter, keeps dance steps
constexpr double kTimeScale = 1.0125;  // with this factor, waltz and rumba match their music
// Cha-chas, rumbas and waltzes have 0.04 to 0.34 of the power at the beat, tangos less than 0.01.
constexpr double kMinBeatPower = 0.02;

struct Metre {
  double beat_frames;
  int per_bar;
  double pulse_frames;  // the period of the metre's fast and slow steps
};
constexpr Metre kFourFour = {12.5, 4, 25};
constexpr Metre kWaltz = {48.4 / 3, 3, 48.4};

// The music with this name in any format; empty: none.
fs::path MusicOf(fs::path path) {
  for (const char* extension : {".ogg", ".wav", ".mp3"}) {
    if (fs::exists(path.replace_extension(extension))) return path;
  }
  return {};
}

bool IsWaltz(const std::string& name) { return name.starts_with("DANCE_W"); }

using Frames = std::vector<Eigen::Matrix3Xd>;

PositionClip InMetres(const std::vector<std::string>& names, Frames frames) {
  for (Eigen::Matrix3Xd& frame : frames) frame *= kMetresPerUnit;
  return {.fps = kFps, .joint_names = names, .frames = std::move(frames)};
}

// Frames of [3, rows] from a file of shape [frames, rows, 3].
Frames ReadRows(const fs::path& path, int rows) {
  const NpyArray array = ReadNpy(path);
  if (array.shape.size() != 3 || array.shape[1] != rows || array.shape[2] != 3) {
    throw InvalidArgument(path.string(),
                          "its shape is not [frames, " + std::to_string(rows) + ", 3]");
  }
  const std::vector<double> values = array.As<double>();
  Frames frames;
  for (int64_t f = 0; f < array.shape[0]; ++f)
    frames.emplace_back(Eigen::Map<const Eigen::Matrix3Xd>(values.data() + 3 * rows * f, 3, rows));
  return frames;
}

Recording Tang(SourceMapping mapping, double time_scale) {
  Recording recording;
  recording.mapping = std::move(mapping);
  recording.tilted_floor = true;
  recording.expects_music = true;
  recording.cutoff_hz = kCutoffHz;
  recording.time_scale = time_scale;
  return recording;
}

Recording Tang2018(const std::string& name, const PrepareOptions& options) {
  const bool locked = IsWaltz(name) || name.starts_with("DANCE_R");
  return Tang(Tang2018Source(), ForClip(options.time_scales, name, locked ? kTimeScale : 1.0));
}

}  // namespace

Recording ReadTang2018Npy(const fs::path& path, const PrepareOptions& options) {
  Recording recording = Tang2018(path.stem().string(), options);
  Frames frames = ReadRows(path, 1 + static_cast<int>(Tang2018JointNames().size()));
  for (Eigen::Matrix3Xd& frame : frames)
    frame = (frame.rightCols(frame.cols() - 1).colwise() + frame.col(0)).eval();
  recording.positions = InMetres(Tang2018JointNames(), std::move(frames));
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
  Frames frames(std::min(center.size(), joints.size()),
                Eigen::Matrix3Xd(3, Tang2018JointNames().size()));
  for (size_t f = 0; f < frames.size(); ++f) {
    for (Eigen::Index j = 0; j < frames[f].cols(); ++j)
      frames[f].col(j) = point(center.at(f)) + point(joints.at(f).at(j));
  }
  recording.positions = InMetres(Tang2018JointNames(), std::move(frames));
  recording.music = MusicOf(folder / "audio");
  recording.music_start_s = load(folder / "config.json").at("start_position").get<double>() / kFps;
  return recording;
}

Recording ReadTang61(const fs::path& path, const PrepareOptions& options) {
  const std::string name = path.stem().string();
  Recording recording = Tang(Tang61Source(), ForClip(options.time_scales, name, 1.0));
  recording.positions =
      InMetres(Tang61JointNames(), ReadRows(path, static_cast<int>(Tang61JointNames().size())));
  recording.music = MusicOf(path);
  const Metre& metre = IsWaltz(name) ? kWaltz : kFourFour;
  if (SpeedPowerAt(recording.positions, metre.pulse_frames / kFps) >= kMinBeatPower) {
    recording.beats = {.period_s = metre.beat_frames / kFps * recording.time_scale,
                       .per_bar = metre.per_bar};
  }
  return recording;
}

}  // namespace choreo
