#include "model/formats/people.h"

#include "model/core/error.h"
#include "model/core/printable.h"

namespace choreo {

int64_t PeopleIn(const NpyArray& array, const std::function<bool(int64_t width)>& is_frame) {
  const std::vector<int64_t>& shape = array.shape;
  if (shape.size() < 3 || shape[0] < 2) return 1;
  int64_t width = 1;
  for (size_t i = 2; i < shape.size(); ++i) width *= shape[i];
  return is_frame(width) && !is_frame(width * shape[1]) ? shape[0] : 1;
}

int64_t ChoosePerson(int64_t people, const std::string& key, const MotionReading& reading) {
  const std::string range = "0 to " + std::to_string(people - 1);
  if (reading.body.empty()) {
    throw InvalidArgument(key, "are of " + std::to_string(people) +
                                   " people: choreo convert --body " + range + " reads one");
  }
  const auto person = NumberBelow(reading.body, static_cast<size_t>(people));
  if (!person)
    throw InvalidArgument("--body", '"' + Printable(reading.body) + "\", must be " + range);
  return static_cast<int64_t>(*person);
}

NpyArray PersonOf(const NpyArray& people, int64_t person) {
  const int64_t size = people.size() / people.shape[0];
  return {{people.shape.begin() + 1, people.shape.end()},
          std::visit(
              [&](const auto& values) -> NpyArray::Values {
                const auto first = values.begin() + person * size;
                return std::decay_t<decltype(values)>(first, first + size);
              },
              people.values)};
}

}  // namespace choreo
