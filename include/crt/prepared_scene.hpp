#pragma once

#include <crt/scene.hpp>
#include <crt/stats.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace crt {

namespace core {
class PreparedData;
}

/// A PreparedScene is a scene made ready for rays: checked, flattened and accelerated. It is
/// immutable: copies share, and any number of threads may use it at once.
class PreparedScene {
 public:
  /// Takes what prepare() computed. This is internal.
  explicit PreparedScene(std::shared_ptr<const core::PreparedData> data) : data_(std::move(data)) {}

  /// Returns the memory it takes. Scenes that were prepared from one another share some of it, and
  /// each counts all.
  MemoryUse memory() const;

  /// Returns what the user should know of the scene, a line each: it has no light, its camera is on
  /// a surface, an image has values that are not finite, a mesh has warnings in its MeshReport. A
  /// render gives the same to RenderOptions::log.
  const std::vector<std::string>& warnings() const;

  /// Returns what rays see. This is internal.
  const core::PreparedData& data() const { return *data_; }
  /// Returns a pointer to the same data that does not keep it alive. This is internal.
  std::weak_ptr<const core::PreparedData> watched_data() const { return data_; }

 private:
  std::shared_ptr<const core::PreparedData> data_;
};

/// Checks the scene (throws Error naming what is wrong) and builds what rays need.
PreparedScene prepare(const Scene& scene);

/// Prepares a scene that was prepared before and edited since. What is made of entities that are
/// the same (copies of one another, in the same order) is taken over from the earlier one, if
/// Settings::precision is the same. So a new camera, light, background or other setting costs next
/// to nothing, and so do other materials that let no light in. Of thousands of entities some that
/// were moved, replaced, added or removed take a few milliseconds. All answers and pictures are
/// those of prepare(scene), to the bit, and so are the starts of hits.
PreparedScene prepare(const Scene& scene, const PreparedScene& earlier);

/// Says what else prepare() may be asked.
struct PrepareOptions {
  /// This is what was prepared earlier, as above, or null. It is used only while prepare() runs.
  const PreparedScene* earlier = nullptr;
  /// Is called some tens of times a second, from one thread at a time, which may be any of those
  /// that work. Returning false ends prepare() with Error (cancelled), within 0.1 s in scenes of up
  /// to a million primitives.
  std::function<bool()> go_on{};
  /// This is the most primitives that the scene may have. With more, prepare() throws Error (limit)
  /// before it takes any memory. 0 means as many as the memory of the machine (or container) may be
  /// enough for. It counts 1350 bytes for each, or 2700 in the exact tier, as the largest
  /// primitives take; lone spheres take 600. There can never be more than 33554432. A solid of
  /// several primitives, or a mesh, that is placed often counts once, and each of its uses as one
  /// primitive of 512 bytes. That is if copies of one Entity are placed, 16 or more.
  std::uint64_t max_primitives = 0;
  /// Returns what stands in for a material of the scene, so that an editor can show shapes in clay.
  /// It is called with each of them, on the thread that calls prepare(). Other materials on the
  /// same entities cost as little as another light. Without it each material is what it is.
  std::function<SharedMaterial(const SharedMaterial&)> material{};
};

/// Prepares a scene with options. Throws Error: cancelled, limit (max_primitives), out_of_memory
/// and those of prepare().
PreparedScene prepare(const Scene& scene, const PrepareOptions& options);

}  // namespace crt
