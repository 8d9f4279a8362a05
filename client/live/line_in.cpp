#include <alsa/asoundlib.h>

#include <vector>

#include "client/live/sound.h"
#include "model/core/error.h"

namespace choreo::live {
namespace {

constexpr unsigned kRate = 44100;           // every sound card supports it
constexpr unsigned kBufferMicros = 200000;  // the longest time between reads without loss

void KeepQuiet(const char*, int, const char*, int, const char*, ...) {}

class LineIn final : public Sound {
 public:
  explicit LineIn(const std::string& device) : device_(device), samples_(kPiece) {
    // Silences ALSA, because our errors explain failures in one line.
    snd_lib_error_set_handler(KeepQuiet);
    Check(snd_pcm_open(&pcm_, device.c_str(), SND_PCM_STREAM_CAPTURE, 0));
    const int code = snd_pcm_set_params(pcm_, SND_PCM_FORMAT_FLOAT, SND_PCM_ACCESS_RW_INTERLEAVED,
                                        1, kRate, /*soft_resample=*/1, kBufferMicros);
    if (code >= 0) return;
    snd_pcm_close(pcm_);
    Check(code);
  }
  ~LineIn() override { snd_pcm_close(pcm_); }

  int sample_rate() const override { return kRate; }
  int channels() const override { return 1; }

  std::span<const float> Next() override {
    snd_pcm_sframes_t read = snd_pcm_readi(pcm_, samples_.data(), samples_.size());
    // After an overrun, continues with the present sound; the lost sound cannot be recovered.
    for (int tries = 0; read < 0 && tries < 3; ++tries) {
      snd_pcm_recover(pcm_, static_cast<int>(read), /*silent=*/1);
      read = snd_pcm_readi(pcm_, samples_.data(), samples_.size());
    }
    if (read < 0) {
      throw Error(ErrorCode::kUnavailable, "--input",
                  "\"" + device_ + "\" is lost: " + snd_strerror(static_cast<int>(read)));
    }
    return std::span(samples_).first(static_cast<size_t>(read));
  }

 private:
  static constexpr auto kPiece = static_cast<size_t>(kPieceSeconds * kRate);

  void Check(int code) const {
    if (code >= 0) return;
    throw Error(ErrorCode::kNotFound, "--input",
                "\"" + device_ + "\" can't be opened: " + snd_strerror(code) +
                    "; `arecord -L` lists the devices");
  }

  std::string device_;
  snd_pcm_t* pcm_ = nullptr;
  std::vector<float> samples_;
};

}  // namespace

std::unique_ptr<Sound> ListenTo(const std::string& device) {
  return std::make_unique<LineIn>(device);
}

}  // namespace choreo::live
