"""The declarations of the package are those of crt.h."""

import ctypes
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from support import SOURCE

import crt
from crt import _library, _structs, diagnostics, farm, images, options, scenes, scripts, values
from crt._fields import FIELDS
from crt._functions import FUNCTIONS

HEADER = re.sub(r"/\*.*?\*/", "", (SOURCE / "include/crt/crt.h").read_text(), flags=re.DOTALL)


def kind_of(declaration: str):
    """Returns what stands for a C type in calls; pointers of all kinds are one."""
    if "*" in declaration or "_fn " in declaration or declaration.endswith("]"):
        return ctypes.c_void_p
    kinds = {
        "double": ctypes.c_double,
        "size_t": ctypes.c_size_t,
        "int32_t": ctypes.c_int32,
        "uint32_t": ctypes.c_uint32,
        "uint64_t": ctypes.c_uint64,
        "crt_status": ctypes.c_int,
        "void": None,
    }
    return kinds[declaration.replace("const", "").split()[0]]


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
    def test_all_of_the_header_are_declared_as_there(self):
        known = functions()
        self.assertGreater(len(known), 80)
        self.assertEqual(list(FUNCTIONS), list(known))
        texts = {_library._Text, ctypes.c_char_p}
        for name, (result, parameters) in known.items():
            function = getattr(_library.library, name)
            ours = [function.restype, *function.argtypes]
            expected = [kind_of(result), *map(kind_of, parameters)]
            self.assertEqual(
                [ctypes.c_void_p if kind in texts else kind for kind in ours], expected, name
            )
            self.assertEqual(function.errcheck is not None, result == "crt_status", name)

    def test_what_is_generated_is_up_to_date(self):
        program = (
            f"import sys; sys.path.insert(0, {str(SOURCE / 'python/tools')!r}); import generate\n"
            "from pathlib import Path; folder = Path(sys.argv[1]); header = generate.HEADER\n"
            "(folder / '_functions.py').write_text(generate.functions(header.read_text()))\n"
            "(folder / '_fields.py').write_text(generate.fields(header.read_text()))\n"
            "(folder / 'values.pyi').write_text(generate.stub())\n"
        )
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-c", program, folder], check=True)
            for file in sorted(Path(folder).iterdir()):
                ours = (SOURCE / "python/crt" / file.name).read_text()
                self.assertEqual(ours, file.read_text(), "run python/tools/generate.py")

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
        modules = diagnostics, farm, images, options, scenes, scripts, values
        structs = {
            thing
            for module in modules
            for thing in vars(module).values()
            if isinstance(thing, type)
            and issubclass(thing, _structs.Struct)
            and thing is not _structs.Struct
        }
        self.assertEqual(len(structs), 19)
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
            "crt_pixel_filter": crt.PixelFilter,
            "crt_falloff_model": crt.FalloffModel,
            "crt_precision": crt.Precision,
            "crt_unit": crt.Unit,
            "crt_farm_task_state": farm.TaskState,
        }
        for name, ours in pairs.items():
            body = re.search(rf"typedef enum {name} \{{(.*?)\}} {name};", HEADER, re.DOTALL)[1]
            names = re.findall(r"CRT_(\w+)", body)
            for number, theirs in enumerate(names):
                self.assertTrue(theirs.endswith(ours(number).name), f"{theirs} is {ours(number)!r}")
            self.assertEqual(len(names), sum(member >= 0 for member in ours))

    def test_fields_that_crt_h_calls_an_enumeration_are_one(self):
        found = 0
        for thing in vars(values).values():
            if not (isinstance(thing, type) and issubclass(thing, _structs.Struct)):
                continue
            for declaration, text in FIELDS.get(getattr(thing, "_name", ""), ()):
                if named := re.match(r"an? ([A-Z]\w+)", text):
                    field = declaration.split()[-1]
                    self.assertIs(thing._enums[field], getattr(crt, named[1]), field)
                    found += 1
        self.assertEqual(found, 11)
        self.assertIs(crt.Camera().projection, crt.Projection.PINHOLE)
        self.assertEqual(repr(crt.Settings(precision=99).precision), "99")

    def test_aovs_have_the_bits_of_the_header(self):
        bits = {
            name.lower(): int(bit) for name, bit in re.findall(r"CRT_AOV_(\w+)\s*=\s*(\d+)", HEADER)
        }
        self.assertEqual(options.AOV_BITS, bits)

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
        self.assertEqual(farm._TASK.itemsize, 160)
        self.assertEqual([farm._TASK.fields[name][1] for name in farm._TASK.names], [
            0, 4, 8, 16, 24, 32
        ])
