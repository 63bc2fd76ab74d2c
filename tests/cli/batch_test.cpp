// Tests runs over catalogues: which outputs are made or kept, and jobs and runs that end early.
#include <csignal>
#include <nlohmann/json.hpp>

#include "batch/finish.h"
#include "batch/memory_need.h"
#include "batch/run.h"
#include "relievo/core/text.h"
#include "support/cli_folder.h"

namespace relievo {
namespace {

using namespace test;
using namespace app::batch;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// Runs jobs without making reliefs. Instead, a job writes the list of its arguments as its solid.
class BatchRun : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    fs::create_directories(folder_ / "out");
    settings_ = {(folder_ / "out").string(), *parse_output_kinds("stl"),
                 [](const auto& arguments) { return pretend(arguments); }};
    for (const char* name : {"a", "b", "c", "d"}) {
      write_all(folder_ / (name + std::string(".ply")), name);
      jobs_.push_back({name, (folder_ / (name + std::string(".ply"))).string(), {}});
    }
  }

  static std::optional<MakeError> pretend(const std::vector<std::string>& arguments) {
    std::string all;
    for (const std::string& argument : arguments) all += argument + " ";
    const std::string name = fs::path(arguments[1]).stem().string();
    if (name == "c") return MakeError{"c.ply: expected something else", false};
    if (name == "d") ::raise(SIGKILL);
    for (const std::string& argument : arguments)
      if (argument.starts_with("--output=") || argument.starts_with("--preview="))
        write_all(argument.substr(argument.find('=') + 1), all);
    return std::nullopt;
  }

  struct Counts {
    std::size_t made = 0, failed = 0, kept = 0;
    bool operator==(const Counts&) const = default;
  };

  Counts run_jobs(RunLimits limits = {2, 0}) {
    const Records records = read_journals(settings_.outputs);
    std::vector<PlannedJob> works;
    for (const Job& job : jobs_) {
      works.push_back({job, std::nullopt, 100});
      if (const auto found = records.find(job.name); found != records.end())
        works.back().before = found->second;
    }
    const auto journal = Journal::open(settings_.outputs);
    Counts counts;
    const auto done =
        app::batch::run(works, settings_, limits, *journal, [&](const JobResult& end, std::size_t) {
          ++(end.is_kept ? counts.kept : end.record.is_made ? counts.made : counts.failed);
        });
    EXPECT_TRUE(done);
    return counts;
  }

  fs::path journal_path() const { return folder_ / "out/.journal" / (host_name() + ".jsonl"); }
  std::size_t journal_lines() const {
    const std::string text = read_all(journal_path());
    return static_cast<std::size_t>(std::ranges::count(text, '\n'));
  }

  RunSettings settings_;
  std::vector<Job> jobs_;
};

TEST_F(BatchRun, SurvivesFailedAndKilledJobs) {
  EXPECT_EQ(run_jobs(), (Counts{2, 2, 0}));
  const Records records = read_journals(settings_.outputs);
  EXPECT_TRUE(records.at("a").is_made);
  EXPECT_EQ(records.at("a").outputs.size(), 2U);
  EXPECT_EQ(records.at("c").error, "c.ply: expected something else");
  EXPECT_FALSE(records.at("c").may_succeed);
  EXPECT_TRUE(records.at("d").error.contains("ended by signal 9")) << records.at("d").error;
  EXPECT_TRUE(records.at("d").may_succeed);
  EXPECT_EQ(journal_lines(), 4U);
}

// A second run keeps finished outputs. It repeats killed jobs, but not failed jobs, whose errors would occur again.
TEST_F(BatchRun, DoesNothingTwice) {
  run_jobs();
  EXPECT_EQ(run_jobs(), (Counts{0, 1, 3}));
  EXPECT_EQ(journal_lines(), 5U);
  write_all(folder_ / "a.ply", "other content");
  EXPECT_EQ(run_jobs(), (Counts{1, 1, 2}));
  jobs_[1].options["height"] = "3";
  EXPECT_EQ(run_jobs(), (Counts{1, 1, 2}));
  fs::remove(folder_ / "out/b.png");
  EXPECT_EQ(run_jobs(), (Counts{1, 1, 2}));
  write_all(folder_ / "out/b.stl", "cut");
  EXPECT_EQ(run_jobs(), (Counts{1, 1, 2}));
  settings_.kinds = *parse_output_kinds("obj");
  EXPECT_EQ(run_jobs(), (Counts{2, 2, 0}));
}

// After an option is changed and changed back, the existing outputs are those of the changed option. So the
// outputs must be made again.
TEST_F(BatchRun, KeepsOnlyWhatWasMadeLast) {
  jobs_.resize(1);
  run_jobs();
  jobs_[0].options["height"] = "3";
  run_jobs();
  jobs_[0].options.clear();
  EXPECT_EQ(run_jobs(), (Counts{1, 0, 0}));
}

TEST_F(BatchRun, GoesOnAfterALineThatWasNotWrittenToItsEnd) {
  jobs_.resize(2);
  run_jobs();
  const std::string text = read_all(journal_path());
  write_all(journal_path(), text.substr(0, text.size() - 20));  // as a power failure leaves it
  EXPECT_EQ(run_jobs(), (Counts{1, 0, 1}));
  EXPECT_EQ(run_jobs(), (Counts{0, 0, 2}));
}

TEST_F(BatchRun, GivesAllProcessorsToTheFewJobsThatMemoryAllows) {
  jobs_.resize(1);
  jobs_[0].options["width"] = "10";
  run_jobs({1, 50});  // the job needs 100 MB, which is over the limit, so it runs alone
  const std::string arguments = read_all(folder_ / "out/a.stl");
  const long processors = ::sysconf(_SC_NPROCESSORS_ONLN);
  EXPECT_TRUE(arguments.contains("--threads="));
  EXPECT_EQ(arguments.find("--threads=1 ") == std::string::npos, processors > 1) << arguments;
  EXPECT_TRUE(arguments.contains("--width=10 "));
}

TEST_F(BatchRun, LocksItsFolder) {
  const auto first = lock_run(settings_.outputs, "");
  ASSERT_TRUE(first);
  EXPECT_FALSE(lock_run(settings_.outputs, ""));
  EXPECT_TRUE(lock_run(settings_.outputs, "-1-of-2"));
}

TEST_F(BatchRun, WritesOneLinePerJobAndThePages) {
  run_jobs();
  ASSERT_TRUE(finish(jobs_, read_journals(settings_.outputs), settings_));
  std::vector<std::string> status;
  for (const std::string& line : lines_of(read_all(folder_ / "out/scans.jsonl")))
    status.push_back(nlohmann::json::parse(line)["status"]);
  EXPECT_EQ(status, (std::vector<std::string>{"made", "made", "failed", "failed"}));
  EXPECT_TRUE(fs::exists(folder_ / "out/index.html"));
  EXPECT_TRUE(fs::exists(folder_ / "out/contact-sheet.png"));
}

// ----------------------------------------------------------------------------- the program, with real scans

// Runs the program on small scans, with options that make small reliefs quickly.
class BatchProgram : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    fs::create_directories(folder_ / "scans");
    fs::remove(folder_ / "torus.ply");
    for (int i = 1; i <= 3; ++i)
      write_all(folder_ / cat("scans/", i, ".ply"), write_ply(torus(1500, 1, .2 + .1 * i)));
    write_all(folder_ / "scans/bad.ply", "ply\nformat ascii 1.0\n");
  }

  // Returns the lines that --list prints: one per job.
  std::vector<std::string> listed(const std::string& options = "") const {
    const Outcome list = must_run(cat("batch scans -o out --list ", options, quick));
    return lines_of(list.out);
  }

  static std::string command_for(const std::vector<std::string>& jobs) {
    std::string command = "batch -o out";
    for (const std::string& job : jobs) command += cat(" --job '", job, "'");
    return command;
  }

  static constexpr const char* quick = " --method linear --height 2 --width 30 --resolution 1.5 --denoise 0 ";
};

TEST_F(BatchProgram, MakesWhatMakeMakes) {
  write_all(folder_ / "scans/notes.txt2", "no scan");
  const Outcome outcome = run(std::string("batch scans -o out") + quick);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(outcome.err.contains("not taken for scans: notes.txt2")) << outcome.err;
  EXPECT_NE(outcome.err.find("expected 4 reliefs, made 3; 1 failed"), std::string::npos) << outcome.err;
  EXPECT_TRUE(outcome.err.contains("failed: bad: ")) << outcome.err;
  for (const char* name : {"1", "2", "3"}) {
    must_run(cat("make scans/", name, ".ply -o ", name, ".stl --quiet", quick));
    EXPECT_EQ(read_all(folder_ / cat(name, ".stl")), read_all(folder_ / "out" / cat(name, ".stl"))) << name;
  }
  const Outcome again = run(std::string("batch scans -o out") + quick);
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_TRUE(again.err.contains("4 of 4, 4 done before, 1 failed")) << again.err;
}

TEST_F(BatchProgram, DoesPartsAndSingleJobs) {
  fs::remove(folder_ / "scans/bad.ply");
  must_run(cat("batch scans -o out --shard 1/2", quick));
  EXPECT_TRUE(fs::exists(folder_ / "out/3.stl"));
  EXPECT_FALSE(fs::exists(folder_ / "out/2.stl"));
  for (const std::string& line : listed()) {
    const Outcome job = must_run(command_for({line}));
    const auto record = nlohmann::json::parse(job.out);
    EXPECT_EQ(record["is_kept"], record["name"] != "2") << job.out;
  }
  must_run(cat("batch scans -o out --pages", quick));
  EXPECT_TRUE(fs::exists(folder_ / "out/index.html"));
}

// A program that hands scans to workers may run several jobs in one process. A bad scan must not stop the
// others.
TEST_F(BatchProgram, DoesSeveralJobsInTurn) {
  const Outcome jobs = run(command_for(listed()));
  EXPECT_EQ(jobs.exit_code, 1);
  std::map<std::string, std::string> status;
  for (const std::string& line : lines_of(jobs.out)) {
    const auto record = nlohmann::json::parse(line);
    status[record["name"]] = record["status"];
  }
  const std::map<std::string, std::string> expected{
      {"1", "made"}, {"2", "made"}, {"3", "made"}, {"bad", "failed"}};
  EXPECT_EQ(status, expected) << jobs.out;
  EXPECT_TRUE(fs::exists(folder_ / "out/1.stl") && fs::exists(folder_ / "out/3.stl"));
}

TEST_F(BatchProgram, EndsAfterTheJobWhoseRecordNobodyTakes) {
  const std::string script = cat("cd '", folder_.string(), "'; '" RELIEVO_CLI "' ",
                                 command_for(listed("--match ?.ply")), " > /dev/full 2> error");
  EXPECT_NE(std::system(script.c_str()), 0);
  EXPECT_TRUE(read_all(folder_ / "error").contains("expected a reader of records"));
  EXPECT_TRUE(fs::exists(folder_ / "out/1.stl"));
  EXPECT_FALSE(fs::exists(folder_ / "out/2.stl"));
}

TEST_F(BatchProgram, MakesAJobOnceThatTwoProcessesGet) {
  const std::string job = cat("'" RELIEVO_CLI "' ", command_for(listed("--match 1.ply")));
  const std::string script = cat("cd '", folder_.string(), "'; ", job, " > a & ", job, " > b; wait");
  ASSERT_EQ(std::system(script.c_str()), 0);
  const auto is_kept = [&](const char* name) -> bool {
    return nlohmann::json::parse(read_all(folder_ / name))["is_kept"];
  };
  EXPECT_NE(is_kept("a"), is_kept("b"));
}

TEST_F(BatchProgram, TakesOptionsOfEachRow) {
  write_all(folder_ / "t.csv", "file,height,name\nscans/1.ply,1in,inch\nscans/1.ply,no number,\n");
  const Outcome outcome = run(cat("batch t.csv -o out --files obj,report --quiet", quick));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NEAR(nlohmann::json::parse(read_all(folder_ / "out/inch.json"))["height_mm"].get<double>(), 25.4,
              .1);
  EXPECT_TRUE(read_all(folder_ / "out/scans.jsonl").contains("no number"));
}

// The lengths on the command line are in the unit of --units, even for scans whose row in the table has
// another unit.
TEST_F(BatchProgram, AppliesTheUnitOnceAndToItsOwnLengths) {
  write_all(folder_ / "t.csv",
            "file,name,units,height\nscans/1.ply,a,,\nscans/1.ply,b,mm,\nscans/1.ply,c,in,1/4\n");
  must_run(
      "batch t.csv -o out --files heightmap,report --quiet --units in --width 1 --height 1/8in --margin 1/4 "
      "--plate 2x2 --tool ball:1/8 --pixel 1/10 --method linear --resolution 1.5mm --denoise 0");
  for (const auto& [name, height_mm] : {std::pair("a", 3.175), {"b", 3.175}, {"c", 6.35}}) {
    const auto report = nlohmann::json::parse(read_all(folder_ / cat("out/", name, ".json")));
    EXPECT_NEAR(report["height_mm"].get<double>(), height_mm, .05) << name;
    EXPECT_NEAR(report["size_mm"][0].get<double>(), 50.8, 1e-3) << name;
    EXPECT_NEAR(report["height_map"]["mm_per_pixel"].get<double>(), 2.54, 1e-9) << name;
  }
}

}  // namespace
}  // namespace relievo
