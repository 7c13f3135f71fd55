#include "scene/rays.hpp"

#include <embree3/rtcore.h>

#include <limits>

#include "io/error.hpp"

namespace bitshade {

struct ray_caster::handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<float> padded;  // Embree reads 16 bytes at a vertex, so the last one needs room

  ~handles() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  void check() const {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw failure(error == RTC_ERROR_OUT_OF_MEMORY
                      ? "out of memory for the scene's triangles: use fewer of them"
                      : "the ray tracer failed with Embree's error " + std::to_string(error));
  }
};

namespace {

RTCRay make_ray(glm::dvec3 origin, glm::dvec3 direction, double start, double end) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x);
  ray.org_y = static_cast<float>(origin.y);
  ray.org_z = static_cast<float>(origin.z);
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tnear = static_cast<float>(start);
  ray.tfar = static_cast<float>(end);
  ray.mask = 0xFFFFFFFFu;
  return ray;
}

}  // namespace

ray_caster::ray_caster(const scene& s) : handles_(std::make_unique<handles>()) {
  // One thread builds the hierarchy, so that it, and with it the winner among equally near
  // triangles, is the same on every machine and thread count.
  handles_->device = rtcNewDevice("threads=1");
  if (!handles_->device) throw failure("the ray tracer cannot start on this processor");
  handles_->scene = rtcNewScene(handles_->device);
  rtcSetSceneFlags(handles_->scene,
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT));
  rtcSetSceneBuildQuality(handles_->scene, RTC_BUILD_QUALITY_MEDIUM);
  const RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  handles_->padded.reserve(s.vertices.size() * 3 + 1);
  for (const auto& v : s.vertices) handles_->padded.insert(handles_->padded.end(), {v.x, v.y, v.z});
  handles_->padded.push_back(0);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             handles_->padded.data(), 0, 3 * sizeof(float), s.vertices.size());
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), s.triangles.size()));
  if (indices) {
    for (const auto& t : s.triangles) {
      *indices++ = t.x;
      *indices++ = t.y;
      *indices++ = t.z;
    }
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(handles_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(handles_->scene);
  handles_->check();
}

ray_caster::~ray_caster() = default;
ray_caster::ray_caster(ray_caster&&) noexcept = default;
ray_caster& ray_caster::operator=(ray_caster&&) noexcept = default;

std::optional<std::uint32_t> ray_caster::first_hit(glm::dvec3 origin, glm::dvec3 direction,
                                                   double start) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray = make_ray(origin, direction, start, std::numeric_limits<double>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(handles_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return query.hit.primID;
}

bool ray_caster::occluded(glm::dvec3 origin, glm::dvec3 direction, double start, double end) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(origin, direction, start, end);
  rtcOccluded1(handles_->scene, &context, &ray);
  return ray.tfar < 0;
}

}  // namespace bitshade
