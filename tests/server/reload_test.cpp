#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <thread>

#include "client/choreo_client.h"
#include "client/cli/local_server.h"
#include "server/model_folder.h"
#include "tests/server/fixture.h"
#include "tests/support/expect_error.h"
#include "tests/support/sanitizers.h"
#include "tests/support/temporary_folder.h"

/// A folder of models that changes while clients dance.
namespace choreo {
namespace {

/// A model of the name and version that a file has; versions dance differently.
class VersionedEngine final : public FakeEngine {
 public:
  VersionedEngine(const std::string& name, int version, std::shared_ptr<std::atomic<int>> alive)
      : version_(version), alive_(std::move(alive)) {
    model_.name = name;
    model_.fingerprint = name + "-" + std::to_string(version);
    ++*alive_;
  }
  ~VersionedEngine() override { --*alive_; }
  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override {
    FakeEngine::Step(in, out);
    for (StepOutput& one : out) one.pose.rotations(2, 20) += 0.01 * version_;
  }

 private:
  const int version_;
  const std::shared_ptr<std::atomic<int>> alive_;
};

class ReloadTest : public ServerTest {
 protected:
  // The server goes before `alive` does.
  ~ReloadTest() override { server.reset(); }

  // As whoever trains models should: whole, or not at all.
  void Write(const std::string& file, const std::string& content) {
    std::ofstream(models / "written") << content;
    std::filesystem::rename(models / "written", models / file);
  }

  void StartFolder() {
    ServerConfig config;
    config.listen = "127.0.0.1:0";
    config.max_load = 2;
    Connect(std::make_unique<Server>(config, folder.Load()));
  }

  void Reload() {
    folder.Reload(*server, [] { return false; });
  }

  Server::Engines Load(const std::filesystem::path& file) {
    ++loaded;
    std::string name;
    int version = 0;
    if (!(std::ifstream(file) >> name >> version)) throw InvalidArgument(file, "no model");
    Server::Engines engines;
    engines.push_back(std::make_unique<VersionedEngine>(name, version, alive));
    return engines;
  }

  static v1::DanceConfig ConfigOf(const std::string& model, int frames = 90) {
    v1::DanceConfig config = Config();
    config.set_model(model);
    config.set_frames(frames);
    return config;
  }

  // Begins a dance and stops it in the middle.
  std::unique_ptr<DanceClient> Begin(const std::string& model) {
    auto client = std::make_unique<DanceClient>(stub());
    client->Send(ConfigOf(model));
    client->SendGenerateUntil(30);
    EXPECT_TRUE(client->ReadFrames(30));
    return client;
  }
  Answer Whole(const std::string& model) {
    v1::StreamDanceRequest request;
    *request.mutable_config() = ConfigOf(model);
    return Dance({request});
  }

  std::vector<std::string> Served() {
    grpc::ClientContext context;
    v1::GetServerInfoResponse info;
    EXPECT_TRUE(stub().GetServerInfo(&context, {}, &info).ok());
    std::vector<std::string> served;
    for (const v1::ModelInfo& model : info.models()) served.push_back(model.fingerprint());
    return served;
  }

  void ExpectAlive(int count) {
    ExpectEventually([&] { return *alive == count; }, std::to_string(count) + " engines are left");
  }

  TemporaryFolder models;
  std::shared_ptr<std::atomic<int>> alive = std::make_shared<std::atomic<int>>(0);
  int loaded = 0;
  ModelFolder folder{models.path(), [this](const auto& file) { return Load(file); }};
};

TEST_F(ReloadTest, ADanceKeepsTheModelThatItBeganWith) {
  Write("a.safetensors", "a 1");
  StartFolder();
  const Answer first = Whole("a");
  ASSERT_TRUE(first.status.ok()) << first.status.error_message();
  const auto during = Begin("a");
  Write("a.safetensors", "a 2");
  Reload();
  EXPECT_EQ(Served(), std::vector<std::string>{"a-2"});
  const Answer second = Whole("a");
  EXPECT_EQ(second.header->fingerprint(), "a-2");
  EXPECT_NE(second.Join().rotations, first.Join().rotations);
  EXPECT_EQ(*alive, 2);

  EXPECT_EQ(during->Finish().Join(), first.Join());
  EXPECT_EQ(during->answer().continuations.back().fingerprint(), "a-1");
  ExpectAlive(1);  // nobody dances the former one any more
}

TEST_F(ReloadTest, ATransitionKeepsItsModelToo) {
  Write("a.safetensors", "a 1");
  StartFolder();
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.set_frames(600);
  const Answer wanted = Generate(request);
  Answer during;
  std::thread call([&] { during = Generate(request); });
  ExpectEventually([this] { return server->transitions() == 1; }, "it is under way");
  Write("a.safetensors", "a 2");
  Reload();
  call.join();
  EXPECT_EQ(during.Join(), wanted.Join());
  EXPECT_NE(Generate(request).Join(), wanted.Join());
  ExpectAlive(1);
}

TEST_F(ReloadTest, AContinuationOfTheFormerModelIsThatOfAnotherCheckpoint) {
  Write("a.safetensors", "a 1");
  StartFolder();
  const auto during = Begin("a");
  const Answer before = Whole("a");
  Write("a.safetensors", "a 2");
  Reload();
  v1::DanceConfig config = ConfigOf("a", 120);
  *config.mutable_continuation() = before.continuations.back();
  v1::StreamDanceRequest request;
  *request.mutable_config() = config;
  const Answer refused = Dance({request});
  EXPECT_EQ(refused.status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_THAT(refused.status.error_message(), testing::HasSubstr("a-1"));
  EXPECT_THAT(refused.status.error_message(), testing::HasSubstr("a-2"));
  EXPECT_TRUE(during->Finish().status.ok());
}

TEST_F(ReloadTest, AFileThatCannotBeUsedLeavesWhatWasServed) {
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

TEST_F(ReloadTest, ModelsComeAndGo) {
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

// Whatever their names, and whichever was there first.
TEST_F(ReloadTest, AGoodFileGoesBeforeABrokenOneOfItsModel) {
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

TEST_F(ReloadTest, WithoutAModelAllAreServedAsBefore) {
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

// A file that was touched, or has another name, is no other model: nobody's dance is.
TEST_F(ReloadTest, OnlyWhatHasChangedIsLoaded) {
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

TEST_F(ReloadTest, AFolderThatCannotBeServedIsNoStart) {
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

// Who dances sees nothing of it, whoever begins has one version or another, and what nobody dances
// is gone.
TEST_F(ReloadTest, AHundredReloadsBesideDances) {
  constexpr int kVersions = 3, kDancers = 4;
  Write("a.safetensors", "a 0");
  StartFolder();
  std::map<std::string, Answer::Joined> wanted;
  for (int version = kVersions - 1; version >= 0; --version) {
    Write("a.safetensors", "a " + std::to_string(version));
    Reload();
    const Answer answer = Whole("a");
    wanted[answer.header->fingerprint()] = answer.Join();
  }
  ASSERT_EQ(wanted.size(), kVersions);
  std::atomic<bool> over = false;
  std::atomic<int> danced = 0;
  std::vector<std::thread> dancers;
  for (int i = 0; i < kDancers; ++i) {
    dancers.emplace_back([&] {
      do {
        const Answer answer = Whole("a");
        ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
        EXPECT_EQ(answer.Join(), wanted.at(answer.header->fingerprint()));
        ++danced;
      } while (!over);
    });
  }
  for (int i = 0; i < 100; ++i) {
    Write("a.safetensors", "a " + std::to_string(i % kVersions));
    Reload();
  }
  over = true;
  for (std::thread& dancer : dancers) dancer.join();
  EXPECT_GE(danced, kDancers);
  std::cout << "100 reloads beside " << danced << " dances, all bit for bit\n";
  ExpectIdle();
  ExpectAlive(1);
}

TEST_F(ReloadTest, ADrainIsNotDisturbed) {
  Write("a.safetensors", "a 1");
  StartFolder();
  const Answer wanted = Whole("a");
  const auto during = Begin("a");
  std::thread drain([this] { server->Drain(10); });
  ExpectEventually([&] { return !Whole("a").status.ok(); }, "new calls are refused");
  Write("a.safetensors", "a 2");
  Reload();
  EXPECT_EQ(during->Finish().Join(), wanted.Join());
  EXPECT_EQ(Whole("a").status.error_code(), grpc::StatusCode::UNAVAILABLE);
  drain.join();
}

TEST_F(ReloadTest, AServerMayGoWhileAFormerModelIsDanced) {
  Write("a.safetensors", "a 1");
  StartFolder();
  const auto during = Begin("a");
  Write("a.safetensors", "a 2");
  Reload();
  server.reset();
  EXPECT_FALSE(during->Finish().status.ok());
  ExpectAlive(0);
}

/// choreod itself, and its signals.
class ReloadedChoreodTest : public testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "choreod runs LibTorch";
    Put("default");
    ::setenv("CHOREO_MODELS", models.path().c_str(), 1);
    // As where nobody says so: OpenBLAS has begun threads before choreod's main.
    ::setenv("OPENBLAS_NUM_THREADS", "2", 1);
    server.emplace(CHOREOD_PROGRAM);
    ::unsetenv("OPENBLAS_NUM_THREADS");
    ::unsetenv("CHOREO_MODELS");
  }

  void Put(const std::string& name) const {
    const auto shipped = std::filesystem::path(SHIPPED_CHECKPOINT).parent_path();
    std::filesystem::copy_file(shipped / (name + ".safetensors"), models / "written");
    std::filesystem::rename(models / "written", models / (name + ".safetensors"));
  }
  std::vector<std::string> Served() const {
    std::vector<std::string> served;
    for (const auto& model : Client().GetServerInfo().models) served.push_back(model.name);
    return served;
  }
  client::Client Client() const { return client::Client({.addresses = {server->address()}}); }

  // With something in the middle.
  std::vector<Pose> Dance(const std::string& model, const std::function<void()>& between = {}) {
    constexpr int64_t kFrames = 150, kFirst = 30;
    const client::Client client = Client();
    const auto one =
        client.StartDance({.model = model, .seed = 1, .frames = kFrames, .generate_until = 0});
    one->GenerateUntil(kFirst);
    std::vector<Pose> poses;
    while (const std::optional<client::Message> message = one->Next()) {
      const auto* block = std::get_if<client::FrameBlock>(&*message);
      if (block == nullptr) continue;
      poses.insert(poses.end(), block->poses.begin(), block->poses.end());
      if (std::ssize(poses) != kFirst) continue;
      if (between) between();
      one->CompleteKeys();
    }
    EXPECT_EQ(std::ssize(poses), kFrames);
    return poses;
  }
  static void ExpectSame(const std::vector<Pose>& poses, const std::vector<Pose>& wanted) {
    ASSERT_EQ(poses.size(), wanted.size());
    for (size_t i = 0; i < poses.size(); ++i) {
      ASSERT_EQ(poses[i].root_position, wanted[i].root_position) << i;
      ASSERT_EQ(poses[i].rotations, wanted[i].rotations) << i;
    }
  }
  // Loading takes seconds, and longer where others compute.
  static void WaitUntil(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!condition() && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  void Await(const std::vector<std::string>& served) const {
    WaitUntil([&] { return Served() == served; });
    ASSERT_EQ(Served(), served);
  }
  void HangUp(int times) const {
    for (int i = 0; i < times; ++i) kill(server->process(), SIGHUP);
  }

  TemporaryFolder models;
  std::optional<cli::LocalServer> server;
};

TEST_F(ReloadedChoreodTest, ReadsItsFolderAgainWhereItIsHungUp) {
  const std::vector<Pose> wanted = Dance("default");
  ExpectSame(Dance("default",
                   [&] {
                     Put("free");
                     HangUp(100);
                     Await({"default", "free"});
                   }),
             wanted);
  const std::vector<Pose> free = Dance("free");
  ExpectSame(Dance("default",
                   [&] {
                     std::filesystem::remove(models / "default.safetensors");
                     std::ofstream(models / "free.safetensors") << "broken in its place";
                     HangUp(1);
                     Await({"free"});
                   }),
             wanted);
  ExpectSame(Dance(""), free);
}

// Of a process's threads the kernel may choose any that takes a signal.
TEST_F(ReloadedChoreodTest, HearsASignalWhicheverThreadItReaches) {
  Put("free");
  const std::string tasks = "/proc/" + std::to_string(server->process()) + "/task";
  for (const auto& task : std::filesystem::directory_iterator(tasks))
    tgkill(server->process(), std::stoi(task.path().filename()), SIGHUP);
  Await({"default", "free"});
}

TEST_F(ReloadedChoreodTest, LeavesWithZeroWhileItIsHungUp) {
  Put("free");
  HangUp(1);
  kill(server->process(), SIGTERM);
  try {
    WaitUntil([&] {
      HangUp(10);
      server->RequireRunning();
      return false;
    });
    FAIL() << "it does not leave";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("exit code 0"));
  }
}

}  // namespace
}  // namespace choreo
