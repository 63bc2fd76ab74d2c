// Checks a solid in an STL file, and a height map of the solid, without the code that made both:
// check_solid SOLID.stl [MAP.png|MAP.tif]. Prints the faults; the exit code is 1 if there are any.
#include <cstdio>
#include <fstream>
#include <iterator>

#include "relievo/io/read.h"
#include "support/read_solid.h"
#include "support/self_intersections.h"

namespace relievo::test {
namespace {

std::string bytes_of(const char* path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The triangles that face +Z, and their bounding box.
struct Front {
  std::vector<Corners> triangles;
  Box box;
};

double turn(const Vec3& a, const Vec3& b, double x, double y) {
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

Front front_of(const Solid& solid) {
  Front front;
  for (const auto& [a, b, c] : solid.triangles) {
    const Corners t{solid.points[a], solid.points[b], solid.points[c]};
    if (!(turn(t[0], t[1], t[2].x(), t[2].y()) > 0)) continue;
    front.triangles.push_back(t);
    for (const Vec3& p : t) front.box.extend(p);
  }
  return front;
}

// Returns the height of the highest triangle at the centre of each pixel; NaN where there is no triangle.
// Each triangle is tested at all pixels in its bounding box.
Image<double> heights_under(const Front& front, int width, int height, double mm_per_pixel) {
  Image<double> heights = filled_image(width, height, std::nan(""));
  const Vec3 middle = front.box.centre();
  const auto x_of = [&](int column) { return middle.x() + (column + .5 - width / 2.) * mm_per_pixel; };
  const auto y_of = [&](int row) { return middle.y() - (row + .5 - height / 2.) * mm_per_pixel; };
  for (const Corners& t : front.triangles) {
    Box box;
    for (const Vec3& p : t) box.extend(p);
    const auto first = [](double at, int most) { return std::clamp(static_cast<int>(at) - 1, 0, most); };
    const int left = first((box.min.x() - middle.x()) / mm_per_pixel + width / 2., width),
              right = first((box.max.x() - middle.x()) / mm_per_pixel + width / 2. + 3, width),
              top = first((middle.y() - box.max.y()) / mm_per_pixel + height / 2., height),
              bottom = first((middle.y() - box.min.y()) / mm_per_pixel + height / 2. + 3, height);
    const double area = turn(t[0], t[1], t[2].x(), t[2].y());
    for (int row = top; row < bottom; ++row)
      for (int column = left; column < right; ++column) {
        const double x = x_of(column), y = y_of(row);
        const double a = turn(t[1], t[2], x, y), b = turn(t[2], t[0], x, y), c = turn(t[0], t[1], x, y);
        if (a < 0 || b < 0 || c < 0) continue;
        const double z = (a * t[0].z() + b * t[1].z() + c * t[2].z()) / area;
        double& highest = heights.at(column, row);
        if (!(highest >= z)) highest = z;
      }
  }
  return heights;
}

// Returns a text about the difference between a map and the solid. The text is empty if no pixel differs
// by more than 0.01 mm, and at most a thousandth of the pixels by more than 0.001 mm.
std::string difference(const Solid& solid, const char* path) {
  const std::string file = bytes_of(path);
  const Result<DepthImage> map = read_depth_image(std::as_bytes(std::span(file)), path);
  if (!map) return map.error().message();
  const Front front = front_of(solid);
  const Vec3 size = front.box.size();
  const int width = map->values.width, height = map->values.height;
  const double mm_per_pixel = std::max(size.x(), size.y()) / std::max(width, height);
  const double mm_per_value = map->step > 0 ? size.z() / 65535 : 1;
  const Image<double> heights = heights_under(front, width, height, mm_per_pixel);
  std::size_t off = 0, count = 0;
  double worst = 0;
  std::string where;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const double z = heights.at(column, row), value = static_cast<double>(map->values.at(column, row));
      const double wanted = std::isnan(z) ? 0 : z - front.box.min.z();
      const double error = std::abs(value * mm_per_value - wanted);
      count += !std::isnan(z);
      off += error > 1e-3;
      if (error > worst) worst = error, where = cat(" at pixel ", column, ", ", row);
    }
  if (static_cast<double>(off) <= 1e-3 * static_cast<double>(count) && worst <= .01) return {};
  return cat("the map is off by more than a micrometre on ", off, " of ", count, " pixels, by ", worst, " mm",
             where);
}

int run(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "usage: check_solid SOLID.stl [MAP]\n"), 2;
  const Solid solid = solid_of(solid_in_stl(bytes_of(argv[1])));
  std::string wrong = check_solid(solid);
  for (const std::string& more :
       {self_intersections(solid), argc > 2 ? difference(solid, argv[2]) : std::string()})
    if (!more.empty()) wrong += (wrong.empty() ? "" : "; ") + more;
  if (wrong.empty()) return 0;
  std::printf("%s\n", wrong.c_str());
  return 1;
}

}  // namespace
}  // namespace relievo::test

int main(int argc, char** argv) {
  return relievo::test::run(argc, argv);
}
