// Makes a folder with a scan for each test, and runs the program `relievo` in this folder.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

#include "relievo/io/read.h"
#include "relievo/io/write.h"
#include "support/shapes.h"

namespace relievo::test {

namespace fs = std::filesystem;

inline std::string read_all(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_all(const fs::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline void write_all(const fs::path& path, std::span<const std::byte> bytes) {
  write_all(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

// Returns the rest of the line that begins with `label`, without leading spaces; an empty text if there is no
// such line.
inline std::string line_of(const std::string& listing, const std::string& label) {
  const std::size_t at = ("\n" + listing).find("\n" + label + " ");
  if (at == std::string::npos) return {};
  const std::string line = listing.substr(at, listing.find('\n', at) - at);
  return line.substr(line.find_first_not_of(' ', label.size()));
}

struct Outcome {
  int exit_code = 0;
  std::string out, err;
};

class CliFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = fs::temp_directory_path() / "relievo-cli-XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    write_all(folder_ / "torus.ply", write_ply(torus(20000, 1, .4)));
  }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }

  // Runs `relievo ARGUMENTS` in the test's folder. The text `before` is put before the program's name in the command.
  Outcome run(const std::string& arguments, const std::string& before = "") const {
    const fs::path out = folder_.string() + ".out", err = folder_.string() + ".err";
    const std::string command = "cd '" + folder_.string() + "' && " + before + " '" RELIEVO_CLI "' " +
                                arguments + " >'" + out.string() + "' 2>'" + err.string() + "' </dev/null";
    const int status = std::system(command.c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_all(out), read_all(err)};
    fs::remove(out);
    fs::remove(err);
    return outcome;
  }

  // Runs the program and expects that it succeeds.
  Outcome must_run(const std::string& arguments) const {
    Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome;
  }

  // Expects that the program fails, prints to stderr one line that contains `part`, and leaves no new file.
  void expect_refusal(const std::string& arguments, const std::string& part,
                      const std::string& before = "") const {
    const auto files = [&] { return std::distance(fs::directory_iterator(folder_), {}); };
    const auto before_run = files();
    const Outcome outcome = run(arguments, before);
    EXPECT_GT(outcome.exit_code, 0) << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.err.contains(part)) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(files(), before_run) << arguments;
  }

  fs::path folder_;
};

}  // namespace relievo::test
