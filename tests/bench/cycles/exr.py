"""Reads pictures of floats as both programs write them: OpenEXR by scan lines, in ZIP or plain."""

import pathlib
import struct
import zlib

import numpy as np

MAGIC, FLOAT = 20000630, 2
LINES_OF_A_BLOCK = {0: 1, 2: 1, 3: 16}  # by the kind of compression: none, each line, 16 lines


def header(data: bytes) -> tuple[dict[str, bytes], int]:
    """Returns the attributes and where they end."""
    if struct.unpack_from("<I", data)[0] != MAGIC:
        raise ValueError("this is no OpenEXR file")
    attributes, place = {}, 8
    while data[place] != 0:
        name, kind, _ = data[place:place + 512].split(b"\0", 2)
        place += len(name) + len(kind) + 2
        size = struct.unpack_from("<I", data, place)[0]
        attributes[name.decode()] = data[place + 4:place + 4 + size]
        place += 4 + size
    return attributes, place + 1


def channel_names(listed: bytes) -> list[str]:
    """Returns the names in the order of the file. All channels must be floats."""
    names = []
    while listed[0] != 0:
        name, rest = listed.split(b"\0", 1)
        if struct.unpack_from("<I", rest)[0] != FLOAT:
            raise ValueError(f"channel {name.decode()} is not of floats")
        names.append(name.decode())
        listed = rest[16:]
    return names


def unpacked(block: bytes, size: int) -> bytes:
    """Undoes ZIP: bytes are stored as differences, those at even places first."""
    if len(block) == size:
        return block
    steps = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64) - 128
    steps[0] += 128
    in_halves = np.cumsum(steps).astype(np.uint8)
    result = np.empty(size, np.uint8)
    result[0::2], result[1::2] = np.split(in_halves, [(size + 1) // 2])
    return result.tobytes()


def read(path: pathlib.Path) -> np.ndarray:
    """Returns height x width x 3 doubles."""
    data = path.read_bytes()
    attributes, place = header(data)
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    names, width, height = channel_names(attributes["channels"]), x1 - x0 + 1, y1 - y0 + 1
    lines = LINES_OF_A_BLOCK[attributes["compression"][0]]
    picture = np.empty((height, len(names), width), np.float32)
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, place):
        first, size = struct.unpack_from("<iI", data, offset)
        rows = picture[first - y0:first - y0 + lines]
        block = unpacked(data[offset + 8:offset + 8 + size], rows.nbytes)
        rows[:] = np.frombuffer(block, "<f4").reshape(rows.shape)
    return picture[:, [names.index(name) for name in "RGB"]].transpose(0, 2, 1).astype(float)
