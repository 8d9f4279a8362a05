#include "client/cli/music.h"

#include <algorithm>
#include <cmath>

#include "model/audio/beats.h"

namespace choreo::cli {

Music ReadMusic(const std::filesystem::path& path) {
  Music music;
  music.audio = DecodeAudioFile(path);
  music.mono = ToModelRate(music.audio);
  const BeatTrack beats = FindBeats(music.mono);
  music.tempo_bpm = beats.tempo_bpm;
  music.beats = beats.Seconds();
  return music;
}

client::Audio AudioFor(const Music& music, double seconds) {
  // The last frames hear a little beyond themselves.
  constexpr double kAfterglow = 0.5;
  const DecodedAudio& audio = music.audio;
  const auto samples = static_cast<int64_t>(std::ceil((seconds + kAfterglow) * audio.sample_rate));
  const int64_t values = std::min(audio.samples(), samples) * audio.channels;
  client::Audio out;
  out.format = {client::AudioKind::kPcmFloat, audio.sample_rate, audio.channels};
  out.samples.assign(audio.interleaved.begin(), audio.interleaved.begin() + values);
  return out;
}

}  // namespace choreo::cli
