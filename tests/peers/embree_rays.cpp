// The rays that `cargo bench -p halflight-tests --bench rays` has written, through Embree 3: one by one, on
// one thread, as rays.sh calls it.
//
//   g++ -O3 -march=native embree_rays.cpp -lembree3 -o embree_rays && ./embree_rays FOLDER

#include <embree3/rtcore.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace {

std::vector<float> read(const std::string &path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) {
        std::fprintf(stderr, "embree_rays: cannot read %s\n", path.c_str());
        std::exit(2);
    }
    std::vector<float> numbers(static_cast<std::size_t>(file.tellg()) / sizeof(float));
    file.seekg(0);
    file.read(reinterpret_cast<char *>(numbers.data()), static_cast<std::streamsize>(numbers.size() * sizeof(float)));
    return numbers;
}

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

RTCRay ray(const float *numbers) {
    RTCRay ray;
    std::memset(&ray, 0, sizeof ray);
    ray.org_x = numbers[0], ray.org_y = numbers[1], ray.org_z = numbers[2];
    ray.dir_x = numbers[3], ray.dir_y = numbers[4], ray.dir_z = numbers[5];
    ray.tfar = numbers[6];
    ray.mask = ~0u;
    return ray;
}

// Millions of rays per second in the fastest of several runs, and how many meet something.
template <typename Meets> void measure(const char *set, const char *kind, const std::vector<float> &rays, Meets meets) {
    double fastest = std::numeric_limits<double>::infinity();
    std::size_t hits = 0;
    for (int run = 0; run < 7; ++run) {
        const double start = seconds();
        hits = 0;
        for (std::size_t i = 0; i + 7 <= rays.size(); i += 7) hits += meets(&rays[i]);
        fastest = std::min(fastest, seconds() - start);
    }
    std::printf("%-8s %-8s %8.3f Mrays/s  %zu meet something\n", set, kind, rays.size() / 7 / fastest * 1e-6, hits);
}

} // namespace

int main(int count, char **arguments) {
    if (count != 2) {
        std::fprintf(stderr, "usage: embree_rays FOLDER\n");
        return 2;
    }
    const std::string folder = std::string(arguments[1]) + "/";
    const std::vector<float> corners = read(folder + "triangles.bin");
    const std::size_t triangles = corners.size() / 9;

    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void *vertices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, triangles * 3);
    std::memcpy(vertices, corners.data(), corners.size() * sizeof(float));
    auto *indices = static_cast<unsigned *>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles));
    for (std::size_t i = 0; i < triangles * 3; ++i) indices[i] = static_cast<unsigned>(i);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    const double start = seconds();
    rtcCommitScene(scene);
    std::printf("%zu triangles: built in %.2f s (high quality, one thread)\n", triangles, seconds() - start);

    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (const char *set : {"camera", "shadow", "diffuse"}) {
        const std::vector<float> rays = read(folder + set + ".bin");
        measure(set, "closest", rays, [&](const float *numbers) {
            RTCRayHit query;
            std::memset(&query, 0, sizeof query);
            query.ray = ray(numbers);
            query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene, &context, &query);
            return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        });
        measure(set, "any", rays, [&](const float *numbers) {
            RTCRay query = ray(numbers);
            rtcOccluded1(scene, &context, &query);
            return query.tfar < 0.0f;
        });
    }
}
