#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/choreo_client.h"
#include "model/messages/dance_manner.h"

/// Edits of finished dances. Frames outside an edit stay the same, bit for bit; GenerateTransition
/// dances those inside again, from the frames before into those after, so that neither end shows.
///
/// Frame numbers count at the model's rate from the dance's first frame; a dance at another rate is
/// sampled at the model's, and the new frames are interpolated at its own.
namespace choreo::client {

/// Seconds of music after a frame that its features need, rounded up.
inline constexpr double kMusicBeyond_s = 0.5;
/// Seconds of music before the first frame that determine its energy, as far as they fit into the
/// byte limit.
inline constexpr double kMusicBefore_s = 35;
inline constexpr double kMaxMusicBytes = 12 << 20;

/// A dance whose first frame is at the beginning of the music.
struct FinishedDance {
  Motion motion = {};
  std::vector<Contacts> contacts = {};  ///< one per frame, or empty
};

/// Settings for the new frames.
struct EditOptions : DanceManner, KnownMusic {
  ModelDescription model = {};   ///< on the client's server
  uint64_t seed = 0;             ///< the same seed gives the same edit
  Audio audio = {};              ///< the song from its start, kPcmFloat; or none
  ControlRequest controls = {};  ///< for the new frames
};

/// A key pose to set into a dance: changes the frames between `from` and `to`, both exclusive.
struct KeyEdit {
  KeyPose key = {};                ///< its frame is in the dance; it replaces a key there
  std::vector<KeyPose> held = {};  ///< keys after it that hold its pose, in order
  /// The last unchanged frame before the key, at least 2 before it; -1 for a key at frame 0.
  int64_t from = 0;
  /// The first unchanged frame after the last of them, at least 2 after it; the dance's frame count
  /// if that is the dance's last frame.
  int64_t to = 0;
  std::string to_id = {};  ///< name of what is at `to` in warnings; empty: "the dance at frame N"
  std::optional<double> to_hit = {};  ///< how hard it is hit, as KeyPose::hit
};

/// Frames between `from` and `to`, both exclusive, to dance anew.
struct Gap {
  int64_t from = 0;        ///< in the dance; -1: from rest at the origin
  int64_t to = 0;          ///< at least 2 after `from`; the dance's frame count for an open end
  std::string to_id = {};  ///< as in KeyEdit, here and below
  std::optional<double> to_hit = {};
  std::vector<KeyPose> keys = {};  ///< between them, with frames, in order
};

/// The result of an edit.
struct EditedDance {
  FinishedDance dance = {};
  int64_t first_changed = 0;           ///< frame of the dance, at its own rate
  int64_t end_changed = 0;             ///< the frame after the last changed one, likewise
  std::vector<KeyReached> keys = {};   ///< that were set
  std::vector<Warning> warnings = {};  ///< from the server, and about knees bent backwards
};

/// Gives a transition the part of a song that its frames, starting at `first`, and their energy
/// depend on: messages have a limit, songs have none. Gives none to a model without music. `song`:
/// as EditOptions::audio. Throws Error(kInvalidArgument) whose field is "audio".
void SetMusic(const Audio& song, const ModelDescription& model, int64_t first,
              TransitionRequest* request);

/// The number of a dance's frames at the model's rate. Throws Error(kInvalidArgument) for a dance
/// without frames.
int64_t CountModelFrames(const FinishedDance& dance, const ModelDescription& model);

/// Sets a key pose. Throws Error(kInvalidArgument) whose field is "key.frame", "from", "to",
/// "audio" or "dance", and as GenerateTransition.
EditedDance SetKey(const Client& client, const FinishedDance& dance, const EditOptions& options,
                   const KeyEdit& edit);

/// Dances the frames between two others again, through the gap's keys alone: another take, or one
/// without a key. Throws Error(kInvalidArgument) whose field is "from", "to", "keys", "audio" or
/// "dance", and as GenerateTransition.
EditedDance DanceAnew(const Client& client, const FinishedDance& dance, const EditOptions& options,
                      const Gap& gap);

/// The same, `takes` times: candidates of one transition where one spans the gap; else with the
/// seeds that follow. Throws the same.
std::vector<EditedDance> DanceTakes(const Client& client, const FinishedDance& dance,
                                    const EditOptions& options, const Gap& gap, int takes);

/// Dances a whole dance again through its keys alone, which have frames, in order, as Client::Dance
/// does: if nothing differs, the frames are those of the dance before it was edited. Throws as
/// that, and Error(kInvalidArgument) for a dance without frames.
EditedDance DanceAllAnew(const Client& client, const FinishedDance& dance,
                         const EditOptions& options, const std::vector<KeyPose>& keys);

/// Makes a dance loop: the frames after `from`, and `added` ones after the dance's end, at least
/// one in all, lead back to the first ones. A dance at another rate than the model's also gets the
/// frames missing to the model's next one. Throws the same.
EditedDance CloseLoop(const Client& client, const FinishedDance& dance, const EditOptions& options,
                      int64_t from, int64_t added = 0);

}  // namespace choreo::client
