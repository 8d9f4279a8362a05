#pragma once

#include <string>

#include "model/core/error.h"

namespace choreo {

/// An error about one of several messages of a kind. what() is for people: it counts the accepted
/// messages of that kind and omits the message around a pose, as in "keyframes[3].rotations[16]".
/// path() is for programs: it is the path inside the message, "keyframe.pose.rotations[16]".
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

/// The path of an error's field in the message as sent. The message names coordinates, and stores a
/// continuation's poses as arrays of numbers, whose indices count vectors, not numbers.
std::string PathInMessage(const Error& error);

}  // namespace choreo
