#include "model/lab/hear_songs.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "model/core/error.h"
#include "model/evaluation/eval_report.h"
#include "model/evaluation/tables/hearing_table.h"
#include "model/samplers/samplers.h"

#ifdef CHOREO_SERVICE
#include "model/audio/decode/decode.h"
#endif

namespace choreo {
namespace {

using Path = std::filesystem::path;

std::vector<Path> SongsIn(const Path& place) {
  if (!std::filesystem::is_directory(place)) return {place};
  static const std::array<std::string, 4> kinds{".wav", ".flac", ".ogg", ".mp3"};
  std::vector<Path> songs;
  for (const auto& entry : std::filesystem::directory_iterator(place)) {
    if (std::ranges::count(kinds, entry.path().extension().string()) > 0)
      songs.push_back(entry.path());
  }
  if (songs.empty()) throw InvalidArgument("--music", place.string() + " has no song");
  std::ranges::sort(songs);
  return songs;
}

NamedSong ReadSong([[maybe_unused]] const Path& path) {
#ifdef CHOREO_SERVICE
  return {path.stem(), ToModelRate(DecodeAudioFile(path))};
#else
  throw InvalidArgument("--music", "this build reads no songs: CHOREO_SERVICE is off");
#endif
}

}  // namespace

void HearSongs(const HearArguments& arguments) {
  if (!arguments.json.empty()) CheckReportPath(arguments.json);
  std::vector<NamedSong> songs;
  for (const Path& place : arguments.music) {
    for (const Path& path : SongsIn(place)) songs.push_back(ReadSong(path));
  }
  std::vector<std::unique_ptr<Sampler>> samplers;
  samplers.push_back(MakeSampler(arguments.model, Device{}));
  const ModelInfo model = samplers.front()->model();
  SampleQueue queue(std::move(samplers), {});
  const Table table = EvaluateHearing(queue, songs);
  std::printf("%s", ToMarkdown(table).c_str());
  if (arguments.json.empty()) return;
  WriteReport(arguments.json, {{"model", model.name}, {"fingerprint", model.fingerprint}}, {table});
}

}  // namespace choreo
