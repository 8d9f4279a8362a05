#pragma once

#include <string>

#include "model/core/error.h"

namespace choreo {

/// An error about one of several messages of a kind. what(), for people, numbers the message among
/// the accepted ones of its kind, and omits the message around a pose:
/// "keyframes[3].rotations[16]". path(), for programs, is the path inside the message:
/// "keyframe.pose.rotations[16]".
class MessageError : public Error {
 public:
  /// `error`: the original error, whose field is the path inside the message. `number`: the
  /// message's index. `key_id`: the id of the key concerned, if any.
  MessageError(const Error& error, int number, std::string key_id = {});

  const std::string& path() const { return path_; }
  const std::string& key_id() const { return key_id_; }

 private:
  std::string path_, key_id_;
};

/// The path of an error's field in the message as sent: with names of coordinates, and for a
/// continuation's poses, which are arrays of numbers, with the vector's index.
std::string PathInMessage(const Error& error);

}  // namespace choreo
