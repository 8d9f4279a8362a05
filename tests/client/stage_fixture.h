#pragma once

#include <gtest/gtest.h>

#include <string>

#include "client/authoring/local_server.h"
#include "model/formats/motion_file.h"
#include "tests/client/run_choreo.h"
#include "tests/client/test_music.h"
#include "tests/support/temporary_folder.h"

namespace choreo {

/// `choreo` with a fake choreod, a folder of its own and a song of ten seconds in it.
class StageTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    server_ = new authoring::LocalServer(std::filesystem::path(FAKE_CHOREOD));
  }
  static void TearDownTestSuite() {
    delete server_;
    server_ = nullptr;
  }
  void SetUp() override { WriteClicks(folder_ / "song.wav", 10); }

  std::string At(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
  static std::string Server() { return " --server " + server_->address() + " "; }
  /// Dances to the song into NAME.npz and NAME.json.
  Outcome Dance(const std::string& name, const std::string& arguments) const {
    return Choreo("dance " + At("song.wav") + Server() + arguments + " -o " + At(name + ".npz") +
                  " --report " + At(name + ".json"));
  }
  Motion Read(const std::string& name) const {
    return ReadMotion(folder_ / name, Skeleton::Smpl24());
  }

  TemporaryFolder folder_;

 private:
  static inline authoring::LocalServer* server_ = nullptr;
};

}  // namespace choreo
