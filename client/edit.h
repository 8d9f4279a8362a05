#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/choreo_client.h"

/// Changes of a dance that is finished. Frames that an edit does not touch stay as they are, bit
/// for bit; those between are danced anew by GenerateTransition, from what stands before them into
/// what follows, so that neither end shows.
///
/// Frame numbers count at the model's rate from the dance's first frame; the dance itself may have
/// any rate: it is then sampled at the model's, and the new frames are interpolated at its own.
namespace choreo::client {

/// Seconds of music that the last frame hears beyond itself, or a little more.
inline constexpr double kMusicBeyond_s = 0.5;
/// Seconds of music before the first frame by which its energy is heard, as far as they fit into so
/// many bytes.
inline constexpr double kMusicBefore_s = 35;
inline constexpr double kMostMusicBytes = 12 << 20;

/// A dance, its first frame at the beginning of the music.
struct FinishedDance {
  Motion motion = {};
  std::vector<Contacts> contacts = {};  ///< one a frame, or none at all
};

/// How the new frames are danced.
struct EditOptions {
  ModelDescription model = {};                ///< of the client's server
  uint64_t seed = 0;                          ///< same seed, same edit
  std::optional<double> temperature = {};     ///< 0 to kMaxTemperature
  std::string style = {};                     ///< one of the model's; empty: as it comes
  std::optional<double> music_dynamics = {};  ///< as DanceConfig has it
  Audio audio = {};                           ///< the song from its start, kPcmFloat; or none
  std::optional<double> variation = {};       ///< as DanceConfig has it
  std::vector<double> music_beats = {};       ///< as DanceConfig::music_beats
  std::vector<Passage> music_passages = {};   ///< as DanceConfig has them
  uint64_t music_id = 0;                      ///< as DanceConfig has it
  Controls controls = {};                     ///< of the new frames
};

/// A key pose set into a dance: the frames between `from` and `to`, both exclusive, change.
struct KeyEdit {
  KeyPose key = {};                ///< its frame is in the dance; what stands there is replaced
  std::vector<KeyPose> held = {};  ///< those behind it that keep its pose, in time
  /// The last frame that stays before the key, at least 2 before it; -1 for a key at frame 0.
  int64_t from = 0;
  /// The first that stays behind the last of them, at least 2 after it; the number of the dance's
  /// frames where that one is its last.
  int64_t to = 0;
  std::string to_id = {};  ///< how warnings call what stands at `to`; empty: "frame N"
};

/// Frames between `from` and `to`, both exclusive, to be danced without a key.
struct Gap {
  int64_t from = 0;  ///< in the dance
  int64_t to = 0;    ///< at least 2 after `from`; the number of the dance's frames: it ends free
  std::string to_id = {};  ///< as KeyEdit::to_id
};

/// What became of a dance.
struct EditedDance {
  FinishedDance dance = {};
  int64_t first_changed = 0;           ///< frame of the dance, at its own rate
  int64_t end_changed = 0;             ///< the frame behind the last changed one, likewise
  std::vector<KeyReached> keys = {};   ///< those that were set
  std::vector<Warning> warnings = {};  ///< the server's, and of knees bent backwards
};

/// Gives a transition as much of a song as its frames, of which `first` is the first, and its
/// energy are heard in: a message has a limit, a song has none. A model that takes no music gets
/// none. `song`: as EditOptions::audio. Throws Error(kInvalidArgument) whose field is "audio".
void SetMusic(const Audio& song, const ModelDescription& model, int64_t first,
              TransitionRequest* request);

/// The number of a dance's frames at the model's rate. Throws Error(kInvalidArgument) for a dance
/// without frames.
int64_t CountModelFrames(const FinishedDance& dance, const ModelDescription& model);

/// Sets a key pose. Throws Error(kInvalidArgument) whose field is "key.frame", "from", "to",
/// "audio" or "dance", and what GenerateTransition throws.
EditedDance SetKey(const Client& client, const FinishedDance& dance, const EditOptions& options,
                   const KeyEdit& edit);

/// Dances what was there between two frames anew, without a key: takes one away. Throws
/// Error(kInvalidArgument) whose field is "from", "to", "audio" or "dance", and what
/// GenerateTransition throws.
EditedDance DanceFreely(const Client& client, const FinishedDance& dance,
                        const EditOptions& options, const Gap& gap);

/// Makes a dance seamless: the frames behind `from`, and `added` ones behind the dance's end, in
/// all at least one, lead back into the first ones. A dance of another rate than the model's gets
/// the frames that are missing to the next of the model's. Errors as above.
EditedDance CloseLoop(const Client& client, const FinishedDance& dance, const EditOptions& options,
                      int64_t from, int64_t added = 0);

}  // namespace choreo::client
