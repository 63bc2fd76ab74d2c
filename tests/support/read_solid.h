// Reads solids from STL, PLY and OBJ files without the library's readers, to check files that the library writes.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/plate/solid.h"

namespace relievo::test {

// A solid as a list of triangles; each triangle has its own corners.
struct ReadSolid {
  std::vector<std::array<Vec3f, 3>> triangles;

  Box box() const {
    Box box;
    for (const auto& corners : triangles)
      for (const Vec3f& p : corners) box.extend(p.cast<double>());
    return box;
  }

  // Returns the enclosed volume, by the divergence theorem. The volume is positive if the triangles face outwards.
  double volume() const {
    double sixfold = 0;
    for (const auto& [a, b, c] : triangles)
      sixfold += a.cast<double>().dot(b.cast<double>().cross(c.cast<double>()));
    return sixfold / 6;
  }

  // Returns whether each edge is used equally often in both directions.
  bool is_closed() const {
    using Corner = std::array<float, 3>;
    const auto corner = [](const Vec3f& p) { return Corner{p.x(), p.y(), p.z()}; };
    std::map<std::pair<Corner, Corner>, int> balance;
    for (const auto& corners : triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const Corner from = corner(corners[i]), to = corner(corners[(i + 1) % 3]);
        from < to ? ++balance[{from, to}] : --balance[{to, from}];
      }
    for (const auto& [edge, count] : balance)
      if (count != 0) return false;
    return !triangles.empty();
  }
};

// Returns the solid after merging equal corners into one point.
inline Solid solid_of(const ReadSolid& read) {
  Solid solid;
  std::map<std::array<float, 3>, Index> numbers;
  for (const auto& corners : read.triangles) {
    Triangle t{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3f& p = corners[i];
      const auto [at, is_new] =
          numbers.try_emplace({p.x(), p.y(), p.z()}, static_cast<Index>(solid.points.size()));
      if (is_new) solid.points.emplace_back(p.cast<double>());
      t[i] = at->second;
    }
    solid.triangles.push_back(t);
  }
  return solid;
}

template <typename T>
T value_at(std::string_view bytes, std::size_t at) {
  T value{};
  if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

inline Vec3f point_at(std::string_view bytes, std::size_t at) {
  return {value_at<float>(bytes, at), value_at<float>(bytes, at + 4), value_at<float>(bytes, at + 8)};
}

// Reads a binary STL. Expects that its length agrees with its number of triangles.
inline ReadSolid solid_in_stl(std::string_view file) {
  ReadSolid solid;
  EXPECT_EQ(file.size(), 84 + std::size_t{50} * value_at<std::uint32_t>(file, 80));
  for (std::size_t at = 84; at + 50 <= file.size(); at += 50)
    solid.triangles.push_back({point_at(file, at + 12), point_at(file, at + 24), point_at(file, at + 36)});
  return solid;
}

// Returns the number after `label` in the text; 0 if there is none.
inline std::size_t number_after(std::string_view text, std::string_view label) {
  const std::size_t at = text.find(label);
  return at == text.npos ? 0 : std::stoul(std::string(text.substr(at + label.size(), 20)));
}

// Reads a binary little-endian PLY of points (x, y, z as floats) and triangles.
inline ReadSolid solid_in_ply(std::string_view file) {
  const std::string_view end = "end_header\n";
  const std::size_t begin = file.find(end) + end.size(), points = number_after(file, "element vertex "),
                    triangles = number_after(file, "element face ");
  EXPECT_EQ(file.size(), begin + 12 * points + 13 * triangles);
  ReadSolid solid;
  for (std::size_t i = 0; i < triangles; ++i) {
    const std::size_t at = begin + 12 * points + 13 * i;
    const auto corner = [&](std::size_t k) {
      return point_at(file, begin + std::size_t{12} * value_at<std::uint32_t>(file, at + 1 + 4 * k));
    };
    solid.triangles.push_back({corner(0), corner(1), corner(2)});
  }
  return solid;
}

// Reads an OBJ with lines `v x y z` and `f a b c`. Corners are numbered from 1.
inline ReadSolid solid_in_obj(const std::string& file) {
  ReadSolid solid;
  std::vector<Vec3f> points;
  std::istringstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (Vec3f p; kind == "v" && words >> p.x() >> p.y() >> p.z()) points.push_back(p);
    if (std::array<std::size_t, 3> f{}; kind == "f" && words >> f[0] >> f[1] >> f[2])
      solid.triangles.push_back({points.at(f[0] - 1), points.at(f[1] - 1), points.at(f[2] - 1)});
  }
  return solid;
}

// Returns the width and height that a PNG file states.
inline std::pair<std::uint32_t, std::uint32_t> size_of_png(std::string_view file) {
  EXPECT_EQ(file.substr(1, 3), "PNG");
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | value_at<std::uint8_t>(file, i);
    return value;
  };
  return {number(16), number(20)};
}

}  // namespace relievo::test
