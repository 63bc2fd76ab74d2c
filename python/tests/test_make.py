"""Reliefs of all kinds of inputs have the bytes that the command line writes."""

import copy
import inspect
import json
import os
import pickle
import re
import subprocess
import zipfile
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import relievo
import relievo.batch
from relievo import Error
from support import InFolder, make, scan, still_life

# Flags of the command line, and the same options in Python.
OPTIONS = [
    (["--height", 4, "--width", 80], {"height_mm": 4, "width_mm": 80}),
    (["--saturation", 2, "--detail", 0.05], {"saturation": 2, "detail": 0.05}),
    (["--height", "1/8in", "--width", "3in"], {"height_mm": "1/8in", "width_mm": "3in"}),
    (
        ["--height", 1, "--width", 30, "--outline", "circle", "--rim", 1.5, "--rim-height", 1, "--draft", 20],
        {"height_mm": 1, "width_mm": 30, "outline": "circle", "rim_mm": 1.5, "rim_height_mm": 1, "draft_deg": 20},
    ),
    (
        ["--height", 3, "--view", "1,0,3", "--up", "0,1,0", "--crop", "0,0.2,1,1", "--tone", "0,1;0.5,0.4;1,0.3"],
        {"height_mm": 3, "view": (1, 0, 3), "up": [0, 1, 0], "crop": (0, 0.2, 1, 1), "tone": [(0, 1), (0.5, 0.4), (1, 0.3)]},
    ),
    (
        ["--height", 2, "--method", "linear", "--form", "die", "--tolerance", 0.05, "--denoise", 0],
        {"height_mm": 2, "method": "linear", "form": "die", "tolerance_mm": 0.05, "denoise": 0},
    ),
    (["--height", 3, "--outline", "none", "--mode", "subspace"], {"height_mm": 3, "outline": "none", "mode": "subspace"}),
]


class SameBytes(InFolder):
    def same(self, flags, relief, inputs=("scan.ply",), solid="relief.stl"):
        self.command("make", *inputs, "-o", solid, "--resolution", 0.5, *flags)
        relief.save("python-" + solid)
        self.assertEqual(Path("python-" + solid).read_bytes(), Path(solid).read_bytes())

    def test_for_all_options(self):
        for flags, options in OPTIONS:
            with self.subTest(options=options):
                self.same(flags, make("scan.ply", **options))

    def test_of_a_file_with_a_warning_of_what_is_left_out(self):
        np.savetxt("scan.xyz", np.vstack([scan().points, [np.nan, 0, 0]]))
        told = r"^scan\.xyz: left out 1 points with coordinates that are not finite$"
        with self.assertWarnsRegex(UserWarning, told) as warned:
            relief = make("scan.xyz", height_mm=2)
        self.assertEqual(Path(warned.filename).name, "support.py")  # the file that called the library
        self.same(["--height", 2], relief, inputs=("scan.xyz",))

    def test_in_all_files(self):
        outputs = ["--preview-size", 100, "--preview", "a.png", "--heightmap", "a.tif", "--tool-picture", "tool.png", "--report", "a.json"]
        flags = ["--wrap", "cylinder:diameter=60", "--resolution", "0.5mm", "--units", "in", *outputs]
        self.command("make", "scan.ply", "-o", "a.3mf", *flags, "--tool", "ball:1mm", "--width", "60mm", "--height", "3mm")
        relief = make("scan.ply", height_mm=3, width_mm=60, wrap="cylinder:diameter=60", tool="ball:1")
        relief.save(
            "b.3mf", preview="b.png", heightmap="b.tif", tool_picture="b-tool.png", report="b.json", units="in",
            preview_size=100,
        )
        for a, b in [("a.3mf", "b.3mf"), ("a.png", "b.png"), ("a.tif", "b.tif"), ("tool.png", "b-tool.png")]:
            self.assertEqual(Path(b).read_bytes(), Path(a).read_bytes(), b)
        a, b = json.loads(Path("a.json").read_text()), json.loads(Path("b.json").read_text())
        del a["seconds"], b["seconds"]
        self.assertEqual(b, a)

    def test_of_arrays_and_objects(self):
        points, normals = scan().points, scan().normals
        forms = {
            "bytes": lambda: make(Path("scan.ply").read_bytes(), height_mm=3),
            "pathlib": lambda: make(Path("scan.ply"), height_mm=3),
            "float32": lambda: make(points.astype(np.float32), normals=normals, height_mm=3),
            "columns": lambda: make(np.asfortranarray(points.astype("f4")), normals=normals, height_mm=3),
            "big endian": lambda: make(points.astype(">f4"), normals=normals.astype(">f8"), height_mm=3),
            "cloud": lambda: make(
                SimpleNamespace(points=points.astype(np.float32).tolist(), normals=normals, colors=[]), height_mm=3
            ),
        }
        self.command("make", "scan.ply", "-o", "a.stl", "--height", 3, "--resolution", 0.5)
        for name, form in forms.items():
            with self.subTest(name):
                self.assertEqual(form().to_bytes("stl"), Path("a.stl").read_bytes())

    def test_of_meshes(self):
        relief = make("scan.ply", height_mm=8, width_mm=40)
        relief.save("mesh.ply")
        mesh = SimpleNamespace(vertices=relief.vertices.astype(np.float32), faces=relief.faces)
        made = make(mesh, height_mm=2, points=5000)
        self.same(["--height", 2, "--points", 5000], made, ["mesh.ply"])
        given = make(mesh.vertices, faces=mesh.faces.astype(np.int64), height_mm=2, points=5000)
        self.assertEqual(given.to_bytes("stl"), made.to_bytes("stl"))

    def test_of_depth_images(self):
        make("scan.ply", height_mm=10, width_mm=60).save(heightmap="depth.tif", heightmap_size=200)
        self.same(
            ["--height", 2, "--depth-values", "height", "--points", 4000],
            make("depth.tif", height_mm=2, depth_values="height", points=4000),
            ["depth.tif"],
        )
        heights = make("scan.ply", height_mm=10, width_mm=60).height_map(200)
        self.same(
            ["--height", 2, "--depth-values", "height", "--points", 4000, "--base-image", "depth.tif"],
            make(heights, height_mm=2, depth_values="height", points=4000, base_image=heights),
            ["depth.tif"],
        )

    def test_of_several_inputs(self):
        flags = ["--height", 3, "--points", 8000]
        self.same(flags, make(["scan.ply", "other.ply"], height_mm=3, points=8000), ["scan.ply", "other.ply"])
        mixed = make([scan().points.astype("f4"), "other.ply"], height_mm=3, points=8000)
        self.assertEqual(mixed.report["models"][1]["file"], "other.ply")
        scene = {"models": [{"file": "scan.ply", "rotate": [0, 30, 0]}, {"file": "other.ply", "scale": 0.5}]}
        Path("scene.json").write_text(json.dumps(scene))
        self.same(flags, make("scene.json", height_mm=3, points=8000), ["scene.json"])

    def test_of_a_project(self):
        Path("work.relievo").write_text(
            json.dumps({"relievo": 1, "input": {"path": "scan.ply"}, "options": {"height": 3, "rim": 2}})
        )
        self.same(["--rim", 1], make("work.relievo", rim_mm=1), ["work.relievo"])
        self.same(["--alpha", 3], make("work.relievo", alpha=3), ["work.relievo"])

    def test_of_a_project_that_contains_its_scan_and_of_one_whose_scan_has_moved(self):
        project = {"relievo": 1, "input": {"path": "gone/scan.ply"}, "options": {"height": 3}}
        with zipfile.ZipFile("packed.relievo", "w") as archive:
            archive.writestr("project.json", json.dumps(project))
            archive.write("scan.ply", "scan/scan.ply")
        self.same([], make("packed.relievo"), ["packed.relievo"])
        Path("linked.relievo").write_text(json.dumps(project))
        self.same(["--scan", "scan.ply"], make("linked.relievo", scan=Path("scan.ply")), ["linked.relievo"])
        self.assertIn("--scan", self.refused("input", make, "linked.relievo").expected)
        self.assertEqual(self.refused("option", make, "scan.ply", scan="other.ply").input, "scan")
        with self.assertRaises(TypeError):
            make("linked.relievo", scan=5)

    def test_of_all_flags_of_the_command_line(self):
        text = subprocess.run([os.environ["RELIEVO"], "make", "--help"], check=True, capture_output=True, text=True).stdout
        flags = {flag.replace("-", "_") for flag in re.findall(r"^  (?:-[a-z],)?--([a-z-]+)", text, re.MULTILINE)}
        keywords = {*inspect.signature(relievo.make).parameters, *inspect.signature(relievo.Relief.save).parameters}
        without = flags - {re.sub("_(mm|deg|mb)$", "", keyword) for keyword in keywords}
        # The output is the first argument of save(). The number of threads applies to the whole process and is set by
        # set_threads().
        self.assertEqual(without, {"help", "output", "threads", "quiet"})


class Results(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.relief = make(still_life(), height_mm=3, width_mm=50)

    def test_are_arrays(self):
        relief = self.relief
        self.assertEqual((relief.vertices.dtype, relief.faces.dtype), (np.float64, np.uint32))
        self.assertLess(relief.faces.max(), len(relief.vertices))
        corners = relief.vertices[relief.faces]
        volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
        self.assertTrue(0 < volume < np.prod(relief.report["size_mm"]))
        self.assertEqual(relief.heights.shape[1] if relief.heights.shape[1] > relief.heights.shape[0] else 1024, 1024)
        self.assertAlmostEqual(float(relief.heights.max()), 3, places=2)
        self.assertEqual(max(relief.height_map(100).shape), 100)
        self.assertAlmostEqual(relief.report["height_mm"], 3)
        self.assertIn("triangles", repr(relief))

    def test_are_not_copied_and_outlive_the_relief(self):
        relief = make(scan(), height_mm=3)
        vertices, faces = relief.vertices, relief.faces
        self.assertTrue(np.shares_memory(vertices, relief.vertices))
        before = vertices.copy(), faces.copy()
        del relief
        self.assertTrue(np.array_equal(vertices, before[0]) and np.array_equal(faces, before[1]))
        with self.assertRaises(ValueError):
            vertices[0] = 0

    def test_are_pickled_and_copied_whole(self):
        for options in [{"colours": scan().points * 0 + 0.5}, {"wrap": "cylinder:diameter=80"}, {"form": "lithophane"},
                        {"tool": "ball:2", "draft_deg": 15}]:
            relief = make(scan().points, normals=scan().normals, height_mm=2, **options)
            for other in [pickle.loads(pickle.dumps(relief)), copy.deepcopy(relief), copy.copy(relief)]:
                for format in ["stl", "3mf", "ply", "obj", "heightmap", "tiff", "preview"]:
                    self.assertEqual(other.to_bytes(format, heightmap_size=64), relief.to_bytes(format, heightmap_size=64))
                self.assertEqual((other.report, other.remarks, repr(other)), (relief.report, relief.remarks, repr(relief)))
                for number, each in enumerate([relief, other]):
                    picture = {"tool_picture": f"{number}.png"} if "tool" in options else {}
                    each.save(f"{number}.stl", report=f"{number}.json", units="in", **picture)
                for ending in ["stl", "json"] + ["png"] * len(picture):
                    self.assertEqual(Path(f"0.{ending}").read_bytes(), Path(f"1.{ending}").read_bytes())

    def test_of_pickles_that_are_cut_are_refused(self):
        state = list(self.relief._native.__getstate__())
        for wrong in [state[:-1], [state[0][:4], *state[1:]], [(b"1", *state[0][1:]), *state[1:]], [(b"", *state[0][1:]), *state[1:]],
                      [*state[:6], b"{", *state[7:]]]:
            with self.assertRaises(ValueError):
                type(self.relief._native).__new__(type(self.relief._native)).__setstate__(tuple(wrong))

    def test_leave_out_rows_that_are_not_finite(self):
        points, normals = scan().points, np.array(scan().normals)
        wanted = make(points, normals=normals, height_mm=3)
        self.assertFalse([line for line in wanted.remarks if "not finite" in line])
        more = np.vstack([[[np.nan] * 3], points, [[np.inf, 1, 2]]])
        relief = make(more, normals=np.vstack([[[np.nan] * 3], normals, [[0, 0, 1]]]), height_mm=3)
        self.assertEqual(relief.to_bytes("stl"), wanted.to_bytes("stl"))
        self.assertIn("points: left out 2 rows that are not finite", relief.remarks)

    def test_say_what_they_are(self):
        session = relievo.Session(scan())
        self.assertRegex(repr(session), r"^<relievo\.Session \d+ points, \d+ triangles>$")
        self.assertRegex(repr(session.frame(height_mm=3)), r"^<relievo\.Frame 3 mm, \d+ points>$")
        self.assertEqual(repr(scan()), f"<relievo.Cloud {len(scan())} points with normals>")

    def test_are_pictures(self):
        picture = self.relief.preview(200, material="bronze")
        self.assertEqual((picture.shape[2], picture.dtype), (3, np.uint8))
        self.assertTrue(self.relief._repr_png_().startswith(b"\x89PNG"))

    def test_have_colours_if_the_scan_has(self):
        self.assertIsNone(self.relief.colours)
        red = np.tile(np.array([1.0, 0, 0]), (len(scan()), 1))
        coloured = make(scan().points, normals=scan().normals, colours=red, height_mm=3)
        self.assertEqual(coloured.colours.shape, coloured.vertices.shape)
        self.assertEqual(coloured.colours.max(axis=0).tolist()[0], 255)
        same = make(
            scan().points, normals=scan().normals, colours=np.uint8([255, 0, 0, 9]) + np.zeros_like(red[:, [0] * 4], "u1"),
            height_mm=3,
        )
        self.assertEqual(same.to_bytes("ply"), coloured.to_bytes("ply"))

    def test_are_saved_all_or_none(self):
        Path("old.stl").write_text("old")
        with self.assertRaises(Error):
            self.relief.save("old.stl", preview="no/such/folder/p.png")
        self.assertEqual(Path("old.stl").read_text(), "old")
        relief = make("scan.ply", height_mm=3)
        error = self.refused("option", relief.save, "scan.ply")
        self.assertEqual(error.expected, "expected different files for input and outputs")
        with self.assertRaises(TypeError):
            relief.save()
        for format in ["stl", "3mf", "ply", "obj", "heightmap", "tiff", "preview"]:
            self.assertGreater(len(relief.to_bytes(format, heightmap_size=64)), 100)

    def test_are_saved_beside_files_of_others(self):
        folder = Path("outputs")
        folder.mkdir()
        for name in ["x.stl.relievo-ABCDEF", "x.stl.relievo-1-1", "x.stl.relievo-", "x.png.relievo-ABCDEF", "x.stl~", "index.html"]:
            (folder / name).write_text(f"{name} of somebody else")
        Path("precious.txt").write_text("precious")
        (folder / "x.stl.relievo-GHIJKL").symlink_to("../precious.txt")
        (folder / "index.html").chmod(0o444)
        others = [Path("precious.txt"), *folder.iterdir()]
        for path in others:
            os.utime(path, ns=(1_600_000_000_123_456_789,) * 2, follow_symlinks=False)

        def found(path):
            return path.is_symlink(), path.read_bytes(), path.lstat().st_mode, path.lstat().st_mtime_ns

        before = {path: found(path) for path in others}
        self.relief.save("outputs/x.stl", preview="outputs/x.png", report="outputs/x.json")
        with self.assertRaises(Error):
            self.relief.save("outputs/y.stl", preview="no/such/folder/y.png")
        ours = {folder / name for name in ["x.stl", "x.png", "x.json"]}
        self.assertEqual({*folder.iterdir(), Path("precious.txt")} - ours, set(before))
        self.assertEqual({path: found(path) for path in others}, before)

    def test_batch_refuses_a_folder_of_others(self):
        Path("many").mkdir()
        Path("many/index.html").write_text("of somebody else")
        with self.assertRaisesRegex(ValueError, "found other files in"):
            relievo.batch.run(".", "many", program=os.environ["RELIEVO"], match="scan.ply")
        self.assertEqual([path.read_text() for path in Path("many").iterdir()], ["of somebody else"])
