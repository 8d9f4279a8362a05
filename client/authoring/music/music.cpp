#include "client/authoring/music/music.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/edit.h"
#include "model/audio/beats/beats.h"
#include "model/audio/beats/onset.h"
#include "model/audio/music/music_analysis.h"
#include "model/core/error.h"
#include "model/core/rounded.h"

namespace choreo::authoring {

namespace {

constexpr double kAll = std::numeric_limits<double>::infinity();

void KeepSamples(double seconds, DecodedAudio* audio) {
  const double samples = std::ceil(seconds * audio->sample_rate);
  if (samples >= static_cast<double>(audio->samples())) return;
  audio->interleaved.resize(static_cast<size_t>(samples) * static_cast<size_t>(audio->channels));
  audio->interleaved.shrink_to_fit();
}

}  // namespace

DecodedAudio ReadSong(const std::filesystem::path& path, double seconds, double start,
                      double more) {
  DecodedAudio audio = DecodeSong(path, seconds, start, more);
  if (audio.interleaved.empty()) {
    throw InvalidArgument("song_start", InFull(start) + " s is after the end of " + path.string() +
                                            " at " + Rounded(audio.end_s) + " s");
  }
  return audio;
}

Music ReadMusic(const std::filesystem::path& path, double seconds, double start,
                const BeatOptions& beats) {
  Music music;
  music.audio = ReadSong(path, seconds, start, kAll);
  music.mono = ToModelRate(music.audio);
  const std::vector<Onset> onsets = FindOnsets(music.mono);
  music.onset_strength = OnsetStrength(onsets);
  music.track = BeatsAsAsked(onsets, start, beats, music.mono);
  MusicAnalysis analysis = AnalyseMusic(music.mono, music.track.Seconds());
  music.passages = std::move(analysis.passages);
  music.energies = std::move(analysis.energies);
  music.id = analysis.id;
  KeepSamples(seconds + client::kMusicBeyond_s, &music.audio);
  return music;
}

void KeepFirst(double seconds, Music* music) {
  KeepSamples(seconds, &music->audio);
  BeatTrack& track = music->track;
  const std::vector<double> beats = BeatsBefore(*music, seconds);
  track.frames.resize(beats.size());
  track.in_bar.resize(beats.size());
  track.confidence.resize(beats.size());
  if (beats.size() != 1) track.tempo_bpm = TempoOf(beats);
  std::erase_if(music->passages,
                [seconds](const Passage& passage) { return passage.from >= seconds; });
}

double HeardSeconds(const Music& music) {
  return static_cast<double>(music.mono.size()) / kModelSampleRate;
}

Counts CountsOf(const Music& music) {
  return CountsFrom(music.track.Seconds(), music.track.DownbeatSeconds());
}

std::vector<double> BeatsBefore(const Music& music, double seconds) {
  std::vector<double> beats = music.track.Seconds();
  std::erase_if(beats, [seconds](double beat) { return beat >= seconds; });
  return beats;
}

void FillInMusic(const Music& music, double seconds, KnownMusic* known) {
  if (known->music_beats.empty()) {
    known->music_beats = music.track.Seconds();
    known->music_downbeats = music.track.DownbeatSeconds();
  }
  for (std::vector<double>* beats : {&known->music_beats, &known->music_downbeats})
    std::erase_if(*beats, [seconds](double beat) { return beat >= seconds; });
  known->music_id = music.id;
  known->music_energies = music.energies;
  known->music_passages = music.passages;
  std::erase_if(known->music_passages,
                [seconds](const Passage& passage) { return passage.from >= seconds; });
}

client::Audio AudioFor(const DecodedAudio& song, double seconds) {
  const auto samples =
      static_cast<int64_t>(std::ceil((seconds + client::kMusicBeyond_s) * song.sample_rate));
  const int64_t values = std::min(song.samples(), samples) * song.channels;
  client::Audio out;
  out.format = {client::AudioKind::kPcmFloat, song.sample_rate, song.channels};
  out.samples.assign(song.interleaved.begin(), song.interleaved.begin() + values);
  return out;
}

double Seconds(const client::Audio& audio) {
  return static_cast<double>(audio.samples.size()) / audio.format.channels /
         audio.format.sample_rate;
}

}  // namespace choreo::authoring
