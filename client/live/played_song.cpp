#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "client/live/sound.h"

namespace choreo::live {
namespace {

class PlayedSong final : public Sound {
 public:
  explicit PlayedSong(DecodedAudio song) : song_(std::move(song)) {}

  int sample_rate() const override { return song_.sample_rate; }
  int channels() const override { return song_.channels; }
  double seconds() const override { return song_.seconds(); }

  std::span<const float> Next() override {
    using Clock = std::chrono::steady_clock;
    if (!began_) began_ = Clock::now();
    const int64_t piece = std::llround(kPieceSeconds * song_.sample_rate);
    const int64_t from = played_;
    const int64_t count = std::min(piece, song_.samples() - from);
    played_ += count;
    const std::chrono::duration<double> sounded(static_cast<double>(played_) / song_.sample_rate);
    std::this_thread::sleep_until(*began_ + std::chrono::duration_cast<Clock::duration>(sounded));
    return std::span(song_.interleaved)
        .subspan(static_cast<size_t>(from * song_.channels),
                 static_cast<size_t>(count * song_.channels));
  }

 private:
  DecodedAudio song_;
  int64_t played_ = 0;
  std::optional<std::chrono::steady_clock::time_point> began_;
};

}  // namespace

std::unique_ptr<Sound> PlaySong(DecodedAudio song) {
  return std::make_unique<PlayedSong>(std::move(song));
}

}  // namespace choreo::live
