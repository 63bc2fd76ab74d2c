// Files of the programs: what is no file, temporary files, and pipes where they are fine.
#include "common/files.h"

#include <sys/stat.h>

#include <csignal>
#include <thread>

#include "common/temporary_file.h"
#include "support/cli_folder.h"

namespace relievo {
namespace {

using namespace test;

class Files : public CliFolder {
 protected:
  std::string path(const char* name) const { return (folder_ / name).string(); }
};

TEST_F(Files, ReadsFilesOnly) {
  const auto expect_refusal_of = [](const std::string& path, const std::string& part) {
    const auto bytes = app::read_file(path);
    ASSERT_FALSE(bytes);
    EXPECT_EQ(bytes.error().kind, ErrorKind::input);
    EXPECT_NE(bytes.error().message().find(part), std::string::npos) << bytes.error().message();
  };
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  expect_refusal_of("/dev/zero", "found a device");
  expect_refusal_of(path("pipe"), "found a pipe");
  expect_refusal_of(folder_.string(), "found a folder");
  expect_refusal_of(path("gone"), "No such file");
  write_all(path("huge"), "");
  fs::resize_file(path("huge"), std::uintmax_t{1} << 40);
  expect_refusal_of(path("huge"), "half of the memory");
}

TEST_F(Files, ReadsPipesOfTheCommandLine) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  const std::string text(300000, 'x');
  std::thread writer([&] { write_all(path("pipe"), text); });
  const auto bytes = app::read_file(path("pipe"), true);
  writer.join();
  ASSERT_TRUE(bytes);
  EXPECT_EQ(*bytes, app::bytes_of(text));
  EXPECT_FALSE(app::read_file("/dev/zero", true));
}

TEST_F(Files, TemporaryFilesAreGoneUnlessKept) {
  const auto files = [&] { return std::distance(fs::directory_iterator(folder_), {}); };
  const auto before = files();
  {
    app::TemporaryFile file(path("new"));
    EXPECT_TRUE(file.append(app::bytes_of("never kept")));
    EXPECT_EQ(files(), before + 1);
  }
  EXPECT_EQ(files(), before);
  app::TemporaryFile file(path("new"));
  EXPECT_TRUE(file.append(app::bytes_of("in two ")));
  EXPECT_TRUE(file.append(app::bytes_of("pieces")));
  EXPECT_TRUE(file.finish());
  EXPECT_TRUE(file.keep(path("kept")));
  EXPECT_EQ(read_all(path("kept")), "in two pieces");
  EXPECT_FALSE(app::TemporaryFile(path("gone/new")).append({}));
}

TEST_F(Files, WhatAnEndedRunLeftIsRemovedByTheNextOne) {
  for (const char* const name : {"a.stl.relievo-abcdef", "a.stl.relievo-abcde", "b.stl.relievo-abcdef"})
    write_all(path(name), "half");
  app::TemporaryFile writing(path("c.stl"));
  const app::TemporaryFile next(path("a.stl")), other(path("c.stl"));
  EXPECT_FALSE(fs::exists(path("a.stl.relievo-abcdef")));
  EXPECT_TRUE(fs::exists(path("a.stl.relievo-abcde"))) << "not a name of ours";
  EXPECT_TRUE(fs::exists(path("b.stl.relievo-abcdef"))) << "of another output";
  EXPECT_TRUE(writing.append({}) && writing.finish() && writing.keep(path("kept"))) << "being written";
}

// Threads go on making files while one of them handles the signal.
TEST_F(Files, ASignalLeavesNoTemporaryFileOfAnyThread) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "this sanitizer delays signals";
#endif
  const auto make_files = [&](int thread) {
    for (;;) app::TemporaryFile(path(std::to_string(thread).c_str()));
  };
  const auto end_while_making = [&] {
    app::remove_temporary_files_on_signals();
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back(make_files, i);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ::kill(::getpid(), SIGTERM);
    for (std::thread& thread : threads) thread.join();
  };
  for (int i = 0; i < 20; ++i) EXPECT_EXIT(end_while_making(), testing::KilledBySignal(SIGTERM), "");
  for (const auto& entry : fs::directory_iterator(folder_)) EXPECT_EQ(entry.path().filename(), "torus.ply");
}

}  // namespace
}  // namespace relievo
