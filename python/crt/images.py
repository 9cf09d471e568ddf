"""This module has the pictures."""

import ctypes
import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arguments
from ._handles import Handle, Reference
from ._library import create, library
from ._structs import Struct, growable, reference
from .errors import Error, Status, of_reading
from .values import RenderStats, Settings


@growable("crt_write_options")
class _WriteOptions(Struct):
    """_WriteOptions say how to write a file."""


class Image(Handle):
    """An Image is a picture: linear RGBA floats, alpha premultiplied, rows from the top. It is
    immutable. np.asarray(image) is its pixels, and notebooks show it."""

    _name = "crt_image"
    _instead_of_pickle = "pickle its pixels, or its encode('exr')"

    @classmethod
    def from_pixels(cls, pixels: NDArray[np.float32]) -> "Image":
        """Makes a copy of height x width x 4 float32. There may be gaps between the rows."""
        return cls._of_array("crt_image_create", pixels, np.dtype(np.float32))

    @classmethod
    def from_rgba8(cls, pixels: NDArray[np.uint8]) -> "Image":
        """Makes a copy of height x width x 4 uint8 as displays want them: exposure, tone map and
        gamma applied, alpha straight."""
        return cls._of_array("crt_image_from_rgba8", pixels, np.dtype(np.uint8))

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> "Image":
        """Reads an image file. Its content decides which format it has. One that is not there
        raises crt.MissingFileError, which is a FileNotFoundError."""
        where = _arguments.text(path, "Image.read: path")
        try:
            return cls._adopt(create("crt_image_read", where))
        except Error as error:
            if error.status != Status.IO:
                raise
            raise of_reading(str(error), where) from None

    @classmethod
    def decode(cls, content: bytes, name: str = "image") -> "Image":
        """Reads an image from a file's bytes. The name is for messages."""
        if not isinstance(content, (bytes, bytearray, memoryview)):
            raise _arguments.refusal("Image.decode: content", "bytes", content)
        given = bytes(content)
        return cls._adopt(create("crt_image_decode", given, len(given), name))

    @classmethod
    def _of_array(cls, function: str, pixels: NDArray[Any], dtype: np.dtype[Any]) -> "Image":
        if not isinstance(pixels, np.ndarray):
            raise _arguments.refusal("pixels", "a NumPy array", pixels)
        if pixels.dtype != dtype or pixels.ndim != 3 or pixels.shape[2] != 4:
            raise TypeError(
                f"pixels are height x width x 4 {dtype}, not {pixels.shape} {pixels.dtype}"
            )
        height, width, channels = pixels.shape
        row_bytes = width * channels * dtype.itemsize
        steps = (channels * dtype.itemsize, dtype.itemsize)
        if pixels.strides[1:] != steps or pixels.strides[0] < row_bytes:
            raise TypeError(
                "pixels of a row must follow one another, and rows must not overlap or run"
                " backwards"
            )
        return cls._adopt(create(function, width, height, pixels.ctypes.data, pixels.strides[0]))

    @property
    def not_finite(self) -> tuple[int, int, int]:
        """Returns how many pixels of the file had values that are not finite (they count as 0), and
        the column and row of the first; (0, 0, 0) if there are none."""
        x, y = ctypes.c_uint32(), ctypes.c_uint32()
        pixels = library.crt_image_not_finite(self._handle, ctypes.byref(x), ctypes.byref(y))
        return int(pixels), x.value, y.value

    @property
    def width(self) -> int:
        """Returns the number of pixels across."""
        return int(library.crt_image_width(self._handle))

    @property
    def height(self) -> int:
        """Returns the number of pixels down."""
        return int(library.crt_image_height(self._handle))

    @property
    def pixels(self) -> NDArray[np.float32]:
        """Returns height x width x 4 float32, read-only: the library's own memory, which the array
        keeps."""
        return np.asarray(_LentArray.of_pixels(self._handle))

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        """Returns the pixels for NumPy: those of the library, unless a copy is asked for."""
        pixels = self.pixels
        wanted = pixels.dtype if dtype is None else np.dtype(dtype)
        if wanted == pixels.dtype and not copy:
            return pixels
        if copy is False:
            raise ValueError(f"the pixels are {pixels.dtype}: {wanted} needs a copy")
        return np.array(pixels, wanted)

    def _summary(self) -> str:
        others = ", ".join(self.channels)
        return f"{self.width} x {self.height} pixels" + (f", and {others}" if others else "")

    @property
    def channels(self) -> dict[str, NDArray[Any]]:
        """Returns what there is beside the colours (see Prepared.render), by name: height x width
        float32, or uint32 for "id", "part" and "samples". They are read-only: the library's own
        memory, which the arrays keep."""
        reference = self._handle
        count = library.crt_image_channel_count(reference)
        names = [library.crt_image_channel_name(reference, index) for index in range(count)]
        return {name.decode(): np.asarray(_LentArray.of_channel(reference, name)) for name in names}

    def to_rgba8(self) -> NDArray[np.uint8]:
        """Returns height x width x 4 uint8, as a file gets them: exposure, tone map and gamma
        applied, alpha straight."""
        reference = self._handle
        shape = library.crt_image_height(reference), library.crt_image_width(reference), 4
        pixels = np.empty(shape, np.uint8)
        library.crt_image_to_rgba8(reference, pixels.ctypes.data, pixels.strides[0])
        return pixels

    def save(
        self, path: str | os.PathLike[str], *, reproducible: bool = False, colors_only: bool = False
    ) -> None:
        """Writes a file whose ending decides the format. `reproducible` leaves out how long the
        render took, `colors_only` the channels beside the colours, which only .exr files hold."""
        options = _WriteOptions(reproducible=reproducible, colors_only=colors_only)
        where = _arguments.text(path, "save: path")
        library.crt_image_write_with(self._handle, where, ctypes.byref(options))

    def encode(
        self, format: str, *, reproducible: bool = False, colors_only: bool = False
    ) -> bytes:
        """Returns the bytes of a file of this format: "png", "exr", ...; otherwise as save()."""
        options = _WriteOptions(reproducible=reproducible, colors_only=colors_only)
        ending = _arguments.text(format, "encode: format")
        handle = create("crt_image_encode", self._handle, ending, ctypes.byref(options))
        buffer = Reference(handle, library.crt_buffer_release)
        return ctypes.string_at(library.crt_buffer_data(buffer), library.crt_buffer_size(buffer))

    def _repr_png_(self) -> bytes:
        """Shows the image in notebooks."""
        return self.encode("png", colors_only=True)

    @property
    def stats(self) -> RenderStats:
        """Returns what rendering it took."""
        stats = RenderStats._filled_by("crt_image_stats", self._handle)
        return stats._freeze("those of an image never change")

    @property
    def settings(self) -> Settings:
        """Returns the settings that it was rendered with. To change them, copy.copy() them for
        with_settings()."""
        settings = Settings._filled_by("crt_image_settings", self._handle)
        return settings._freeze(
            "those of an image never change: change a copy.copy() of them, and take"
            " image.with_settings()"
        )

    def with_settings(self, settings: Settings) -> "Image":
        """Returns the same pixels with another gamma, other texts, ..."""
        return Image._adopt(
            create(
                "crt_image_with_settings",
                self._handle,
                reference(settings, "crt_settings", "with_settings: settings"),
            )
        )


class _LentArray:
    """NumPy makes an array of a _LentArray. The array keeps it, and it keeps the image."""

    def __init__(
        self,
        reference: Reference,
        address: int,
        kind: type,
        shape: tuple[int, ...],
        strides: tuple[int, ...],
    ) -> None:
        self._reference = reference
        self.__array_interface__: dict[str, Any] = {
            "version": 3,
            "typestr": np.dtype(kind).str,
            "shape": shape,
            "strides": strides,
            "data": (address, True),  # read-only
        }

    @classmethod
    def of_pixels(cls, reference: Reference) -> "_LentArray":
        row_stride = ctypes.c_size_t()
        address = library.crt_image_pixels(reference, ctypes.byref(row_stride))
        shape = library.crt_image_height(reference), library.crt_image_width(reference), 4
        return cls(reference, address, np.float32, shape, (row_stride.value, 16, 4))

    @classmethod
    def of_channel(cls, reference: Reference, name: bytes) -> "_LentArray":
        floats = library.crt_image_channel(reference, name)
        address = floats or library.crt_image_channel_uint(reference, name)
        height, width = library.crt_image_height(reference), library.crt_image_width(reference)
        return cls(
            reference, address, np.float32 if floats else np.uint32, (height, width), (4 * width, 4)
        )
