#include "batch/output_folder.h"

#include <cerrno>

#include "common/descriptor.h"
#include "common/owned_folder.h"
#include "relievo/core/text.h"

namespace relievo::app::batch {
namespace {

constexpr std::string_view owner = "batch";

Result<void> check_ownership(Ownership found, const std::string& folder) {
  if (found == Ownership::of_others)
    return option_error(
        "output",
        cat("expected an empty folder, or one of relievo batch, found other files in '", folder, "'"));
  if (found == Ownership::unusable)
    return system_error(ErrorKind::output, folder, "expected a folder that can be written to");
  return {};
}

}  // namespace

Result<void> check_output_folder(const std::string& outputs) {
  return check_ownership(ownership_of(outputs, owner), outputs);
}

Result<void> make_output_folder(const std::string& outputs, const std::filesystem::path& inner) {
  RELIEVO_CHECK(check_ownership(own_folder(outputs, owner), outputs));
  if (inner.empty()) return {};
  std::error_code failed;
  std::filesystem::create_directories(outputs / inner, failed);
  errno = failed.value();
  return check_ownership(failed ? Ownership::unusable : Ownership::owned, outputs);
}

}  // namespace relievo::app::batch
