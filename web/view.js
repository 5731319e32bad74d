// A figure on the page: zoom, pan, hover, legend, downloads, and cursors that move together.

const views = [];

/** Moves the cursors of all figures of one result to the same time, speed or frequency. */
function moveCursors(from, kind, value, more = {}) {
  for (const view of views) {
    if (view.result === from.result) view.showCursor(kind, value, more, view === from);
  }
}

function element(tag, attributes = {}, ...children) {
  const e = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) e.addEventListener(key.slice(2), value);
    else if (value !== undefined && value !== false) e.setAttribute(key, value);
  }
  e.append(...children);
  return e;
}

function save(name, blob) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const tip = {
  show(lines, x, y) {
    const box = document.getElementById("tip");
    box.replaceChildren(...lines.map((l, i) => element("div", {}, i ? l : element("b", {}, l))));
    box.hidden = false;
    const { width, height } = box.getBoundingClientRect();
    box.style.left = `${Math.max(4, x + 16 + width > innerWidth ? x - 14 - width : x + 16)}px`;
    box.style.top = `${Math.max(4, y + 14 + height > innerHeight ? y - 10 - height : y + 14)}px`;
  },
  hide() { document.getElementById("tip").hidden = true; },
};

/** A command line with texts for its places, {x}; a brace of its own is written twice there. */
const filled = (command, texts) =>
  command.replace(/\{\{|\{(-?[nxy])\}/g, (place, name) => (name === undefined ? "{" : texts[name] ?? place));
/** A text as a cell. One that a spreadsheet would take for a formula gets an apostrophe in front, "this is text". */
const csvText = (t) => {
  const text = String(t ?? "");
  return `"${(/^[=+\-@\t\r]/.test(text) ? "'" + text : text).replace(/"/g, '""')}"`;
};
const LENGTHS = { m: 1, mm: 1e-3, "µm": 1e-6, nm: 1e-9 };

const ON_PAPER = 400, WIDE_ON_PAPER = 820;  // [pixels] of a printed figure: letters are of some 7 pt on A4

class FigureView {
  /** @param figures all of one kind: the stations, contacts or planes to choose from */
  constructor(figures, result, arrays) {
    this.figures = figures;
    this.result = result;
    this.arrays = arrays;
    this.drawings = new Map();
    const kind = figures[0].kind;
    this.canvas = element("canvas");
    this.over = element("canvas", { class: "over", tabindex: 0 });
    this.legend = element("div", { class: "legend" });
    this.extra = element("div");
    this.ranges = element("div", { class: "ranges", hidden: "" });
    this.title = element("h3");
    this.about = element("p", { class: "about" });
    const tool = (name, title, run) => element("button", { type: "button", title, onclick: run }, name);
    this.select = element("select", { title: "Which", onchange: () => this.choose(Number(this.select.value)) },
      ...figures.map((f, i) => element("option", { value: i }, f.variant || f.heading)));
    this.plot = element("div", { class: "plot" }, this.canvas, this.over);
    this.card = element("article", { class: "card", id: `figure-${result.number}-${kind}` },
      element("div", { class: "top" }, element("div", {}, this.title),
        element("div", { class: "tools" }, figures.length > 1 ? this.select : "",
          tool("All", "See everything (double click)", () => this.showAll()),
          tool("Reset", "The view as at first", () => this.reset()),
          (this.rangeTool = tool("Range", "Ranges of the axes as numbers", () => this.showRanges(this.ranges.hidden))),
          tool("SVG", "Download as SVG, as it is seen", () => this.saveSvg()),
          tool("PNG", "Download as PNG, as it is seen", () => this.savePng()),
          tool("CSV", "Download the data", () => this.saveCsv()))),
      this.about, this.plot, this.ranges, this.legend, this.extra);
    this.isWide = figures[0].width > 880;
    if (this.isWide) this.card.classList.add("wide");
    views.push(this);
    this.listen();
    this.choose(0);
  }

  get drawing() {
    if (!this.drawings.has(this.figure)) this.drawings.set(this.figure, new Drawing(this.figure, this.arrays));
    return this.drawings.get(this.figure);
  }

  choose(number) {
    this.figure = this.figures[number];
    this.over.setAttribute("aria-label", this.figure.subtitle);
    this.title.textContent = this.figure.heading;
    this.title.title = this.figure.summary;
    this.about.textContent = this.figure.subtitle || this.figure.summary;
    this.cursor = null;
    this.showRanges(!this.ranges.hidden);
    this.makeLegend();
    this.makeExtra();
    if (this.width) this.draw();
  }

  makeLegend() {
    const d = this.drawing;
    this.legend.replaceChildren(...d.legend().map((entry) => {
      const sample = element("canvas", { width: 64, height: 28 });
      const ctx = sample.getContext("2d");
      ctx.scale(2, 2);
      d.drawSample(ctx, entry, 1, 7);
      const button = element("button", { type: "button", "aria-pressed": String(!d.hidden.has(entry.name)),
        title: "Show or hide; with Alt only this", onclick: (event) => {
          const names = d.legend().map((e) => e.name);
          if (event.altKey) {
            const isOnly = names.every((n) => n === entry.name || d.hidden.has(n));
            d.hidden = new Set(isOnly ? [] : names.filter((n) => n !== entry.name));
          } else if (!d.hidden.delete(entry.name)) d.hidden.add(entry.name);
          this.makeLegend();
          this.draw();
        } }, sample, entry.name);
      return button;
    }));
  }

  makeExtra() {
    const parts = [];
    const { header, rows } = this.figure.table;
    if (rows.length) parts.push(tableOf(header, rows));
    if (this.figure.notes.length) parts.push(element("p", { class: "notes" }, this.figure.notes.join(" ")));
    this.command = element("div", { class: "command", hidden: "" });
    this.command.style.display = "none";
    parts.push(this.command);
    this.extra.replaceChildren(...parts);
  }

  resize() {
    const width = Math.floor(this.plot.clientWidth);
    if (!width || width === this.width) return;
    this.draw();
  }

  draw() {
    this.width = Math.floor(this.plot.clientWidth);
    if (!this.width) return;
    const { width } = this.figure, height = this.drawing.heightAt(this.width);
    const isStacked = height !== this.figure.height;  // panels below each other: as high as that takes
    const scale = this.width / width;
    // wide pages make wide plots, but circles need height too
    const isSquare = this.figure.panels.some((p) => p.equal || p.cells);
    this.height = Math.round(Math.min(isSquare ? height * scale : height * Math.min(1.15, scale), 900) - 40);
    this.height = Math.max(this.height, isSquare ? Math.min(260, height) : 0.8 * height - 40);
    if (isStacked) this.height = Math.max(this.height, Math.round(0.85 * height));
    const ctx = this.canvas.getContext("2d"), dots = devicePixelRatio || 1;
    this.height = Math.round(this.drawing.filledHeight(ctx, this.width, this.height));
    for (const c of [this.canvas, this.over]) {
      c.width = this.width * dots;
      c.height = this.height * dots;
      c.style.height = `${this.height}px`;
    }
    ctx.setTransform(dots, 0, 0, dots, 0, 0);
    ctx.clearRect(0, 0, this.width, this.height);
    this.drawing.dark = null;
    this.drawing.draw(ctx, this.width, this.height);
    this.drawOver();
    this.tellRanges();
    this.isDrawn = true;
  }

  // ---- ranges as numbers

  /** Shows or hides boxes for the ends of the axes of a panel; of several panels it is chosen. */
  showRanges(areShown) {
    this.ranges.hidden = !areShown;
    this.rangeTool.setAttribute("aria-expanded", String(areShown));
    if (!areShown) return;
    const { panels } = this.drawing, name = (p, i) => `${i + 1} ${p.title.split(" | ")[0] || withoutUnit(p.y.title)}`;
    this.rangePanel = panels[0];
    const choice = panels.length < 2 ? "" : element("select", { "aria-label": "panel", onchange: (e) => {
      this.rangePanel = panels[Number(e.target.value)];
      this.tellRanges();
    } }, ...panels.map((p, i) => element("option", { value: i }, name(p, i))));
    this.boxes = ["x", "y"].map((axis) => ["from", "to"].map((end) => element("input", { type: "text", inputmode: "decimal",
      size: 8, "aria-label": `${axis} ${end}`, onchange: () => this.takeRange(axis) })));
    const pair = (axis, [from, to]) => element("span", {}, axis, from, "to", to);
    this.ranges.replaceChildren(choice, pair("x", this.boxes[0]), pair("y", this.boxes[1]));
    this.tellRanges();
  }

  /** Writes the ends of the axes into their boxes. */
  tellRanges() {
    if (this.ranges.hidden || !this.rangePanel.ax) return;
    for (const [boxes, axis] of [[this.boxes[0], this.rangePanel.ax], [this.boxes[1], this.rangePanel.ay]]) {
      boxes[0].value = shown(axis.first, 6);
      boxes[1].value = shown(axis.last, 6);
      for (const box of boxes) box.removeAttribute("aria-invalid");
    }
  }

  /** Gives an axis the range in its boxes; what is no range is marked. */
  takeRange(axis) {
    const boxes = this.boxes[axis === "x" ? 0 : 1], p = this.rangePanel;
    const [first, last] = boxes.map((box) => box.value.trim() === "" ? NaN : Number(box.value.replace(/−/g, "-")));
    const isRange = first < last && Number.isFinite(last - first) && !(p[axis].log && first <= 0);
    for (const box of boxes) box.setAttribute("aria-invalid", String(!isRange));
    if (isRange) this.setView(p, axis === "x" ? [first, last] : null, axis === "y" ? [first, last] : null);
  }

  // ---- zoom, pan, hover

  panelAt(x, y, room = 0) {
    return this.drawing.panels.find((p) => p.box && x >= p.box.x - room && x <= p.box.x + p.box.w + room &&
      y >= p.box.y - room && y <= p.box.y + p.box.h + room);
  }

  /** Sets a panel's view, and x of those that share it. */
  setView(panel, x, y) {
    const d = this.drawing, wasX = panel.view.x;
    panel.view = { x: x || panel.view.x, y: y || panel.view.y };
    const column = d.panels.indexOf(panel) % d.columns;
    if (x && x !== wasX) {
      d.panels.forEach((p, i) => {
        if (p !== panel && i % d.columns === column && p.x.title === panel.x.title) p.view.x = x;
      });
    }
    this.draw();
  }

  reset() {
    this.drawing.reset();
    this.draw();
  }

  /** Everything there is, beyond what is seen at first. */
  showAll() {
    for (const p of this.drawing.panels) {
      let x = [Infinity, -Infinity], y = [Infinity, -Infinity];
      const add = (range, v, log) => {
        if (!Number.isFinite(v) || (log && v <= 0)) return;
        range[0] = Math.min(range[0], v);
        range[1] = Math.max(range[1], v);
      };
      for (const c of p.curves) {
        if (c.is_key === false) continue;
        for (let i = 0; i < c.x.length; ++i) {
          if (!Number.isFinite(c.y[i])) continue;
          add(x, c.x[i], p.x.log);
          add(y, c.y[i], p.y.log);
        }
      }
      if (p.cells) {
        for (const [range, edges] of [[x, edgesOf(p.cells.x)], [y, edgesOf(p.cells.y)]]) {
          add(range, edges[0]);
          add(range, edges[edges.length - 1]);
        }
      }
      const wide = (r, log) => {
        const room = r[1] > r[0] ? 0.03 * (r[1] - r[0]) : 0.5 * Math.abs(r[0]) || 1;
        return p.cells ? r : log ? [r[0] / 1.15, r[1] * 1.15] : [r[0] - room, r[1] + room];
      };
      if (x[0] <= x[1] && y[0] <= y[1]) p.view = { x: wide(x, p.x.log), y: wide(y, p.y.log) };
    }
    this.draw();
  }

  listen() {
    const o = this.over;
    const at = (e) => {
      const r = o.getBoundingClientRect();
      return [e.clientX - r.left, e.clientY - r.top];
    };
    o.addEventListener("pointerdown", (e) => {
      const [x, y] = at(e), panel = this.panelAt(x, y);
      if (!panel || e.pointerType === "touch") return;
      o.setPointerCapture(e.pointerId);
      const pans = e.shiftKey || e.button !== 0;
      this.drag = { panel, x, y, pans, from: { x: [panel.ax.first, panel.ax.last], y: [panel.ay.first, panel.ay.last] } };
      e.preventDefault();
      o.focus({ preventScroll: true });
    });
    o.addEventListener("contextmenu", (e) => e.preventDefault());
    o.addEventListener("pointermove", (e) => {
      const [x, y] = at(e);
      if (!this.drag) return this.hover(x, y, e);
      const { panel, from } = this.drag;
      this.drag.to = [x, y];
      if (!this.drag.pans) return this.drawOver();
      const ax = new Axis(panel.x.log, ...from.x), ay = new Axis(panel.y.log, ...from.y);
      const dx = (this.drag.x - x) / panel.box.w, dy = (y - this.drag.y) / panel.box.h;
      this.setView(panel, [ax.value(dx), ax.value(1 + dx)], [ay.value(dy), ay.value(1 + dy)]);
    });
    const end = (e) => {
      const drag = this.drag;
      this.drag = null;
      if (!drag) return;
      const [x, y] = at(e), { panel } = drag;
      if (drag.pans) return;
      const wide = Math.abs(x - drag.x), high = Math.abs(y - drag.y);
      if (wide < 5 && high < 5) {
        this.drawOver();
        return this.click(panel, x, y);
      }
      const fx = (v) => Math.min(1, Math.max(0, (v - panel.box.x) / panel.box.w));
      const fy = (v) => Math.min(1, Math.max(0, 1 - (v - panel.box.y) / panel.box.h));
      const [x0, x1] = [fx(drag.x), fx(x)].sort((a, b) => a - b), [y0, y1] = [fy(drag.y), fy(y)].sort((a, b) => a - b);
      // a narrow box zooms one direction only
      this.setView(panel, wide < 12 && !panel.equal ? null : [panel.ax.value(x0), panel.ax.value(x1)],
        high < 12 && !panel.equal ? null : [panel.ay.value(y0), panel.ay.value(y1)]);
    };
    o.addEventListener("pointerup", end);
    o.addEventListener("pointerleave", () => {
      tip.hide();
      this.point = null;
      moveCursors(this, null);
    });
    o.addEventListener("dblclick", () => this.reset());
    o.addEventListener("wheel", (e) => {
      const [x, y] = at(e), inside = this.panelAt(x, y), panel = inside || this.panelAt(x, y, 46);
      if (!panel || !(e.ctrlKey || document.activeElement === o)) return;  // else the page scrolls
      e.preventDefault();
      const f = Math.exp(Math.sign(e.deltaY) * 0.18);
      const fx = (x - panel.box.x) / panel.box.w, fy = 1 - (y - panel.box.y) / panel.box.h;
      const zoom = (a, c) => [a.value(c - c * f), a.value(c + (1 - c) * f)];
      this.setView(panel, fx < 0 ? null : zoom(panel.ax, fx), fy < 0 ? null : zoom(panel.ay, fy));
    }, { passive: false });
    o.addEventListener("keydown", (e) => {
      const panel = this.drawing.panels[0];
      const move = { ArrowLeft: [-0.15, 0], ArrowRight: [0.15, 0], ArrowUp: [0, 0.15], ArrowDown: [0, -0.15] }[e.key];
      const factor = { "+": 0.8, "=": 0.8, "-": 1.25 }[e.key];
      if (e.key === "0") this.reset();
      else if (move) {
        this.setView(panel, [panel.ax.value(move[0]), panel.ax.value(1 + move[0])], [panel.ay.value(move[1]), panel.ay.value(1 + move[1])]);
      } else if (factor) {
        const range = (a) => [a.value(0.5 - 0.5 * factor), a.value(0.5 + 0.5 * factor)];
        this.setView(panel, range(panel.ax), range(panel.ay));
      } else return;
      e.preventDefault();
    });
  }

  cellAt(panel, x, y) {
    const cells = panel.cells;
    const find = (edges, v) => {
      for (let i = 0; i + 1 < edges.length; ++i) if (v >= edges[i] && v < edges[i + 1]) return i;
      return -1;
    };
    const i = find(edgesOf(cells.x), panel.ax.value((x - panel.box.x) / panel.box.w));
    const j = find(edgesOf(cells.y), panel.ay.value(1 - (y - panel.box.y) / panel.box.h));
    return i < 0 || j < 0 ? null : { i, j, value: cells.values[j * cells.x.length + i] };
  }

  /** The nearest point of a panel's curves. */
  nearest(panel, x, y, isWanted = () => true) {
    const d = this.drawing;
    let best = null, least = 22 * 22;
    for (const c of panel.curves) {
      if (!d.isShown(c) || !isWanted(c) || (!c.name && !c.end_name && !c.hover && !c.along && panel.curves.length > 3 && !c.marker && !panel.cursor)) continue;
      for (let k = 0; k < c.x.length; ++k) {
        const dx = d.px(panel, c.x[k]) - x;
        if (dx > 22 || dx < -22) continue;
        const dy = d.py(panel, c.y[k]) - y, far = dx * dx + dy * dy;
        if (far < least || (far === least && c.details)) {
          least = far;
          best = { c, k };
        }
      }
    }
    return best;
  }

  hover(x, y, e) {
    const panel = this.panelAt(x, y), d = this.drawing;
    this.point = null;
    if (!panel) {
      tip.hide();
      moveCursors(this, null);
      return;
    }
    const lines = [], near = this.nearest(panel, x, y);
    let value = panel.ax.value((x - panel.box.x) / panel.box.w);
    if (near) {
      const { c, k } = near;
      lines.push(c.name || c.end_name || panel.title || withoutUnit(panel.y.title));
      if (c.hover?.[k]) lines.push(c.hover[k]);
      if (panel.frame !== false) {
        const line = (axis, v) => axis.title && `${withoutUnit(axis.title)} = ${shown(v)} ${unitOf(axis.title)}${
          axis.also ? ` = ${shown(v * axis.also_factor, 4)} ${axis.also}` : ""}`.trim();
        if (c.details) lines.push("click: its multipliers and command");
        if (this.figure.subject !== "rotor") lines.push(line(panel.x, c.x[k]), line(panel.y, c.y[k]));
      }
      if (c.along) lines.push(`${c.along_title} = ${shown(c.along[k], 7)}${c.along_title === "time" ? " s" : ""}`);
      this.point = { panel, x: d.px(panel, c.x[k]), y: d.py(panel, c.y[k]), c };
      value = c.x[k];
      if (panel.cursor) moveCursors(this, panel.cursor, value, { amplitude: c.y[k], unit: unitOf(panel.y.title), station: this.figure.variant });
      else if (c.along) moveCursors(this, c.along_title, c.along[k]);
    } else {
      const cell = panel.cells && this.cellAt(panel, x, y);
      if (cell) {
        const cells = panel.cells, { i, j, value: v } = cell;
        lines.push(cells.categories ? cells.categories[v]?.name || "not computed" : `${cells.title} = ${shown(v, 4)}`);
        lines.push(`${withoutUnit(panel.x.title)} = ${cells.x_names ? cells.x_names[i] : `${shown(cells.x[i])} ${unitOf(panel.x.title)}`}`);
        lines.push(`${withoutUnit(panel.y.title)} = ${cells.y_names ? cells.y_names[j] : `${shown(cells.y[j])} ${unitOf(panel.y.title)}`}`);
        if (cells.command) lines.push("click: the command of this point");
      } else if (panel.frame !== false) {
        lines.push(`${withoutUnit(panel.x.title)} = ${shown(value, 4)} ${unitOf(panel.x.title)}`);
        lines.push(`${withoutUnit(panel.y.title)} = ${shown(panel.ay.value(1 - (y - panel.box.y) / panel.box.h), 4)} ${unitOf(panel.y.title)}`);
      }
      if (panel.cursor) moveCursors(this, panel.cursor, value);
      else moveCursors(this, null);
    }
    if (lines.length) tip.show(lines.filter(Boolean), e.clientX, e.clientY);
    else tip.hide();
    this.drawOver();
  }

  click(panel, x, y) {
    const point = this.nearest(panel, x, y, (c) => c.details);
    if (point) {
      const { c, k } = point;
      return this.tellCommand(filled(c.command, { n: String(c.along[k]) }), c.details[k].split("\n"));
    }
    const cell = panel.cells?.command && this.cellAt(panel, x, y);
    if (!cell) return;
    const cells = panel.cells, number = (v) => String(Number(v.toPrecision(12)));
    const values = { x: cells.x[cell.i] * cells.x_factor, y: cells.y[cell.j] * cells.y_factor };
    const texts = Object.entries(values).flatMap(([name, v]) => [[name, number(v)], ["-" + name, number(-v)]]);
    this.tellCommand(filled(cells.command, Object.fromEntries(texts)), []);
  }

  /** Shows a command line below the figure, with what is to be said before it. */
  tellCommand(text, lines) {
    const copy = element("button", { type: "button", onclick: () => {
      navigator.clipboard?.writeText(text).then(() => { copy.textContent = "Copied"; }, () => {});
    } }, "Copy");
    const told = text ? [element("code", {}, text), copy] : [];
    this.command.replaceChildren(...lines.map((l) => element("div", { class: "detail" }, l)), ...told);
    this.command.style.display = "flex";
    this.command.hidden = false;
  }

  /** A cursor at a time, speed or frequency, from this figure or another one. */
  showCursor(kind, value, more, isOwn) {
    this.cursor = kind ? { kind, value, more, isOwn } : null;
    this.drawOver();
  }

  drawOver() {
    const ctx = this.over.getContext("2d"), d = this.drawing, dots = devicePixelRatio || 1;
    ctx.setTransform(dots, 0, 0, dots, 0, 0);
    ctx.clearRect(0, 0, this.width, this.height);
    if (this.cursor) {
      const { kind, value, more } = this.cursor;
      for (const p of d.panels) {
        if (!p.box) continue;
        const { x, y, w, h } = p.box;
        if (p.cursor === kind) {
          const at = d.px(p, value);
          if (at < x || at > x + w) continue;
          ctx.strokeStyle = paint("gray");
          ctx.lineWidth = 1;
          ctx.setLineDash([3, 3]);
          ctx.beginPath();
          ctx.moveTo(at, y);
          ctx.lineTo(at, y + h);
          ctx.stroke();
        }
        for (const c of p.curves) {
          if (c.along_title !== kind || !c.along?.length || c.along[0] > value || c.line === undefined) continue;
          let low = 0, high = c.along.length - 1;
          if (c.along[high] < value) continue;
          while (high - low > 1) {
            const middle = (low + high) >> 1;
            if (c.along[middle] <= value) low = middle;
            else high = middle;
          }
          ctx.fillStyle = paint("alarm");
          ctx.setLineDash([]);
          drawMarker(ctx, "circle", d.px(p, c.x[low]), d.py(p, c.y[low]), 10);
        }
        // a line of a spectrum is a circle of the orbit
        if (kind === "frequency" && more.amplitude && LENGTHS[more.unit] && p.equal && this.figure.subject === "orbit" && more.station === this.figure.variant) {
          const r = (more.amplitude * LENGTHS[more.unit]) / LENGTHS[unitOf(p.x.title)];
          ctx.strokeStyle = paint("alarm");
          ctx.lineWidth = 1.6;
          ctx.setLineDash([5, 3]);
          ctx.beginPath();
          ctx.arc(d.px(p, 0), d.py(p, 0), Math.abs(d.px(p, r) - d.px(p, 0)), 0, 2 * Math.PI);
          ctx.stroke();
        }
      }
    }
    if (this.point) {
      ctx.setLineDash([]);
      ctx.strokeStyle = paint(this.point.c.paint, true);
      ctx.lineWidth = 2;
      ctx.beginPath();
      ctx.arc(this.point.x, this.point.y, 6, 0, 2 * Math.PI);
      ctx.stroke();
    }
    if (this.drag?.to && !this.drag.pans) {
      const { panel, x, y, to } = this.drag, b = panel.box;
      const wide = Math.abs(to[0] - x), high = Math.abs(to[1] - y);
      const x0 = wide < 12 ? b.x : Math.min(x, to[0]), x1 = wide < 12 ? b.x + b.w : Math.max(x, to[0]);
      const y0 = high < 12 ? b.y : Math.min(y, to[1]), y1 = high < 12 ? b.y + b.h : Math.max(y, to[1]);
      ctx.fillStyle = paint("forward");
      ctx.globalAlpha = 0.15;
      ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
      ctx.globalAlpha = 1;
    }
  }

  // ---- paper

  /** Puts a picture for white paper beside the canvas, which is not printed. */
  prepareToPrint() {
    const width = this.isWide ? WIDE_ON_PAPER : ON_PAPER;
    this.paper = element("div", { class: "paper" });
    this.paper.innerHTML = this.drawing.printed(width).replace(/^<\?xml.*?\?>/, "");
    this.plot.append(this.paper);
  }
  endPrint() {
    this.paper?.remove();
    this.paper = null;
    if (this.isDrawn) this.draw();
  }

  // ---- downloads

  get fileName() { return `${this.figure.kind}${this.figure.variant ? "_" + this.figure.variant.replace(/[^\w]+/g, "_") : ""}`; }

  /** Draws for white paper, with titles and legend. */
  whole(ctx) {
    const d = this.drawing;
    d.dark = false;
    d.drawWhole(ctx, this.figure.width, this.figure.height);
    d.dark = null;
    this.draw();
  }

  svg() {
    const ctx = new SvgContext(this.figure.width, this.figure.height + 40);
    this.whole(ctx);
    return ctx.document();
  }
  saveSvg() { save(`${this.fileName}.svg`, new Blob([this.svg()], { type: "image/svg+xml" })); }

  savePng() {
    const canvas = element("canvas", { width: 2 * this.figure.width, height: 2 * (this.figure.height + 40) });
    const ctx = canvas.getContext("2d");
    ctx.scale(2, 2);
    this.whole(ctx);
    canvas.toBlob((blob) => save(`${this.fileName}.png`, blob));
  }

  csv() {
    const lines = [];
    for (const p of this.drawing.panels) {
      const named = p.title || p.y.title;
      if (p.cells) {
        const c = p.cells;
        lines.push([p.x.title, p.y.title, c.title].map(csvText).join(","));
        for (let j = 0; j < c.y.length; ++j) {
          for (let i = 0; i < c.x.length; ++i) {
            const v = c.values[j * c.x.length + i];
            lines.push([c.x_names ? csvText(c.x_names[i]) : c.x[i], c.y_names ? csvText(c.y_names[j]) : c.y[j],
              c.categories ? csvText(c.categories[v]?.name) : v].join(","));
          }
        }
      }
      if (!p.curves.length) continue;
      lines.push(["panel", "curve", p.x.title, p.y.title, "along", "note"].map(csvText).join(","));
      for (const c of p.curves) {
        for (let k = 0; k < c.x.length; ++k) {
          lines.push([csvText(named), csvText(c.name || c.end_name), c.x[k], c.y[k], c.along ? c.along[k] : "", csvText(c.hover?.[k])].join(","));
        }
      }
    }
    return lines.join("\n") + "\n";
  }
  saveCsv() { save(`${this.fileName}.csv`, new Blob([this.csv()], { type: "text/csv" })); }
}

function tableOf(header, rows) {
  return element("div", { class: "scroll" }, element("table", {},
    element("thead", {}, element("tr", {}, ...header.map((h) => element("th", {}, h)))),
    element("tbody", {}, ...rows.map((r) => element("tr", {}, ...r.map((c) => element("td", {}, c)))))));
}
