"""The declarations of the package are those of crt.h."""

import ctypes
import re
import unittest

from support import SOURCE

import crt
from crt import _library, _structs, diagnostics, images, rendering, scenes, values

HEADER = re.sub(r"/\*.*?\*/", "", (SOURCE / "include/crt/crt.h").read_text(), flags=re.DOTALL)


def letter_of(declaration: str) -> str:
    """Returns what stands for a C type in _library's tables."""
    if "*" in declaration or "_fn " in declaration:
        return "p"
    words = declaration.replace("const", "").split()
    letters = {
        "double": "d",
        "size_t": "z",
        "int32_t": "i",
        "uint32_t": "u",
        "uint64_t": "l",
        "void": "-",
    }
    return "p" if declaration.endswith("]") else letters[words[0]]


def functions() -> dict[str, tuple[str, list[str]]]:
    """Returns what each function of crt.h returns and its parameters, as declared."""
    found = re.findall(r"CRT_API (\w[\w ]*?\*?) ?(crt_\w+)\(([^)]*)\);", HEADER)
    return {
        name: (
            result,
            [] if parameters == "void" else [" ".join(p.split()) for p in parameters.split(",")],
        )
        for result, name, parameters in found
    }


class Functions(unittest.TestCase):
    def test_those_that_are_declared_have_the_parameters_of_the_header(self):
        known = functions()
        self.assertGreater(len(known), 80)
        for name, letters in _library.STATUS_FUNCTIONS.items():
            result, parameters = known[name]
            self.assertEqual(result, "crt_status", name)
            self.assertEqual(letters.replace("s", "p"), "".join(map(letter_of, parameters)), name)
        for name, letters in _library.PLAIN_FUNCTIONS.items():
            result, parameters = known[name]
            self.assertNotEqual(result, "crt_status", name)
            self.assertEqual(
                letters.replace("t", "p"), "".join(map(letter_of, [result, *parameters])), name
            )

    def test_the_library_is_the_one_that_the_header_is_of(self):
        major, minor, patch = (
            re.search(rf"CRT_VERSION_{part} (\d+)", HEADER)[1]
            for part in ("MAJOR", "MINOR", "PATCH")
        )
        self.assertEqual(crt.version(), (int(major), int(minor), int(patch)))


class Structs(unittest.TestCase):
    KINDS = {
        "int32_t": ctypes.c_int32,
        "uint32_t": ctypes.c_uint32,
        "uint64_t": ctypes.c_uint64,
        "double": ctypes.c_double,
    }

    def kind_of(self, declaration: str):
        if declaration.startswith("const char* ") and "const*" not in declaration:
            return ctypes.c_char_p
        if "*" in declaration:
            return ctypes.c_void_p
        if declaration.startswith("crt_"):
            return ctypes._CFuncPtr
        kind = self.KINDS[declaration.split()[0]]
        return kind * 3 if declaration.endswith("[3]") else kind

    def fields_of(self, struct: str):
        body = re.search(rf"typedef struct {struct} \{{(.*?)\}} {struct};", HEADER, re.DOTALL)[1]
        for line in body.split(";"):
            declaration = " ".join(line.split())
            if declaration:
                yield re.search(r"(\w+)(\[\d\])?$", declaration)[1], declaration

    def test_their_fields_are_those_of_the_header_in_its_order(self):
        modules = diagnostics, images, rendering, scenes, values
        structs = {
            thing
            for module in modules
            for thing in vars(module).values()
            if isinstance(thing, type)
            and issubclass(thing, _structs.Struct)
            and thing is not _structs.Struct
        }
        self.assertEqual(len(structs), 13)
        for struct in structs:
            (first, _), *fields = self.fields_of(struct._name)
            self.assertEqual(first, "struct_size")
            self.assertEqual([name for name, _ in fields], list(struct._kinds), struct._name)
            for name, declaration in fields:
                kind = self.kind_of(declaration)
                ours = struct._kinds[name]
                self.assertTrue(ours is kind or issubclass(ours, kind), f"{struct._name}.{name}")

    def test_enumerations_have_the_numbers_of_the_header(self):
        pairs = {
            "crt_status": crt.Status,
            "crt_pattern_type": crt.PatternType,
            "crt_light_type": crt.LightType,
            "crt_projection": crt.Projection,
            "crt_aperture_shape": crt.ApertureShape,
            "crt_background_type": crt.BackgroundType,
        }
        for name, ours in pairs.items():
            body = re.search(rf"typedef enum {name} \{{(.*?)\}} {name};", HEADER, re.DOTALL)[1]
            names = re.findall(r"CRT_(\w+)", body)
            for number, theirs in enumerate(names):
                self.assertTrue(theirs.endswith(ours(number).name), f"{theirs} is {ours(number)!r}")
            self.assertEqual(len(names), sum(member >= 0 for member in ours))

    def test_aovs_have_the_bits_of_the_header(self):
        bits = {
            name.lower(): int(bit) for name, bit in re.findall(r"CRT_AOV_(\w+)\s*=\s*(\d+)", HEADER)
        }
        self.assertEqual(rendering._AOV_BITS, bits)

    def test_rays_and_hits_have_the_frozen_layout(self):
        self.assertEqual((crt.RAY.itemsize, crt.HIT.itemsize), (64, 56))
        self.assertEqual(
            [crt.RAY.fields[name][1] for name in ("origin", "direction", "t_min", "t_max")],
            [0, 24, 48, 56],
        )
        self.assertEqual(
            [crt.HIT.fields[name][1] for name in ("t", "normal", "u", "v", "entity_id", "flags")],
            [0, 8, 32, 40, 48, 52],
        )
