// Draws what the paper shows besides finished reliefs: weights, points, and reliefs by other mappings of
// heights. docs/gallery/make runs this program. Usage: relievo_paper_figures WHAT SCAN OUT.png, or
// relievo_paper_figures weights OUT.svg
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <string_view>

#include "common/files.h"
#include "common/read_inputs.h"
#include "core/lists.h"
#include "geometry/neighbours.h"
#include "geometry/plane.h"
#include "paper/control_points.h"
#include "paper/paper_model.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/io/write.h"
#include "relievo/make_relief.h"
#include "relievo/picture/render.h"

namespace relievo {
namespace {

// A scan, with the values that its drawings need. Pictures show it as previews do: its longer side is 100 mm, the plate
// adds a margin of 5 mm on each side, and 7.5 mm of white surround the plate.
struct Scan {
  std::shared_ptr<const ReliefModel> model;
  const Surface& surface = model->surface();
  std::vector<Vec2> visible = in_plane(surface.points);
  Box box = Box::of(surface.points);
  double mm_per_unit = 100 / box.longer_side(), pixels_per_mm = 6.4;
  int width = static_cast<int>(pixels_per_mm * (mm_per_unit * box.size().x() + 25)),
      height = static_cast<int>(pixels_per_mm * (mm_per_unit * box.size().y() + 25));

  std::vector<Index> control(std::size_t count) const {
    return paper::control_points(visible, surface.boundary.is_boundary, surface.rho, count);
  }
};

Result<Scan> read_scan(const std::string& path) {
  const View front = View().for_paper();
  RELIEVO_TRY(const Scene scene, app::read_scene({path}, {}, {}, nullptr));
  RELIEVO_TRY(const ViewSample sample, sample_for_view(scene, front, {}, nullptr));
  RELIEVO_TRY(ReliefModel model, prepare(*sample.cloud, front));
  return Scan{std::make_shared<const ReliefModel>(std::move(model))};
}

Image8 white(const Scan& scan) {
  return filled_image<std::uint8_t>(scan.width, scan.height, 255);
}

// Draws a point as a square of three pixels.
void draw_point(const Scan& scan, const Vec2& p, std::uint8_t grey, Image8& image) {
  const Vec2 at = scan.pixels_per_mm * scan.mm_per_unit * (p - scan.box.centre().head<2>());
  const int x = scan.width / 2 + static_cast<int>(at.x()), y = scan.height / 2 - static_cast<int>(at.y());
  for (int v = y - 1; v <= y + 1; ++v)
    for (int u = x - 1; u <= x + 1; ++u)
      if (image.contains(u, v)) image.at(u, v) = grey;
}

Image8 curvature_picture(const Scan& scan) {
  Image8 image = white(scan);
  for (std::size_t i = 0; i < scan.visible.size(); ++i)
    draw_point(scan, scan.visible[i], static_cast<std::uint8_t>(128 + 100 * scan.surface.curvature.k[i]),
               image);
  return image;
}

Image8 control_picture(const Scan& scan) {
  Image8 image = white(scan);
  for (const Vec2& p : scan.visible) draw_point(scan, p, 225, image);
  for (const Index i : scan.control(usual_control_points)) draw_point(scan, scan.visible[i], 40, image);
  return image;
}

// Returns the picture in grey, without its transparency, on white.
Image8 on_white(const Image8& drawn) {
  Image8 image = filled_image<std::uint8_t>(drawn.width, drawn.height, 255);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const int opacity = drawn[4 * i + 3];
    image[i] = static_cast<std::uint8_t>((drawn[4 * i + 1] * opacity + 255 * (255 - opacity)) / 255);
  }
  return image;
}

// A place on the horse of Fig. 9. `share` is the position from the lower left corner of the horse's bounding
// box, as fractions of the box's width and height.
struct Place {
  const char* name;
  Vec2 share;
};
const std::array places{Place{"abdomen", {.43, .54}}, Place{"hip", {.21, .65}}, Place{"neck", {.77, .84}}};

// Returns the mean height of the points whose distance from the place, as a share of the longer side, is in
// `range`.
double mean_height(const Scan& scan, const Relief& relief, const Vec2& place, const Vec2& range) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < scan.visible.size(); ++i) {
    const double distance = (scan.visible[i] - place).norm() / scan.box.longer_side();
    if (distance >= range.x() && distance < range.y()) sum += relief.heights[i], ++count;
  }
  return sum / count;
}

// Prints, for each beta of Fig. 9 and each place, the height of the place and this height minus the height of
// the surroundings, both as shares of the relief's height. Returns a picture of the places.
Result<Image8> saturation_picture(const Scan& scan) {
  Image8 image = white(scan);
  for (const Vec2& p : scan.visible) draw_point(scan, p, 200, image);
  for (const double beta : {0., 2.5, 5., 7.5, 10.}) {
    std::printf("beta %4.1f", beta);
    const double height = .05 * scan.box.longer_side();
    RELIEVO_TRY(const Relief relief, scan.model->make_at_height(height, {{1, beta}, .02}, 1));
    for (const auto& [name, share] : places) {
      const Vec2 at = scan.box.min.head<2>() + share.cwiseProduct(scan.box.size().head<2>());
      const double own = mean_height(scan, relief, at, {0, .01}),
                   around = mean_height(scan, relief, at, {.05, .06});
      std::printf("  %s %.2f, bulge %+.3f", name, own / height, (own - around) / height);
      for (const Vec2& p : scan.visible)
        if ((p - at).norm() < .01 * scan.box.longer_side()) draw_point(scan, p, 0, image);
    }
    std::printf("\n");
  }
  return image;
}

Image8 surface_picture(const Scan& scan, const Shown* shown) {
  FrameRenderer renderer(scan.model);
  RenderOptions options;
  options.width = scan.width;
  options.height = scan.height;
  options.mm_per_unit = scan.mm_per_unit;
  options.is_fine = true;
  options.camera.zoom = 110. / 125;
  options.has_shadows = shown != nullptr;  // the model is so deep that its shadows would cover the ground
  Picture picture;
  renderer.render(shown ? *shown : renderer.original(), options, picture);
  return on_white(picture.image);
}

// Describes how heights are mapped from the control points to all visible points. At the control points, the
// heights are divided by known heights, and these ratios are interpolated.
struct Mapping {
  bool is_gaussian = false;  // by Gaussian weights of the nearest control points, not by a B-spline
  enum class Known { none, depths, uncompressed } known = Known::uncompressed;
  std::size_t control_points = usual_control_points;
};

using Heights = std::vector<float>;

Heights solved(const PaperModel& model, double u) {
  auto workspace = model.make_solve_workspace();
  Heights heights(model.control_points());
  model.solve({.u = u, .beta = .01}, workspace, heights);
  return heights;
}

// Returns one known height per visible point: 1, the scan's depth, or the height from equation (9) with w_k = 1.
Heights known_heights(const Scan& scan, Mapping::Known known) {
  if (known == Mapping::Known::none) return Heights(scan.visible.size(), 1);
  if (known == Mapping::Known::uncompressed)
    return solved(*scan.model->paper(), std::numeric_limits<double>::infinity());
  const double lowest = Box::of(scan.surface.points).min.z();
  Heights depths;
  for (const Vec3& p : scan.surface.points) depths.push_back(static_cast<float>(p.z() - lowest));
  return depths;
}

// Returns, for each visible point, the mean of the ratios at the twelve nearest control points, with Gaussian
// weights.
Heights gaussian_ratios(std::span<const Vec2> control, std::span<const float> ratios,
                        std::span<const Vec2> visible) {
  const KdTree<Vec2> tree(control);
  Heights means(visible.size());
  parallel_for(visible.size(), [&](std::size_t i) {
    std::array<Index, 12> found;
    std::array<double, 12> distances_sq;
    const std::size_t count = tree.nearest(visible[i], found.size(), found.data(), distances_sq.data());
    double sum = 0, weights = 0;
    for (std::size_t j = 0; j < count; ++j) {
      const double weight = std::exp(-4 * distances_sq[j] / std::max(distances_sq[count - 1], 1e-30));
      sum += weight * static_cast<double>(ratios[found[j]]);
      weights += weight;
    }
    means[i] = static_cast<float>(sum / weights);
  });
  return means;
}

Result<Heights> mapped_heights(const Scan& scan, const Mapping& mapping, double u) {
  RELIEVO_TRY(const PaperModel model, PaperModel::prepare(scan.surface, mapping.control_points));
  const std::vector<Index> chosen = scan.control(mapping.control_points);
  const std::vector<Vec2> control = pick(scan.visible, chosen);
  const Heights known = known_heights(scan, mapping.known), compressed = solved(model, u);
  Heights of_control = pick(known, chosen);
  if (mapping.known == Mapping::Known::uncompressed)
    of_control = solved(model, std::numeric_limits<double>::infinity());
  Heights heights(known.size());
  if (!mapping.is_gaussian) {
    const paper::HeightMapping spline(control, scan.visible, {of_control, known});
    auto workspace = spline.make_workspace();
    spline.carry(compressed, workspace, heights);
    return heights;
  }
  const float faint = paper::faint_share * *std::ranges::max_element(of_control);
  Heights ratios;
  for (std::size_t i = 0; i < control.size(); ++i)
    ratios.push_back(paper::compression_ratio(compressed[i], of_control[i], faint));
  heights = gaussian_ratios(control, ratios, scan.visible);
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] *= known[i];
  return heights;
}

// Returns the picture of the relief. Prints how much its heights differ from the heights solved without
// control points.
Result<Image8> mapping_picture(const Scan& scan, const Mapping& mapping) {
  const double u = std::pow(4, -.01);
  RELIEVO_TRY(const Heights heights, mapped_heights(scan, mapping, u));
  const Heights exact = solved(*scan.model->paper(), u);
  double sum = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) sum += std::pow(heights[i] - exact[i], 2);
  const auto [low, high] = std::ranges::minmax(exact);
  std::printf("%zu visible points, %zu control points, rms %.2f %% of the height\n", exact.size(),
              scan.control(mapping.control_points).size(),
              100 * std::sqrt(sum / static_cast<double>(exact.size())) / static_cast<double>(high - low));
  const std::vector<Vec3f> normals = vertex_normals(scan.surface, heights);
  const Shown shown{heights, normals};
  return surface_picture(scan, &shown);
}

// Returns the SVG of the curve y(x) for x in [0, most_x] and y in [0, 1]. `panel` is the number of its diagram.
std::string curve(int panel, double most_x, const std::function<double(double)>& y) {
  std::string text = "<polyline points=\"";
  for (int i = 0; i <= 200; ++i)
    text += cat(30 + 240 * panel + i, ",", std::round(10 * (215 - 200 * y(i * most_x / 200))) / 10, " ");
  return text + "\"/>\n";
}

// Returns Fig. 3 as an SVG with four diagrams: the weight of curvature (6), first for several alpha and then
// for several beta; the weight of the boundary (7); and the angle of the expected normal (5) over w, as a
// share of 90 degrees.
std::string weight_curves() {
  constexpr double delta = .25;
  std::string text =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 970 250\" font-family=\"sans-serif\" "
      "font-size=\"13\">\n"
      "<rect width=\"970\" height=\"250\" fill=\"#fff\"/>\n<g fill=\"none\" stroke=\"#999\">";
  for (int panel = 0; panel < 4; ++panel)
    text += cat("<rect x=\"", 30 + 240 * panel, "\" y=\"15\" width=\"200\" height=\"200\"/>");
  text += "</g>\n<g fill=\"none\" stroke=\"#06c\">\n";
  const auto of_alpha_beta = [&](int panel, double alpha, double beta) {
    text += curve(panel, 1, [&](double k) {
      return paper::curvature_weight(k, delta, {.u = std::pow(alpha, -beta), .beta = beta});
    });
  };
  for (const double alpha : {0., .25, .5, 1., 2., 4., 8.}) of_alpha_beta(0, alpha, 1);
  for (const double beta : {0., .25, .5, 1., 2., 4., 8.}) of_alpha_beta(1, 2, beta);
  text += curve(2, 6, [](double distance) { return paper::boundary_weight(distance, 2); });
  for (const double degrees : {15., 30., 45., 60., 75.}) {
    const double angle = degrees * std::numbers::pi / 180;
    text += curve(3, 1, [&](double w) {
      const Vec2 slope = paper::slope_of(paper::expected_normal({std::sin(angle), 0, std::cos(angle)}, w), 4);
      return std::atan(slope.norm()) / (std::numbers::pi / 2);
    });
  }
  text += "</g>\n<g text-anchor=\"middle\">";
  constexpr std::array names{"(6) over |k|: alpha 0 to 8", "(6) over |k|: beta 0 to 8",
                             "(7) over distance, 0 to 6 rho", "(5) angle over w, 15 to 75 degrees"};
  for (int panel = 0; panel < 4; ++panel)
    text += cat("<text x=\"", 130 + 240 * panel, "\" y=\"238\">", names[static_cast<std::size_t>(panel)],
                "</text>");
  return text + "</g>\n</svg>\n";
}

Result<Image8> picture_of(std::string_view what, const Scan& scan) {
  using enum Mapping::Known;
  constexpr std::array<Choice<Mapping>, 6> mappings{
      {{"heights", {false, none}},
       {"gaussian-with-jumps", {true, depths}},
       {"gaussian", {true, uncompressed}},
       {"ratio-with-jumps", {false, depths}},
       {"ratio", {}},
       {"half", {false, uncompressed, usual_control_points / 2}}}};
  if (what == "original") return surface_picture(scan, nullptr);
  if (what == "curvature") return curvature_picture(scan);
  if (what == "control-points") return control_picture(scan);
  if (what == "saturations") return saturation_picture(scan);
  RELIEVO_TRY(const Mapping mapping, parse_choice("WHAT", what, mappings));
  return mapping_picture(scan, mapping);
}

Result<void> write(const char* path, std::span<const std::byte> bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (file.flush()) return {};
  return input_error(path, {}, "expected a file that can be written");
}

Result<void> draw(std::span<const char* const> arguments) {
  if (arguments.size() == 3 && arguments[1] == std::string_view("weights"))
    return write(arguments[2], app::bytes_of(weight_curves()));
  if (arguments.size() != 4)
    return option_error("arguments", "expected WHAT SCAN OUT.png, or weights OUT.svg");
  RELIEVO_TRY(const Scan scan, read_scan(arguments[2]));
  RELIEVO_TRY(const Image8 image, picture_of(arguments[1], scan));
  return write(arguments[3], write_png(image));
}

}  // namespace
}  // namespace relievo

int main(int argc, char** argv) {
  const auto drawn = relievo::draw({argv, static_cast<std::size_t>(argc)});
  if (!drawn) std::fprintf(stderr, "%s\n", drawn.error().message().c_str());
  return drawn ? 0 : 1;
}
