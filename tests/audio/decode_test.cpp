#include "model/audio/decode.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sndfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <thread>

#include "model/core/error.h"
#include "tests/audio/signals.h"

namespace choreo::decode_test {

using ::testing::HasSubstr;

struct FileFormat {
  const char* name;
  int format;
  int rate;
  int channels;
  double snr_db;  // of the decoded samples; infinite: they are exact
};

std::ostream& operator<<(std::ostream& out, const FileFormat& format) { return out << format.name; }

constexpr double kExact = std::numeric_limits<double>::infinity();
/// libsndfile writes a variable bit rate.
constexpr int kMp3 = SF_FORMAT_MPEG | SF_FORMAT_MPEG_LAYER_III;

const FileFormat kFormats[] = {
    {"wav8", SF_FORMAT_WAV | SF_FORMAT_PCM_U8, 8000, 1, 35},
    {"wav16", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 44100, 2, 85},
    {"wav24", SF_FORMAT_WAVEX | SF_FORMAT_PCM_24, 96000, 6, 120},
    {"wav32float", SF_FORMAT_WAV | SF_FORMAT_FLOAT, 192000, 8, kExact},
    {"flac16", SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 44100, 2, 85},
    {"flac24", SF_FORMAT_FLAC | SF_FORMAT_PCM_24, 48000, 1, 120},
    {"vorbis", SF_FORMAT_OGG | SF_FORMAT_VORBIS, 44100, 2, 20},
    {"opus", SF_FORMAT_OGG | SF_FORMAT_OPUS, 48000, 1, 15},
    {"mp3", kMp3, 44100, 2, 20},
};

/// A folder of its own for each test process.
class DecodeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("choreo_decode_test_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path Write(int format, int rate, int channels,
                              std::span<const float> wave) const {
    const auto path = folder_ / "sound";
    SF_INFO info{};
    info.samplerate = rate;
    info.channels = channels;
    info.format = format;
    SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
    EXPECT_NE(file, nullptr) << sf_strerror(nullptr);
    const sf_count_t frames = static_cast<sf_count_t>(wave.size()) / channels;
    EXPECT_EQ(sf_writef_float(file, wave.data(), frames), frames);
    sf_close(file);
    return path;
  }

  std::filesystem::path WriteBytes(const std::string& bytes) const {
    const auto path = folder_ / "bytes";
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

  static std::string Bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  DecodedAudio Decode(const std::string& bytes) const { return DecodeAudioFile(WriteBytes(bytes)); }

  static std::string Refusal(const std::string& bytes) {
    try {
      DecodeMono(std::as_bytes(std::span(bytes)));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
      EXPECT_THAT(error.field(), ::testing::StartsWith("audio"));
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path folder_;
};

class DecodeFormatTest : public DecodeTest, public ::testing::WithParamInterface<FileFormat> {
 protected:
  /// Two seconds, another tone in each channel.
  std::vector<float> Wave() const {
    const auto& format = GetParam();
    const size_t channels = static_cast<size_t>(format.channels);
    std::vector<float> wave(channels * static_cast<size_t>(2 * format.rate));
    for (size_t c = 0; c < channels; ++c) {
      const auto tone =
          Sine(300.0 + 100.0 * static_cast<double>(c), format.rate, 2 * format.rate, 0.6);
      for (size_t i = 0; i < tone.size(); ++i) wave[i * channels + c] = tone[i];
    }
    return wave;
  }
  std::filesystem::path WriteWave() const {
    return Write(GetParam().format, GetParam().rate, GetParam().channels, Wave());
  }
};
INSTANTIATE_TEST_SUITE_P(Formats, DecodeFormatTest, ::testing::ValuesIn(kFormats),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(DecodeFormatTest, RoundTrips) {
  const FileFormat& format = GetParam();
  const std::vector<float> wave = Wave();
  const auto path = WriteWave();
  const DecodedAudio audio = DecodeAudioFile(path);
  EXPECT_EQ(audio.sample_rate, format.rate);
  EXPECT_EQ(audio.channels, format.channels);
  ASSERT_EQ(audio.samples(), 2 * format.rate);
  EXPECT_DOUBLE_EQ(audio.seconds(), 2.0);
  double squares = 0, errors = 0;
  for (size_t i = 0; i < wave.size(); ++i) {
    squares += static_cast<double>(wave[i]) * wave[i];
    errors += std::pow(static_cast<double>(wave[i]) - audio.interleaved[i], 2);
  }
  EXPECT_GE(10 * std::log10(squares / errors), format.snr_db);

  const std::vector<float> mono = ToModelRate(audio);
  EXPECT_EQ(static_cast<int64_t>(mono.size()), 2 * kModelSampleRate);
  const std::string bytes = Bytes(path);
  EXPECT_EQ(DecodeMono(std::as_bytes(std::span(bytes))), mono);
}

// Headers that state ten minutes of 8 channels at 192 kHz, or half of the real length.
TEST_F(DecodeTest, FlacIsReadDespiteAWrongHeader) {
  const std::vector<float> wave(8 * 5000);
  const std::string bytes = Bytes(Write(SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 192'000, 8, wave));
  for (const uint64_t samples : {uint64_t{600} * 192'000, uint64_t{2500}, uint64_t{0}}) {
    std::string other = bytes;
    // The last 36 bits of the 8 bytes at 18 are the samples of each channel.
    for (size_t i = 0; i < 4; ++i) other[22 + i] = static_cast<char>(samples >> (24 - 8 * i));
    const DecodedAudio audio = Decode(other);
    EXPECT_EQ(audio.samples(), 5000) << samples;
    if (samples == 0) {
      EXPECT_TRUE(audio.notes.empty());  // it doesn't say
    } else {
      EXPECT_EQ(audio.notes,
                (std::vector<std::string>{"its header says " + std::to_string(samples) +
                                          " samples, 5000 are there"}));
    }
  }
}

TEST_F(DecodeTest, EndsOnRequest) {
  const std::string bytes =
      Bytes(Write(SF_FORMAT_WAV | SF_FORMAT_PCM_16, 8000, 1, std::vector<float>(300'000)));
  int pieces = 0;
  EXPECT_THROW(DecodeMono(std::as_bytes(std::span(bytes)),
                          [&] {
                            if (++pieces == 2) throw Error(ErrorCode::kCancelled, "", "enough");
                          }),
               Error);
  EXPECT_EQ(pieces, 2);
}

TEST_P(DecodeFormatTest, TruncatedFilesAreReadWithANote) {
  const std::string bytes = Bytes(WriteWave());
  ASSERT_EQ(Refusal(bytes), "accepted");
  EXPECT_TRUE(Decode(bytes).notes.empty());
  // Pages of Ogg hold up to a second each.
  const bool is_ogg = (GetParam().format & SF_FORMAT_TYPEMASK) == SF_FORMAT_OGG;
  for (const double share : {is_ogg ? 0.95 : 0.5, 0.9}) {
    const size_t size = static_cast<size_t>(share * static_cast<double>(bytes.size()));
    const DecodedAudio audio = Decode(bytes.substr(0, size));
    EXPECT_GT(audio.seconds(), 2 * share - (is_ogg ? 1.5 : 0.3)) << share;
    EXPECT_LT(audio.seconds(), 2) << share;
    EXPECT_FALSE(audio.notes.empty()) << share;
  }
  EXPECT_NE(Refusal(bytes.substr(0, 20)), "accepted");
}

// Joined as by `cat a b`.
TEST_P(DecodeFormatTest, JoinedFilesAreReadToTheEnd) {
  const std::string bytes = Bytes(WriteWave());
  EXPECT_NEAR(Decode(bytes + bytes + bytes).seconds(), 6, 0.15);
  const auto mono = [](const std::string& file) {
    return DecodeMono(std::as_bytes(std::span(file)));
  };
  EXPECT_NEAR(static_cast<double>(mono(bytes + bytes).size()), 4 * kModelSampleRate, 2500);
}

TEST_P(DecodeFormatTest, ReadsAPartFromTheMiddle) {
  const auto path = WriteWave();
  const DecodedAudio whole = DecodeAudioFile(path);
  const DecodedAudio part = DecodeAudioFile(path, 1000, 0.5);
  ASSERT_EQ(part.samples(), whole.samples() - GetParam().rate / 2);
  const auto from = whole.interleaved.end() - std::ssize(part.interleaved);
  EXPECT_TRUE(std::equal(part.interleaved.begin(), part.interleaved.end(), from));
  const DecodedAudio after = DecodeAudioFile(path, 1000, 3);
  EXPECT_TRUE(after.interleaved.empty());
  EXPECT_DOUBLE_EQ(after.end_s, 2.0);
}

TEST_P(DecodeFormatTest, NoSamplesAreRefused) {
  const std::string bytes =
      Bytes(Write(GetParam().format, GetParam().rate, GetParam().channels, {}));
  EXPECT_NE(Refusal(bytes), "accepted");
}

TEST_F(DecodeTest, RefusesOtherFiles) {
  EXPECT_THAT(Refusal(""), HasSubstr("audio: 0 bytes"));
  EXPECT_THAT(Refusal("Dance, dance, wherever you may be."),
              HasSubstr("not WAV, FLAC, Ogg or MP3 audio but text"));
  EXPECT_THAT(Refusal(std::string(10000, '\0')),
              AllOf(HasSubstr("not WAV, FLAC, Ogg or MP3"), HasSubstr("ffmpeg -i")));
  EXPECT_THAT(Refusal("<!DOCTYPE html><html><head><title>404 Not Found</title></head></html>\n"),
              HasSubstr("audio but text, such as a web page"));
  EXPECT_THAT(Refusal("RIFF\x10\0\0\0WAVE"), HasSubstr("audio: "));
  std::string noise;
  for (const float value : Noise(20000, 77)) noise += static_cast<char>(127 * value);
  EXPECT_THAT(Refusal(noise), HasSubstr("not WAV"));
  const auto aiff = Write(SF_FORMAT_AIFF | SF_FORMAT_PCM_16, 44100, 1, Noise(1000, 1));
  EXPECT_THAT(Refusal(Bytes(aiff)), AllOf(HasSubstr("AIFF"), HasSubstr("is not WAV")));
}

TEST_F(DecodeTest, FilesThatCannotBeOpenedAreNamed) {
  for (const auto& path : {folder_ / "absent.wav", folder_}) {
    try {
      DecodeAudioFile(path);
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kNotFound);
      EXPECT_EQ(error.field(), path.string());
    }
  }
  try {
    DecodeAudioFile(WriteBytes("text"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.field(), (folder_ / "bytes").string());
  }
}

TEST_F(DecodeTest, LimitsAreHeld) {
  const int u8 = SF_FORMAT_WAV | SF_FORMAT_PCM_U8;
  const std::vector<float> noise = Noise(1800, 1);
  EXPECT_THAT(Refusal(Bytes(Write(u8, 7999, 1, noise))),
              AllOf(HasSubstr("audio.sample_rate: 7999"), HasSubstr("8000 to 192000")));
  EXPECT_THAT(Refusal(Bytes(Write(u8, 192001, 1, noise))), HasSubstr("audio.sample_rate: 192001"));
  EXPECT_THAT(Refusal(Bytes(Write(u8, 8000, 9, noise))),
              AllOf(HasSubstr("audio.channels: 9"), HasSubstr("1 to 8")));
  std::vector<float> ten_minutes(8000 * 600, 0.25f);
  EXPECT_EQ(DecodeAudioFile(Write(u8, 8000, 1, ten_minutes)).samples(), 8000 * 600);
  ten_minutes.insert(ten_minutes.end(), 8000 * 60, 0.25f);
  const auto longer = Write(u8, 8000, 1, ten_minutes);
  EXPECT_THAT(Refusal(Bytes(longer)), AllOf(HasSubstr("600 s"), HasSubstr("at most")));
  // Limits apply to the requested part.
  EXPECT_NEAR(DecodeAudioFile(longer, 5, 640).seconds(), 8, 4);
  EXPECT_EQ(DecodeAudioFile(longer, 1000, 60).samples(), 8000 * 600);
}

TEST_F(DecodeTest, SamplesThatAreNoNumbersAreRefusedByIndex) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::vector<float> wave = Noise(2 * 100000, 1);
    wave[2 * 70001 + 1] = bad;
    EXPECT_THAT(Refusal(Bytes(Write(SF_FORMAT_WAV | SF_FORMAT_FLOAT, 44100, 2, wave))),
                AllOf(HasSubstr("audio.data"), HasSubstr("sample 70001 of channel 1")));
  }
}

TEST_F(DecodeTest, Mp3OfVaryingBitRateIsReadToItsEndWithoutAnIndex) {
  // Loud noise, then a faint tone: the first frames' bit rate says little about the length.
  std::vector<float> wave = Noise(44100 * 3, 1, 0.3);
  const std::vector<float> tone = Sine(200, 44100, 44100 * 3, 0.05);
  wave.insert(wave.end(), tone.begin(), tone.end());
  const std::string bytes = Bytes(Write(kMp3, 44100, 1, wave));
  ASSERT_EQ(Decode(bytes).samples(), 44100 * 6);
  const size_t index = bytes.find("Xing");
  ASSERT_NE(index, std::string::npos);
  const size_t second_frame = bytes.find(bytes.substr(0, 2), index);
  const std::string without = bytes.substr(second_frame);
  EXPECT_NEAR(Decode(without).seconds(), 6.0, 0.1);
  EXPECT_NEAR(Decode(without.substr(0, without.size() / 2)).seconds(), 1.7, 1.3);
  // Joined to a file with an index, whose frame count is then too small.
  const DecodedAudio joined = Decode(bytes + without);
  EXPECT_NEAR(joined.seconds(), 12.0, 0.2);
  ASSERT_FALSE(joined.notes.empty());
  EXPECT_THAT(joined.notes[0], HasSubstr("frames, "));
  // Its silence before the song is right even so.
  const std::vector<float> alone = Decode(bytes).interleaved;
  EXPECT_TRUE(std::equal(alone.begin(), alone.begin() + 44100, joined.interleaved.begin()));
  // Fraunhofer's tag is a frame that is no sound.
  const size_t third_frame = without.find(without.substr(0, 2), 200);
  std::string tagged = without.substr(0, third_frame) + without;
  std::fill(tagged.begin() + 4, tagged.begin() + static_cast<std::ptrdiff_t>(third_frame), '\0');
  tagged.replace(36, 4, "VBRI");
  EXPECT_EQ(Decode(tagged).samples(), Decode(without).samples());
  // After a server's headers, or in the middle of a frame.
  EXPECT_NEAR(Decode("HTTP/1.1 200 OK\r\nContent-Type: audio/mpeg\r\n\r\n" + bytes).seconds(), 6,
              0.1);
  EXPECT_NEAR(Decode(without.substr(100)).seconds(), 6, 0.15);
}

// Headers by programs that do not know the length, and other common errors.
TEST_F(DecodeTest, WavIsReadDespiteAWrongHeader) {
  const std::string bytes =
      Bytes(Write(SF_FORMAT_WAV | SF_FORMAT_PCM_16, 44100, 1, Noise(5000, 1)));
  const size_t data = bytes.find("data");
  for (const uint32_t size :
       {0U, 0x7FFFF000U, 0x80000000U, 0xFFFFFFFEU, 0xFFFFFFFFU, 10'008U, 5'001U}) {
    std::string other = bytes;
    other.replace(4, 4, "\xff\xff\xff\xff");
    other.replace(data + 4, 4, std::string(reinterpret_cast<const char*>(&size), 4));
    const DecodedAudio audio = Decode(other);
    EXPECT_EQ(audio.samples(), 5000) << size;
    EXPECT_EQ(audio.notes, (std::vector<std::string>{"its header says " + std::to_string(size) +
                                                     " bytes of samples, 10000 are there"}));
    EXPECT_EQ(Refusal(other), "accepted");
  }
}

// RF64 and BW64, as recorders write them: lengths in a chunk of their own, others of odd length.
TEST_F(DecodeTest, LongWavIsReadDespiteAWrongHeader) {
  const std::string wav =
      Bytes(Write(SF_FORMAT_WAV | SF_FORMAT_PCM_16, 22050, 1, Sine(440, 22050, 22050)));
  const size_t data = wav.find("data");
  const std::string format = wav.substr(12, 24), samples = wav.substr(data + 8);
  const auto number = [](uint64_t value, size_t size) {
    return std::string(reinterpret_cast<const char*>(&value), size);
  };
  const std::string whole = number(UINT32_MAX, 4);
  for (const std::string kind : {"RF64", "BW64"}) {
    for (const std::string& odd : {std::string(), "iXML" + number(5, 4) + "<a/>\n" + '\0',
                                   "iXML" + number(5, 4) + "<a/>\n"}) {
      for (const uint64_t stated :
           {samples.size(), size_t{0}, samples.size() / 2, size_t{1} << 40}) {
        SCOPED_TRACE(kind + " " + std::to_string(odd.size()) + " " + std::to_string(stated));
        const DecodedAudio audio =
            Decode(kind + whole + "WAVEds64" + number(28, 4) + number(0, 8) + number(stated, 8) +
                   number(0, 12) + odd + format + "data" + whole + samples + "axml" + number(7, 4) +
                   "<a></a>" + '\0');
        const bool is_right = stated == samples.size();
        EXPECT_NEAR(audio.seconds(), 1, is_right ? 1e-9 : 0.001);
        EXPECT_EQ(audio.notes.empty(), is_right);
      }
    }
  }
  // In WAV, too; a byte further on, what comes next may look like a chunk.
  const std::string list = "LIST" + number(7, 4) + "INFOabc";
  for (const std::string& odd : {list, list + '\0'}) {
    for (const size_t at : {size_t{12}, data})
      EXPECT_NEAR(Decode(wav.substr(0, at) + odd + wav.substr(at)).seconds(), 1, 1e-9);
  }
}

TEST_F(DecodeTest, WavsWithSeveralChunksOfSamplesAreReadToTheirEnd) {
  const std::vector<float> wave = Sine(440, 22050, 22050);
  const std::string wav = Bytes(Write(SF_FORMAT_WAV | SF_FORMAT_PCM_16, 22050, 1, wave));
  const std::string samples = wav.substr(wav.find("data"));
  const DecodedAudio whole = Decode(wav),
                     twice = Decode(wav + "LIST" + std::string(4, '\0') + samples);
  EXPECT_EQ(twice.samples(), 2 * whole.samples());
  EXPECT_TRUE(std::equal(whole.interleaved.begin(), whole.interleaved.end(),
                         twice.interleaved.begin() + whole.samples()));
  // The second file is cut off.
  const DecodedAudio cut = Decode(wav + wav.substr(0, wav.size() / 2));
  EXPECT_NEAR(cut.seconds(), 1.5, 0.01);
  ASSERT_EQ(cut.notes.size(), 1U);
  EXPECT_THAT(cut.notes[0], HasSubstr("part 2: its header says 44100 bytes"));
  const size_t data = wav.find("data");
  EXPECT_THAT(
      Refusal(wav.substr(0, data) + "LIST" + std::string("\x40\x10\0\0", 4) + "wavl" + samples),
      HasSubstr("a wavl list"));
  const std::string other = Bytes(Write(SF_FORMAT_WAV | SF_FORMAT_PCM_16, 44100, 1, wave));
  EXPECT_THAT(Refusal(wav + other), HasSubstr("they must match"));
}

TEST_F(DecodeTest, JoinedFlacsOfTwoRatesGetANote) {
  const int flac = SF_FORMAT_FLAC | SF_FORMAT_PCM_16;
  const std::string one = Bytes(Write(flac, 22050, 1, Sine(440, 22050, 22050)));
  const DecodedAudio joined = Decode(one + Bytes(Write(flac, 48000, 2, Noise(96000, 3))));
  EXPECT_NEAR(joined.seconds(), 1, 1e-9);
  ASSERT_FALSE(joined.notes.empty());
  EXPECT_THAT(joined.notes.back(),
              AllOf(HasSubstr("frames have 2 channels at 48000 Hz, not 1 channels at 22050 Hz"),
                    HasSubstr("re-encode")));
}

TEST_F(DecodeTest, TagsBeforeOtherFormatsAreSkipped) {
  const std::string tag = "ID3\x04" + std::string(5, '\0') + '\x20' + std::string(32, '\0');
  for (const int format : {SF_FORMAT_FLAC | SF_FORMAT_PCM_16, SF_FORMAT_OGG | SF_FORMAT_VORBIS}) {
    const std::string bytes = Bytes(Write(format, 22050, 1, Sine(440, 22050, 22050)));
    const DecodedAudio audio = Decode(tag + bytes);
    EXPECT_NEAR(audio.seconds(), 1, 1e-9);
    EXPECT_TRUE(audio.notes.empty());
  }
}

TEST_F(DecodeTest, CancellingChannelsAreReadWithANote) {
  const std::vector<float> left = Sine(440, 22050, 3 * 22050, 0.5);
  struct Case {
    size_t from;           // where the right channel becomes the left's inverse
    float offset, common;  // of both
    const char* told;
  };
  for (const auto& [from, offset, common, told] : {Case{0, 0, 0, "in 3 of 3 s"},
                                                   {22050, 0, 0, "in 2 of 3 s"},
                                                   {0, 0.3F, 0, "in 3 of 3 s"},
                                                   {0, 0, 0.03F, "in 3 of 3 s"},
                                                   {3 * 22050, 0.3F, 0, ""}}) {
    const std::vector<float> tone = Sine(1000, 22050, 3 * 22050, common);
    std::vector<float> both, mono;
    for (size_t i = 0; i < left.size(); ++i) {
      const float first = left[i] + offset + tone[i];
      both.insert(both.end(), {first, (i < from ? left[i] : -left[i]) + offset + tone[i]});
      mono.push_back(first);
    }
    const std::string bytes = Bytes(Write(SF_FORMAT_WAV | SF_FORMAT_FLOAT, 22050, 2, both));
    const DecodedAudio audio = Decode(bytes);
    EXPECT_EQ(ToModelRate(audio), mono) << told;
    EXPECT_EQ(DecodeMono(std::as_bytes(std::span(bytes))), mono) << told;
    ASSERT_EQ(audio.notes.size(), *told == 0 ? 0U : 1U);
    if (*told != 0) {
      EXPECT_THAT(audio.notes[0], HasSubstr(told));
    }
  }
}

TEST_F(DecodeTest, APipeIsReadToItsEnd) {
  const std::string bytes =
      Bytes(Write(SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 8000, 1, Noise(9000, 2)));
  const auto fifo = folder_ / "fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(fifo, std::ios::binary) << bytes; });
  EXPECT_EQ(DecodeAudioFile(fifo).samples(), 9000);
  writer.join();
}

}  // namespace choreo::decode_test
