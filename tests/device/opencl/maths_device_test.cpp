// Tests that the portable maths gives the same results in OpenCL C and in C++.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "backends/opencl/devices.hpp"
#include "backends/opencl/programs.hpp"
#include "core/error.hpp"
#include "core/random.hpp"
#include "technique/portable/prelude.hpp"
#include "tests/device/opencl/opencl_devices.hpp"

namespace triptych::opencl_backend {
namespace {

namespace portable = technique::portable;

constexpr const char* kernel_text = R"(
__kernel void maths(__global const float2* in, __global float4* out) {
  int i = (int)get_global_id(0);
  float2 v = in[i];
  float2 slab = tri_slab(v.x * 20.0f - 5.0f, v.y - 1.0f, 9.0f);
  out[4 * i] = (float4)(tri_opacity(v.x, v.y), tri_table_position(v.x), slab.x, slab.y);
  out[4 * i + 1] = (float4)(tri_log2_1m(v.x), tri_1m_exp2(-v.y * 8.0f),
                            (float)tri_sample_count(v.y * 300.0f), tri_step_share(v.y * 3.0f, 2));
  float along = tri_along_axis(v.x, v.y, 1.0f - v.x, v.y, 0.3f, 2.0f, 1e-9f, 1e-9f, -1e-8f, 0.6f,
                               v.x, v.y, 1e-9f, -1e-9f, 1e-9f);
  float2 interval = tri_sphere_interval(v.x - 0.5f, v.y * 3.0f - 1.0f, 0.7f);
  float discriminant = tri_sphere_discriminant(v.x, 0.2f, v.y + 1.5f, 1.0f, 0.3f, v.x - 0.5f);
  out[4 * i + 2] = (float4)(along, interval.x, interval.y, discriminant);
  float hit = discriminant >= 0.0f ? discriminant : 0.0f;
  out[4 * i + 3] = (float4)(
      tri_sphere_distance(v.x, 0.2f, v.y + 1.5f, 0.3f, v.x - 0.5f, hit),
      tri_sphere_cosine(1.0f, 0.3f, v.x - 0.5f, hit), tri_depth(0.01f, v.y), tri_cosine_turns(v.x));
}
)";

struct Vector {
  float x;
  float y;
};

// Returns pairs of opacity and step length: the extremes, the smallest value, the largest value
// below 1, and seeded random values.
std::vector<Vector> vectors() {
  std::vector<Vector> all;
  for (const float alpha : {0.0F, 0x1p-30F, 0x1p-24F, 0x1p-20F, 0.25F, 0.5F, 1 - 0x1p-24F}) {
    for (const float steps : {0.0F, 0x1p-10F, 0.1F, 0.5F, 1.0F, 2.0F})
      all.push_back({alpha, steps});
  }
  core::Random random(3);
  while (all.size() < 4096) {
    all.push_back({static_cast<float>(random.uniform()), static_cast<float>(random.uniform(0, 2))});
  }
  return all;
}

std::vector<float> expected(const std::vector<Vector>& in) {
  std::vector<float> out;
  for (const auto& [x, y] : in) {
    const auto slab = portable::tri_slab(x * 20.0F - 5.0F, y - 1.0F, 9.0F);
    out.insert(out.end(), {portable::tri_opacity(x, y), portable::tri_table_position(x), slab.x,
                           slab.y, portable::tri_log2_1m(x), portable::tri_1m_exp2(-y * 8.0F),
                           static_cast<float>(portable::tri_sample_count(y * 300.0F)),
                           portable::tri_step_share(y * 3.0F, 2)});
    const float along = portable::tri_along_axis(x, y, 1.0F - x, y, 0.3F, 2.0F, 1e-9F, 1e-9F,
                                                 -1e-8F, 0.6F, x, y, 1e-9F, -1e-9F, 1e-9F);
    const auto interval = portable::tri_sphere_interval(x - 0.5F, y * 3.0F - 1.0F, 0.7F);
    const float discriminant =
        portable::tri_sphere_discriminant(x, 0.2F, y + 1.5F, 1.0F, 0.3F, x - 0.5F);
    const float hit = std::max(discriminant, 0.0F);
    out.insert(out.end(), {along, interval.x, interval.y, discriminant,
                           portable::tri_sphere_distance(x, 0.2F, y + 1.5F, 0.3F, x - 0.5F, hit),
                           portable::tri_sphere_cosine(1.0F, 0.3F, x - 0.5F, hit),
                           portable::tri_depth(0.01F, y), portable::tri_cosine_turns(x)});
  }
  return out;
}

std::vector<float> on_device(const Found& found, const std::vector<Vector>& in) {
  return checked([&] {
    const cl::Context context(found.device);
    const Session session{.device = found.device,
                          .context = context,
                          .queue = cl::CommandQueue(context, found.device),
                          .batch = 1};
    const cl::Program program =
        build(session, program_source({"sphere_math.h"}) + kernel_text, "-cl-std=CL1.2");
    std::vector<float> out(16 * in.size());
    const cl::Buffer from(context, CL_MEM_READ_ONLY, in.size() * sizeof(Vector));
    const cl::Buffer to(context, CL_MEM_WRITE_ONLY, out.size() * sizeof(float));
    session.queue.enqueueWriteBuffer(from, CL_TRUE, 0, in.size() * sizeof(Vector), in.data());
    cl::Kernel kernel(program, "maths");
    kernel.setArg(0, from);
    kernel.setArg(1, to);
    session.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(in.size()));
    session.queue.enqueueReadBuffer(to, CL_TRUE, 0, out.size() * sizeof(float), out.data());
    return out;
  });
}

// Returns the distance in units in the last place. It is 0 for identical bits, and for +0 and −0.
std::int64_t ulps(float a, float b) {
  if (a == b) return 0;
  const auto ordered = [](float x) {
    const auto bits = std::bit_cast<std::int32_t>(x);
    return bits < 0 ? -static_cast<std::int64_t>(bits & 0x7fffffff) : std::int64_t{bits};
  };
  return std::llabs(ordered(a) - ordered(b));
}

TEST(OpenClMaths, MatchesTheHost) {
  const std::vector<Vector> in = vectors();
  const std::vector<float> host = expected(in);
  for (const Found& found : find_devices().found) {
    SCOPED_TRACE(found.info.id);
    const std::vector<float> device = on_device(found, in);
    std::int64_t worst = 0;
    for (std::size_t i = 0; i < host.size(); ++i) worst = std::max(worst, ulps(host[i], device[i]));
    std::printf("%s: %lld ulp\n", found.info.id.c_str(), static_cast<long long>(worst));
    // The functions use only additions, products, divisions and square roots. A CPU rounds all of
    // these as IEEE 754 requires. Other devices may have errors of 2.5 ulp in divisions and 3 ulp
    // in square roots.
    EXPECT_LE(worst, found.info.driver == "pocl" ? 0 : 8);
  }
}

TEST(OpenClPrograms, AFailedBuildReportsTheCompilerLog) {
  for (const Found& found : find_devices().found) {
    SCOPED_TRACE(found.info.id);
    const cl::Context context(found.device);
    const Session session{.device = found.device,
                          .context = context,
                          .queue = cl::CommandQueue(context, found.device),
                          .batch = 1};
    try {
      static_cast<void>(
          build(session, "__kernel void broken() { no_such_name; }", "-cl-std=CL1.2"));
      ADD_FAILURE() << "the broken program was built";
    } catch (const core::ApiError& error) {
      EXPECT_EQ(error.call(), "clBuildProgram");
      EXPECT_EQ(error.code(), "CL_BUILD_PROGRAM_FAILURE");
      EXPECT_NE(std::string(error.what()).find("no_such_name"), std::string::npos) << error.what();
    }
  }
}

TEST(OpenClErrors, ContainTheNameOfTheCode) {
  EXPECT_EQ(code_name(CL_INVALID_KERNEL_ARGS), "CL_INVALID_KERNEL_ARGS");
  EXPECT_EQ(code_name(-1234), "error -1234");
  EXPECT_THROW(checked([] { throw cl::Error(CL_DEVICE_NOT_AVAILABLE, "clFinish"); }),
               core::DeviceLost);
  try {
    checked([] { throw cl::Error(CL_INVALID_VALUE, "clFinish"); });
  } catch (const core::DeviceLost&) {
    ADD_FAILURE() << "an invalid value was reported as a lost device";
  } catch (const core::ApiError& error) {
    EXPECT_NE(std::string(error.what()).find("clFinish returned CL_INVALID_VALUE at maths_device"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace triptych::opencl_backend
