"""The module that knows PNG alone, which wheels fall back to, agrees with the one that has
OpenImageIO."""

import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy as np

import crt

LIBRARY = pathlib.Path(os.environ["CRT_LIBRARY"])
MODULE = LIBRARY.parent / "crt_png/crt_image_files.so"
GREY, RGB, PALETTE, GREY_ALPHA, RGBA = 0, 2, 3, 4, 6
CHANNELS = {GREY: 1, RGB: 3, PALETTE: 1, GREY_ALPHA: 2, RGBA: 4}

# Reads each file that is named, and writes what it is to standard output; or what is wrong.
READER = """
import sys, numpy as np, crt
for name in sys.argv[1:]:
    try:
        print(crt.Image.read(name).pixels.tobytes().hex())
    except crt.Error as error:
        print(error.status.name, error)
"""


def chunk(name: bytes, content: bytes) -> bytes:
    body = name + content
    return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))


def rows(samples: np.ndarray, depth: int) -> bytes:
    """Returns rows of samples as PNG has them, without filters."""
    if depth == 16:
        packed = samples.astype(">u2").view(np.uint8).reshape(len(samples), -1)
    elif depth == 8:
        packed = samples.astype(np.uint8).reshape(len(samples), -1)
    else:
        bits = (samples[..., None] >> np.arange(depth - 1, -1, -1)) & 1
        packed = np.packbits(bits.reshape(len(samples), -1).astype(np.uint8), axis=1)
    return b"".join(b"\0" + row.tobytes() for row in packed)


def png(samples: np.ndarray, color: int, depth: int, interlaced: bool = False, *others) -> bytes:
    height, width = samples.shape[:2]
    header = struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, interlaced)
    passes = [(0, 0, 1, 1)]
    if interlaced:  # row, column, and steps of Adam7
        passes = [
            (0, 0, 8, 8), (0, 4, 8, 8), (4, 0, 8, 4), (0, 2, 4, 4), (2, 0, 4, 2), (0, 1, 2, 2),
            (1, 0, 2, 1),
        ]  # fmt: skip
    parts = [samples[y::down, x::right] for y, x, down, right in passes]
    content = b"".join(rows(part, depth) for part in parts if part.size)
    chunks = [chunk(b"IHDR", header), *others, chunk(b"IDAT", zlib.compress(content))]
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunks) + chunk(b"IEND", b"")


def samples_of(color: int, depth: int) -> np.ndarray:
    random = np.random.default_rng(color * 100 + depth)
    shape = (11, 13) if CHANNELS[color] == 1 else (11, 13, CHANNELS[color])
    return random.integers(0, 2**depth, shape)


@unittest.skipUnless(MODULE.exists(), "the module was not built (Debian: libpng-dev)")
class Png(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        (cls.folder / "crt").mkdir()
        shutil.copy(LIBRARY, cls.folder / "libcrt.so.1")
        shutil.copy(MODULE, cls.folder / "crt")

    def by_png_alone(self, program: str, *arguments: object) -> list[str]:
        done = subprocess.run(
            [sys.executable, "-c", program, *map(str, arguments)],
            env={**os.environ, "CRT_LIBRARY": str(self.folder / "libcrt.so.1")},
            capture_output=True,
            text=True,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout.splitlines()

    def test_both_read_the_same(self):
        palette = chunk(b"PLTE", np.random.default_rng(1).bytes(3 * 256))
        few = chunk(b"PLTE", np.random.default_rng(2).bytes(3 * 16))
        clear = chunk(b"tRNS", bytes(range(0, 256, 17)))
        files = {
            f"{color}-{depth}-{interlaced}.png": png(
                samples_of(color, depth), color, depth, interlaced
            )
            for color, depths in ((GREY, (1, 2, 4, 8, 16)), (RGB, (8, 16)), (RGBA, (8, 16)))
            for depth in depths
            for interlaced in (False, True)
        }
        files["grey-alpha.png"] = png(samples_of(GREY_ALPHA, 8), GREY_ALPHA, 8)
        files["palette.png"] = png(samples_of(PALETTE, 8), PALETTE, 8, False, palette)
        files["clear.png"] = png(samples_of(PALETTE, 4), PALETTE, 4, True, few, clear)
        for name, content in files.items():
            (self.folder / name).write_bytes(content)
        found = self.by_png_alone(READER, *(self.folder / name for name in files))
        self.assertEqual(len(found), 21)
        for name, line in zip(files, found):
            pixels = np.frombuffer(bytes.fromhex(line), np.float32).reshape(11, 13, 4)
            expected = crt.Image.read(self.folder / name).pixels
            np.testing.assert_array_equal(pixels, expected, err_msg=name)

    def test_what_it_writes_is_what_the_other_reads(self):
        pixels = np.random.default_rng(3).integers(0, 256, (9, 7, 4), np.uint8)
        opaque = pixels.copy()
        opaque[..., 3] = 255
        program = (
            "import sys, numpy as np, crt\n"
            "image = crt.Image.from_rgba8(np.load(sys.argv[1]))\n"
            "settings = crt.Settings(title='Größe', author='A. Uthor', notes='n' * 5000)\n"
            "image.with_settings(settings).save(sys.argv[2])\n"
        )
        for array in (pixels, opaque):
            np.save(self.folder / "pixels.npy", array)
            written = self.folder / "written.png"
            self.by_png_alone(program, self.folder / "pixels.npy", written)
            ours = crt.Image.from_rgba8(array)
            np.testing.assert_array_equal(crt.Image.read(written).to_rgba8(), ours.to_rgba8())
            content = written.read_bytes()
            for text in (b"iTXtTitle\0\0\0\0\0Gr\xc3\xb6", b"tEXtAuthor\0A. Uthor"):
                self.assertIn(text, content)

    def test_broken_files_and_other_formats_are_errors(self):
        whole = png(samples_of(RGB, 8), RGB, 8)
        tall = png(np.zeros((1, 1, 3), int), RGB, 8).replace(
            chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, RGB, 0, 0, 0)),
            chunk(b"IHDR", struct.pack(">IIBBBBB", 2**20, 2**20, 8, RGB, 0, 0, 0)),
        )
        damaged = bytearray(whole)
        damaged[whole.index(b"IDAT") + 10] ^= 0xFF
        contents = {
            "cut.png": whole[: len(whole) // 2],
            "damaged.png": bytes(damaged),
            "tall.png": tall,
            "other.bmp": crt.Image.from_pixels(np.zeros((2, 2, 4), np.float32)).encode("bmp"),
            "interlaced.png": whole.replace(
                chunk(b"IHDR", struct.pack(">IIBBBBB", 13, 11, 8, RGB, 0, 0, 0)),
                chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 2**25, 8, RGB, 0, 0, 1)),
            ),
            "rows.png": png(np.zeros((1, 1, 3), int), RGB, 8).replace(
                chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, RGB, 0, 0, 0)),
                chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 9, 8, RGB, 0, 0, 0)),
            ),
        }
        for name, content in contents.items():
            (self.folder / name).write_bytes(content)
        found = self.by_png_alone(READER, *(self.folder / name for name in contents))
        statuses = [line.split(" ")[0] for line in found]
        self.assertEqual(statuses, ["IO", "IO", "IO", "UNSUPPORTED", "IO", "IO"], found)
        self.assertIn("pixels; the limit is", found[2])
        self.assertIn("PNG files alone; those of bmp need OpenImageIO", found[3])
