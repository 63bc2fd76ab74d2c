#include "lettering/font.h"

namespace relievo {

bool has_lettering() {
  return false;
}

Result<ShapedLine> shape_line(const Ornament&, double) {
  return option_error("text", "expected none, as this build has no HarfBuzz to set it");
}

Result<void> check_text(const Ornament& ornament) {
  RELIEVO_CHECK(shape_line(ornament, .01));
  return {};
}

}  // namespace relievo
