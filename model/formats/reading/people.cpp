#include "model/formats/reading/people.h"

#include <algorithm>

#include "model/core/error.h"
#include "model/core/text/printable.h"

namespace choreo {

int64_t PeopleIn(const NpyArray& array, const std::function<bool(int64_t width)>& is_frame) {
  const std::vector<int64_t>& shape = array.shape;
  if (shape.size() < 3) return 1;
  int64_t width = 1;
  for (size_t i = 2; i < shape.size(); ++i) width *= shape[i];
  return is_frame(width) ? std::max<int64_t>(1, std::min(shape[0], shape[1])) : 1;
}

int64_t ChoosePerson(int64_t people, const std::string& key, const MotionReading& reading) {
  const std::string range = "0 to " + std::to_string(people - 1);
  if (reading.body.empty()) {
    reading.Note("its " + key + " are of " + std::to_string(people) +
                 " people; 0 is read, --body " + range + " chooses");
    return 0;
  }
  const auto person = NumberBelow(reading.body, static_cast<size_t>(people));
  if (!person)
    throw InvalidArgument("--body", '"' + Printable(reading.body) + "\", must be " + range);
  return static_cast<int64_t>(*person);
}

bool HoldsPeople(const NpyArray& array, int64_t people) {
  const std::vector<int64_t>& shape = array.shape;
  return shape.size() > 1 && (shape[0] == people || (shape.size() > 2 && shape[1] == people));
}

NpyArray PersonOf(const NpyArray& array, int64_t people, int64_t person) {
  std::vector<int64_t> shape = array.shape;
  const bool come_first = shape[0] == people;
  const int64_t rows = come_first ? 1 : shape[0], size = array.size() / people / rows;
  shape.erase(shape.begin() + (come_first ? 0 : 1));
  return {shape, std::visit(
                     [&](const auto& values) -> NpyArray::Values {
                       std::decay_t<decltype(values)> one;
                       for (int64_t row = 0; row < rows; ++row) {
                         const auto first = values.begin() + (row * people + person) * size;
                         one.insert(one.end(), first, first + size);
                       }
                       return one;
                     },
                     array.values)};
}

}  // namespace choreo
