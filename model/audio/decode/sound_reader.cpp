#include "model/audio/decode/sound_reader.h"

#include "model/core/error.h"

namespace choreo {
namespace {

class ChainReader final : public SoundReader {
 public:
  ChainReader(std::vector<ByteSource> parts, ReaderOf open, const std::string& name)
      : name_(name), parts_(std::move(parts)), open_(std::move(open)) {
    reader_ = open_(parts_[0]);
    sample_rate_ = reader_->sample_rate();
    channels_ = reader_->channels();
  }

  int64_t Read(std::span<float> interleaved) override {
    while (reader_) {
      const int64_t count = reader_->Read(interleaved);
      if (count > 0) return count;
      for (const std::string& note : reader_->notes())
        notes_.push_back(parts_.size() > 1 ? "part " + std::to_string(part_ + 1) + ": " + note
                                           : note);
      reader_ = nullptr;
      while (!reader_ && ++part_ < parts_.size()) Open();
    }
    return 0;
  }

 private:
  void Open() {
    try {
      reader_ = open_(parts_[part_]);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kInvalidArgument) throw;
      notes_.push_back("part " + std::to_string(part_ + 1) + " of " +
                       std::to_string(parts_.size()) + " is skipped: " + error.Of("").what());
      return;
    }
    if (reader_->sample_rate() == sample_rate_ && reader_->channels() == channels_) return;
    throw InvalidArgument(name_, "part 1 has " + std::to_string(channels_) + " channels at " +
                                     std::to_string(sample_rate_) + " Hz, part " +
                                     std::to_string(part_ + 1) + " " +
                                     std::to_string(reader_->channels()) + " at " +
                                     std::to_string(reader_->sample_rate()) +
                                     ": they must match; re-encode them, or use one");
  }

  const std::string name_;
  std::vector<ByteSource> parts_;
  ReaderOf open_;
  size_t part_ = 0;
  std::unique_ptr<SoundReader> reader_;
};

}  // namespace

std::unique_ptr<SoundReader> ReadOneAfterAnother(std::vector<ByteSource> parts, ReaderOf open,
                                                 const std::string& name) {
  return std::make_unique<ChainReader>(std::move(parts), std::move(open), name);
}

}  // namespace choreo
