#include "relievo/relief/subspace.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/lists.h"
#include "core/memory.h"
#include "relief/style.h"
#include "relief/subspace/control_mesh.h"
#include "relief/weight_table.h"

namespace relievo {
namespace {

const Compression keep_all{std::numeric_limits<double>::infinity(), 0};

// The splines of ratio and offset (see SubspaceModel) use the same hierarchy of lattices. The cells of the
// finest lattice are at least 3/4 of ControlPoints::radius wide. The cells of each coarser lattice are twice
// as wide as those of the next finer one. The ratio is fitted on the two coarsest lattices, and the offset is
// fitted on the others.
constexpr int last_ratio_level = 1;

SplineOptions spline_options(std::span<const Vec2> points, double radius) {
  SplineOptions options;
  options.min = options.max = points[0];
  for (const Vec2& p : points) {
    options.min = options.min.cwiseMin(p);
    options.max = options.max.cwiseMax(p);
  }
  constexpr double most_cells = 1024;  // per side of the finest lattice
  options.cell = std::max(.75 * radius, (options.max - options.min).maxCoeff() / most_cells);
  options.levels = 5;
  options.damping = 1e-4;
  return options;
}

}  // namespace

std::vector<double> reference_heights(const Surface& surface, const HeightSystem& system, double max_slope) {
  const std::vector<float> boundary_weight = boundary_weights(surface.boundary.distance, surface.rho);
  std::vector<Vec2> slopes(surface.points.size());
  find_slopes(slope_input(surface, {}, boundary_weight), {keep_all, 0, max_slope}, slopes);
  std::vector<double> heights(slopes.size());
  system.solve(slopes, heights);
  return heights;
}

struct SubspaceModel::Workspace::Storage {
  explicit Storage(HeightSystem::Workspace s) : system(std::move(s)) {}

  HeightSystem::Workspace system;
  WeightTable weight;
  std::vector<Vec2f> slopes;
  std::vector<float> heights, ratios, offsets;  // at the control points
  SplineFunction ratio, offset;
  std::vector<float> pair;  // the values of both splines at the nodes, interleaved
  MultilevelSpline::Workspace ratio_fit, offset_fit;
};

SubspaceModel::Workspace::Workspace(std::unique_ptr<Storage> storage) : storage_(std::move(storage)) {}
SubspaceModel::Workspace::Workspace(Workspace&&) noexcept = default;
SubspaceModel::Workspace& SubspaceModel::Workspace::operator=(Workspace&&) noexcept = default;
SubspaceModel::Workspace::~Workspace() = default;

std::size_t SubspaceModel::Workspace::memory() const {
  return storage_->system.memory() + bytes(storage_->pair) + bytes(storage_->slopes);
}

SubspaceModel::SubspaceModel(HeightSystem system, Samples samples, double delta)
    : system_(std::move(system)), samples_(std::move(samples)), delta_(delta) {}

Result<SubspaceModel> SubspaceModel::prepare(const Surface& surface, const SubspaceOptions& options,
                                             const Known& known, Progress* progress) {
  const std::vector<Vec2> points = in_plane(surface.points);
  const std::vector<float> boundary_weight = boundary_weights(surface.boundary.distance, surface.rho);
  std::span<const double> reference = known.reference;
  std::vector<double> solved;
  if (reference.empty()) {
    RELIEVO_CHECK(begin_stage(progress, "reference heights", .75));
    RELIEVO_TRY(const auto all, HeightSystem::build(points, surface.triangulation, surface.boundary));
    reference = solved = reference_heights(surface, all, options.max_slope);
  }

  RELIEVO_CHECK(begin_stage(progress, "control points", .85));
  ControlPoints control = grow_control_points(points, surface.boundary.distance, options.control);
  const ControlMesh mesh = mesh_control_points(surface, control);
  RELIEVO_TRY(HeightSystem system, HeightSystem::build(mesh.points, mesh.triangulation, mesh.boundary));
  const std::vector<Index> samples = sample_regions(surface, control, options.normals_per_point);
  std::vector<PointLayers> own_layers;
  if (known.layers.empty()) own_layers = normal_layers(surface.points, surface.normals);
  const std::span<const PointLayers> layers = known.layers.empty() ? own_layers : known.layers;

  SubspaceModel model(
      std::move(system),
      {pick(surface.normals, samples), pick(surface.curvature.k, samples), pick(layers, samples), samples},
      surface.curvature.delta);
  model.control_ = std::move(control);
  model.reference_.assign(reference.begin(), reference.end());
  model.set_reference(options.max_slope, boundary_weight);
  model.set_splines(mesh.points, points);
  return model;
}

std::size_t SubspaceModel::memory() const {
  return system_.memory() + ratio_spline_.memory() + offset_spline_.memory() + bytes(control_.points) +
         bytes(samples_.normals) + bytes(samples_.k) + bytes(samples_.layers) + bytes(samples_.points) +
         bytes(control_reference_) + bytes(ratio_terms_) + bytes(places_) + bytes(reference_);
}

SubspaceModel::Workspace SubspaceModel::make_workspace() const {
  const std::size_t n = control_.points.size();
  auto storage = std::make_unique<Workspace::Storage>(system_.make_workspace());
  storage->slopes.resize(n);
  for (std::vector<float>* values : {&storage->heights, &storage->ratios, &storage->offsets})
    values->resize(n);
  storage->ratio = ratio_spline_.make_function();
  storage->offset = offset_spline_.make_function();
  storage->pair.resize(2 * storage->offset.nodes.size());
  storage->ratio_fit = ratio_spline_.make_workspace();
  storage->offset_fit = offset_spline_.make_workspace();
  return Workspace(std::move(storage));
}

void SubspaceModel::solve(const Shape& shape, std::span<const float> boundary_weight,
                          Workspace& workspace) const {
  Workspace::Storage& storage = *workspace.storage_;
  const SlopeInput input{samples_.normals, samples_.k, {}, delta_, samples_.layers};
  const std::size_t per_point = samples_.k.size() / control_.points.size();
  with_style(shape, [&](const auto& style) {
    storage.weight.fill(delta_, style.weighted());
    const auto slope_of = [&](std::size_t i) -> Vec2f {
      return style.slope(input, i, storage.weight(samples_.k[i]), boundary_weight[samples_.points[i]]);
    };
    // The slope of a control point is the mean slope of its region's samples.
    const auto mean_slope = [&](std::size_t c) {
      Vec2f sum = Vec2f::Zero();
      for (std::size_t i = c * per_point; i < (c + 1) * per_point; ++i) sum += slope_of(i);
      storage.slopes[c] = sum / static_cast<float>(per_point);
    };
    parallel_for(control_.points.size(), mean_slope, 512);
  });
  system_.solve(storage.slopes, storage.heights, storage.system);  // z_c, the heights of the control points
}

// Computes the reference heights. A reference height below a thousandth of the height range is too small as a
// divisor, so the ratio of such a point fades to the common ratio of all control points.
void SubspaceModel::set_reference(double max_slope, std::span<const float> boundary_weight) {
  Workspace workspace = make_workspace();
  solve({keep_all, 0, max_slope}, boundary_weight, workspace);
  control_reference_ = workspace.storage_->heights;
  const auto [lowest, highest] = std::minmax_element(control_reference_.begin(), control_reference_.end());
  const float faint = 1e-3F * (*highest - *lowest);
  for (const float z_ref : control_reference_) {
    const float sum = std::max(z_ref * z_ref + faint * faint, std::numeric_limits<float>::min());
    ratio_terms_.push_back({z_ref / sum, faint * faint / sum});
  }
}

// The ratio r = z_c / z_ref is fitted with weights z_ref^2, so the fit minimises the sum of (z_c - r z_ref)^2
// over the control points.
void SubspaceModel::set_splines(std::span<const Vec2> sites, std::span<const Vec2> points) {
  std::vector<float> weights;
  for (const float z_ref : control_reference_) weights.push_back(z_ref * z_ref);
  SplineOptions options = spline_options(points, control_.radius);
  options.last_fitted = last_ratio_level;
  ratio_spline_ = MultilevelSpline(sites, weights, options);

  std::fill(weights.begin(), weights.end(), 1.F);
  options.first_fitted = last_ratio_level + 1;
  options.last_fitted = options.levels - 1;
  offset_spline_ = MultilevelSpline(sites, weights, options);
  places_ = offset_spline_.pack(points);
}

void SubspaceModel::fit(Workspace::Storage& storage) const {
  double compressed = 0, reference = 0;
  for (std::size_t c = 0; c < storage.heights.size(); ++c) {
    const auto z_ref = static_cast<double>(control_reference_[c]);
    compressed += z_ref * static_cast<double>(storage.heights[c]);
    reference += z_ref * z_ref;
  }
  const auto overall = static_cast<float>(reference > 0 ? compressed / reference : 0);
  for (std::size_t c = 0; c < storage.heights.size(); ++c) {
    const RatioTerm& term = ratio_terms_[c];
    storage.ratios[c] = storage.heights[c] * term.own + term.overall * overall;
  }
  ratio_spline_.fit(storage.ratios, storage.ratio, storage.ratio_fit);
  for (std::size_t c = 0; c < storage.heights.size(); ++c) {
    const float fitted = storage.ratios[c] - storage.ratio_fit.rest[c];
    storage.offsets[c] = storage.heights[c] - fitted * control_reference_[c];
  }
  offset_spline_.fit(storage.offsets, storage.offset, storage.offset_fit);
}

void SubspaceModel::carry(std::span<const float> boundary_weight, Workspace& workspace,
                          std::span<float> heights) const {
  Workspace::Storage& storage = *workspace.storage_;
  fit(storage);
  MultilevelSpline::pair_up(storage.ratio, storage.offset, storage.pair);
  const float ratio = storage.ratio.mean, offset = storage.offset.mean;
  parallel_ranges(heights.size(), default_grain, [&](std::size_t begin, std::size_t end) {
    const std::span<float> z = heights.subspan(begin, end - begin);
    std::array<float, default_grain> offsets;
    offset_spline_.evaluate(storage.pair, std::span(places_).subspan(begin, z.size()), {z, offsets});
    for (std::size_t i = 0; i < z.size(); ++i)
      z[i] = (z[i] + ratio) * reference_[begin + i] + (offsets[i] + offset) * boundary_weight[begin + i];
  });
}

}  // namespace relievo
