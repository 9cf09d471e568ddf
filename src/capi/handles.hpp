// Each handle of the C interface is a value of the C++ interface and a count of references.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "crt/crt.h"
#include "crt/entity.hpp"
#include "crt/image.hpp"
#include "crt/job.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/primitives.hpp"
#include "crt/scene.hpp"
#include "crt/script.hpp"
#include "crt/section.hpp"
#include "crt/surface_mesh.hpp"

namespace crt::capi {

struct Counted {
  std::atomic<std::uint32_t> references{1};
};

template <class Handle>
Handle* retain(Handle* handle) noexcept {
  if (handle != nullptr) handle->references.fetch_add(1, std::memory_order_relaxed);
  return handle;
}

template <class Handle>
void release(Handle* handle) noexcept {
  if (handle != nullptr && handle->references.fetch_sub(1, std::memory_order_acq_rel) == 1)
    delete handle;
}

struct Release {
  template <class Handle>
  void operator()(Handle* handle) const noexcept {
    release(handle);
  }
};

/// A Held is a reference that the library holds itself.
template <class Handle>
using Reference = std::unique_ptr<Handle, Release>;

/// Holds the number with which a progress callback stopped a render. Any thread may call the
/// callback.
using CancelValue = std::shared_ptr<std::atomic<int>>;

}  // namespace crt::capi

struct crt_entity : crt::capi::Counted {
  explicit crt_entity(crt::Entity new_value) : value(std::move(new_value)) {}
  crt::Entity value;
};

struct crt_image : crt::capi::Counted {
  explicit crt_image(std::shared_ptr<const crt::Image> new_value) : value(std::move(new_value)) {}
  explicit crt_image(crt::Image image)
      : value(std::make_shared<const crt::Image>(std::move(image))) {}
  std::shared_ptr<const crt::Image> value;
};

struct crt_scene : crt::capi::Counted {
  crt::Scene value;
  /// Points to what was prepared last, so that parts of it can be used again while a handle still
  /// exists.
  std::weak_ptr<const crt::core::PreparedData> prepared;
  /// Holds the handle that crt_scene_get_background() has lent of the background's picture.
  mutable crt::capi::Reference<crt_image> lent_background;
};

struct crt_prepared : crt::capi::Counted {
  explicit crt_prepared(crt::PreparedScene new_value) : value(std::move(new_value)) {}
  crt::PreparedScene value;
};

struct crt_job : crt::capi::Counted {
  crt_job(crt::RenderJob new_value, crt::capi::CancelValue new_cancel_value)
      : value(std::move(new_value)), cancel_value(std::move(new_cancel_value)) {}
  crt::RenderJob value;
  crt::capi::CancelValue cancel_value;
};

struct crt_buffer : crt::capi::Counted {
  explicit crt_buffer(std::vector<std::byte> new_bytes) : bytes(std::move(new_bytes)) {}
  std::vector<std::byte> bytes;
};

struct crt_diagnostics : crt::capi::Counted {
  explicit crt_diagnostics(std::vector<crt::Diagnostic> new_list);
  std::vector<crt::Diagnostic> list;
  std::string text;
  std::string json;
};

struct crt_profile : crt::capi::Counted {
  std::vector<crt::Contour> contours;
  bool is_drawn = false;  ///< whether pieces can be added to the last contour
};

struct crt_section : crt::capi::Counted {
  crt::Section value;
  std::vector<std::size_t> first;  ///< point of each contour, and how many points there are
  std::vector<double> points;
};

struct crt_surface_mesh : crt::capi::Counted {
  explicit crt_surface_mesh(crt::SurfaceMesh new_value) : value(std::move(new_value)) {}
  crt::SurfaceMesh value;
};

struct crt_file_content {
  std::vector<std::byte> bytes;
};
