"""Unusable inputs raise an exception that names the fault and its place, and never end the program."""

import pickle
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import relievo
import relievo.batch
from support import InFolder, scan


class Refusals(InFolder):
    def test_name_file_place_and_expectation(self):
        Path("bad.xyz").write_text("1 2 3\n4 five 6\n")
        error = self.refused("input", relievo.make, "bad.xyz")
        self.assertEqual((error.input, error.place), ("bad.xyz", "line 2"))
        self.assertIn("found 'five'", error.expected)
        self.assertEqual(str(error), f"bad.xyz, line 2: {error.expected}")
        self.assertEqual(self.refused("input", relievo.make, "none.ply").input, "none.ply")
        self.assertEqual(self.refused("input", relievo.make, b"\x00\x01").input, "bytes")
        self.refused("geometry", relievo.make, "scan.ply", height_mm=5000)
        copy = pickle.loads(pickle.dumps(error))
        self.assertEqual((str(copy), copy.place), (str(error), error.place))

    def test_of_memory_are_memory_errors_too(self):
        self.assertTrue(issubclass(relievo.OutOfMemory, relievo.Error))
        self.assertTrue(issubclass(relievo.OutOfMemory, MemoryError))
        self.assertFalse(issubclass(relievo.Error, MemoryError))

    def test_name_the_keyword_of_an_option(self):
        self.assertEqual(self.refused("option", relievo.make, scan(), width_mm=-1).input, "width_mm")
        self.assertEqual(self.refused("option", relievo.make, scan(), rim_mm=2, rim_height_mm=float("nan")).input, "rim_height_mm")
        self.assertEqual(self.refused("option", relievo.make, scan(), height_mm="2 ells").input, "height_mm")
        self.assertEqual(self.refused("option", relievo.make, scan(), outline="star").input, "outline")
        self.assertEqual(self.refused("option", relievo.make, scan(), height_mm=1, alpha=2).kind, "option")
        self.assertEqual(self.refused("option", relievo.make, scan(), base="image").input, "base")

    def test_name_the_nearest_keyword(self):
        for wrong, nearest in [("hieght_mm", "height_mm"), ("height", "height_mm"), ("rim_hight", "rim_height_mm"), ("out_line", "outline")]:
            with self.assertRaisesRegex(TypeError, f"'{wrong}'; the nearest is '{nearest}'"):
                relievo.make(scan(), **{wrong: 1})
        for far, hint in [("verbose", "'verbose'$"), ("units", "save\\(\\) takes units$"), ("threads", "set_threads\\(\\) sets")]:
            with self.assertRaisesRegex(TypeError, hint):
                relievo.make(scan(), **{far: 1})

    def test_name_what_is_no_function_frame_or_number(self):
        with self.assertRaisesRegex(TypeError, "progress: expected a function, found int"):
            relievo.make(scan(), progress=3)
        with self.assertRaisesRegex(TypeError, "expected a frame, found NoneType"):
            relievo.Session(scan()).picture(None)
        with self.assertRaisesRegex(TypeError, "expected a whole number, found str"):
            relievo.set_threads("x")

    def test_name_the_program_that_batch_needs(self):
        with self.assertRaisesRegex(ValueError, "relievoo: expected the program relievo, which Python's package"):
            relievo.batch.run(".", "out", program="relievoo")

    def test_hint_at_the_transposed_array(self):
        error = self.refused("input", relievo.make, np.array(scan().points).T)
        self.assertRegex(error.expected, r"^expected \(N, 3\), found \(3, \d+\); the transposed array, \.T,")

    def test_are_type_errors_for_wrong_types(self):
        for wrong in [5, None, object(), lambda: 0]:
            with self.assertRaises(TypeError):
                relievo.make(wrong)
        for options in [{"height_mm": [1]}, {"height_mm": True}, {"outline": 5j}, {"saturation": "much"}, {"camera": 1j}]:
            with self.assertRaises(TypeError, msg=options):
                relievo.make(scan(), **options)
        with self.assertRaises(TypeError):
            relievo.make("scan.ply", normals=scan().normals)

    def test_of_arrays(self):
        points, normals = scan().points, scan().normals
        with_nan, with_zero = points.copy(), normals.copy()
        with_nan[7, 1], with_zero[9] = np.nan, 0
        cases = [
            ("shape", "source", points[:, :2], {}),
            ("shape", "points", points[:0], {}),
            ("shape", "points", points.ravel(), {}),
            ("shape", "points", np.zeros((2, 3, 3)), {}),
            ("shape", "points", np.array(3.0), {}),
            ("dtype", "points", points.astype(complex), {}),
            ("dtype", "points", points.astype(object), {}),
            ("dtype", "points", points.astype("U9"), {}),
            ("dtype", "points", points > 0, {}),
            ("row 0", "points", points * np.nan, {}),
            ("row 7", "points", with_nan, {"faces": [[0, 1, 2]]}),
            ("shape", "normals", points, {"normals": normals[:-1]}),
            ("row 9", "normals", points, {"normals": with_zero}),
            ("shape", "colours", points, {"colours": np.zeros((len(points), 2), "u1")}),
            ("dtype", "colours", points, {"colours": np.zeros((len(points), 3), "i8")}),
            ("row 0", "colours", points, {"colours": points * 0 + 2}),
            ("row 0", "faces", points, {"faces": [[0, 1, len(points)]]}),
            ("row 0", "faces", points, {"faces": [[0, 1, -1]]}),
            ("dtype", "faces", points, {"faces": [[0.0, 1, 2]]}),
            ("shape", "faces", points, {"faces": np.zeros((0, 3), int)}),
            ("", "faces", points, {"faces": [[1, 1, 1]]}),
        ]
        for place, name, array, extras in cases:
            with self.subTest(place=place, name=name, shape=array.shape, dtype=array.dtype):
                error = self.refused("input", relievo.make, array, height_mm=3, **extras)
                self.assertEqual((error.input, error.place), (name, place))
        self.refused("geometry", relievo.make, points[:1].repeat(100, axis=0))
        self.refused("geometry", relievo.make, points[:3])
        self.refused("input", relievo.make, SimpleNamespace(points=[]))
        self.refused("input", relievo.make, [[1, 2, 3], [4, 5]])
        self.refused("input", relievo.make, [])
        self.refused("geometry", relievo.make, np.full((20, 20), np.nan))
        self.refused("geometry", relievo.make, np.full((20, 20), np.inf))
        self.refused("input", relievo.make, np.zeros((20, 5)))

    def test_are_none_for_what_can_be_read(self):
        points = np.array(scan().points)
        points.setflags(write=False)
        strided = np.zeros((len(points), 6))[:, ::2]
        strided[:] = points
        wanted = relievo.make(points, height_mm=3, resolution_mm=0.5).to_bytes("stl")
        packed = np.zeros(len(points), np.dtype([("x", "u1"), ("p", "f8", 3)]))
        packed["p"] = points  # makes the points unaligned
        for array in [strided, points[::-1][::-1], packed["p"], np.ma.array(points), points.tolist()]:
            self.assertEqual(relievo.make(array, height_mm=3, resolution_mm=0.5).to_bytes("stl"), wanted)
        masked = relievo.make(np.ma.masked_less(points, 0), height_mm=3, resolution_mm=0.5)
        self.assertRegex("\n".join(masked.remarks), r"points: left out \d+ rows that are not finite")
        self.refused("input", relievo.make, np.ma.masked_all(points.shape))

    def test_of_strange_paths(self):
        self.assertEqual(self.refused("input", relievo.make, b"no\xffsuch".decode("utf-8", "surrogateescape")).kind, "input")
        name = "scan-\udcff.ply"
        Path("scan.ply").rename(name)
        self.assertIn("models", relievo.make(name, height_mm=3, resolution_mm=0.5).report)

    def test_of_pictures_and_files(self):
        relief = relievo.make(scan(), height_mm=3, resolution_mm=0.5)
        self.refused("option", relief.preview, 0)
        self.refused("option", relief.preview, 100, "gold")
        self.refused("option", relief.height_map, -1)
        self.refused("option", relief.to_bytes, "docx")
        self.refused("option", relief.save, "a.docx")
        self.refused("option", relief.save, "a.stl", units="ell")
        self.refused("option", relief.save, "a.stl", heightmap_size=1)
        self.refused("option", relief.save, "a.stl", preview_size=5000)
        self.refused("option", relief.save, tool_picture="a.png")
        with self.assertRaises(TypeError):
            relief.height_map("large")
