// Writes LAZ files of point formats 0 and 6, independently of the library's decoder.
#pragma once

#include <bit>
#include <map>
#include <random>

#include "support/format_samples.h"

namespace relievo {

// The frequencies of symbols. They adapt to the symbols written so far, as those of LASzip do.
class LazTestModel {
 public:
  explicit LazTestModel(std::uint32_t symbols) : counts_(symbols, 1), starts_(symbols), cycle_(symbols) {
    update();
    cycle_ = left_ = (symbols + 6) / 2;
  }
  std::uint64_t start(std::size_t symbol) const { return starts_[symbol]; }
  bool is_last(std::size_t symbol) const { return symbol + 1 == counts_.size(); }
  void count(std::size_t symbol) {
    ++counts_[symbol];
    if (--left_ == 0) update();
  }

 private:
  void update() {
    total_ += cycle_;
    if (total_ > 32768) {
      total_ = 0;
      for (auto& count : counts_) total_ += count = (count + 1) / 2;
    }
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < counts_.size(); sum += counts_[i++])
      starts_[i] = 0x80000000U / total_ * sum >> 16;
    cycle_ = std::min<std::uint32_t>(5 * cycle_ / 4, static_cast<std::uint32_t>(counts_.size() + 6) * 8);
    left_ = cycle_;
  }
  std::vector<std::uint32_t> counts_, starts_;
  std::uint32_t total_ = 0, cycle_ = 0, left_ = 0;
};

struct LazTestBit {
  std::uint32_t zeros = 1, total = 2, start_of_one = 4096, cycle = 4, left = 4;

  void count(std::uint32_t value) {
    if (value == 0) ++zeros;
    if (--left > 0) return;
    total += cycle;
    if (total > 8192) {
      total = (total + 1) / 2;
      zeros = (zeros + 1) / 2;
      if (zeros == total) ++total;
    }
    start_of_one = zeros * (0x80000000U / total) >> 18;
    left = cycle = std::min(5 * cycle / 4, 64U);
  }
};

class LazTestEncoder {
 public:
  void symbol(LazTestModel& model, std::uint32_t symbol) {
    const std::uint64_t part = length_ >> 15, start = model.start(symbol) * part;
    const std::uint64_t end = model.is_last(symbol) ? length_ : model.start(symbol + 1) * part;
    add(start, end - start);
    model.count(symbol);
  }
  void bit(LazTestBit& model, std::uint32_t value) {
    const std::uint64_t start = (length_ >> 13) * model.start_of_one;
    value == 0 ? add(0, start) : add(start, length_ - start);
    model.count(value);
  }
  void bits(std::uint32_t value, unsigned count) {
    if (count > 19) {
      bits(value & 0xFFFF, 16);
      return bits(value >> 16, count - 16);
    }
    add(value * (length_ >> count), length_ >> count);
  }
  std::string take() {
    add(length_ / 2, 1);
    return bytes_;
  }

 private:
  void add(std::uint64_t start, std::uint64_t length) {
    base_ += start;
    if (base_ >> 32 != 0)
      for (std::size_t i = bytes_.size(); ++bytes_[--i] == 0;) continue;  // carries into the bytes before
    base_ &= 0xFFFFFFFF;
    for (length_ = length; length_ < 1 << 24; length_ <<= 8, base_ = base_ << 8 & 0xFFFFFFFF)
      bytes_ += static_cast<char>(base_ >> 24);
  }
  std::string bytes_;
  std::uint64_t base_ = 0, length_ = 0xFFFFFFFF;
};

// Encodes differences from predictions. The caller computes the predictions and chooses the contexts.
class LazTestIntegers {
 public:
  explicit LazTestIntegers(std::size_t contexts) : sizes_(contexts, LazTestModel(33)) {
    for (unsigned size = 1; size <= 32; ++size) high_.emplace_back(1U << std::min(size, 8U));
  }
  void write(LazTestEncoder& encoder, std::int32_t difference, std::size_t context) {
    const auto magnitude =
        static_cast<std::uint32_t>(difference <= 0 ? -std::int64_t{difference} : difference - 1);
    last_bits = static_cast<std::uint32_t>(std::bit_width(magnitude));
    encoder.symbol(sizes_[context], last_bits);
    if (last_bits == 0) return encoder.bit(small_, static_cast<std::uint32_t>(difference));
    const std::uint32_t number = difference > 0
                                     ? static_cast<std::uint32_t>(difference - 1)
                                     : static_cast<std::uint32_t>(difference + ((1LL << last_bits) - 1));
    const unsigned low = last_bits > 8 ? last_bits - 8 : 0;
    encoder.symbol(high_[last_bits - 1], number >> low);
    if (low > 0) encoder.bits(number & ((1U << low) - 1), low);
  }
  std::uint32_t last_bits = 0;

 private:
  std::vector<LazTestModel> sizes_, high_;
  LazTestBit small_;
};

using LazTestPoint = std::array<std::int32_t, 3>;

struct LazTestClass {
  std::uint32_t number = 0;
  bool is_withheld = false;

  std::uint32_t in_one_byte() const { return number | (is_withheld ? 128U : 0U); }
  std::uint32_t flags() const { return is_withheld ? 4 : 0; }
};

// Returns a chunk of points. Each point is the only return of its pulse, and point i has the class
// classes[i]; there may be fewer classes than points. LASzip predicts a step in x or y by the median of
// earlier steps, and z by the previous z. The caller must make every second step in x and y 0, and no step
// negative. Then all medians are 0, and this encoder need not compute them.
inline std::string laz_chunk(const std::vector<LazTestPoint>& points, bool is_layered,
                             std::vector<LazTestClass> classes = {}) {
  classes.resize(points.size());
  std::string first;
  for (const std::int32_t value : points[0]) first += raw(value);
  const auto byte = [](std::uint32_t value) { return std::string(1, static_cast<char>(value)); };
  first +=
      std::string(2, '\0') +
      (is_layered ? byte(0x11) + byte(classes[0].flags()) + byte(classes[0].number) + std::string(13, '\0')
                  : byte(9) + byte(classes[0].in_one_byte()) + std::string(4, '\0'));
  LazTestEncoder main, heights, class_layer, flag_layer;
  std::map<std::uint32_t, LazTestModel> class_models, flag_models;
  LazTestEncoder& z_encoder = is_layered ? heights : main;
  LazTestModel changes(is_layered ? 128 : 64);
  LazTestIntegers x(2), y(22), z(20);
  std::int32_t z_before = is_layered ? points[0][2] : 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const LazTestClass &now = classes[i], &before = classes[i - 1];
    const bool has_change = !is_layered && now.in_one_byte() != before.in_one_byte();
    main.symbol(changes, has_change ? 8 : 0);
    const auto write = [](LazTestEncoder& to, auto& models, std::uint32_t context, LazTestModel fresh,
                          std::uint32_t symbol) {
      to.symbol(models.try_emplace(context, fresh).first->second, symbol);
    };
    if (has_change) write(main, class_models, before.in_one_byte(), LazTestModel(256), now.in_one_byte());
    write(class_layer, class_models, before.number + 256, LazTestModel(256), now.number);
    write(flag_layer, flag_models, before.flags(), LazTestModel(64), now.flags());
    x.write(main, points[i][0] - points[i - 1][0], 1);
    y.write(main, points[i][1] - points[i - 1][1], 1 + (x.last_bits < 20 ? x.last_bits & ~1U : 20));
    const std::uint32_t bits = (x.last_bits + y.last_bits) / 2;
    z.write(z_encoder, points[i][2] - z_before, 1 + (bits < 18 ? bits & ~1U : 18));
    z_before = points[i][2];
  }
  if (!is_layered) return first + main.take();
  const std::string xy = main.take(), z_bytes = heights.take();
  const auto size = [](std::size_t n) { return raw(static_cast<std::uint32_t>(n)); };
  const std::string class_bytes = class_layer.take(), flag_bytes = flag_layer.take();
  return first + size(points.size()) + size(xy.size()) + size(z_bytes.size()) + size(class_bytes.size()) +
         size(flag_bytes.size()) + std::string(20, '\0') + xy + z_bytes + class_bytes + flag_bytes;
}

// Returns points such as laz_chunk() needs: no step in x and y is negative, and every second step is 0.
inline std::vector<LazTestPoint> any_points(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<LazTestPoint> points = {{-1000, 2000, 500}};
  while (points.size() < count) {
    LazTestPoint p = points.back();
    if (points.size() % 2 == 1) {
      p[0] += 2 + static_cast<std::int32_t>(random() % 100000 >> random() % 12);
      p[1] += 2 + static_cast<std::int32_t>(random() % 3000);
    }
    p[2] = 3 * static_cast<std::int32_t>(points.size()) + (points.size() % 5 == 0 ? 70000000 : 0);
    points.push_back(p);
  }
  return points;
}

// Returns a LAZ file with chunks of any sizes. The point format is 0, or 6 if the chunks are layered.
// Coordinates are integers. Point i of each chunk has the class classes[i].
inline std::string laz(const std::vector<std::vector<LazTestPoint>>& chunks, bool is_layered,
                       const std::vector<LazTestClass>& classes = {}) {
  std::string file(375, '\0'), data;
  LazTestEncoder table;
  LazTestIntegers numbers(2);
  std::uint32_t count = 0;
  std::int32_t points_before = 0, bytes_before = 0;
  for (const auto& points : chunks) {
    const std::string chunk = laz_chunk(points, is_layered, classes);
    const auto here = static_cast<std::int32_t>(points.size()),
               bytes = static_cast<std::int32_t>(chunk.size());
    numbers.write(table, here - points_before, 0);
    numbers.write(table, bytes - bytes_before, 1);
    points_before = here;
    bytes_before = bytes;
    count += static_cast<std::uint32_t>(points.size());
    data += chunk;
  }
  const std::uint16_t size = is_layered ? 30 : 20;
  const std::uint16_t version = is_layered ? 3 : 2, item = is_layered ? 10 : 6;
  const std::string record = raw(version) + std::string(10, '\0') + raw(~std::uint32_t{0}) +
                             std::string(16, '\0') + raw(std::uint16_t{1}) + raw(item) + raw(size) +
                             raw(version);
  std::string user = "laszip encoded";
  user.resize(16);
  std::string head = std::string(2, '\0') + user + raw(std::uint16_t{22204}) +
                     raw(static_cast<std::uint16_t>(record.size())) + std::string(32, '\0') + record;
  file.replace(0, 4, "LASF");
  file = patched(file, 24, std::uint8_t{1});
  file = patched(file, 25, std::uint8_t{4});
  file = patched(file, 94, std::uint16_t{375});
  file = patched(file, 96, static_cast<std::uint32_t>(375 + head.size()));
  file = patched(file, 100, std::uint32_t{1});
  file = patched(file, 104, static_cast<std::uint8_t>(is_layered ? 134 : 128));
  file = patched(file, 105, size);
  file = patched(file, 247, std::uint64_t{count});
  for (std::size_t i = 0; i < 3; ++i) file = patched(file, 131 + 8 * i, 1.0);
  const std::uint64_t table_at = file.size() + head.size() + 8 + data.size();
  return file + head + raw(table_at) + data + raw(std::uint32_t{0}) +
         raw(static_cast<std::uint32_t>(chunks.size())) + table.take();
}

}  // namespace relievo
