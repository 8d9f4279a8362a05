#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <fstream>
#include <string>
#include <vector>

/// The .proto files are the API's manual: everything in them has a comment.
namespace choreo::comments_test {

namespace pb = google::protobuf;

std::vector<std::string> bare;  // names of what has no comment before it
int seen = 0;

template <class Descriptor>
void Check(const Descriptor& descriptor) {
  ++seen;
  pb::SourceLocation location;
  ASSERT_TRUE(descriptor.GetSourceLocation(&location));
  if (location.leading_comments.size() < 3) bare.push_back(descriptor.full_name());
}

void CheckEnum(const pb::EnumDescriptor& type) {
  Check(type);
  for (int i = 0; i < type.value_count(); ++i) Check(*type.value(i));
}

void CheckMessage(const pb::Descriptor& type) {
  Check(type);
  for (int i = 0; i < type.field_count(); ++i) Check(*type.field(i));
  for (int i = 0; i < type.real_oneof_decl_count(); ++i) Check(*type.oneof_decl(i));
  for (int i = 0; i < type.enum_type_count(); ++i) CheckEnum(*type.enum_type(i));
  for (int i = 0; i < type.nested_type_count(); ++i) CheckMessage(*type.nested_type(i));
}

TEST(ProtoCommentsTest, EveryElementIsDocumented) {
  pb::FileDescriptorSet files;  // as protoc wrote it, with comments
  std::ifstream stream(CHOREO_DESCRIBED_API, std::ios::binary);
  ASSERT_TRUE(files.ParseFromIstream(&stream)) << CHOREO_DESCRIBED_API;
  ASSERT_EQ(files.file_size(), 2);
  pb::DescriptorPool pool;
  for (const pb::FileDescriptorProto& described : files.file()) {
    const pb::FileDescriptor* file = pool.BuildFile(described);
    ASSERT_NE(file, nullptr) << described.name();
    for (int i = 0; i < file->message_type_count(); ++i) CheckMessage(*file->message_type(i));
    for (int i = 0; i < file->enum_type_count(); ++i) CheckEnum(*file->enum_type(i));
    for (int i = 0; i < file->service_count(); ++i) {
      const pb::ServiceDescriptor& service = *file->service(i);
      Check(service);
      for (int k = 0; k < service.method_count(); ++k) Check(*service.method(k));
    }
  }
  EXPECT_THAT(bare, testing::IsEmpty());
  EXPECT_GT(seen, 150);
}

}  // namespace choreo::comments_test
