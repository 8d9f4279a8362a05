#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/formats/arrays/amass_npz.h"
#include "model/formats/containers/pickle.h"
#include "model/training/prepare/recordings.h"

namespace choreo {
namespace {

namespace fs = std::filesystem;

const std::set<std::string> kMusicExtensions = {".wav", ".mp3", ".ogg", ".flac"};

std::vector<std::string> ReadNames(const fs::path& path) {
  std::ifstream file(path);
  if (!file) throw Error(ErrorCode::kNotFound, path.string(), "no such file");
  return std::vector<std::string>(std::istream_iterator<std::string>(file), {});
}

/// The motions by name, except ignored ones.
std::map<std::string, fs::path> FindMotions(const fs::path& input) {
  const fs::path folder = input / "motions";
  if (!fs::is_directory(folder))
    throw Error(ErrorCode::kNotFound, folder.string(), "no such folder");
  std::map<std::string, fs::path> motions;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".pkl") motions[entry.path().stem().string()] = entry.path();
  }
  const fs::path ignored = input / "ignore_list.txt";
  if (fs::exists(ignored)) {
    for (const std::string& name : ReadNames(ignored)) motions.erase(name);
  }
  if (motions.empty())
    throw Error(ErrorCode::kNotFound, folder.string(), "no motion (*.pkl) that is not ignored");
  return motions;
}

std::map<std::string, fs::path> FindSongs(const fs::path& input) {
  std::map<std::string, fs::path> songs;
  for (const auto& entry : fs::recursive_directory_iterator(input)) {
    if (!kMusicExtensions.contains(entry.path().extension().string())) continue;
    fs::path& song = songs[entry.path().stem().string()];
    // Takes the first path of several, independent of the folder's order.
    if (song.empty() || entry.path() < song) song = entry.path();
  }
  return songs;
}

/// gBR_sBM_cAll_d04_mBR0_ch01 → mBR0.
std::string SongOf(const std::string& name) {
  const size_t end = name.rfind('_');
  const size_t begin = end == std::string::npos || end == 0 ? end : name.rfind('_', end - 1);
  if (begin == std::string::npos) {
    throw InvalidArgument(name,
                          "names no song: expected a name such as gBR_sBM_cAll_d04_mBR0_ch01");
  }
  return name.substr(begin + 1, end - begin - 1);
}

Recording ReadAistRecording(const std::string& name, const fs::path& path, const fs::path& song) {
  const NpzArchive arrays = ParsePickledArrays(ReadFile(path), path.string());
  // Without smpl_scaling, the motion would be read as another layout.
  for (const char* key : {"smpl_poses", "smpl_trans", "smpl_scaling"}) {
    if (!arrays.Has(key)) throw InvalidArgument(path.string(), std::string("has no ") + key);
  }
  const NpyArray scaling = arrays.Array("smpl_scaling");
  if (scaling.size() != 1 || !(scaling.As<double>()[0] > 0))
    throw InvalidArgument(path.string(), "smpl_scaling is not one number above 0");
  Recording recording;
  recording.genre = name.substr(0, name.find('_'));
  recording.motion = ReadSmplMotion(arrays, {.notes = &recording.notes});
  recording.ground = true;  // bodies differ from SMPL's neutral one
  recording.music = song;
  recording.expects_music = true;
  return recording;
}

}  // namespace

std::vector<RecordingSource> ListAistRecordings(const PrepareOptions& options) {
  const std::map<std::string, fs::path> songs = FindSongs(options.input);
  std::vector<RecordingSource> sources;
  for (const auto& [name, path] : FindMotions(options.input)) {
    sources.push_back({name, [=, name = name, path = path] {
                         const auto song = songs.find(SongOf(name));
                         return ReadAistRecording(name, path,
                                                  song == songs.end() ? fs::path() : song->second);
                       }});
  }
  return sources;
}

nlohmann::ordered_json AistSplits(const PrepareOptions& options) {
  std::map<std::string, std::string> list_of;  // by name
  nlohmann::ordered_json parts;
  for (const auto& [part, suffix] :
       {std::pair("train", "train"), {"validation", "val"}, {"test", "test"}}) {
    const std::string list = std::string("crossmodal_") + suffix + ".txt";
    const fs::path path = options.input / "splits" / list;
    parts[part] = nlohmann::ordered_json::array();
    for (const std::string& name : ReadNames(path)) {
      const auto [other, is_new] = list_of.emplace(name, list);
      if (!is_new) throw InvalidArgument(path.string(), name + " is in " + other->second + " too");
      parts[part].push_back(name);
    }
  }
  parts["unused"] = nlohmann::ordered_json::array();
  for (const auto& [name, path] : FindMotions(options.input)) {
    if (!list_of.contains(name)) parts["unused"].push_back(name);
  }
  return parts;
}

}  // namespace choreo
