"""Figures of whirl as matplotlib axes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np


def _limits(set_limits: Any, axis: dict[str, Any]) -> None:
    if math.isfinite(axis["first"]):
        set_limits(axis["first"], None)
    if math.isfinite(axis["last"]):
        set_limits(None, axis["last"])


def _draw_cells(axes: Any, cells: dict[str, Any], plt: Any) -> None:
    shape = (len(cells["y"]), len(cells["x"]))
    values = np.reshape(cells["values"], shape)
    categories = cells["categories"]
    if categories:
        colors = plt.matplotlib.colors.ListedColormap([color for _, color in categories])
        mesh = axes.pcolormesh(cells["x"], cells["y"], values, cmap=colors, vmin=-0.5,
                               vmax=len(categories) - 0.5, shading="nearest")
        bar = axes.figure.colorbar(mesh, ax=axes, ticks=range(len(categories)))
        bar.ax.set_yticklabels([name for name, _ in categories])
    else:
        colors = "RdBu_r" if cells["is_diverging"] else "viridis"
        mesh = axes.pcolormesh(cells["x"], cells["y"], values, cmap=colors, vmin=cells["first"],
                               vmax=cells["last"], shading="nearest")
        axes.figure.colorbar(mesh, ax=axes, label=cells["title"])
    for names, ticks, at in ((cells["x_names"], axes.set_xticks, cells["x"]),
                             (cells["y_names"], axes.set_yticks, cells["y"])):
        if names:
            ticks(at, names)


def _draw_panel(axes: Any, panel: dict[str, Any], plt: Any) -> None:
    if panel["cells"]["values"]:
        _draw_cells(axes, panel["cells"], plt)
    named = set()
    for curve in panel["curves"]:
        label = curve["name"] if curve["name"] and curve["name"] not in named else None
        named.add(curve["name"])
        axes.plot(curve["x"], curve["y"], color=curve["color"], label=label,
                  linestyle=curve["dash"] if curve["has_line"] else "none",
                  marker="o" if curve["has_marker"] else None, markersize=0.7 * curve["size"])
    for kind, at, _, color, dash in panel["rules"]:
        if kind == "vertical":
            axes.axvline(at, color=color, linestyle=dash, linewidth=0.8)
        elif kind == "horizontal":
            axes.axhline(at, color=color, linestyle=dash, linewidth=0.8)
        else:
            axes.axline((0.0, 0.0), slope=at, color=color, linestyle=dash, linewidth=0.8)
    for x, y, text in panel["labels"]:
        axes.annotate(text, (x, y), textcoords="offset points", xytext=(4, 4), fontsize="small")
    for axis, scale, label, limits in ((panel["x"], axes.set_xscale, axes.set_xlabel, axes.set_xlim),
                                       (panel["y"], axes.set_yscale, axes.set_ylabel, axes.set_ylim)):
        if axis["is_log"]:
            scale("log")
        label(axis["title"])
        _limits(limits, axis)
    axes.set_title(panel["title"])
    if panel["has_equal_scales"]:
        axes.set_aspect("equal")
    if any(named):
        axes.legend(fontsize="small")


def draw(figure: dict[str, Any], plt: Any, on: Any = None) -> Any:
    """Draws a figure; its axes, or an array of them."""
    panels = figure["panels"]
    columns = min(figure["columns"], len(panels)) or 1
    rows = -(-len(panels) // columns) or 1
    on = on or plt.figure(figsize=(figure["width"] / 90, figure["height"] / 90), layout="constrained")
    axes = on.subplots(rows, columns, squeeze=False)
    for place, panel in zip(axes.flat, panels):
        _draw_panel(place, panel, plt)
    for place in list(axes.flat)[len(panels):]:
        place.remove()
    on.suptitle(": ".join(part for part in (figure["title"], figure["subtitle"]) if part))
    return axes[0, 0] if len(panels) == 1 else axes
