// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <whitney/io/formats/color_map.h>
#include <whitney/io/formats/mesh_writers.h>
#include <whitney/io/formats/surface.h>

namespace whitney::io {

namespace {

using Vec3 = std::array<double, 3>;

constexpr double kViewAngle = 24;                      // degrees, across the picture
constexpr Vec3 kTowardsViewer = {0.42, -0.70, 0.577};  // from the front, above, a little to the right; z is up
constexpr double kCurveRadius = 0.018;                 // of a curve's tube, in radii of the whole

/// Six digits are finer than any picture, and keep the scene small.
std::string short_number(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 7).ptr;
  return {text.data(), end};
}

std::string vector_text(double x, double y, double z) {
  return "<" + short_number(x) + "," + short_number(y) + "," + short_number(z) + ">";
}

std::string color_text(const Vec3& c) { return "srgb " + vector_text(c[0], c[1], c[2]); }

/// A ball around the object: the middle of its bounding box, and the distance to the farthest point.
struct Ball {
  Vec3 center{};
  double radius = 1;
};

Ball bounding_ball(const MeshView& mesh) {
  Ball ball;
  if (mesh.num_points() == 0) return ball;
  Vec3 low{}, high{};
  for (std::size_t i = 0; i < mesh.num_points(); ++i) {
    const auto p = mesh.position(i);
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = i == 0 ? p[k] : std::min(low[k], p[k]);
      high[k] = i == 0 ? p[k] : std::max(high[k], p[k]);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) ball.center[k] = low[k] / 2 + high[k] / 2;
  double radius = 0;
  for (std::size_t i = 0; i < mesh.num_points(); ++i) {
    const auto p = mesh.position(i);
    radius = std::max(radius, std::hypot(p[0] - ball.center[0], p[1] - ball.center[1], p[2] - ball.center[2]));
  }
  if (radius > 0) ball.radius = radius;
  return ball;
}

/// The scene around the object, which is moved and scaled into the unit ball, so that units do not matter.
void write_setting(AtomicFile& file, bool coloured) {
  constexpr double kPi = 3.14159265358979323846;
  const double distance = 1.06 / std::sin(kViewAngle / 2 * kPi / 180);
  file.write(
      "// Written by whitney-toolkit. Render: povray +I<this file> +O<picture.png> +W1200 +H1200 +A0.1 -D\n"
      "#version 3.7;\n"
      "global_settings { assumed_gamma 1 max_trace_level 10 }\n"
      "background { srgb <0.965,0.97,0.98> }\n"
      "// The view follows the shorter side of the picture.\n"
      "#declare Aspect = image_width / image_height;\n"
      "camera {\n  perspective\n  location " +
      vector_text(distance * kTowardsViewer[0], distance * kTowardsViewer[1], distance * kTowardsViewer[2]) +
      "\n  sky z\n  up y\n  right -x * Aspect  // right-handed\n  angle 2 * degrees(atan2(max(Aspect, 1) * "
      "tan(radians(" +
      short_number(kViewAngle) +
      ") / 2), 1))\n  look_at 0\n}\n"
      "// A broad light from the upper left that casts soft shadows, and a weak one without shadows from the right.\n"
      "light_source { <-4,-9,11> rgb 0.95 area_light <4,0,0> <0,2.6,2.6> 5 5 adaptive 1 jitter }\n"
      "light_source { <12,-5,3> rgb 0.38 shadowless }\n"
      "#default { finish { ambient 0.16 diffuse 0.66 specular 0.18 roughness 0.035 } }\n"
      "#declare Tone = pigment { ");
  if (coloured) {
    file.write("gradient x color_map {");
    for (std::size_t i = 0; i < kColorStops.size(); ++i) {
      file.write("\n  [" + short_number(static_cast<double>(i) / (kColorStops.size() - 1)) + " " +
                 color_text(kColorStops[i]) + "]");
    }
    file.write(" } ");
  } else {
    file.write("color " + color_text({0.33, 0.55, 0.78}) + " ");
  }
  file.write("}\n");
}

/// The place of a point's colour on the scale; short of both ends, where the gradient repeats.
double scale_position(double t) { return 0.001 + 0.998 * t; }

void write_surface(AtomicFile& file, const MeshView& mesh, const Ball& ball) {
  const auto list = [&file](const char* keyword, std::size_t count, const auto& item) {
    file.write("  ");
    file.write(keyword);
    file.write(" {\n    ");
    file.write(std::uint64_t{count});
    for (std::size_t i = 0; i < count; ++i) {
      file.write(i % 4 == 0 ? ",\n    " : ", ");
      file.write(item(i));
    }
    file.write("\n  }\n");
  };
  // Triangles as numbers of corners: normals belong to corners, since a one-sided surface has none at its points.
  std::vector<std::array<std::size_t, 3>> triangles;
  std::size_t first = 0;
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    const std::size_t n = mesh.cell(c).size();
    for (std::size_t i = 1; i + 1 < n; ++i) triangles.push_back({first, first + i, first + i + 1});
    first += n;
  }
  const std::vector<double> normals = corner_normals(mesh);
  file.write("mesh2 {\n");
  list("vertex_vectors", mesh.num_points(), [&](std::size_t i) {
    const auto p = mesh.position(i);
    return vector_text((p[0] - ball.center[0]) / ball.radius, (p[1] - ball.center[1]) / ball.radius,
                       (p[2] - ball.center[2]) / ball.radius);
  });
  list("normal_vectors", mesh.corners.size(),
       [&](std::size_t i) { return vector_text(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]); });
  if (!mesh.color.empty()) {
    list("uv_vectors", mesh.num_points(),
         [&](std::size_t i) { return "<" + short_number(scale_position(mesh.color[i])) + ",0>"; });
  }
  const auto triple = [](std::size_t a, std::size_t b, std::size_t c) {
    return "<" + std::to_string(a) + "," + std::to_string(b) + "," + std::to_string(c) + ">";
  };
  const auto by_points = [&](std::size_t i) {
    const auto [a, b, c] = triangles[i];
    return triple(mesh.corners[a], mesh.corners[b], mesh.corners[c]);
  };
  list("face_indices", triangles.size(), by_points);
  list("normal_indices", triangles.size(),
       [&](std::size_t i) { return triple(triangles[i][0], triangles[i][1], triangles[i][2]); });
  if (!mesh.color.empty()) list("uv_indices", triangles.size(), by_points);
  file.write(mesh.color.empty() ? "  texture { pigment { Tone } }\n}\n"
                                : "  texture { uv_mapping pigment { Tone } }\n}\n");
}

/// A curve: a ball at every point, a cylinder along every edge, both in the colour of the point (of the edge's first).
void write_curve(AtomicFile& file, const MeshView& mesh, const Ball& ball) {
  const auto place = [&](std::size_t i) {
    const auto p = mesh.position(i);
    return vector_text((p[0] - ball.center[0]) / ball.radius, (p[1] - ball.center[1]) / ball.radius,
                       (p[2] - ball.center[2]) / ball.radius);
  };
  const auto texture = [&](std::size_t i) {
    return mesh.color.empty() ? std::string("pigment { Tone }")
                              : "pigment { color " + color_text(color_of(mesh.color[i])) + " }";
  };
  const std::string radius = short_number(kCurveRadius);
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    const std::uint32_t a = mesh.cell(c)[0], b = mesh.cell(c)[1];
    file.write("sphere { " + place(a) + ", " + radius + " " + texture(a) + " }\n");
    file.write("sphere { " + place(b) + ", " + radius + " " + texture(b) + " }\n");
    if (place(a) != place(b)) {  // a cylinder of length 0 is an error
      file.write("cylinder { " + place(a) + ", " + place(b) + ", " + radius + " " + texture(a) + " }\n");
    }
  }
}

/// The strata of a surface: thin tubes along its boundary, balls at the corners.
void write_strata(AtomicFile& file, const MeshView& mesh, const Ball& ball) {
  const auto place = [&](std::size_t i) {
    const auto p = mesh.position(i);
    return vector_text((p[0] - ball.center[0]) / ball.radius, (p[1] - ball.center[1]) / ball.radius,
                       (p[2] - ball.center[2]) / ball.radius);
  };
  const std::string ink = " pigment { color " + color_text({0.12, 0.14, 0.2}) + " } }\n";
  const std::string thin = short_number(kCurveRadius / 3), thick = short_number(kCurveRadius);
  for (const MeshStratum& stratum : mesh.strata) {
    if (stratum.dim > 1) continue;
    for (const std::uint32_t v : stratum.simplices)
      file.write("sphere { " + place(v) + ", " + (stratum.dim == 0 ? thick : thin) + ink);
    for (std::size_t i = 0; stratum.dim == 1 && i < stratum.simplices.size(); i += 2) {
      const std::string a = place(stratum.simplices[i]), b = place(stratum.simplices[i + 1]);
      if (a != b) file.write("cylinder { " + a + ", " + b + ", " + thin + ink);
    }
  }
}

}  // namespace

void write_pov(AtomicFile& file, const MeshView& mesh) {
  const Ball ball = bounding_ball(mesh);
  write_setting(file, !mesh.color.empty());
  if (mesh.num_cells() == 0) return;
  if (mesh.dim == 1) {
    write_curve(file, mesh, ball);
  } else {
    write_surface(file, mesh, ball);
  }
  write_strata(file, mesh, ball);
}

}  // namespace whitney::io
