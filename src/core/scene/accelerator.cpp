#include "core/scene/accelerator.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <tuple>

#include "core/math/vector.hpp"
#include "core/scene/embree_tree.hpp"

namespace crt::core {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// How far along the ray from a hit other crossings may be and yet be at its place, or at the start of a ray
/// that goes on from it, whose origin is rounded. Wide, as the next ray may meet at right angles what
/// this one grazes: it only decides where to look.
double company_width(const WorldRay& ray, const RayHit& hit) {
  constexpr double error_factor = 4;
  constexpr double relative_width = 0x1p-40;
  const double farthest =
      std::fma(std::abs(hit.t), largest_component(ray.direction), largest_component(ray.origin));
  return error_factor * hit.error + relative_width * farthest;
}

/// How far before the end of a ray the crossing of a surface through that end may be; the flatter the ray,
/// the farther. Within it is_at_end() looks closely.
double end_width(const WorldRay& ray) {
  constexpr double relative_width = 0x1p-26;
  return relative_width *
         std::fma(ray.t_max, largest_component(ray.direction), largest_component(ray.origin));
}

bool any_surface_is_shared(const CompiledScene& scene) {
  std::vector<std::uint32_t> owners(scene.face_surfaces.size(), nothing);
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    const SceneObject& solid = scene.objects[object];
    const std::uint32_t count = solid.is_csg() ? scene.programs[solid.program].leaf_count() : 1;
    for (const Leaf& leaf : std::span(scene.leaves).subspan(solid.first_leaf, count)) {
      for (std::uint32_t face = 0; face < leaf.face_count; ++face) {
        std::uint32_t& owner = owners[scene.face_surfaces[leaf.first_face + face].surface];
        if (owner != nothing && owner != object) return true;
        owner = object;
      }
    }
  }
  return false;
}

}  // namespace

/// One ray on its way through the scene. The kinds differ in what they keep of an object's crossings.
class Accelerator::Query {
 public:
  Query(const Accelerator& accelerator, const WorldRay& ray, RayWorkspace& work)
      : accelerator_(accelerator), ray_(ray), work_(work), limit_(ray.t_max), near_end_(ray.t_max) {
    if (ray.end_error > 0) near_end_ -= end_width(ray);
  }
  virtual ~Query() = default;
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  /// Nothing at t > limit() matters any more; below t_min, the query is done.
  double limit() const { return limit_; }
  const WorldRay& ray() const { return ray_; }

  void test(std::uint32_t object_index) {
    ++work_.intersection_tests;
    const SceneObject& object = accelerator_.object(object_index);
    if (object.is_csg()) {
      test_csg(object_index, object);
    } else {
      test_leaf(object_index, object);
    }
  }

 protected:
  /// Is given the object's crossings with t_min < t <= limit in order until it returns false.
  virtual bool take(const RayHit& hit) = 0;
  /// Is told first whether the ray starts inside; false skips the object.
  virtual bool begin(std::uint32_t /*object*/, bool /*starts_inside*/) { return true; }
  /// Is told when the object has no (more) crossings.
  virtual void end(std::uint32_t /*object*/, std::uint32_t /*leaf*/, bool /*inside*/) {}

  void set_limit(double limit) { limit_ = limit; }

  /// Whether take() never asks for more of an object than its first crossing.
  bool takes_one_ = false;

  /// Whether a crossing is before the ray's end and not at it.
  bool is_on_way(const RayHit& hit) const {
    return hit.t < near_end_ || (hit.t < ray_.t_max && !accelerator_.is_at_end(ray_, hit));
  }

 private:
  void test_leaf(std::uint32_t object_index, const SceneObject& object);
  void test_csg(std::uint32_t object_index, const SceneObject& object);

  const Accelerator& accelerator_;
  const WorldRay& ray_;
  RayWorkspace& work_;
  double limit_;
  double near_end_;
};

void Accelerator::Query::test_leaf(std::uint32_t object_index, const SceneObject& object) {
  const Leaf& leaf = accelerator_.leaf(object.first_leaf);
  const ObjectRay object_ray = accelerator_.object_ray(object.first_leaf, ray_);
  CrossingList& crossings = work_.crossings;
  crossings.clear();
  // A crossing above that is not at the start: it is also more than its error above, to the last bit or so.
  constexpr double more_than_rounding = 0x1p-50;
  const double start = farthest_start(ray_);
  const double first_above = takes_one_ ? start + more_than_rounding * std::abs(start) : infinity;
  bool inside = leaf_crossings(leaf, ray_, object_ray, crossings, work_.leaf_escalations, first_above);
  // Another object's surface that coincides with the one the ray starts on is at the start as well.
  const bool starts_here = object_ray.start.face != no_face;
  std::size_t index = 0;
  for (; index < crossings.size(); ++index) {
    const Crossing& crossing = crossings[index];
    if (crossing.t > ray_.t_min && (starts_here || !is_at_start(leaf, ray_, object_ray, crossing))) break;
    inside = crossing.entering;
  }
  if (!begin(object_index, inside && object.solid)) return;
  for (; index < crossings.size() && crossings[index].t <= limit_; ++index) {
    const Crossing& crossing = crossings[index];
    inside = crossing.entering;
    const RayHit hit{.t = crossing.t,
                     .error = crossing.error,
                     .t_low = crossing.t_low,
                     .object = object_index,
                     .leaf = object.first_leaf,
                     .face = crossing.face,
                     .surface = accelerator_.face_surface(leaf, crossing.face).surface,
                     .root = crossing.root,
                     .entering = crossing.entering};
    if (!take(hit)) return;
  }
  end(object_index, object.first_leaf, inside && object.solid);
}

void Accelerator::Query::test_csg(std::uint32_t object_index, const SceneObject& object) {
  const CsgProgram& program = accelerator_.compiled_.programs[object.program];
  WorldRay csg_ray = ray_;
  csg_ray.t_max = std::nextafter(limit_, infinity);
  CsgEvaluation evaluation(program, accelerator_.compiled_.leaves, accelerator_.compiled_.face_surfaces,
                           csg_ray, work_.csg);
  bool inside = evaluation.starts_inside();
  std::uint32_t leaf = program.first_leaf;
  if (begin(object_index, inside)) {
    CsgHit found;
    while (evaluation.next(found)) {
      inside = found.entering;
      leaf = program.first_leaf + found.leaf;
      const RayHit hit{.t = found.t,
                       .error = found.error,
                       .t_low = found.t_low,
                       .object = object_index,
                       .leaf = leaf,
                       .face = found.face,
                       .surface = found.surface,
                       .root = found.root,
                       .entering = found.entering};
      if (!take(hit)) return;
    }
    end(object_index, leaf, inside);
  }
}

Accelerator::Accelerator(CompiledScene compiled)
    : compiled_(std::move(compiled)), objects_share_surfaces_(any_surface_is_shared(compiled_)) {
  Bounds total;
  for (std::uint32_t i = 0; i < compiled_.objects.size(); ++i) {
    const Bounds& bounds = compiled_.objects[i].bounds;
    if (bounds.finite()) {
      bounded_.push_back(i);
      total.include(bounds);
    } else {
      unbounded_.push_back(i);
    }
  }
  if (bounded_.empty()) return;
  std::vector<Bounds> boxes;
  boxes.reserve(bounded_.size());
  for (const std::uint32_t object : bounded_) boxes.push_back(compiled_.objects[object].bounds);
  tree_ = std::make_unique<EmbreeTree>(boxes, total);
}

Accelerator::~Accelerator() = default;

ObjectRay Accelerator::object_ray(std::uint32_t index, const WorldRay& ray) const {
  const Leaf& leaf = compiled_.leaves[index];
  ObjectRay result = leaf.placement->to_object(ray.origin, ray.direction);
  result.start = start_on_leaf(leaf, index, compiled_.face_surfaces, ray.start);
  return result;
}

SurfacePoint Accelerator::surface_point(const WorldRay& ray, const RayHit& hit) const {
  const Leaf& leaf = compiled_.leaves[hit.leaf];
  const Crossing crossing{.t = hit.t,
                          .error = hit.error,
                          .face = hit.face,
                          .root = 0,
                          .entering = hit.entering != leaf.complemented};
  return leaf.shape->surface_point(object_ray(hit.leaf, ray), crossing);
}

bool Accelerator::is_at_end(const WorldRay& ray, const RayHit& hit) const {
  if (!(ray.end_error > 0)) return false;
  const Vec3 normal = compiled_.leaves[hit.leaf].placement->normal_to_world(surface_point(ray, hit).normal);
  const double slope = std::abs(glm::dot(normal, ray.direction));
  return (ray.t_max - hit.t - hit.error) * slope <= ray.end_error;
}

void Accelerator::traverse(Query& query) const {
  for (const std::uint32_t object : unbounded_) {
    if (query.limit() <= query.ray().t_min) return;
    query.test(object);
  }
  if (!tree_ || query.limit() <= query.ray().t_min) return;
  tree_->traverse(query.ray().origin, query.ray().direction, query.ray().t_min, query.limit(),
                  [&](std::uint32_t box) {
                    query.test(bounded_[box]);
                    return query.limit();
                  });
}

RayHit Accelerator::nearest(const WorldRay& ray, RayWorkspace& work) const {
  class Nearest final : public Query {
   public:
    Nearest(const Accelerator& accelerator, const WorldRay& world_ray, RayWorkspace& workspace)
        : Query(accelerator, world_ray, workspace) {
      takes_one_ = true;
    }
    RayHit best;

   private:
    bool take(const RayHit& hit) override {
      if (!(hit.t < ray().t_max)) return false;
      if (std::tie(hit.t, hit.t_low, hit.object) < std::tie(best.t, best.t_low, best.object)) {
        const double reach = hit.t + company_width(ray(), hit);
        const bool has_company = best.t <= reach;
        best = hit;
        best.has_company = has_company;
        set_limit(reach);
      } else {
        best.has_company = true;
      }
      return false;
    }
  };
  Nearest query(*this, ray, work);
  traverse(query);
  return query.best.has_company ? gather_company(ray, query.best, work) : query.best;
}

RayHit Accelerator::gather_company(const WorldRay& ray, const RayHit& nearest, RayWorkspace& work) const {
  WorldRay piece = ray;
  piece.t_max = std::min(ray.t_max, std::nextafter(nearest.t + company_width(ray, nearest), infinity));
  std::vector<RayHit>& here = work.here;
  std::vector<RayHit>& near = work.near;
  here.clear();
  near.clear();
  all(piece, nullptr, near, work);
  std::sort(near.begin(), near.end(), [](const RayHit& a, const RayHit& b) {
    return std::tie(a.object, a.t, a.t_low) < std::tie(b.object, b.t, b.t_low);
  });
  const auto split = std::stable_partition(
      near.begin(), near.end(), [&](const RayHit& crossing) { return same_place(crossing, nearest); });
  here.assign(near.begin(), split);
  near.erase(near.begin(), split);
  if (here.empty()) return nearest;
  RayHit first = here.front();
  first.has_company = here.size() + near.size() > 1;
  return first;
}

bool Accelerator::any(const WorldRay& ray, RayWorkspace& work) const {
  class Any final : public Query {
   public:
    Any(const Accelerator& accelerator, const WorldRay& world_ray, RayWorkspace& workspace)
        : Query(accelerator, world_ray, workspace) {
      takes_one_ = true;
    }
    bool found = false;

   private:
    bool take(const RayHit& hit) override {
      if (is_on_way(hit)) {
        found = true;
        set_limit(-infinity);
      }
      return false;
    }
  };
  Any query(*this, ray, work);
  traverse(query);
  return query.found;
}

bool Accelerator::all(const WorldRay& ray, const std::vector<bool>* is_opaque, std::vector<RayHit>& out,
                      RayWorkspace& work) const {
  class All final : public Query {
   public:
    All(const Accelerator& accelerator, const WorldRay& world_ray, RayWorkspace& workspace,
        const std::vector<bool>* opaque, std::vector<RayHit>& hits)
        : Query(accelerator, world_ray, workspace),
          accelerator_(accelerator),
          is_opaque_(opaque),
          out_(hits) {}
    bool stopped = false;

   private:
    bool take(const RayHit& hit) override {
      if (!is_on_way(hit)) return false;
      if (is_opaque_ != nullptr && (*is_opaque_)[accelerator_.leaf(hit.leaf).material]) {
        stopped = true;
        set_limit(-infinity);
        return false;
      }
      out_.push_back(hit);
      return true;
    }

    const Accelerator& accelerator_;
    const std::vector<bool>* is_opaque_;
    std::vector<RayHit>& out_;
  };
  All query(*this, ray, work, is_opaque, out);
  traverse(query);
  return !query.stopped;
}

Stay Accelerator::stay(const WorldRay& ray, std::uint32_t object, RayWorkspace& work) const {
  class Stayed final : public Query {
   public:
    using Query::Query;
    Stay result;

   private:
    bool begin(std::uint32_t /*object*/, bool starts_inside) override {
      result.inside = starts_inside;
      return starts_inside;
    }
    bool take(const RayHit& hit) override {
      result.exit = hit;
      return false;
    }
  };
  Stayed query(*this, ray, work);
  query.test(object);
  return query.result;
}

void Accelerator::surrounding(const WorldRay& ray, std::vector<RayHit>& out, RayWorkspace& work) const {
  class Surrounding final : public Query {
   public:
    Surrounding(const Accelerator& accelerator, const WorldRay& world_ray, RayWorkspace& workspace,
                std::vector<RayHit>& hits)
        : Query(accelerator, world_ray, workspace), out_(hits) {}

   private:
    bool begin(std::uint32_t /*object*/, bool starts_inside) override { return starts_inside; }
    bool take(const RayHit& hit) override {
      out_.push_back(hit);
      return false;
    }
    void end(std::uint32_t object, std::uint32_t leaf, bool inside) override {
      if (inside)
        out_.push_back({.t = infinity, .error = 0, .object = object, .leaf = leaf, .face = no_face});
    }

    std::vector<RayHit>& out_;
  };
  Surrounding query(*this, ray, work, out);
  traverse(query);
}

}  // namespace crt::core
