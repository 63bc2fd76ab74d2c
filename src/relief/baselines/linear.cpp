#include "relief/baselines/scaled.h"
#include "relievo/relief/baselines.h"

namespace relievo {

Relief linear_relief(const Surface& surface, double height) {
  return scaled_relief(depths(surface), surface, height);
}

}  // namespace relievo
