#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <functional>
#include <map>

#include "tests/server/operation/reload_fixture.h"
#include "tests/support/expect_error.h"

// Which files of a model folder are served.
namespace choreo::model_folder_test {

TEST_F(ReloadTest, UnusableFileKeepsTheServedModel) {
  Write("a.safetensors", "a 1");
  Write("b.safetensors", "b 1");
  StartFolder();
  const auto path = models / "a.safetensors";
  const std::map<std::string, std::function<void()>> harms = {
      {"empty", [&] { Write("a.safetensors", ""); }},
      {"none", [&] { Write("a.safetensors", "no model"); }},
      {"a folder", [&] { std::filesystem::create_directory(path); }},
      {"a link to nothing", [&] { std::filesystem::create_symlink("nowhere", path); }},
      {"a device", [&] { std::filesystem::create_symlink("/dev/zero", path); }},
      {"a FIFO", [&] { ASSERT_EQ(mkfifo(path.c_str(), 0600), 0); }},
      {"of another's model", [&] { Write("a.safetensors", "b 2"); }},
  };
  for (const auto& [what, harm] : harms) {
    SCOPED_TRACE(what);
    std::filesystem::remove_all(path);
    harm();
    Write("b.safetensors", "b " + std::to_string(10 + loaded));  // others are loaded all the same
    const std::string fingerprint = "b-" + std::to_string(10 + loaded);
    Reload();
    if (what == "of another's model") {
      EXPECT_EQ(Served(), std::vector<std::string>{"b-2"});  // files come in order
      continue;
    }
    EXPECT_EQ(Served(), (std::vector<std::string>{"a-1", fingerprint}));
    EXPECT_TRUE(Whole("a").status.ok());
  }
  std::filesystem::remove_all(path);
  Write("a.safetensors", "a 3");
  Write("b.safetensors", "b 3");
  Reload();
  EXPECT_EQ(Served(), (std::vector<std::string>{"a-3", "b-3"}));
  ExpectAlive(2);
}

TEST_F(ReloadTest, AddsAndRemovesModels) {
  Write("b.safetensors", "b 1");
  StartFolder();
  Write("a.safetensors", "a 1");
  Write(".hidden.safetensors", "hidden 1");
  Write("notes.txt", "notes 1");
  Reload();
  EXPECT_EQ(Served(), (std::vector<std::string>{"a-1", "b-1"}));
  EXPECT_EQ(Whole("").header->model(), "a");
  Write("default.safetensors", "z 1");
  Reload();
  EXPECT_EQ(Served(), (std::vector<std::string>{"z-1", "a-1", "b-1"}));
  EXPECT_EQ(Whole("").header->model(), "z");

  const Answer wanted = Whole("b");
  const auto during = Begin("b");
  std::filesystem::remove(models / "b.safetensors");
  std::filesystem::remove(models / "default.safetensors");
  Reload();
  EXPECT_EQ(Served(), std::vector<std::string>{"a-1"});
  const Answer refused = Whole("b");
  EXPECT_EQ(refused.status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_THAT(refused.status.error_message(), testing::HasSubstr("this server has \"a\""));
  EXPECT_EQ(during->Finish().Join(), wanted.Join());
  ExpectAlive(1);
}

// Names and order do not matter.
TEST_F(ReloadTest, PrefersAGoodFileToABrokenOneOfTheSameModel) {
  Write("default.safetensors", "a 1");
  Write("b.safetensors", "b 1");
  StartFolder();
  Write("default.safetensors", "broken");
  Reload();
  EXPECT_EQ(Served(), (std::vector<std::string>{"a-1", "b-1"}));
  Write("z.safetensors", "a 2");
  Reload();
  EXPECT_EQ(Served(), (std::vector<std::string>{"a-2", "b-1"})) << "it is the default still";
  Write("default.safetensors", "a 4");
  std::filesystem::remove(models / "z.safetensors");
  Reload();
  EXPECT_EQ(Served(), (std::vector<std::string>{"a-4", "b-1"}));
  ExpectAlive(2);
}

TEST_F(ReloadTest, KeepsServedModelsIfNoneIsUsable) {
  Write("a.safetensors", "a 1");
  StartFolder();
  std::filesystem::remove(models / "a.safetensors");
  Reload();
  EXPECT_EQ(Served(), std::vector<std::string>{"a-1"});
  Write("b.safetensors", "broken");
  Reload();
  EXPECT_EQ(Served(), std::vector<std::string>{"a-1"});
  std::filesystem::remove_all(models.path());
  Reload();
  EXPECT_EQ(Served(), std::vector<std::string>{"a-1"});
  EXPECT_TRUE(Whole("a").status.ok());
}

// A touched or renamed file holds the same model, so no dance changes.
TEST_F(ReloadTest, LoadsOnlyChangedFiles) {
  Write("a.safetensors", "a 1");
  Write("b.safetensors", "b 1");
  StartFolder();
  const Answer before = Whole("a");
  loaded = 0;
  Reload();
  EXPECT_EQ(loaded, 0);
  Write("a.safetensors", "a 1");
  Reload();
  EXPECT_EQ(loaded, 1);
  std::filesystem::rename(models / "b.safetensors", models / "c.safetensors");
  Reload();
  EXPECT_EQ(loaded, 2);
  EXPECT_EQ(*alive, 2);
  EXPECT_EQ(Served(), (std::vector<std::string>{"a-1", "b-1"}));
  EXPECT_EQ(Whole("a").Join(), before.Join());
}

// They lie beside the checkpoint, so its own file stays as it is.
TEST_F(ReloadTest, ChangedFiguresAreRead) {
  Write("a.safetensors", "a 1");
  StartFolder();
  const auto recognised = [this] {
    grpc::ClientContext context;
    v1::GetServerInfoResponse info;
    EXPECT_TRUE(stub().GetServerInfo(&context, {}, &info).ok());
    return info.models(0).style_recognition().recognised_percent();
  };
  EXPECT_EQ(recognised(), 0);
  const auto during = Begin("a");
  Write("a.figures.json", "60");
  Reload();
  EXPECT_EQ(recognised(), 60);
  Write("a.figures.json", "broken");
  Reload();
  EXPECT_EQ(recognised(), 0);
  std::filesystem::remove(models / "a.figures.json");
  loaded = 0;
  Reload();
  Reload();
  EXPECT_EQ(loaded, 1);
  EXPECT_TRUE(during->Finish().status.ok());
  ExpectAlive(1);
}

TEST_F(ReloadTest, DoesNotStartFromAnUnusableFolder) {
  ExpectError(ErrorCode::kInvalidArgument, "no .safetensors file", [&] { folder.Load(); });
  Write("a.safetensors", "a 1");
  Write("b.safetensors", "a 2");
  ExpectError(ErrorCode::kInvalidArgument, "b.safetensors: its model \"a\" comes from a.safetens",
              [&] { folder.Load(); });
  ModelFolder nowhere(models / "nowhere", [this](const auto& file) { return Load(file); });
  ExpectError(ErrorCode::kInvalidArgument, "--models: " + (models / "nowhere").string(),
              [&] { nowhere.Load(); });
  ModelFolder file(models / "a.safetensors", [this](const auto& one) { return Load(one); });
  ExpectError(ErrorCode::kInvalidArgument, "Not a directory", [&] { file.Load(); });
}

}  // namespace choreo::model_folder_test
