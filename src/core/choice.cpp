#include "relievo/core/choice.h"

#include "relievo/core/text.h"

namespace relievo {

std::string either(const std::vector<std::string_view>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += cat(i == 0 ? "" : i + 1 == names.size() ? " or " : ", ", names[i]);
  return text;
}

std::unexpected<Error> not_one_of(std::string_view option, const std::vector<std::string_view>& names,
                                  std::string_view found) {
  return option_error(std::string(option), cat("expected one of ", either(names), ", found '", found, "'"));
}

}  // namespace relievo
