// How well beats are heard: for songs with a tempo map (SONG.beats beside SONG.ogg: seconds, one a
// line), the F measure of what is found in the whole song (FindBeats) and of what a live dance of
// transitions of 2 s predicts (MusicBeats), from second 10 on, at 70 ms.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "model/audio/beats.h"
#include "model/audio/decode.h"
#include "model/core/grid.h"
#include "model/dance/music_beats.h"

namespace choreo::bench {
namespace {

constexpr double kFrom = 10, kTolerance = 0.07;  // seconds

double FMeasure(std::vector<double> found, std::vector<double> map) {
  const auto early = [](double time) { return time < kFrom; };
  std::erase_if(found, early);
  std::erase_if(map, early);
  size_t hits = 0;
  for (size_t i = 0, j = 0; i < found.size() && j < map.size();) {
    if (std::abs(found[i] - map[j]) <= kTolerance) {
      ++hits, ++i, ++j;
    } else {
      found[i] < map[j] ? ++i : ++j;
    }
  }
  const size_t all = found.size() + map.size();
  return all == 0 ? 0 : 2.0 * static_cast<double>(hits) / static_cast<double>(all);
}

std::vector<double> ReadMap(const std::filesystem::path& song, double shift) {
  std::filesystem::path path = song;
  std::ifstream file(path.replace_extension(".beats"));
  std::vector<double> map;
  for (double time = 0; file >> time;) map.push_back(time + shift);
  return map;
}

struct Live {
  std::vector<double> beats;
  double certain = 0;  // share of the transitions that have beats
  double milliseconds = 0;
};

Live Hear(const std::vector<float>& mono) {
  AudioFeed feed(kModelSampleRate, 1, 0);
  feed.Push(mono, 0, [] {});
  MusicBeats music(30, {}, std::nullopt, &feed);
  Live live;
  int transitions = 0, with = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int64_t from = 0; from + kUsualFrames <= feed.ready(); from += kUsualFrames, ++transitions) {
    with += !music.Around(from, from + kUsualFrames).empty();
    for (int64_t frame = from; frame < from + kUsualFrames; ++frame) music.Of(frame);
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  live.beats = music.told();
  live.certain = static_cast<double>(with) / transitions;
  live.milliseconds = 1000 * spent.count() / transitions;
  return live;
}

}  // namespace
}  // namespace choreo::bench

int main(int argc, char** argv) {
  using namespace choreo;
  CLI::App program("Compares beats heard live with those found in the whole song.");
  std::vector<std::string> songs;
  double shift = 0;
  program.add_option("songs", songs, "Songs, each with its tempo map SONG.beats beside it.")
      ->required()
      ->check(CLI::ExistingFile);
  program.add_option("--shift", shift,
                     "Seconds by which the songs' onsets lie behind their tempo maps.");
  CLI11_PARSE(program, argc, argv);
  std::printf("%-34s %8s %8s %8s %8s %8s %10s\n", "song", "F whole", "F live", "live/wh.", "first",
              "certain", "ms a trans.");
  for (const std::string& song : songs) {
    const std::vector<float> mono = ToModelRate(DecodeAudioFile(song));
    const std::vector<double> map = bench::ReadMap(song, shift);
    const double whole = bench::FMeasure(FindBeats(mono).Seconds(), map);
    const bench::Live live = bench::Hear(mono);
    const double f = bench::FMeasure(live.beats, map);
    std::printf("%-34s %8.2f %8.2f %8.2f %7.1fs %8.2f %10.2f\n",
                std::filesystem::path(song).stem().c_str(), whole, f, f / whole,
                live.beats.empty() ? -1 : live.beats.front(), live.certain, live.milliseconds);
  }
  return 0;
}
