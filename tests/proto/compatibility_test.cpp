#include "tests/proto/compatibility.h"

#include <gmock/gmock.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>

#include "choreo/v1/choreography.pb.h"

namespace choreo::compatibility_test {

using google::protobuf::DescriptorPool;
using google::protobuf::DescriptorProto;
using google::protobuf::FieldDescriptorProto;
using google::protobuf::FileDescriptorProto;
using google::protobuf::FileDescriptorSet;
using testing::ElementsAreArray;
using testing::IsEmpty;

/// tests/proto/released.txtpb: the API of the last release (CONTRIBUTING.md says how it is made).
FileDescriptorSet Released() {
  std::ifstream file(CHOREO_RELEASED_API);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  FileDescriptorSet set;
  if (!google::protobuf::TextFormat::ParseFromString(text, &set))
    throw std::runtime_error(std::string(CHOREO_RELEASED_API) + " is no FileDescriptorSet");
  return set;
}

TEST(ApiTest, IsCompatibleWithTheLastRelease) {
  const DescriptorPool& current = *v1::DanceConfig::descriptor()->file()->pool();
  const FileDescriptorSet files = Released();
  DescriptorPool pool;
  for (const FileDescriptorProto& file : files.file()) {
    const auto* released = pool.BuildFile(file);
    ASSERT_NE(released, nullptr) << file.name();
    EXPECT_THAT(BreakingChanges(*released, current), IsEmpty());
  }
  // It was the API that was compared.
  const auto* service = pool.FindServiceByName("choreo.v1.Choreography");
  ASSERT_NE(service, nullptr);
  EXPECT_GE(service->method_count(), 3);
}

constexpr const char* kSmallApi = R"pb(
  name: "small.proto"
  package: "small"
  syntax: "proto3"
  message_type {
    name: "Pose"
    field { name: "x" number: 1 label: LABEL_OPTIONAL type: TYPE_FLOAT }
    field { name: "joints" number: 2 label: LABEL_REPEATED type: TYPE_INT32 }
    field { name: "frame" number: 3 label: LABEL_OPTIONAL type: TYPE_INT64 oneof_index: 0 }
    field { name: "time" number: 4 label: LABEL_OPTIONAL type: TYPE_DOUBLE oneof_index: 0 }
    field {
      name: "seed"
      number: 5
      label: LABEL_OPTIONAL
      type: TYPE_UINT64
      oneof_index: 1
      proto3_optional: true
    }
    field { name: "kind" number: 6 label: LABEL_OPTIONAL type: TYPE_ENUM type_name: ".small.Kind" }
    oneof_decl { name: "when" }
    oneof_decl { name: "_seed" }
    reserved_range { start: 9 end: 10 }
    reserved_name: "old"
    nested_type {
      name: "Inner"
      field { name: "y" number: 1 label: LABEL_OPTIONAL type: TYPE_FLOAT }
    }
  }
  message_type { name: "Frames" }
  enum_type {
    name: "Kind"
    value { name: "NONE" number: 0 }
    value { name: "REST" number: 1 }
  }
  enum_type {
    name: "Other"
    value { name: "NOTHING" number: 0 }
  }
  service {
    name: "Dancer"
    method {
      name: "Dance"
      input_type: ".small.Pose"
      output_type: ".small.Frames"
      server_streaming: true
    }
  }
)pb";

/// A change to the small API, and what it breaks.
struct Change {
  const char* name;
  std::function<void(FileDescriptorProto& file, DescriptorProto& pose)> make;
  std::vector<std::string> breaks;
};

void PrintTo(const Change& change, std::ostream* out) { *out << change.name; }

class ChangeTest : public testing::TestWithParam<Change> {};

TEST_P(ChangeTest, IsJudged) {
  FileDescriptorProto file;
  ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(kSmallApi, &file));
  DescriptorPool released;
  const auto* before = released.BuildFile(file);
  ASSERT_NE(before, nullptr);
  GetParam().make(file, *file.mutable_message_type(0));
  DescriptorPool current;
  ASSERT_NE(current.BuildFile(file), nullptr);

  EXPECT_THAT(BreakingChanges(*before, current), ElementsAreArray(GetParam().breaks));
}

std::string Name(const testing::TestParamInfo<Change>& info) { return info.param.name; }

FieldDescriptorProto* AddField(DescriptorProto& message, const char* name, int number) {
  FieldDescriptorProto* field = message.add_field();
  field->set_name(name);
  field->set_number(number);
  field->set_label(FieldDescriptorProto::LABEL_OPTIONAL);
  field->set_type(FieldDescriptorProto::TYPE_INT32);
  return field;
}

INSTANTIATE_TEST_SUITE_P(
    Additive, ChangeTest,
    testing::Values(
        Change{"Nothing", [](auto&, auto&) {}, {}},
        Change{"Field", [](auto&, auto& pose) { AddField(pose, "z", 7); }, {}},
        Change{"FieldOfAOneof",
               [](auto&, auto& pose) {
                 AddField(pose, "beat", 7)->set_oneof_index(0);
                 // Fields of a oneof stand together.
                 pose.mutable_field()->SwapElements(4, 6);
               },
               {}},
        Change{"Message", [](auto& file, auto&) { file.add_message_type()->set_name("New"); }, {}},
        Change{"EnumValue",
               [](auto& file, auto&) {
                 auto* value = file.mutable_enum_type(0)->add_value();
                 value->set_name("MOVING");
                 value->set_number(2);
               },
               {}},
        Change{"Method",
               [](auto& file, auto&) {
                 auto* method = file.mutable_service(0)->add_method();
                 *method = file.service(0).method(0);
                 method->set_name("Rest");
               },
               {}},
        Change{"OrderOfFields",
               [](auto&, auto& pose) { pose.mutable_field()->SwapElements(0, 1); },
               {}}),
    Name);

INSTANTIATE_TEST_SUITE_P(
    Breaking, ChangeTest,
    testing::Values(
        Change{"FieldRemoved",
               [](auto&, auto& pose) { pose.mutable_field()->DeleteSubrange(0, 1); },
               {"small.Pose.x: removed"}},
        Change{"FieldRenamed",
               [](auto&, auto& pose) { pose.mutable_field(0)->set_name("left"); },
               {"small.Pose.x: removed"}},
        Change{"FieldRenumbered",
               [](auto&, auto& pose) { pose.mutable_field(0)->set_number(7); },
               {"small.Pose.x: number was 1, is 7"}},
        Change{"FieldRetyped",
               [](auto&, auto& pose) {
                 pose.mutable_field(0)->set_type(FieldDescriptorProto::TYPE_DOUBLE);
               },
               {"small.Pose.x: type was float, is double"}},
        Change{"FieldOfAnotherEnum",
               [](auto&, auto& pose) { pose.mutable_field(5)->set_type_name(".small.Other"); },
               {"small.Pose.kind: type was small.Kind, is small.Other"}},
        Change{"FieldNoLongerRepeated",
               [](auto&, auto& pose) {
                 pose.mutable_field(1)->set_label(FieldDescriptorProto::LABEL_OPTIONAL);
               },
               {"small.Pose.joints: label was repeated, is plain"}},
        Change{"FieldNoLongerOptional",
               [](auto&, auto& pose) {
                 pose.mutable_field(4)->clear_oneof_index();
                 pose.mutable_field(4)->clear_proto3_optional();
                 pose.mutable_oneof_decl()->RemoveLast();
               },
               {"small.Pose.seed: label was optional, is plain"}},
        Change{
            "OneofRenamed",
            [](auto&, auto& pose) { pose.mutable_oneof_decl(0)->set_name("at"); },
            {"small.Pose.frame: oneof was when, is at", "small.Pose.time: oneof was when, is at"}},
        Change{"ReservedNumberUsed",
               [](auto&, auto& pose) {
                 pose.clear_reserved_range();
                 AddField(pose, "z", 9);
               },
               {"small.Pose.z: uses what was reserved"}},
        Change{"ReservedNameUsed",
               [](auto&, auto& pose) {
                 pose.clear_reserved_name();
                 AddField(pose, "old", 7);
               },
               {"small.Pose.old: uses what was reserved"}},
        Change{"MessageRemoved",
               [](auto&, auto& pose) { pose.clear_nested_type(); },
               {"small.Pose.Inner: removed"}},
        Change{"EnumValueRemoved",
               [](auto& file, auto&) { file.mutable_enum_type(0)->mutable_value()->RemoveLast(); },
               {"small.Kind.REST: removed"}},
        Change{
            "EnumValueRenumbered",
            [](auto& file, auto&) { file.mutable_enum_type(0)->mutable_value(1)->set_number(2); },
            {"small.Kind.REST: number was 1, is 2"}},
        Change{"EnumRemoved",
               [](auto& file, auto&) { file.mutable_enum_type()->RemoveLast(); },
               {"small.Other: removed"}},
        Change{"MethodRemoved",
               [](auto& file, auto&) { file.mutable_service(0)->clear_method(); },
               {"small.Dancer.Dance: removed"}},
        Change{"MethodNoLongerStreams",
               [](auto& file, auto&) {
                 file.mutable_service(0)->mutable_method(0)->clear_server_streaming();
               },
               {"small.Dancer.Dance: response was a stream, is one message"}},
        Change{"MethodTakesAnotherMessage",
               [](auto& file, auto&) {
                 file.mutable_service(0)->mutable_method(0)->set_input_type(".small.Frames");
               },
               {"small.Dancer.Dance: request was small.Pose, is small.Frames"}},
        Change{"ServiceRemoved",
               [](auto& file, auto&) { file.clear_service(); },
               {"small.Dancer: removed"}}),
    Name);

}  // namespace choreo::compatibility_test
