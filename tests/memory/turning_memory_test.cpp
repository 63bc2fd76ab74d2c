// Tests that turning a scan does not copy its points, of which there may be many.
#include <gtest/gtest.h>

#include "memory/failing_allocation.h"
#include "relievo/samples/sample.h"
#include "relievo/scan/view.h"
#include "scan/measured_cloud.h"
#include "scan/turning/turned_surface.h"

namespace relievo {
namespace {

// The normals are estimated, so their signs are unknown, and each frame has to orient them towards the
// viewer. Orienting the normals must not copy the points either.
TEST(TurningMemory, CopiesThePointsInNoFrame) {
  Cloud cloud = *make_sample("shell", {.points = 100000});
  cloud.normals.clear();
  const TurningScan scan(**MeasuredCloud::measure(cloud, View{}));
  ASSERT_TRUE(scan.do_normals_face_viewer);
  const test::FailingAllocation none(
      {.first = 1L << 60, .least_bytes = scan.points.size() * sizeof(FrontPoint)});
  const bool is_made = turned_surface(scan, View{}, 18000).has_value();
  const long copies = none.counted();
  EXPECT_TRUE(is_made);
  EXPECT_EQ(copies, 0);
}

}  // namespace
}  // namespace relievo
