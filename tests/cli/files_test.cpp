// Tests files of the programs: paths that are not files, temporary files, and pipes where they are allowed.
#include "common/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/xattr.h>

#include <csignal>
#include <list>
#include <thread>

#include "common/temporary_file.h"
#include "support/cli_folder.h"

namespace relievo {
namespace {

using namespace test;

class Files : public CliFolder {
 protected:
  std::string path(const char* name) const { return (folder_ / name).string(); }

  // Writes a file as a killed process leaves it, with the mark of a temporary file. Returns false if
  // the file system does not support attributes.
  bool leave(const char* name) const {
    write_all(path(name), "unfinished");
    return ::setxattr(path(name).c_str(), "user.relievo.unfinished", "", 0, 0) == 0;
  }
};

TEST_F(Files, ReadsFilesOnly) {
  const auto expect_refusal_of = [](const std::string& path, const std::string& part) {
    const auto bytes = app::read_file(path);
    ASSERT_FALSE(bytes);
    EXPECT_EQ(bytes.error().kind, ErrorKind::input);
    EXPECT_TRUE(bytes.error().message().contains(part)) << bytes.error().message();
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
  { EXPECT_TRUE(app::TemporaryFile(path("new")).append(app::bytes_of("never kept"))); }
  EXPECT_EQ(files(), before);
  app::TemporaryFile file(path("new"));
  EXPECT_TRUE(file.append(app::bytes_of("in two ")));
  EXPECT_TRUE(file.append(app::bytes_of("pieces")));
  EXPECT_TRUE(file.finish());
  EXPECT_TRUE(file.keep(path("kept")));
  EXPECT_EQ(read_all(path("kept")), "in two pieces");
  EXPECT_EQ(files(), before + 1);
  EXPECT_FALSE(app::TemporaryFile(path("gone/new")).append({}));
  app::TemporaryFile other(path("new"));
  EXPECT_TRUE(other.append(app::bytes_of("another")) && other.keep(path("kept")));
  EXPECT_EQ(read_all(path("kept")), "another") << "in place of what is there";
  fs::create_directory(path("folder"));
  app::TemporaryFile refused(path("new"));
  EXPECT_FALSE(refused.keep(path("folder")));
  EXPECT_EQ(files(), before + 2) << "nothing is left of what could not take its place";
}

// Names of temporary files end with consecutive numbers. Here, files with the next 2,000 numbers already
// exist, so the program has to skip these numbers.
TEST_F(Files, NothingIsRemovedThatWasThere) {
  write_all(path("a.stl"), "old");
  std::vector<std::string> names{"a.stl.relievo-abcdef", "a.stl.relievo-ABCDEF", "a.stl.relievo-"};
  for (int i = 0; i < 2000; ++i)
    names.push_back("a.stl.relievo-" + std::to_string(::getpid()) + "-" + std::to_string(i));
  for (const std::string& name : names) write_all(path(name.c_str()), name);
  app::TemporaryFile file(path("a.stl"));
  EXPECT_TRUE(file.append(app::bytes_of("new")) && file.finish() && file.keep(path("a.stl")));
  EXPECT_EQ(read_all(path("a.stl")), "new");
  for (const std::string& name : names) EXPECT_EQ(read_all(path(name.c_str())), name);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), static_cast<long>(names.size()) + 2);
}

// The test itself writes the files that a process leaves if it is killed just before it replaces an old file
// by the new file, which is then already complete.
TEST_F(Files, WhatAKilledRunLeftIsRemovedByTheNextOne) {
  write_all(path("a.stl"), "old");
  if (!leave("a.stl.relievo-1-1") || !leave("b.stl.relievo-1-1")) GTEST_SKIP() << "no attributes here";
  app::TemporaryFile file(path("a.stl"));
  EXPECT_TRUE(file.append({}) && file.finish() && file.keep(path("a.stl")));
  EXPECT_FALSE(fs::exists(path("a.stl.relievo-1-1")));
  EXPECT_TRUE(fs::exists(path("b.stl.relievo-1-1"))) << "of another output";
  EXPECT_LT(::getxattr(path("a.stl").c_str(), "user.relievo.unfinished", nullptr, 0), 0);
}

TEST_F(Files, WhatKilledRunsLeftInAFolderIsRemovedWhateverItsPath) {
  if (!leave("a.stl.relievo-1-1") || !leave("b.stl.relievo-1-2") || !leave("open.relievo-1-4") ||
      !leave("kept"))
    GTEST_SKIP() << "no attributes here";
  write_all(path("c.stl.relievo-1-3"), "of others");
  const app::Descriptor open(::open(path("open.relievo-1-4").c_str(), O_RDWR));
  ASSERT_EQ(::flock(open.number(), LOCK_EX), 0);
  app::remove_abandoned_files(folder_);
  EXPECT_FALSE(fs::exists(path("a.stl.relievo-1-1")));
  EXPECT_FALSE(fs::exists(path("b.stl.relievo-1-2")));
  EXPECT_TRUE(fs::exists(path("open.relievo-1-4"))) << "a process still writes it";
  EXPECT_TRUE(fs::exists(path("kept"))) << "its process was killed after it had renamed the file";
  EXPECT_TRUE(fs::exists(path("c.stl.relievo-1-3")));
  app::remove_abandoned_files(path("no-such-folder"));
}

TEST_F(Files, AsManyTemporaryFilesAsAreWantedCanBeWritten) {
  std::list<app::TemporaryFile> many;
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(many.emplace_back(path("many")).append({})) << i;
}

int calls_of_umask = 0;

TEST_F(Files, TemporaryFilesHaveTheirPermissionsAndLeaveTheMaskAlone) {
  const auto mode_of = [&](unsigned mode) {
    app::TemporaryFile file(path("new"), mode);
    EXPECT_TRUE(file.append({}) && file.finish() && file.keep(path("kept")));
    struct stat status {};
    EXPECT_EQ(::stat(path("kept").c_str(), &status), 0);
    return status.st_mode & 0777;
  };
  const mode_t before = ::umask(027);
  calls_of_umask = 0;
  EXPECT_EQ(mode_of(0666), 0640U);
  EXPECT_EQ(mode_of(0600), 0600U);
  EXPECT_EQ(calls_of_umask, 0) << "which would change it for all threads";
  ::umask(before);
}

// One thread handles the signal. Meanwhile the other threads continue to make files.
TEST_F(Files, ASignalLeavesNoTemporaryFileOfAnyThread) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "this sanitizer delays signals";
#endif
  const auto make_files = [&](int thread) {
    const std::string place = path(std::to_string(thread).c_str());
    for (;;) {
      app::TemporaryFile file(place);
      if (!file.append({}) || !file.keep(place)) std::abort();
    }
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
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_FALSE(entry.path().string().contains(".relievo-")) << entry.path();
}

}  // namespace
}  // namespace relievo

// Replaces umask() of the C library by a function that counts its calls.
extern "C" mode_t umask(mode_t mask) {
  ++relievo::calls_of_umask;
  return static_cast<mode_t>(::syscall(SYS_umask, mask));
}
