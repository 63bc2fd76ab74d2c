// Makes triangle meshes of shapes that have closed forms.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "relievo/scan/mesh.h"

namespace relievo::test {

// Returns the mesh of a surface at(u, v) over [0, 1] x [0, 1]. Along each parameter, the surface must be
// closed or end in a point. `u_count` and `v_count` are the numbers of edges along the parameters.
inline Mesh parametric_mesh(const std::function<Vec3(double, double)>& at, int u_count, int v_count) {
  Mesh mesh;
  for (int v = 0; v <= v_count; ++v)
    for (int u = 0; u <= u_count; ++u)
      mesh.points.push_back(at(static_cast<double>(u % u_count) / u_count, static_cast<double>(v) / v_count));
  const auto number = [&](int u, int v) { return static_cast<Index>(v * (u_count + 1) + u); };
  for (int v = 0; v < v_count; ++v)
    for (int u = 0; u < u_count; ++u) {
      mesh.triangles.push_back({number(u, v), number(u + 1, v), number(u + 1, v + 1)});
      mesh.triangles.push_back({number(u, v), number(u + 1, v + 1), number(u, v + 1)});
    }
  return mesh;
}

// Returns the mesh of a sphere around the origin, with the poles on the y axis.
inline Mesh sphere_mesh(double radius, int sides) {
  return parametric_mesh(
      [&](double u, double v) -> Vec3 {
        const double a = 2 * std::numbers::pi * u, b = std::numbers::pi * v;
        return radius * Vec3(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
      },
      sides, sides / 2);
}

// Returns a torus about the z axis. R is the distance from the axis to the centre of the tube, and r is the
// radius of the tube.
inline Mesh torus_mesh(double R, double r, int sides) {
  return parametric_mesh(
      [&](double u, double v) -> Vec3 {
        const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v;
        const double ring = R + r * std::cos(b);
        return {ring * std::cos(a), ring * std::sin(a), r * std::sin(b)};
      },
      sides, sides / 2);
}

// Returns the mesh of a button about the z axis. It has a flat face of radius `face` at height z + edge.
// Around the face, a quarter circle falls to height z.
inline Mesh button_mesh(double face, double edge, double z, int sides) {
  return parametric_mesh(
      [&](double u, double v) -> Vec3 {
        const double a = 2 * std::numbers::pi * u, b = std::numbers::pi * std::max(0., v - .5);
        const double radius = v < .5 ? 2 * v * face : face + edge * std::sin(b);
        return {radius * std::cos(a), radius * std::sin(a), z + edge * (v < .5 ? 1 : std::cos(b))};
      },
      sides, sides / 2);
}

inline Mesh joined(Mesh mesh, const Mesh& other) {
  const auto first = static_cast<Index>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
  return mesh;
}

// Returns the mesh of a flat gear in the plane z = 0. Its teeth extend from the radius `root` to the
// radius `tip`, and their flanks are radial.
inline Mesh gear_mesh(double root, double tip, int teeth) {
  Mesh mesh;
  const int steps = 40;  // number of steps along the arc of a tooth
  const auto at = [&](double radius, double angle) {
    mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    return static_cast<Index>(mesh.points.size() - 1);
  };
  for (int k = 0; k < 2 * teeth * steps; ++k) {
    const double radius = k / steps % 2 == 0 ? tip : root, unit = std::numbers::pi / teeth / steps;
    const Index middle = at(0, 0), begin = at(radius, k * unit), end = at(radius, (k + 1) * unit);
    mesh.triangles.push_back({middle, begin, end});
  }
  return mesh;
}

}  // namespace relievo::test
