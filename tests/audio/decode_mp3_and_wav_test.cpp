#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/audio/decode_fixture.h"
#include "tests/audio/signals.h"

// MP3 and WAV files as other programs write them: without an index, with wrong headers, joined.
namespace choreo::decode_test {

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

}  // namespace choreo::decode_test
