#include "proto/wire/control_messages.h"

#include <google/protobuf/reflection.h>

#include "model/core/error.h"
#include "model/core/text/field.h"
#include "model/motion/controls/controls.h"
#include "model/motion/controls/velocity_factors.h"
#include "proto/wire/convert.h"

namespace choreo::wire {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// Adds to a repeated field of `Sent`.
template <typename Sent, typename Value>
void AddAll(const std::vector<Value>& values, const FieldDescriptor* field, Message* out) {
  const auto sent = out->GetReflection()->GetMutableRepeatedFieldRef<Sent>(out, field);
  for (const Value& value : values) sent.Add(static_cast<Sent>(value));
}

/// Reads a repeated field of `Sent`.
template <typename Sent, typename Value>
void GetAll(const Message& message, const FieldDescriptor* field, std::vector<Value>* values) {
  const auto sent = message.GetReflection()->GetRepeatedFieldRef<Sent>(message, field);
  values->assign(sent.begin(), sent.end());
}

bool IsOfFloats(const FieldDescriptor* field) {
  return field->cpp_type() == FieldDescriptor::CPPTYPE_FLOAT;
}

}  // namespace

const FieldDescriptor* FieldOf(const Message& message, std::string_view name) {
  const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(std::string(name));
  if (field != nullptr) return field;
  throw Error(ErrorCode::kInternal, "",
              message.GetTypeName() + " has no field " + std::string(name));
}

void FieldWriter::operator()(const char* name, const std::vector<int64_t>& frames) const {
  AddAll<int64_t>(frames, FieldOf(*out_, name), out_);
}

void FieldWriter::operator()(const char* name, const std::vector<double>& values) const {
  const FieldDescriptor* field = FieldOf(*out_, name);
  IsOfFloats(field) ? AddAll<float>(values, field, out_) : AddAll<double>(values, field, out_);
}

void FieldWriter::operator()(const char* name, const std::vector<float>& values) const {
  AddAll<float>(values, FieldOf(*out_, name), out_);
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

void FieldWriter::operator()(const char* name, const std::vector<Passage>& passages) const {
  for (const Passage& passage : passages)
    out_->GetReflection()->AddMessage(out_, FieldOf(*out_, name))->CopyFrom(ToProto(passage));
}

void FieldWriter::operator()(const char* name, const std::string& text) const {
  out_->GetReflection()->SetString(out_, FieldOf(*out_, name), text);
}

void FieldWriter::operator()(const char* name, const std::optional<double>& number) const {
  if (number) out_->GetReflection()->SetDouble(out_, FieldOf(*out_, name), *number);
}

void FieldWriter::operator()(const char* name, uint64_t number) const {
  out_->GetReflection()->SetUInt64(out_, FieldOf(*out_, name), number);
}

void FieldReader::operator()(const char* name, std::vector<int64_t>& frames) const {
  GetAll<int64_t>(message_, FieldOf(message_, name), &frames);
}

void FieldReader::operator()(const char* name, std::vector<double>& values) const {
  const FieldDescriptor* field = FieldOf(message_, name);
  IsOfFloats(field) ? GetAll<float>(message_, field, &values)
                    : GetAll<double>(message_, field, &values);
}

void FieldReader::operator()(const char* name, std::vector<float>& values) const {
  GetAll<float>(message_, FieldOf(message_, name), &values);
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
  std::vector<int> numbers;
  GetAll<int>(message_, FieldOf(message_, name), &numbers);
  for (const int number : numbers) {
    const int part = number - v1::BODY_PART_TRUNK;
    if (part < 0 || part >= kBodyParts)
      throw InvalidArgument(At(field_ + '.' + name, std::ssize(parts)),
                            std::to_string(number) + " is not a BodyPart");
    parts.emplace_back(kBodyPartNames[static_cast<size_t>(part)]);
  }
}

void FieldReader::operator()(const char* name, std::vector<Passage>& passages) const {
  const auto sent = message_.GetReflection()->GetRepeatedFieldRef<v1::MusicPassage>(
      message_, FieldOf(message_, name));
  for (const v1::MusicPassage& passage : sent) passages.push_back(FromProto(passage));
}

void FieldReader::operator()(const char* name, std::string& text) const {
  text = message_.GetReflection()->GetString(message_, FieldOf(message_, name));
}

void FieldReader::operator()(const char* name, std::optional<double>& number) const {
  const FieldDescriptor* field = message_.GetDescriptor()->FindFieldByName(name);
  if (field && message_.GetReflection()->HasField(message_, field))
    number = message_.GetReflection()->GetDouble(message_, field);
}

void FieldReader::operator()(const char* name, uint64_t& number) const {
  number = message_.GetReflection()->GetUInt64(message_, FieldOf(message_, name));
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
