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

    @needs("nbclient", "nbformat", "ipykernel")
    def test_a_kernel_of_jupyter_shows_figures_tables_and_progress(self):
        import nbclient
        import nbformat

        cells = [f"import sys\nsys.path.insert(0, {support.PACKAGE!r})\nimport whirl\n"
                 f"m = whirl.read({str(support.MODELS / 'jeffcott_stator.toml')!r})",
                 "m.unbalance()", "m.check().report()", "m.unbalance().to_dataframe()",
                 "import time\nm.simulate(revolutions=3, discard=0, progress=lambda *told: None)\n"
                 "bar = whirl.progress.bar()\nbar('a', 1, 4)\nbar._begin -= 2\nbar('a', 2, 4)\nbar('a', 3, 4)",
                 "bar.close()", "m.modes(modes=0)"]
        book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(text) for text in cells])
        client = nbclient.NotebookClient(book, timeout=60, kernel_name="python3", allow_errors=True)
        client.execute()
        outputs = [cell.outputs for cell in book.cells]
        self.assertEqual(outputs[0], [])
        figure, page, table = (outputs[i][0].data["text/html"] for i in (1, 2, 3))
        self.assertTrue(figure.startswith("<svg") and "<pre" in figure, figure[:80])
        self.assertIn("<iframe", page)
        self.assertIn("<table", table)
        # one line, rewritten in its place, and empty in the end
        self.assertEqual([o.output_type for o in outputs[4]], ["display_data"])
        self.assertEqual(outputs[4][0].data["text/html"], "")
        error = outputs[6][0]
        self.assertEqual((error.ename, error.evalue), ("ModelError", "--modes 0: expected a whole number from 1 to 10 000"))
        self.assertEqual(len(error.traceback), 5)  # a line, a head, the cell, the method, the message

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
