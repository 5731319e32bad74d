"""Notebooks of docs/notebooks: their cells run in order, what they show can be shown, and they are kept
without outputs."""

import ast
import contextlib
import io
import json
import os
import shutil
import time
import unittest

import support
from support import needs

NOTEBOOKS = support.REPOSITORY / "docs/notebooks"


def cells_of(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)["cells"]


def shown(value):
    """What a notebook shows of the value of a cell's last line."""
    for way in ("_repr_html_", "_repr_svg_", "__repr__"):
        text = getattr(value, way, lambda: None)()
        if text:
            return text
    raise AssertionError(f"{type(value).__name__} shows nothing")


def run(path, after=lambda number, text: None):
    """Runs the cells of a notebook in one namespace; an exception leaves, with the number of the cell."""
    names = {"__name__": "__main__"}
    for number, cell in enumerate(cells_of(path), 1):
        if cell["cell_type"] != "code":
            continue
        tree = ast.parse("".join(cell["source"]), f"{path.name}, cell {number}")
        last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, f"{path.name}, cell {number}", "exec"), names)
        value = eval(compile(ast.Expression(last.value), f"{path.name}, cell {number}", "eval"), names) if last else None
        after(number, "" if value is None else shown(value))


@needs("scipy", "pandas", "matplotlib")
class Notebooks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        import matplotlib

        matplotlib.use("Agg")
        # as they lie in the repository, whose models they read, but they may write beside themselves
        os.makedirs("docs/notebooks")
        os.symlink(support.MODELS, "models")
        os.chdir("docs/notebooks")

    def test_cells_run(self):
        import matplotlib.pyplot as plt

        paths = sorted(NOTEBOOKS.glob("*.ipynb"))
        self.assertGreaterEqual(len(paths), 3)
        for path in paths:
            with self.subTest(notebook=path.name):
                begin = time.process_time()
                with contextlib.redirect_stdout(io.StringIO()):
                    run(path, lambda number, text: plt.close("all"))
                print(f"{path.name}: {time.process_time() - begin:.1f} s of processor")

    def test_are_kept_without_outputs(self):
        for path in NOTEBOOKS.glob("*.ipynb"):
            for cell in cells_of(path):
                self.assertFalse(cell.get("outputs"), path.name)
                self.assertIsNone(cell.get("execution_count"), path.name)

    def test_a_wrong_cell_is_found(self):
        shutil.copy(NOTEBOOKS / "1_first_rotor.ipynb", "wrong.ipynb")
        with open("wrong.ipynb", encoding="utf-8") as file:
            text = file.read()
        with open("wrong.ipynb", "w", encoding="utf-8") as file:
            file.write(text.replace("m.critical()", "m.critcal()"))
        with self.assertRaises(AttributeError):
            run(support.pathlib.Path("wrong.ipynb"))


if __name__ == "__main__":
    support.main()
