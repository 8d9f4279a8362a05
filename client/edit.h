#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/choreo_client.h"
#include "model/messages/dance_manner.h"

/// Edits finished dances. Frames outside an edit stay the same, bit for bit. GenerateTransition
/// generates the frames inside again: they continue the frames before, and lead into the frames
/// after.
///
/// Frame numbers count from the dance's first frame, at the model's rate. A dance at another rate
/// is resampled to the model's, and new frames are interpolated at the dance's rate.
namespace choreo::client {

/// Seconds of music after a frame that its music features need, rounded up.
inline constexpr double kMusicBeyond_s = 0.5;

/// A dance whose first frame is at the beginning of the music.
struct FinishedDance {
  Motion motion = {};
  std::vector<Contacts> contacts = {};  ///< one per frame, or empty
};

/// Settings for the new frames.
struct EditOptions {
  ModelDescription model = {};  ///< on the client's server
  uint64_t seed = 0;            ///< the same seed gives the same edit
  DanceManner manner = {};
  Audio audio = {};              ///< the song from its start, kPcmFloat; or none
  KnownMusic known = {};         ///< of the song
  ControlRequest controls = {};  ///< for the new frames
};

/// A key pose to set into a dance: changes the frames between `from` and `to`, both exclusive.
struct KeyEdit {
  KeyPose key = {};                ///< its frame must be in the dance; replaces a key there
  std::vector<KeyPose> held = {};  ///< keys after it that hold its pose, in order
  /// The last unchanged frame before the key, at least 2 before it; -1 for a key at frame 0.
  int64_t from = 0;
  /// The first unchanged frame after the last of `key` and `held`, at least 2 after it; the dance's
  /// frame count if that key is at the dance's last frame.
  int64_t to = 0;
  std::string to_id = {};  ///< name of the pose at `to` in warnings; empty: "the dance at frame N"
  std::optional<double> to_hit = {};  ///< KeyPose::hit of the pose at `to`
};

/// The frames between `from` and `to`, both exclusive, to generate again.
struct Gap {
  int64_t from = 0;        ///< in the dance; -1: from rest at the origin
  int64_t to = 0;          ///< at least 2 after `from`; the dance's frame count for an open end
  std::string to_id = {};  ///< as in KeyEdit
  std::optional<double> to_hit = {};  ///< as in KeyEdit
  std::vector<KeyPose> keys = {};     ///< between them, with frames, in order
};

/// The result of an edit.
struct EditedDance {
  FinishedDance dance = {};
  int64_t first_changed = 0;           ///< frame of the dance, at its own rate
  int64_t end_changed = 0;             ///< the frame after the last changed one, at its own rate
  std::vector<KeyReached> keys = {};   ///< the keys that were set
  std::vector<Warning> warnings = {};  ///< from the server, and about knees bent backwards
};

/// Sets a transition's music: the part of a song on which its frames, from `first` on, and their
/// energy depend; messages have a size limit. Sets none for a model without music. `song`: as
/// EditOptions::audio. Throws Error(kInvalidArgument) whose field is "audio".
void SetMusic(const Audio& song, const ModelDescription& model, int64_t first,
              TransitionRequest* request);

/// Counts a dance's frames at the model's rate. Throws Error(kInvalidArgument) for a dance without
/// frames.
int64_t CountModelFrames(const FinishedDance& dance, const ModelDescription& model);

/// Sets a key pose in a dance. Throws Error(kInvalidArgument) whose field is "key.frame", "from",
/// "to", "audio" or "dance", and as GenerateTransition does.
EditedDance SetKey(const Client& client, const FinishedDance& dance, const EditOptions& options,
                   const KeyEdit& edit);

/// Generates the frames of a gap again, through the gap's keys alone, for another take or to remove
/// a key. Throws Error(kInvalidArgument) whose field is "from", "to", "keys", "audio" or "dance",
/// and as GenerateTransition does.
EditedDance DanceAnew(const Client& client, const FinishedDance& dance, const EditOptions& options,
                      const Gap& gap);

/// Generates `takes` versions of a gap, each as DanceAnew does. They are one transition's
/// candidates if it can span the gap; otherwise each take has the next seed. Throws as DanceAnew
/// does.
std::vector<EditedDance> DanceTakes(const Client& client, const FinishedDance& dance,
                                    const EditOptions& options, const Gap& gap, int takes);

/// Generates a whole dance again through its keys alone, as Client::Dance does. Unchanged keys and
/// options give the frames that the dance had before edits. `keys`: with frames, in order. Throws
/// as Client::Dance does, and Error(kInvalidArgument) for a dance without frames.
EditedDance DanceAllAnew(const Client& client, const FinishedDance& dance,
                         const EditOptions& options, const std::vector<KeyPose>& keys);

/// Makes a dance loop: generates the frames after `from`, and `added` frames after the dance's end,
/// at least one in all, which lead back to the first frames. A dance at another rate than the
/// model's also gets the frames up to the model's next frame. Throws as DanceAnew does.
EditedDance CloseLoop(const Client& client, const FinishedDance& dance, const EditOptions& options,
                      int64_t from, int64_t added = 0);

}  // namespace choreo::client
