"""This module loads libcrt, and declares the functions of crt.h that this package calls.

The environment variable CRT_LIBRARY may name the file; otherwise the system's loader is asked for
libcrt.so.1. A function that returns a status raises crt.Error instead. Calls give up Python's lock,
so other threads go on.
"""

import ctypes
import ctypes.util
import os
from typing import Any

from .errors import Error, Status

ABI = 1


class _Text:
    """A _Text is an argument that is a str and arrives as UTF-8 ended by 0."""

    @classmethod
    def from_param(cls, text: str) -> ctypes.c_char_p:
        return ctypes.c_char_p(to_utf8(text))


def to_utf8(text: str | os.PathLike[str]) -> bytes:
    text = os.fspath(text)
    if "\0" in text:
        raise ValueError("a text for CRT must not contain the character 0")
    return os.fsencode(text)


# What stands for a type in the tables below; pointers of all kinds are p.
_TYPES = {
    "p": ctypes.c_void_p,
    "s": _Text,
    "d": ctypes.c_double,
    "z": ctypes.c_size_t,
    "i": ctypes.c_int32,
    "u": ctypes.c_uint32,
    "l": ctypes.c_uint64,
    "t": ctypes.c_char_p,
    "-": None,
}

# Functions that return a status: their parameters.
STATUS_FUNCTIONS = {
    "crt_pattern_init": "pz",
    "crt_pattern_init_type": "pzi",
    "crt_material_init": "pz",
    "crt_light_init": "pz",
    "crt_light_init_type": "pzi",
    "crt_camera_init": "pz",
    "crt_background_init": "pz",
    "crt_settings_init": "pz",
    "crt_script_options_init": "pz",
    "crt_render_options_init": "pz",
    "crt_write_options_init": "pz",
    "crt_sphere_create": "pdp",
    "crt_box_create": "ppp",
    "crt_plane_create": "ppp",
    "crt_half_plane_create": "pppp",
    "crt_cylinder_create": "ppdp",
    "crt_cone_create": "ppddp",
    "crt_torus_create": "ppddp",
    "crt_disc_create": "ppdp",
    "crt_triangle_create": "pppp",
    "crt_mesh_create": "pzpzp",
    "crt_empty_create": "p",
    "crt_union_create": "pzp",
    "crt_intersection_create": "pzp",
    "crt_difference_create": "ppzp",
    "crt_entity_with_transform": "ppp",
    "crt_entity_with_material": "ppp",
    "crt_entity_with_id": "pup",
    "crt_scene_create": "p",
    "crt_scene_copy": "pp",
    "crt_scene_add_entity": "pp",
    "crt_scene_add_light": "pp",
    "crt_scene_set_camera": "pp",
    "crt_scene_set_background": "pp",
    "crt_scene_set_settings": "pp",
    "crt_scene_get_entity": "pzp",
    "crt_scene_get_light": "pzp",
    "crt_scene_get_camera": "pp",
    "crt_scene_get_background": "pp",
    "crt_scene_get_settings": "pp",
    "crt_scene_prepare_with": "ppp",
    "crt_scene_from_script": "pzsppp",
    "crt_scene_from_script_file": "sppp",
    "crt_file_content_append": "ppz",
    "crt_diagnostics_get": "pzp",
    "crt_diagnostics_get_call": "pzzp",
    "crt_render": "ppp",
    "crt_render_start": "ppp",
    "crt_job_progress": "pp",
    "crt_job_snapshot": "pp",
    "crt_job_cancel": "p",
    "crt_job_wait": "pp",
    "crt_image_create": "uupzp",
    "crt_image_from_rgba8": "uupzp",
    "crt_image_read": "sp",
    "crt_image_decode": "pzpp",
    "crt_image_to_rgba8": "ppz",
    "crt_image_write_with": "psp",
    "crt_image_encode": "pspp",
    "crt_image_stats": "pp",
    "crt_image_settings": "pp",
    "crt_image_with_settings": "ppp",
    "crt_intersect": "ppzzpz",
    "crt_distances": "ppzzpp",
    "crt_occluded": "ppzzp",
    "crt_crossings": "pppzp",
}

# The others: what they return, and their parameters.
PLAIN_FUNCTIONS = {
    "crt_version": "u",
    "crt_error_message": "t",
    "crt_entity_release": "-p",
    "crt_scene_release": "-p",
    "crt_prepared_release": "-p",
    "crt_job_release": "-p",
    "crt_job_is_finished": "ip",
    "crt_image_retain": "pp",
    "crt_image_release": "-p",
    "crt_buffer_release": "-p",
    "crt_diagnostics_release": "-p",
    "crt_entity_is_solid": "ip",
    "crt_entity_primitive_count": "lp",
    "crt_scene_entity_count": "zp",
    "crt_scene_light_count": "zp",
    "crt_diagnostics_count": "zp",
    "crt_diagnostics_text": "tp",
    "crt_image_not_finite": "lppp",
    "crt_image_width": "up",
    "crt_image_height": "up",
    "crt_image_pixels": "ppp",
    "crt_image_channel_count": "zp",
    "crt_image_channel_name": "tpz",
    "crt_image_channel": "ppt",
    "crt_image_channel_uint": "ppt",
    "crt_buffer_data": "pp",
    "crt_buffer_size": "zp",
}


def _find() -> str:
    return os.environ.get("CRT_LIBRARY") or ctypes.util.find_library("crt") or f"libcrt.so.{ABI}"


def _load() -> ctypes.CDLL:
    path = _find()
    try:
        loaded = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(
            f"CRT's library cannot be loaded ({error}); CRT_LIBRARY may name its file"
        ) from error
    for name, parameters in STATUS_FUNCTIONS.items():
        function = getattr(loaded, name)
        function.restype = ctypes.c_int
        function.argtypes = [_TYPES[letter] for letter in parameters]
        function.errcheck = _raise_error
    for name, letters in PLAIN_FUNCTIONS.items():
        function = getattr(loaded, name)
        function.restype = _TYPES[letters[0]]
        function.argtypes = [_TYPES[letter] for letter in letters[1:]]
    return loaded


def _raise_error(status: int, _function: Any, _arguments: Any) -> None:
    if status != Status.OK:
        raise Error(Status(status), library.crt_error_message().decode())


library = _load()


def create(name: str, *arguments: Any) -> int:
    """Calls a function whose last parameter gets a handle, which is returned."""
    handle = ctypes.c_void_p()
    getattr(library, name)(*arguments, ctypes.byref(handle))
    assert handle.value is not None
    return handle.value


def version() -> tuple[int, int, int]:
    """Returns the library's version."""
    number = library.crt_version()
    return number >> 16, number >> 8 & 0xFF, number & 0xFF
