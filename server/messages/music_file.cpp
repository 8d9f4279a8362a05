#include "server/messages/music_file.h"

#include <algorithm>

#include "model/audio/decode/decode.h"
#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "server/messages/refusal.h"

namespace choreo {

void MusicBudget::Reserve(int64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (bytes > bytes_ - reserved_) {
    throw Refused(Refusal::kFileMusic,
                  "the server is full: incomplete music files hold " + std::to_string(reserved_) +
                      " bytes, this one needs " + std::to_string(bytes) + " more, at most " +
                      std::to_string(bytes_) + " are allowed in all (--max-file-music-mib)");
  }
  reserved_ += bytes;
}

void MusicBudget::GiveBack(int64_t bytes) {
  const std::lock_guard lock(mutex_);
  reserved_ -= bytes;
}

double MusicBudget::utilisation() const {
  const std::lock_guard lock(mutex_);
  return static_cast<double>(reserved_) / static_cast<double>(bytes_);
}

void MusicFile::Append(std::string_view bytes, const std::string& field) {
  const int64_t needed = size() + static_cast<int64_t>(bytes.size());
  if (needed > kMaxAudioFileBytes) {
    throw InvalidArgument(
        field, "the file is longer than " + std::to_string(kMaxAudioFileBytes) + " bytes");
  }
  if (needed > reserved_) {
    // Doubles, so that a byte is copied at most twice on average.
    const int64_t wanted = std::max(needed, std::min(2 * reserved_, kMaxAudioFileBytes));
    budget_.Reserve(wanted - reserved_);
    reserved_ = wanted;
    bytes_.reserve(static_cast<size_t>(wanted));
  }
  bytes_ += bytes;
}

void MusicFile::Clear() {
  bytes_ = {};
  budget_.GiveBack(reserved_);
  reserved_ = 0;
}

DecodedMusic DecodedMusic::Of(std::span<const std::byte> file,
                              const std::function<void()>& between) {
  DecodedMusic music;
  music.mono = DecodeMono(file, between, &music.notes);
  return music;
}

double DecodedMusic::seconds() const { return static_cast<double>(mono.size()) / kModelSampleRate; }

MusicAnalysis DecodedMusic::Analyse(const std::vector<double>& beats) const {
  return beats.empty() ? AnalyseMusic(mono) : AnalyseMusic(mono, beats);
}

}  // namespace choreo
