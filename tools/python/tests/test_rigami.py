"""The package against the C face and the command line. RIGAMI: the program; needs matplotlib.

python test_rigami.py"""
import os
import subprocess
import tempfile
import unittest

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import rigami

PROGRAM = os.environ["RIGAMI"]


class Miura(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.file = os.path.join(self.folder.name, "miura.opx")
        subprocess.run([PROGRAM, "gen", "miura", "6", "6", "-o", self.file], check=True)

    def out(self, name):
        return os.path.join(self.folder.name, name)

    def test_folds_as_the_command_line_does(self):
        """Every frame's angles and places as the program writes them, byte for byte."""
        outputs = [word for name in ("a.csv", "a.fold", "a.obj") for word in ("-o", self.out(name))]
        subprocess.run([PROGRAM, "fold", self.file, "-q", *outputs], check=True)
        pattern = rigami.Pattern.read(self.file)
        motion = rigami.Motion(pattern)
        self.assertEqual(motion.outcome, "folded")
        for form in [".csv", ".obj"]:
            with open(self.out("a" + form), "rb") as f:
                self.assertEqual(motion.to_bytes(form), f.read(), form)
        table = np.genfromtxt(self.out("a.csv"), delimiter=",", comments="#", skip_header=1)
        angles = np.array([motion.angles(i) for i in range(len(motion))])
        degrees = table[:, -angles.shape[1] :]
        self.assertLess(np.abs(degrees - np.degrees(angles)).max(), 1e-12 * 180)

        self.assertTrue(np.array_equal(motion.path.view(np.uint64), angles.view(np.uint64)))
        self.assertFalse(motion.path.flags.owndata)
        self.assertEqual(len(motion.percent), len(motion))
        self.assertTrue((np.diff(motion.percent) > 0).all() and motion.percent[0] == 0 and motion.percent[-1] == 100)
        self.assertEqual(motion.mobility(len(motion) // 2), 1)
        self.assertEqual(motion.triangles.shape, (2 * len(motion.facets), 3))
        self.assertEqual(motion._repr_png_()[:4], b"\x89PNG")

        frames = [state.angles.copy() for state in rigami.Fold(pattern)]
        self.assertEqual(len(frames), len(motion))
        self.assertTrue(np.array_equal(np.array(frames).view(np.uint64), angles.view(np.uint64)))

    def test_drives_a_crease_and_plots(self):
        """One crease from flat to 60 degrees: at a vertex the tangents of half the angles keep their ratio, cos 60
        degrees or 1."""
        pattern = rigami.Pattern.read(self.file)
        fold = rigami.Fold(pattern, flat=True, frames=61)
        driven = 0
        valley = pattern.assignment[fold.crease_edge[driven]] == "V"
        fold.drive({driven: np.radians(60 if valley else -60)})
        path = np.array([state.angles.copy() for state in fold])
        self.assertEqual(len(path), 61)
        self.assertLess(np.abs(np.abs(np.degrees(path[:, driven])) - np.arange(61)).max(), 1e-10)
        fold.forget()
        self.assertEqual(fold.info.frames, 1)
        ratio = np.abs(np.tan(path[1:] / 2) / np.tan(path[1:, driven : driven + 1] / 2))
        known = np.array([0.5, 1, 2])
        self.assertLess(np.abs(ratio[:, :, None] - known).min(axis=2).max(), 1e-9)
        self.assertTrue((np.abs(path[-1]) > 0.1).all(), "every crease follows")

        figure, axes = plt.subplots()
        lines = axes.plot(np.degrees(path[:, driven]), np.degrees(path), linewidth=0.8)
        axes.set(xlabel="driven crease, degrees", ylabel="fold angles, degrees")
        figure.savefig(self.out("angles.png"))
        plt.close(figure)
        self.assertEqual(len(lines), path.shape[1])
        self.assertGreater(os.path.getsize(self.out("angles.png")), 5000)

    def test_arrays_are_the_librarys(self):
        fold = rigami.Fold(rigami.Pattern.read(self.file))
        fold.go_to(50)
        for view in [fold.angles, fold.positions, fold.transforms, fold.flat]:
            self.assertFalse(view.flags.owndata)
            self.assertFalse(view.flags.writeable)
        there = int(rigami.ffi.cast("uintptr_t", rigami.lib.rg_fold_angles(fold._handle, rigami.ffi.NULL)))
        self.assertEqual(fold.angles.ctypes.data, there)
        x, flat, placed = fold.positions.copy(), fold.flat, fold.transforms
        for facet, t in zip(fold.facets, placed):
            for v in facet:
                at = t[0] * flat[v, 0] + t[1] * flat[v, 1] + t[3]
                self.assertLess(np.abs(at - x[v]).max(), 1e-9)
        positions = fold.positions
        del fold
        self.assertTrue(np.array_equal(positions, x), "a view keeps its fold alive")

    def test_arrays_go_in(self):
        read = rigami.Pattern.read(self.file)
        made = rigami.Pattern.from_arrays(read.vertices, read.edges, read.assignment)
        self.assertEqual(made.assignment, read.assignment)
        self.assertTrue(np.array_equal(made.vertices, read.vertices))
        a, b = rigami.Motion(read), rigami.Motion(made)
        self.assertTrue(np.array_equal(a.angles(-1), b.angles(-1)))
        with self.assertRaises(rigami.Error):
            rigami.Pattern.from_arrays(read.vertices, read.edges + len(read.vertices), read.assignment)

        with self.assertRaises(ValueError):
            rigami.Pattern.from_arrays(read.vertices, read.edges.astype(np.int64) + 2**32, read.assignment)
        with self.assertRaises(ValueError):
            rigami.Pattern.from_arrays(read.vertices, read.edges + 0.5, read.assignment)

    def test_structs_keep_their_owners(self):
        """What has gone comes back as something else's memory: as that of a motion with other frames."""
        pattern = rigami.Pattern.read(self.file)
        report, info = rigami.Motion(pattern, frames=5).report, rigami.Fold(pattern, frames=5).info
        size, tangent = rigami.Pattern.read(self.file).info, rigami.Fold(pattern, frames=5).tangent().info
        others = [kind(pattern, frames=7) for kind in (rigami.Motion, rigami.Fold) for _ in range(3)]
        others += [rigami.Pattern.generate("miura", 2, 2) for _ in range(3)]
        others += [rigami.Fold(others[-1], flat=True).tangent() for _ in range(3)]
        self.assertEqual((report.frame_count, info.frames), (5, 5))
        self.assertEqual((size.vertices, tangent.columns), (49, 60))

    def test_texts_have_no_end_within(self):
        with self.assertRaises(ValueError):
            rigami.Pattern.read(self.file + "\0.cp")
        with self.assertRaises(ValueError):
            rigami.Motion(rigami.Pattern.read(self.file), frames=3).write(self.out("a.obj\0.csv"))
        self.assertFalse(os.path.exists(self.out("a.obj")))

    def test_snapshot_tangent_progress(self):
        fold = rigami.Fold(rigami.Pattern.read(self.file))
        fold.go_to(37)
        kept, before = fold.snapshot(), fold.angles.copy()
        fold.go_to(100)
        fold.restore(kept)
        self.assertTrue(np.array_equal(fold.angles, before))
        tangent = fold.tangent()
        value, column, start = tangent.csr
        C = np.zeros(tangent.shape)
        for row in range(tangent.shape[0]):
            C[row, column[start[row] : start[row + 1]]] = value[start[row] : start[row + 1]]
        basis = tangent.basis
        self.assertLess(np.abs(C @ basis.T).max(), 1e-9)
        self.assertEqual(np.linalg.matrix_rank(C, tol=1e-8), tangent.shape[1] - len(basis))
        wish = np.zeros(tangent.shape[1])
        wish[0] = 1
        self.assertLess(np.abs(C @ tangent.project(wish)).max(), 1e-9)

        class Enough(Exception):
            pass

        def stop(progress):
            raise Enough

        with self.assertRaises(Enough):
            rigami.Motion(rigami.Pattern.generate("miura", 12, 12), progress=stop)


if __name__ == "__main__":
    unittest.main()
