// Tests tables and lists of jobs, and the memory that jobs need.
#include "batch/jobs.h"

#include <nlohmann/json.hpp>

#include "batch/finish.h"
#include "batch/memory_need.h"
#include "relievo/core/text.h"
#include "support/cli_folder.h"

namespace relievo {
namespace {

using namespace test;
using namespace app;
using namespace app::batch;
using Cells = std::vector<std::string>;

TEST(BatchTable, ReadsWhatSpreadsheetsWrite) {
  const auto table = read_table(
      "\xEF\xBB\xBF"
      "file,view,height\r\na.ply,left,4\r\n\"b, \"\"c\"\".ply\",\"1,0,\n0\"\r\n,,\r\n",
      "t.csv");
  ASSERT_TRUE(table) << table.error().message();
  EXPECT_EQ(table->columns, (Cells{"file", "view", "height"}));
  ASSERT_EQ(table->rows.size(), 2U);
  EXPECT_EQ(table->rows[0].cells, (Cells{"a.ply", "left", "4"}));
  EXPECT_EQ(table->rows[1].cells, (Cells{"b, \"c\".ply", "1,0,\n0", ""}));
  EXPECT_EQ(table->rows[1].line, 3U);
}

TEST(BatchTable, ReadsSemicolonsAndTabs) {
  for (const char separator : {';', '\t'}) {
    const auto table = read_table(cat("file", separator, "height\na.ply", separator, "2,5"), "t.csv");
    ASSERT_TRUE(table);
    EXPECT_EQ(table->rows.at(0).cells, (Cells{"a.ply", "2,5"}));
  }
}

TEST(BatchTable, RefusesWhatIsNoTable) {
  const auto error_of = [](std::string_view text) { return read_table(text, "t.csv").error().message(); };
  EXPECT_EQ(error_of("file\na.ply\nb.ply,4\n"),
            "t.csv, line 3: expected 1 cells as in the first row, found 2");
}

class BatchJobs : public CliFolder {
 protected:
  Result<std::vector<Job>> list(const std::string& path, const Options& common = {}) const {
    const auto is_option = [](const std::string& name) { return name == "height" || name == "view"; };
    return list_jobs({(folder_ / path).string(), "", (folder_ / "out").string(), common}, is_option);
  }
  std::string error_of(const std::string& table) const {
    write_all(folder_ / "t.csv", table);
    const auto jobs = list("t.csv");
    return jobs ? "" : jobs.error().message();
  }
};

TEST_F(BatchJobs, AreTheScansOfAFolder) {
  fs::create_directories(folder_ / "b/c");
  fs::create_directories(folder_ / "out");
  fs::create_directories(folder_ / "depths");
  for (const char* name : {"b/c/x.obj", "b/x.stl", "b/x.PLY", "b/texture.png", "b/notes.pdf", "b/.hidden.ply",
                           "out/old.ply", "depths/d.png"})
    write_all(folder_ / name, "");
  const auto jobs = list("", {{"height", "3"}});
  ASSERT_TRUE(jobs);
  std::vector<std::string> names;
  for (const Job& job : *jobs) names.push_back(job.name);
  // Pictures beside models are not scans but textures. The outputs of a run are not scans either.
  EXPECT_EQ(names, (Cells{"b/c/x", "b/x", "b/x-2", "depths/d", "torus"}));
  EXPECT_EQ(skipped_files({folder_.string(), "", (folder_ / "out").string(), {}}, *jobs),
            (Cells{"b/notes.pdf", "b/texture.png"}));
  EXPECT_EQ(jobs->back().file, (folder_ / "torus.ply").string());
  EXPECT_EQ(jobs->back().options, (Options{{"height", "3"}}));
}

TEST(BatchPages, NameTheSameScansUnderSeveralNames) {
  const std::vector<Job> jobs{{"b", {}, {}}, {"a", {}, {}}, {"c", {}, {}}, {"failed", {}, {}}};
  Records records;
  for (const Job& job : jobs) records[job.name] = {job.name, job.name + ".ply", true, {}, false, "hash"};
  records["c"].hash = "other";
  records["failed"].is_made = false;
  EXPECT_EQ(same_scans(jobs, records), (std::vector<Cells>{{"b", "a"}}));
}

TEST_F(BatchJobs, AreTheRowsOfATable) {
  write_all(folder_ / "t.csv",
            "file,view,name,height\ntorus.ply,left,,\ntorus.ply,,sides/right,5\ntorus.ply\n");
  const auto jobs = list("t.csv", {{"height", "3"}});
  ASSERT_TRUE(jobs) << jobs.error().message();
  ASSERT_EQ(jobs->size(), 3U);
  EXPECT_EQ((*jobs)[0].name, "torus");
  EXPECT_EQ((*jobs)[1].name, "sides/right");
  EXPECT_EQ((*jobs)[2].name, "torus-2");
  EXPECT_EQ((*jobs)[0].options, (Options{{"height", "3"}, {"view", "left"}}));
  EXPECT_EQ((*jobs)[1].options, (Options{{"height", "5"}}));
  for (const Job& job : *jobs) {
    EXPECT_EQ(job.file, (folder_ / "torus.ply").string());
    const auto again = job_from_json(to_json(job));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->options, job.options);
  }
}

TEST_F(BatchJobs, NameWhatIsWrongInATable) {
  EXPECT_TRUE(error_of("file,hight\na.ply,3\n").contains("found 'hight'"));
  EXPECT_TRUE(error_of("file,name\na.ply,x\nb.ply,x\n").contains("line 3"));
  EXPECT_TRUE(error_of("file\n").contains("expected scans, found none"));
}

// The preview of a-heights.ply has the name that the height map of a.ply would have.
TEST_F(BatchJobs, HaveOutputsOfDifferentNames) {
  fs::remove(folder_ / "torus.ply");
  for (const char* name : {"a.ply", "a-heights.ply", "contact-sheet.ply"}) write_all(folder_ / name, "");
  const Catalogue catalogue{folder_.string(), "", (folder_ / "out").string(), {}, {"-heights.png", ".png"}};
  const auto jobs = list_jobs(catalogue, {});
  ASSERT_TRUE(jobs) << jobs.error().message();
  std::vector<std::string> names;
  for (const Job& job : *jobs) names.push_back(job.name);
  EXPECT_EQ(names, (Cells{"a-heights", "a-2", "scan-contact-sheet"}));
}

TEST_F(BatchJobs, AreNamedInUtf8) {
  write_all(folder_ / "caf\xe9.ply", "");
  const auto jobs = list("");
  ASSERT_FALSE(jobs);
  EXPECT_TRUE(jobs.error().message().contains("expected names and options in UTF-8"))
      << jobs.error().message();
  expect_refusal("batch . -o out --list", "expected names and options in UTF-8");
  EXPECT_TRUE(list_jobs({folder_.string(), "t*", (folder_ / "out").string(), {}}, {}));
}

TEST_F(BatchJobs, ReadTheFilesThatScenesProjectsAndOptionsName) {
  write_all(folder_ / "s.json", R"({"models": [{"file": "torus.ply"}]})");
  write_all(folder_ / "p.relievo", R"({"relievo": 1, "input": {"path": "s.json"}, "options": {}})");
  write_all(folder_ / "l.json", R"([{"kind": "drawing", "file": "d.svg"}])");
  const auto path = [&](const char* name) { return (folder_ / name).string(); };
  Cells files;
  for (const InputFile& file : files_of({"p", path("p.relievo"), {{"ornaments", path("l.json")}}}))
    files.push_back(file.path);
  EXPECT_EQ(files,
            (Cells{path("p.relievo"), path("s.json"), path("torus.ply"), path("l.json"), path("d.svg")}));
}

// More points need more memory, and a scene needs the memory for the points of all its models.
TEST_F(BatchJobs, NeedMemoryByTheirPoints) {
  write_all(folder_ / "s.json", R"({"models": [{"file": "torus.ply"}, {"file": "large.ply"}]})");
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1000000\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n";
  write_all(folder_ / "large.ply", header);
  fs::resize_file(folder_ / "large.ply", header.size() + 12000000);
  const auto need = [&](const char* name) { return memory_need_mb({"n", (folder_ / name).string(), {}}); };
  const double none = need("gone.ply"), small = need("torus.ply"), large = need("large.ply");
  EXPECT_GT(small, none);
  EXPECT_GT(large - none, 40 * (small - none));
  EXPECT_LT(large, 1000);
  EXPECT_GT(need("s.json"), large + small - none - 1);
  EXPECT_GT(available_memory_mb(), 0);
}

}  // namespace
}  // namespace relievo
