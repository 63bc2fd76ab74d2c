#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "common/files.h"
#include "common/output_files.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"
#include "relievo/io/write.h"
#include "relievo/samples/sample.h"

namespace relievo::app::cli {
namespace {

struct SampleArguments {
  std::string name, output;
  SampleOptions options;
};

Result<void> sample(const SampleArguments& arguments) {
  RELIEVO_CHECK(check_output(arguments.output, {".ply"}));
  RELIEVO_TRY(const Cloud cloud, make_sample(arguments.name, arguments.options));
  const OutputFile file{arguments.output, write_ply(cloud, cat("relievo sample ", arguments.name))};
  return write_files({&file, 1});
}

std::string names_text() {
  std::string text;
  for (const SampleInfo& info : samples())
    text += cat(text.empty() ? "" : "; ", info.name, ": ", info.description);
  return text;
}

}  // namespace

void add_sample(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<SampleArguments>();
  CLI::App& command = *program.add_subcommand("sample", "Generate a scan to try things with");
  command.add_option("name", arguments->name, names_text())->required()->type_name("NAME");
  command.add_option("-o,--output", arguments->output, "point cloud with normals")
      ->required()
      ->type_name("F.ply");
  command.add_option("--points", arguments->options.points, "number of points [1000 to 100000000]")
      ->type_name("N")
      ->capture_default_str();
  command
      .add_option("--noise", arguments->options.noise,
                  "standard deviation along the normal, in spacings [0 to 5]")
      ->type_name("S")
      ->capture_default_str();
  command.callback([arguments, &result] { result = sample(*arguments); });
}

}  // namespace relievo::app::cli
