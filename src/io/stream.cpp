#include "relievo/io/stream.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/quantile.h"
#include "io/formats.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/scan/normals.h"

namespace relievo {
namespace {

constexpr std::size_t head_size = 1 << 20;   // in bytes; larger than any header
constexpr std::size_t piece_size = 8 << 20;  // bytes read at a time
// Number of points in the sample, and number of points per read.
constexpr std::size_t sample_points = 200000, sample_run = 200;

// Reads and decodes the rows of the file in blocks.
class Rows {
 public:
  Rows(ByteSource& source, const io::Records& records) : source_(source), records_(records) {}

  const io::Records& records() const { return records_; }

  // Returns how many of the rows that were read last are left out.
  std::size_t left_out() const {
    return io::count_left_out(records_, reinterpret_cast<const char*>(bytes_.data()),
                              bytes_.size() / records_.stride);
  }

  Result<void> read(std::uint64_t first, std::size_t count, Cloud& to) {
    bytes_.resize(count * records_.stride);
    const auto read = source_.read(records_.offset + first * records_.stride, bytes_);
    if (!read) return read;
    to = io::sized_cloud(records_, count);
    const char* const rows = reinterpret_cast<const char*>(bytes_.data());
    parallel_ranges(count, 4096, [&](std::size_t begin, std::size_t end) {
      io::decode_rows(records_, rows + begin * records_.stride, end - begin, to, begin);
    });
    return {};
  }

  // Calls f(cloud) for every block, in the order of the file.
  template <typename F>
  Result<void> each(std::string_view stage, double from, double to, Progress* progress, F&& f) {
    const std::size_t most = std::max<std::size_t>(1, piece_size / records_.stride);
    Cloud piece;
    for (std::uint64_t row = 0; row < records_.count; row += most) {
      const double done = static_cast<double>(row) / static_cast<double>(records_.count);
      RELIEVO_CHECK(begin_stage(progress, stage, from + done * (to - from)));
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(most, records_.count - row));
      RELIEVO_CHECK(read(row, count, piece));
      f(piece);
    }
    return {};
  }

 private:
  ByteSource& source_;
  const io::Records& records_;
  std::vector<std::byte> bytes_;
};

// Returns a sample of the rows, from all parts of the file.
Result<Cloud> take_sample(Rows& rows) {
  const std::uint64_t count = rows.records().count;
  if (count == 0) return Cloud{};  // the offset may be beyond the end of the file
  const std::uint64_t runs =
      std::max<std::uint64_t>(1, std::min(count, std::uint64_t{sample_points}) / sample_run);
  Cloud sample, run;
  for (std::uint64_t i = 0; i < runs; ++i) {
    const std::uint64_t first = count / runs * i;
    const auto length =
        static_cast<std::size_t>(std::min<std::uint64_t>(runs == 1 ? count : sample_run, count - first));
    RELIEVO_CHECK(rows.read(first, length, run));
    for (std::size_t k = 0; k < run.size(); ++k) {
      if (!run.points[k].allFinite() || (run.has_normals() && run.normals[k].isZero(0))) continue;
      sample.points.push_back(run.points[k]);
      if (run.has_normals()) sample.normals.push_back(run.normals[k]);
    }
  }
  return sample;
}

// Values that are estimated from a sample of the cloud's points.
struct Scout {
  Vec3 middle;                // median of the points
  double outlier_radius = 0;  // points farther from the middle are outliers
  float sign = 1;             // -1 if the normals point inwards
};

// Estimates the values of Scout. The outlier radius is defined as in outliers(): 20 times the distance within
// which 90 % of the points are.
Scout scout(const Cloud& sample) {
  Scout it;
  std::vector<double> values(sample.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = sample.points[i][axis];
    it.middle[axis] = median(values);
  }
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = (sample.points[i] - it.middle).norm();
  it.outlier_radius = 20 * quantile(values, .9);
  it.sign = normals_point_inward(sample) ? -1.F : 1.F;
  return it;
}

// A grid over the view plane with the sums of the front-most points of each square. Memory is proportional to
// the number of squares. Three passes over the file find the box, the largest depth in each square, and the
// sums.
class ViewGrid {
 public:
  ViewGrid(const View& view, const Scout& scout, bool has_normals, bool has_colours)
      : turn_(view.R_view_model), scout_(scout), has_normals_(has_normals), has_colours_(has_colours) {}

  // First pass: finds the box in the view, and counts the points that face the viewer.
  void look(const Cloud& piece) {
    place(piece);
    for (const Place& p : places_) {
      if (!p.counts) continue;
      box_.extend(p.at);
      ++points_;
    }
  }
  std::uint64_t points() const { return points_; }
  double extent() const { return std::max(box_.size().x(), box_.size().y()); }

  // Chooses the size of the squares so that about `wanted` of them contain points. The sample shows which
  // share of the box the points cover. Returns false for a cloud without extent, and for an extent too large
  // or too small for single precision.
  bool lay_grid(const Cloud& sample, double wanted) {
    const Vec3 size = box_.size();
    const double longer = extent();
    if (!(longer > 1e-18 && longer < 1e18)) return false;
    // Squares contain about 20 points of the sample, so that few squares on the model are empty.
    const auto side =
        static_cast<std::size_t>(std::clamp(std::sqrt(static_cast<double>(sample.size()) / 20), 8.0, 192.0));
    const double coarse = longer / static_cast<double>(side);
    std::vector<std::uint8_t> is_seen(side * side + 2 * side + 1, 0);
    place(sample);
    for (const Place& p : places_) {
      if (!p.counts) continue;
      const auto c = static_cast<std::size_t>((p.at.x() - box_.min.x()) / coarse),
                 r = static_cast<std::size_t>((p.at.y() - box_.min.y()) / coarse);
      is_seen[std::min(is_seen.size() - 1, r * side + c)] = 1;
    }
    const auto seen = static_cast<double>(std::ranges::count(is_seen, 1));
    const double most_squares = 6 * wanted;
    square_ = std::max(coarse * std::sqrt(seen / wanted), std::sqrt(size.x() * size.y() / most_squares));
    square_ = std::max(square_, (size.x() + size.y()) / most_squares);
    columns_ = 1 + static_cast<std::size_t>(size.x() / square_);
    rows_ = 1 + static_cast<std::size_t>(size.y() / square_);
    top_.assign(columns_ * rows_, -std::numeric_limits<float>::infinity());
    return true;
  }

  // Second pass: finds the front-most depth in each square.
  void raise(const Cloud& piece) {
    place(piece);
    for (const Place& p : places_)
      if (p.counts) top_[p.square] = std::max(top_[p.square], static_cast<float>(p.at.z()));
  }

  // Third pass: sums the points near the front-most depth. On a slope a square contains a range of depths,
  // which follows from the normal or, without normals, from an assumed slope of 2.
  void gather(const Cloud& piece) {
    if (sums_.empty()) sums_.resize(top_.size());
    place(piece);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Place& p = places_[i];
      if (!p.counts) continue;
      const double nz = std::max(.1, double{p.normal.z()}),
                   slope = has_normals_ ? std::sqrt(1 - nz * nz) / nz : 2;
      if (p.at.z() + square_ * (1 + 1.5 * slope) < double{top_[p.square]}) continue;
      Sum& sum = sums_[p.square];
      sum.at += p.at;
      sum.normal += p.normal;
      if (has_colours_)
        for (std::size_t k = 0; k < 3; ++k) sum.colour[k] += piece.colours[i][k];
      ++sum.count;
    }
  }

  Cloud means() const {
    Cloud cloud;
    const Mat3 back = turn_.transpose();
    for (const Sum& sum : sums_) {
      if (sum.count == 0 || (has_normals_ && sum.normal.isZero(0))) continue;
      cloud.points.push_back(back * (sum.at / sum.count) + scout_.middle);
      if (has_normals_) cloud.normals.push_back((back.cast<float>() * sum.normal).normalized());
      if (!has_colours_) continue;
      const auto mean = [&](std::size_t k) {
        return static_cast<std::uint8_t>(static_cast<double>(sum.colour[k]) / sum.count + .5);
      };
      cloud.colours.push_back({mean(0), mean(1), mean(2)});
    }
    return cloud;
  }

 private:
  // A point in view coordinates, relative to the middle of the cloud.
  struct Place {
    Vec3 at;
    Vec3f normal;
    Index square = 0;
    bool counts = false;
  };
  struct Sum {
    Vec3 at = Vec3::Zero();
    Vec3f normal = Vec3f::Zero();
    // The sums are integers, because adding 1 to a float above 2^24 has no effect.
    std::array<std::uint32_t, 3> colour = {};
    std::uint32_t count = 0;
  };

  void place(const Cloud& piece) {
    places_.resize(piece.size());
    const Eigen::Matrix3f turn = scout_.sign * turn_.cast<float>();
    parallel_for(piece.size(), [&](std::size_t i) {
      Place& p = places_[i];
      const Vec3 from_middle = piece.points[i] - scout_.middle;
      p.at = turn_ * from_middle;
      p.normal = has_normals_ ? Vec3f(turn * piece.normals[i]) : Vec3f(Vec3f::UnitZ());
      p.counts = p.at.allFinite() && from_middle.norm() <= scout_.outlier_radius && p.normal.z() > 0;
      if (!p.counts || top_.empty()) return;
      const auto c = static_cast<std::size_t>((p.at.x() - box_.min.x()) / square_),
                 r = static_cast<std::size_t>((p.at.y() - box_.min.y()) / square_);
      p.square = static_cast<Index>(std::min(r, rows_ - 1) * columns_ + std::min(c, columns_ - 1));
    });
  }

  Mat3 turn_;
  const Scout& scout_;
  bool has_normals_, has_colours_;
  std::vector<Place> places_;  // points of the current block
  std::uint64_t points_ = 0;
  Box box_;
  double square_ = 0;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<float> top_;
  std::vector<Sum> sums_;
};

Result<io::StreamRecords> find_rows(const io::Source& head) {
  for (const io::Format& format : io::formats)
    if (format.find_rows && format.is_format(head)) return format.find_rows(head);
  return head.error({},
                    cat("expected a binary ", io::row_format_names(), " file, to be read piece by piece"));
}

Result<io::StreamRecords> open_records(ByteSource& source, std::string_view name, bool keeps_doubtful) {
  std::vector<std::byte> head(std::min<std::uint64_t>(head_size, source.size()));
  RELIEVO_CHECK(source.read(0, head));
  const io::Source beginning{
      {reinterpret_cast<const char*>(head.data()), head.size()}, name, nullptr, keeps_doubtful};
  auto found = find_rows(beginning);
  if (!found) return found;
  io::Records& r = found->records;
  const std::uint64_t left = source.size() - std::min(source.size(), r.offset);
  if (r.stride > 0 && r.count <= left / r.stride) return found;
  if (r.stride > 0 && found->may_end_early && left >= r.stride) {
    found->missing_rows = r.count - left / r.stride;
    r.count = left / r.stride;
    return found;
  }
  return beginning.error_at_byte(
      r.offset, cat("expected ", r.count, " points of ", r.stride, " bytes, found ", left, " bytes"));
}

}  // namespace

bool can_stream(std::span<const std::byte> head, std::string_view name) {
  return find_rows({{reinterpret_cast<const char*>(head.data()), head.size()}, name}).has_value();
}

Result<StreamedCloud> stream_front(ByteSource& source, std::string_view name, const View& view,
                                   const StreamOptions& options, Progress* progress) {
  const double points = options.points;
  if (!(points >= 1000 && points <= 1e7))
    return option_error("points", cat("expected a number from 1000 to 1e+07, found ", points));
  RELIEVO_TRY(const auto found, open_records(source, name, options.keeps_doubtful));
  Rows rows(source, found.records);
  RELIEVO_CHECK(begin_stage(progress, "first look", 0));
  RELIEVO_TRY(const Cloud sample, take_sample(rows));
  if (sample.size() < 4)
    return input_error(std::string(name), {}, "expected points, found none with finite coordinates");
  const Scout scouted = scout(sample);
  ViewGrid front(view, scouted, found.records.normal.has_value(), found.records.colour.has_value());

  std::uint64_t left_out = 0;
  RELIEVO_CHECK(rows.each("extent", 0, .2, progress, [&](const Cloud& piece) {
    front.look(piece);
    left_out += rows.left_out();
  }));
  if (front.points() == 0)
    return geometry_error("expected points that face the viewer, found none; try another view");
  if (!front.lay_grid(sample, points))
    return geometry_error(
        cat("expected points that cover an area in the view, found an extent of ", front.extent()));
  RELIEVO_CHECK(rows.each("front", .2, .4, progress, [&](const Cloud& piece) { front.raise(piece); }));
  RELIEVO_CHECK(rows.each("means", .4, .6, progress, [&](const Cloud& piece) { front.gather(piece); }));
  StreamedCloud streamed{front.means(), found.format, found.records.count, found.faces, found.missing_rows};
  if (left_out > 0)
    streamed.remarks.push_back(io::remark_on_left_out(left_out, found.records.left_out->which));
  return streamed;
}

}  // namespace relievo
