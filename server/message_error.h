#pragma once

#include <string>

#include "model/core/error.h"

namespace choreo {

/// An error about a message that may come more than once. People read its number among those
/// accepted of its kind, and no message around a pose: "keyframes[3].rotations[16]". Programs get
/// the path in the message: "keyframe.pose.rotations[16]".
class MessageError : public Error {
 public:
  /// `error`: its field is the path in the message. `key_id`: of the key that it is about, if any.
  MessageError(const Error& error, int number, std::string key_id = {});

  const std::string& path() const { return path_; }
  const std::string& key_id() const { return key_id_; }

 private:
  std::string path_, key_id_;
};

/// The path of an error's field in the sent message. There coordinates have names, and the poses of
/// a continuation are arrays of numbers: vectors are counted, not numbers.
std::string PathInMessage(const Error& error);

}  // namespace choreo
