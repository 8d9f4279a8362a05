#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include "tests/audio/decode_fixture.h"
#include "tests/audio/signals.h"

namespace choreo::decode_test {

struct FileFormat {
  const char* name;
  int format;
  int rate;
  int channels;
  double snr_db;  // of the decoded samples; infinite: they are exact
};

std::ostream& operator<<(std::ostream& out, const FileFormat& format) { return out << format.name; }

constexpr double kExact = std::numeric_limits<double>::infinity();

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
  for (const auto& path : {folder_ / "absent.wav", folder_.path()}) {
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

// Half of what the channels have is the same, and half is inverted, or a little more.
TEST_F(DecodeTest, OfChannelsThatCancelInPartTheLouderIsHeard) {
  const std::vector<float> tone = Sine(440, 22050, 22050, 0.4);
  struct Case {
    float common, second;  // how much of another tone both have; the second channel's loudness
    bool told;
  };
  for (const auto& [common, second, told] :
       {Case{0.5F, 1, true}, {0.5F, 1.3F, true}, {0.7F, 1, false}, {1, 1, false}, {0, 2, true}}) {
    const std::vector<float> other = Sine(1000, 22050, 22050, 0.4);
    std::vector<float> both, heard;
    for (size_t i = 0; i < tone.size(); ++i) {
      const float left = tone[i] + common * other[i],
                  right = second * (common * other[i] - tone[i]);
      both.insert(both.end(), {left, right});
      heard.push_back(second > 1 ? right : left);
    }
    const std::string bytes = Bytes(Write(SF_FORMAT_WAV | SF_FORMAT_FLOAT, 22050, 2, both));
    const DecodedAudio audio = Decode(bytes);
    ASSERT_EQ(audio.notes.size(), told ? 1U : 0U) << common << " " << second;
    EXPECT_EQ(ToModelRate(audio) == heard, told);
    EXPECT_EQ(DecodeMono(std::as_bytes(std::span(bytes))), ToModelRate(audio));
  }
  // Unrelated channels do not cancel each other, however many there are.
  std::vector<float> many;
  for (size_t i = 0; i < 22050; ++i) {
    for (int channel = 0; channel < 6; ++channel)
      many.push_back(0.1F *
                     std::sin(static_cast<float>(i) * 0.02F * static_cast<float>(channel + 1)));
  }
  EXPECT_TRUE(Decode(Bytes(Write(SF_FORMAT_WAV | SF_FORMAT_FLOAT, 22050, 6, many))).notes.empty());
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
