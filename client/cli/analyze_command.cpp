#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "client/cli/commands.h"
#include "client/cli/music.h"
#include "client/cli/output_file.h"
#include "model/audio/mfcc.h"
#include "model/core/npy.h"

namespace choreo::cli {
namespace {

struct AnalyzeOptions {
  std::string song;
  bool json = false;
  std::string features;
};

void Run(const AnalyzeOptions& options) {
  if (!options.features.empty()) RequireWritable("--features", options.features);
  const Music music = ReadMusic(options.song);
  if (!options.features.empty()) {
    const FeatureMatrix rows = Mfcc(music.mono);
    WriteNpy(options.features, {{rows.rows(), rows.cols()},
                                std::vector<float>(rows.data(), rows.data() + rows.size())});
  }
  if (options.json) {
    nlohmann::ordered_json json;
    json["duration_s"] = music.audio.seconds();
    json["sample_rate"] = music.audio.sample_rate;
    json["tempo_bpm"] = music.tempo_bpm;
    json["beats"] = music.beats;
    std::cout << json.dump(2) << std::endl;
  } else {
    std::printf("%.2f s at %d Hz, %d channels; %.1f beats a minute, %zu beats\n",
                music.audio.seconds(), music.audio.sample_rate, music.audio.channels,
                music.tempo_bpm, music.beats.size());
  }
}

}  // namespace

void AddAnalyzeCommand(CLI::App& program) {
  auto options = std::make_shared<AnalyzeOptions>();
  CLI::App* command = program.add_subcommand(
      "analyze", "Show what is heard in a song: its tempo, beats and features.");
  command->add_option("song", options->song, "WAV, FLAC, Ogg or MP3 file.")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_flag("--json", options->json,
                    "Print duration_s, sample_rate, tempo_bpm and beats (seconds) as JSON.");
  command->add_option("--features", options->features,
                      "FILE.npy for the MFCC rows that the models hear: [rows, 40], 30 a second.");
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
