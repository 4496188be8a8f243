// The program that embree_spheres compiles and runs. It draws spheres with Embree
// (RTC_GEOMETRY_TYPE_SPHERE_POINT), with packets of eight coherent rays on all cores.
//   embree_spheres SCENE COUNT EDGE eye(3) forward(3) up(3) tangent_of_half
// EDGE is the edge length of the image in pixels. Each (3) stands for three coordinates, and the
// last argument is the tangent of half the field of view.
// Prints Embree's version and the build time in ms. Then reads commands, one per line. For each
// command it draws a frame and prints the time in nanoseconds. "frame" does nothing else; "image
// FILE" also writes premultiplied RGBA floats to FILE, top row first.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr int tile = 16;
constexpr int lanes = 8;
constexpr float ambient = 0.3F;
constexpr float diffuse = 0.7F;

struct Vector {
  float x, y, z;
};
Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct View {
  int edge;
  Vector eye, forward, up, right;
  float half;
};

struct Scene {
  RTCScene scene;
  std::vector<std::uint8_t> colours;
};

// Traces eight pixels of a row.
void draw_packet(const Scene& scene, const View& view, int x, int y, float* image) {
  alignas(32) int valid[lanes];
  RTCRayHit8 rays;
  const float v =
      (1 - 2 * (static_cast<float>(y) + 0.5F) / static_cast<float>(view.edge)) * view.half;
  for (int k = 0; k < lanes; ++k) {
    const float u =
        (2 * (static_cast<float>(x + k) + 0.5F) / static_cast<float>(view.edge) - 1) * view.half;
    valid[k] = x + k < view.edge ? -1 : 0;
    rays.ray.org_x[k] = view.eye.x;
    rays.ray.org_y[k] = view.eye.y;
    rays.ray.org_z[k] = view.eye.z;
    rays.ray.dir_x[k] = view.forward.x + u * view.right.x + v * view.up.x;
    rays.ray.dir_y[k] = view.forward.y + u * view.right.y + v * view.up.y;
    rays.ray.dir_z[k] = view.forward.z + u * view.right.z + v * view.up.z;
    rays.ray.tnear[k] = 0;
    rays.ray.tfar[k] = INFINITY;
    rays.ray.time[k] = 0;
    rays.ray.mask[k] = ~0U;
    rays.ray.id[k] = 0;
    rays.ray.flags[k] = 0;
    rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.primID[k] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid, scene.scene, &rays, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene.scene, &context, &rays);
#endif
  for (int k = 0; k < lanes && x + k < view.edge; ++k) {
    float* pixel = image + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(view.edge) +
                                static_cast<std::size_t>(x + k));
    if (rays.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) {
      std::memset(pixel, 0, 4 * sizeof(float));
      continue;
    }
    const float nx = rays.hit.Ng_x[k], ny = rays.hit.Ng_y[k], nz = rays.hit.Ng_z[k];
    const float dx = rays.ray.dir_x[k], dy = rays.ray.dir_y[k], dz = rays.ray.dir_z[k];
    const float cosine = std::abs(nx * dx + ny * dy + nz * dz) /
                         std::sqrt((nx * nx + ny * ny + nz * nz) * (dx * dx + dy * dy + dz * dz));
    const float light = (ambient + diffuse * cosine) / 255;
    const std::uint8_t* colour =
        scene.colours.data() + 3 * static_cast<std::size_t>(rays.hit.primID[k]);
    for (int c = 0; c < 3; ++c) pixel[c] = light * static_cast<float>(colour[c]);
    pixel[3] = 1;
  }
}

void draw(const Scene& scene, const View& view, std::vector<float>& image) {
  const int across = (view.edge + tile - 1) / tile;
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int n = next++; n < across * across; n = next++) {
      const int x0 = n % across * tile;
      const int y0 = n / across * tile;
      for (int y = y0; y < std::min(y0 + tile, view.edge); ++y) {
        for (int x = x0; x < std::min(x0 + tile, view.edge); x += lanes)
          draw_packet(scene, view, x, y, image.data());
      }
    }
  };
  std::vector<std::jthread> threads;
  for (unsigned k = 1; k < std::thread::hardware_concurrency(); ++k) threads.emplace_back(work);
  work();
}

double since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
}

Scene load(RTCDevice device, const char* file, std::size_t count) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  void* spheres =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, count);
  Scene scene{rtcNewScene(device), std::vector<std::uint8_t>(3 * count)};
  std::ifstream in(file, std::ios::binary);
  in.read(static_cast<char*>(spheres), static_cast<std::streamsize>(16 * count));
  in.read(reinterpret_cast<char*>(scene.colours.data()), static_cast<std::streamsize>(3 * count));
  const auto begin = std::chrono::steady_clock::now();
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.scene);
  std::printf("Embree %s %.3f\n", RTC_VERSION_STRING, since(begin) / 1e6);
  std::fflush(stdout);
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 14) return 3;
  const auto number = [&](int n) { return static_cast<float>(std::atof(argv[n])); };
  const auto vector = [&](int n) { return Vector{number(n), number(n + 1), number(n + 2)}; };
  View view{std::atoi(argv[3]), vector(4), vector(7), vector(10), {}, number(13)};
  view.right = cross(view.forward, view.up);
  const RTCDevice device = rtcNewDevice(nullptr);
  const Scene scene = load(device, argv[1], static_cast<std::size_t>(std::atoll(argv[2])));
  std::vector<float> image(4 * static_cast<std::size_t>(view.edge) *
                           static_cast<std::size_t>(view.edge));
  for (std::string line; std::getline(std::cin, line);) {
    const auto begin = std::chrono::steady_clock::now();
    draw(scene, view, image);
    std::printf("%.0f\n", since(begin));
    if (line.starts_with("image ")) {
      std::ofstream(line.substr(6), std::ios::binary)
          .write(reinterpret_cast<const char*>(image.data()),
                 static_cast<std::streamsize>(image.size() * sizeof(float)));
    }
    std::fflush(stdout);
  }
}
