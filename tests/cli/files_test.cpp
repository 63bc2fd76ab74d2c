// Files of the programs: what is no file, temporary files, and pipes where they are fine.
#include "common/files.h"

#include <sys/stat.h>

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

}  // namespace
}  // namespace relievo
