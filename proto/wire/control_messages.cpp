#include "proto/wire/control_messages.h"

#include "model/core/error.h"
#include "model/core/text/field.h"
#include "model/motion/controls/controls.h"
#include "model/motion/controls/velocity_factors.h"

namespace choreo::wire {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// Calls `read(message, field)` with a repeated field's numbers, one by one.
template <typename Read>
auto All(const Message& message, const char* name, const Read& read) {
  const FieldDescriptor* field = FieldOf(message, name);
  std::vector<decltype(read(field, 0))> values;
  for (int i = 0; i < message.GetReflection()->FieldSize(message, field); ++i)
    values.push_back(read(field, i));
  return values;
}

}  // namespace

const FieldDescriptor* FieldOf(const Message& message, std::string_view name) {
  const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(std::string(name));
  if (field != nullptr) return field;
  throw Error(ErrorCode::kInternal, "",
              message.GetTypeName() + " has no field " + std::string(name));
}

void FieldWriter::operator()(const char* name, const std::vector<int64_t>& frames) const {
  for (const int64_t frame : frames)
    out_->GetReflection()->AddInt64(out_, FieldOf(*out_, name), frame);
}

void FieldWriter::operator()(const char* name, const std::vector<double>& values) const {
  for (const double value : values)
    out_->GetReflection()->AddFloat(out_, FieldOf(*out_, name), static_cast<float>(value));
}

void FieldWriter::operator()(const char* name, const std::vector<Eigen::Vector2d>& points) const {
  for (const Eigen::Vector2d& point : points) (*this)(name, std::vector{point.x(), point.y()});
}

void FieldWriter::operator()(const char* name, const std::vector<std::string>& parts) const {
  for (const std::string& part : parts) {
    const std::optional<BodyPart> known = FindBodyPart(part);
    if (!known) {
      throw InvalidArgument(field_ + '.' + name, '"' + part + "\" is none of " + BodyPartNames());
    }
    out_->GetReflection()->AddEnumValue(out_, FieldOf(*out_, name),
                                        v1::BODY_PART_TRUNK + static_cast<int>(*known));
  }
}

void FieldWriter::operator()(const char* name, const std::string& text) const {
  out_->GetReflection()->SetString(out_, FieldOf(*out_, name), text);
}

void FieldWriter::operator()(const char* name, const std::optional<double>& number) const {
  if (number) out_->GetReflection()->SetDouble(out_, FieldOf(*out_, name), *number);
}

void FieldReader::operator()(const char* name, std::vector<int64_t>& frames) const {
  frames = All(message_, name, [this](const FieldDescriptor* field, int i) {
    return message_.GetReflection()->GetRepeatedInt64(message_, field, i);
  });
}

void FieldReader::operator()(const char* name, std::vector<double>& values) const {
  values = All(message_, name, [this](const FieldDescriptor* field, int i) -> double {
    return message_.GetReflection()->GetRepeatedFloat(message_, field, i);
  });
}

void FieldReader::operator()(const char* name, std::vector<Eigen::Vector2d>& points) const {
  std::vector<double> numbers;
  (*this)(name, numbers);
  if (numbers.size() % 2 != 0) {
    throw InvalidArgument(field_ + '.' + name,
                          std::to_string(numbers.size()) + " numbers, not two for each point");
  }
  for (size_t i = 0; i < numbers.size(); i += 2) points.emplace_back(numbers[i], numbers[i + 1]);
}

void FieldReader::operator()(const char* name, std::vector<std::string>& parts) const {
  parts = All(message_, name, [this, name](const FieldDescriptor* field, int i) {
    const int number = message_.GetReflection()->GetRepeatedEnumValue(message_, field, i);
    const int part = number - v1::BODY_PART_TRUNK;
    if (part < 0 || part >= kBodyParts)
      throw InvalidArgument(At(field_ + '.' + name, i),
                            std::to_string(number) + " is not a BodyPart");
    return std::string(kBodyPartNames[static_cast<size_t>(part)]);
  });
}

void FieldReader::operator()(const char* name, std::string& text) const {
  text = message_.GetReflection()->GetString(message_, FieldOf(message_, name));
}

void FieldReader::operator()(const char* name, std::optional<double>& number) const {
  const FieldDescriptor* field = message_.GetDescriptor()->FindFieldByName(name);
  if (field && message_.GetReflection()->HasField(message_, field))
    number = message_.GetReflection()->GetDouble(message_, field);
}

v1::Controls ToProto(const ControlRequest& controls) {
  v1::Controls out;
  WriteControls(controls, &out);
  return out;
}

ControlRequest FromProto(const v1::Controls& controls, const std::string& field) {
  ControlRequest out;
  ReadControls(controls, field, &out);
  return out;
}

}  // namespace choreo::wire
