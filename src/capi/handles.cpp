// This file implements retaining and releasing.
#include "capi/handles.hpp"

using crt::capi::release;
using crt::capi::retain;

crt_entity* crt_entity_retain(crt_entity* entity) {
  return retain(entity);
}
void crt_entity_release(crt_entity* entity) {
  release(entity);
}

crt_scene* crt_scene_retain(crt_scene* scene) {
  return retain(scene);
}
void crt_scene_release(crt_scene* scene) {
  release(scene);
}

crt_prepared* crt_prepared_retain(crt_prepared* prepared) {
  return retain(prepared);
}
void crt_prepared_release(crt_prepared* prepared) {
  release(prepared);
}

crt_job* crt_job_retain(crt_job* job) {
  return retain(job);
}
void crt_job_release(crt_job* job) {
  release(job);
}

crt_image* crt_image_retain(crt_image* image) {
  return retain(image);
}
void crt_image_release(crt_image* image) {
  release(image);
}

crt_buffer* crt_buffer_retain(crt_buffer* buffer) {
  return retain(buffer);
}
void crt_buffer_release(crt_buffer* buffer) {
  release(buffer);
}

crt_diagnostics* crt_diagnostics_retain(crt_diagnostics* diagnostics) {
  return retain(diagnostics);
}
void crt_diagnostics_release(crt_diagnostics* diagnostics) {
  release(diagnostics);
}

crt_profile* crt_profile_retain(crt_profile* profile) {
  return retain(profile);
}
void crt_profile_release(crt_profile* profile) {
  release(profile);
}

crt_section* crt_section_retain(crt_section* section) {
  return retain(section);
}
void crt_section_release(crt_section* section) {
  release(section);
}

crt_surface_mesh* crt_surface_mesh_retain(crt_surface_mesh* mesh) {
  return retain(mesh);
}
void crt_surface_mesh_release(crt_surface_mesh* mesh) {
  release(mesh);
}
