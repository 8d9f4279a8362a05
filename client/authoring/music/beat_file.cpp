#include "client/authoring/music/beat_file.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "model/audio/beats/onset.h"
#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/core/text/printable.h"

namespace choreo::authoring {
namespace {

constexpr double kMaxSongSeconds = 1e6;  // of a song, of which the dance may use only a part
constexpr std::streamsize kMaxLineLength = 1000;

WrittenBeat ParseBeat(const std::string& line, const std::string& field) {
  std::istringstream words(line);
  std::string second, count, rest;
  words >> second >> count >> rest;
  WrittenBeat beat;
  const auto read = [](const std::string& word, auto* number) {
    const char* end = word.data() + word.size();
    const auto [at, error] = std::from_chars(word.data(), end, *number);
    return error == std::errc() && at == end;
  };
  if (!rest.empty() || !read(second, &beat.second) || !(beat.second >= 0) ||
      beat.second > kMaxSongSeconds) {
    throw InvalidArgument(field, '"' + Printable(line) +
                                     "\" is not a beat: a second of the song, as in 12.5, and, if "
                                     "known, its count in the bar");
  }
  if (!count.empty() &&
      (!read(count, &beat.count) || beat.count < 1 || beat.count > kMaxBeatsInBar)) {
    throw InvalidArgument(field, '"' + Printable(count) +
                                     "\" is not a count in a bar, must be 1 to " +
                                     std::to_string(kMaxBeatsInBar));
  }
  return beat;
}

}  // namespace

void RequireGap(double before, double beat, const std::string& field) {
  if (beat - before >= 1 / kOnsetRate) return;
  throw InvalidArgument(field, "is " + Rounded(beat - before) +
                                   " s after the beat before it, must be 1/" + Rounded(kOnsetRate) +
                                   " s or more");
}

std::vector<WrittenBeat> ReadBeatFile(const std::string& path, double from) {
  if (!std::filesystem::is_regular_file(path))
    throw Error(ErrorCode::kNotFound, "beats", path + " is not a file");
  std::ifstream file(path);
  std::vector<WrittenBeat> beats;
  double last = -1;
  std::string line(kMaxLineLength, '\0');
  for (int number = 1; file.getline(line.data(), kMaxLineLength) || file.gcount() > 0; ++number) {
    const std::string field = path + ":" + std::to_string(number);
    if (file.fail()) throw InvalidArgument(field, "is too long for the line of a beat");
    std::string text = line.c_str();
    if (number == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    text = text.substr(0, text.find('#'));
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    const WrittenBeat beat = ParseBeat(text, field);
    RequireGap(last, beat.second, field);
    last = beat.second;
    if (beats.size() >= kMaxBeats)
      throw InvalidArgument(field, "is beat " + std::to_string(kMaxBeats + 1) + ", the limit is " +
                                       std::to_string(kMaxBeats));
    if (beat.second >= from) beats.push_back(beat);
  }
  if (last < 0) throw InvalidArgument("beats", path + " is empty, but for comments");
  return beats;
}

}  // namespace choreo::authoring
