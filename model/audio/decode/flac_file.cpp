#include <FLAC/stream_decoder.h>

#include <algorithm>
#include <memory>

#include "model/audio/decode/sound_reader.h"
#include "model/core/error.h"

namespace choreo {
namespace {

struct DeleteFlac {
  void operator()(FLAC__StreamDecoder* decoder) const { FLAC__stream_decoder_delete(decoder); }
};

class FlacReader final : public SoundReader {
 public:
  FlacReader(ByteSource source, const std::string& name, bool in_ogg)
      : name_(name), source_(std::move(source)), decoder_(FLAC__stream_decoder_new()) {
    const auto begin =
        in_ogg ? FLAC__stream_decoder_init_ogg_stream : FLAC__stream_decoder_init_stream;
    if (begin(decoder_.get(), OnRead, nullptr, nullptr, nullptr, OnEnd, OnWrite, OnMetadata,
              OnError, this) != FLAC__STREAM_DECODER_INIT_STATUS_OK ||
        !FLAC__stream_decoder_process_until_end_of_metadata(decoder_.get())) {
      throw InvalidArgument(name_, "not FLAC audio");
    }
    while (sample_rate_ == 0 && Decode()) {
    }
    if (sample_rate_ == 0) throw InvalidArgument(name_, "not FLAC audio, or 0 samples of it");
  }

  int64_t Read(std::span<float> interleaved) override {
    const size_t wanted = interleaved.size() - interleaved.size() % static_cast<size_t>(channels_);
    while (decoded_.size() - taken_ < wanted && Decode()) {
    }
    const size_t count = std::min(wanted, decoded_.size() - taken_);
    std::copy_n(decoded_.begin() + static_cast<std::ptrdiff_t>(taken_), count, interleaved.begin());
    taken_ += count;
    if (taken_ == decoded_.size()) {
      decoded_.clear();
      taken_ = 0;
    }
    read_ += static_cast<int64_t>(count) / channels_;
    if (count < wanted && !ended_) {
      ended_ = true;
      if (stated_ > 0 && stated_ != read_)
        notes_.push_back("its header says " + std::to_string(stated_) + " samples, " +
                         std::to_string(read_) + " are there");
      if (damaged_ > 0) notes_.push_back(std::to_string(damaged_) + " places in it are damaged");
      if (others_ > 0) {
        notes_.push_back(std::to_string(others_) + " of its frames have " + other_ + ", not " +
                         FormatOf(channels_, sample_rate_) +
                         ", and are left out: joined files must match, re-encode them");
      }
    }
    return static_cast<int64_t>(count) / channels_;
  }

 private:
  using Decoder = const FLAC__StreamDecoder*;

  bool Decode() {
    return FLAC__stream_decoder_process_single(decoder_.get()) &&
           FLAC__stream_decoder_get_state(decoder_.get()) < FLAC__STREAM_DECODER_END_OF_STREAM;
  }

  static std::string FormatOf(int channels, int rate) {
    return std::to_string(channels) + " channels at " + std::to_string(rate) + " Hz";
  }

  static FLAC__StreamDecoderReadStatus OnRead(Decoder, FLAC__byte* to, size_t* bytes, void* user) {
    auto& self = *static_cast<FlacReader*>(user);
    *bytes = self.source_.read_at(self.position_, {reinterpret_cast<std::byte*>(to), *bytes});
    self.position_ += static_cast<int64_t>(*bytes);
    return *bytes == 0 ? FLAC__STREAM_DECODER_READ_STATUS_END_OF_STREAM
                       : FLAC__STREAM_DECODER_READ_STATUS_CONTINUE;
  }
  static FLAC__bool OnEnd(Decoder, void* user) {
    const auto& self = *static_cast<FlacReader*>(user);
    return self.position_ >= self.source_.size;
  }
  static FLAC__StreamDecoderWriteStatus OnWrite(Decoder, const FLAC__Frame* frame,
                                                const FLAC__int32* const samples[], void* user) {
    auto& self = *static_cast<FlacReader*>(user);
    const FLAC__FrameHeader& header = frame->header;
    const auto channels = static_cast<int>(header.channels);
    if (self.sample_rate_ == 0) {
      self.sample_rate_ = static_cast<int>(header.sample_rate);
      self.channels_ = channels;
    }
    const auto rate = static_cast<int>(header.sample_rate);
    if (channels != self.channels_ || rate != self.sample_rate_) {
      ++self.others_;
      self.other_ = FormatOf(channels, rate);
      return FLAC__STREAM_DECODER_WRITE_STATUS_CONTINUE;
    }
    const float scale = 1.0F / static_cast<float>(int64_t{1} << (header.bits_per_sample - 1));
    for (unsigned i = 0; i < header.blocksize; ++i) {
      for (int c = 0; c < channels; ++c)
        self.decoded_.push_back(scale * static_cast<float>(samples[c][i]));
    }
    return FLAC__STREAM_DECODER_WRITE_STATUS_CONTINUE;
  }
  static void OnMetadata(Decoder, const FLAC__StreamMetadata* metadata, void* user) {
    if (metadata->type == FLAC__METADATA_TYPE_STREAMINFO)
      static_cast<FlacReader*>(user)->stated_ =
          static_cast<int64_t>(metadata->data.stream_info.total_samples);
  }
  static void OnError(Decoder, FLAC__StreamDecoderErrorStatus, void* user) {
    ++static_cast<FlacReader*>(user)->damaged_;
  }

  const std::string name_;
  ByteSource source_;
  int64_t position_ = 0, stated_ = 0, read_ = 0, damaged_ = 0, others_ = 0;
  std::string other_;  // the format of those
  std::vector<float> decoded_;
  size_t taken_ = 0;
  bool ended_ = false;
  std::unique_ptr<FLAC__StreamDecoder, DeleteFlac> decoder_;
};

}  // namespace

std::unique_ptr<SoundReader> ReadFlac(const ByteSource& source, const std::string& name) {
  return std::make_unique<FlacReader>(source, name, false);
}

std::unique_ptr<SoundReader> ReadOggFlac(const ByteSource& source, const std::string& name) {
  return std::make_unique<FlacReader>(source, name, true);
}

}  // namespace choreo
