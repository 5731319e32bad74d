// Draws a figure: the description is made by the program (libio/drawing/figure.hpp), the same as for files.

// ---------------------------------------------------------------- numbers and colors

/** Arrays of the page, decoded when first asked for. */
class Arrays {
  constructor(texts) {
    this.texts = texts;
    this.known = [];
  }
  get(number) {
    if (this.known[number]) return this.known[number];
    const text = this.texts[number];
    const bytes = Uint8Array.from(atob(text.slice(4)), (c) => c.charCodeAt(0));
    const values = text.startsWith("f64") ? new Float64Array(bytes.buffer) : new Float32Array(bytes.buffer);
    this.texts[number] = "";
    return (this.known[number] = values);
  }
}

const isDark = () => document.documentElement.dataset.theme === "dark";

/** Color of a meaning; text on white pages is darker than lines. */
function paint(name, isText = false, dark = isDark()) {
  const colors = page.colors.paints[name] || page.colors.paints.ink;
  return dark ? colors[2] : colors[isText ? 1 : 0];
}

function mapColor(map, place) {
  let stops = page.colors.maps[map];
  const at = Math.min(1, Math.max(0, place)) * (stops.length - 1);
  const i = Math.min(Math.floor(at), stops.length - 2), share = at - i;
  return stops[i].map((a, k) => Math.round(a + share * (stops[i + 1][k] - a)));
}

const hexToRgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));

/** A number as people write it. */
function shown(value, digits = 5) {
  if (!Number.isFinite(value)) return "–";
  if (value !== 0 && (Math.abs(value) < 1e-4 || Math.abs(value) >= 1e7)) {
    return value.toExponential(Math.max(0, digits - 2)).replace("-", "−");
  }
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}

const superscript = (text) =>
  text.replace(/[-−0-9]/g, (c) => ({ "-": "⁻", "−": "⁻" })[c] || "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)]);

/** A number along an axis with a minus sign, as "{:g}" writes it. */
function tickLabel(value, digits) {
  const [number, exponent] = Math.abs(value).toExponential(digits - 1).split("e"), power = Number(exponent);
  const text = power < -4 || power >= digits
    ? `${Number(number)}e${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`
    : String(Number(Math.abs(value).toPrecision(digits)));
  return (value < 0 ? "−" : "") + text;
}

const unitOf = (title) => (title.match(/\[([^\]]*)\]\s*$/) || [, ""])[1];
const withoutUnit = (title) => title.replace(/\s*\[[^\]]*\]\s*$/, "");

// ---------------------------------------------------------------- axes

/** A range along one direction. */
class Axis {
  constructor(log, first, last) {
    Object.assign(this, { log, first, last });
  }
  place(v) {
    return this.log ? Math.log(v / this.first) / Math.log(this.last / this.first)
                    : (v - this.first) / (this.last - this.first);
  }
  value(place) {
    return this.log ? this.first * (this.last / this.first) ** place
                    : this.first + place * (this.last - this.first);
  }
  /** As libio/drawing/axis.cpp makes them; a zoomed axis has others than the file. */
  ticks(most) {
    if (!this.log) return this.rounds(most);
    const powers = this.powers(most);
    return powers.filter((t) => t.label).length < 2 ? this.rounds(most).filter((t) => t.value > 0) : powers;
  }
  rounds(most) {
    const wide = (this.last - this.first) / most, power = 10 ** Math.floor(Math.log10(wide));
    let step = [1, 2, 5, 10].find((d) => d * power >= wide * (1 - 1e-9)) * power, ticks = this.every(step);
    for (let i = 0; i < 4 && ticks.length < 2; ++i) {  // one alone tells no size
      const wanted = 0.75 * step, unit = 10 ** Math.floor(Math.log10(wanted) + 1e-9);
      step = ([5, 2].find((d) => d * unit <= wanted * (1 + 1e-9)) || 1) * unit;
      ticks = this.every(step);
    }
    return ticks;
  }
  every(step) {
    const largest = Math.max(Math.abs(this.first), Math.abs(this.last)), ticks = [];
    const needed = 1 + Math.floor(Math.log10(largest)) - Math.floor(Math.log10(step) + 1e-9);
    const digits = Math.min(17, Math.max(6, needed));
    const from = Math.ceil(this.first / step - 1e-9), to = this.last / step + 1e-9;
    if (!(to - from < 1000) || !(Math.abs(from) < 1e15)) return ticks;  // rounding cannot tell them apart
    for (let i = from; i <= to; ++i) {
      ticks.push({ value: i * step, label: tickLabel(i * step, digits) });
    }
    return ticks;
  }
  powers(most) {
    const from = Math.floor(Math.log10(this.first) + 1e-9), to = Math.ceil(Math.log10(this.last) - 1e-9);
    const { start, stride } = this.labelled(from, to, most), ticks = [];
    for (let p = from; p <= to; ++p) {
      for (let digit = 1; digit <= 9; ++digit) {
        const value = digit * 10 ** p;
        if (value < this.first * (1 - 1e-9) || value > this.last * (1 + 1e-9)) continue;
        if (digit === 1) ticks.push({ value, label: (p - start) % stride ? "" : "10" + superscript(String(p)) });
        else if (stride === 1) ticks.push({ value, label: "" });
      }
    }
    return ticks;
  }
  /** Which powers of ten from one to another have labels: two at least where two are seen. */
  labelled(from, to, most) {
    const low = Math.ceil(Math.log10(this.first) - 1e-9), high = Math.floor(Math.log10(this.last) + 1e-9);
    const stride = Math.max(1, Math.floor((to - from + most) / most)), next = from + stride * Math.ceil((low - from) / stride);
    if (next + stride <= high || high <= low) return { start: from, stride };
    return { start: low, stride: Math.ceil((high - low + 1) / most) };
  }
}

// ---------------------------------------------------------------- drawing as SVG

let clipNumber = 0;  // several pictures may stand in one document

/** Takes the calls of a canvas and writes SVG; only what figures use. */
class SvgContext {
  constructor(width, height) {
    Object.assign(this, { width, height, body: [], path: "", depth: 0, stack: [],
      fillStyle: "#000", strokeStyle: "#000", lineWidth: 1, globalAlpha: 1, font: "12px sans-serif",
      textAlign: "start", dash: [], lineCap: "butt", lineJoin: "miter" });
    this.measure = document.createElement("canvas").getContext("2d");
  }
  n(v) { return String(Math.round(v * 100) / 100); }
  esc(t) { return t.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;").replace(/"/g, "&quot;"); }
  save() {
    const { fillStyle, strokeStyle, lineWidth, globalAlpha, font, textAlign, dash, lineCap } = this;
    this.stack.push({ fillStyle, strokeStyle, lineWidth, globalAlpha, font, textAlign, dash, lineCap, groups: 0 });
  }
  restore() {
    const { groups, ...state } = this.stack.pop();
    for (let i = 0; i < groups; ++i) this.body.push("</g>");
    Object.assign(this, state);
  }
  open(attributes) {
    this.body.push(`<g ${attributes}>`);
    this.stack[this.stack.length - 1].groups++;
  }
  translate(x, y) { this.open(`transform="translate(${this.n(x)} ${this.n(y)})"`); }
  rotate(a) { this.open(`transform="rotate(${this.n((a * 180) / Math.PI)})"`); }
  beginPath() { this.path = ""; }
  moveTo(x, y) { this.path += `M${this.n(x)} ${this.n(y)}`; }
  lineTo(x, y) { this.path += `L${this.n(x)} ${this.n(y)}`; }
  closePath() { this.path += "z"; }
  rect(x, y, w, h) { this.path += `M${this.n(x)} ${this.n(y)}h${this.n(w)}v${this.n(h)}h${this.n(-w)}z`; }
  arc(x, y, r) {
    this.path += `M${this.n(x - r)} ${this.n(y)}a${this.n(r)} ${this.n(r)} 0 1 0 ${this.n(2 * r)} 0` +
      `a${this.n(r)} ${this.n(r)} 0 1 0 ${this.n(-2 * r)} 0z`;
  }
  setLineDash(dash) { this.dash = dash; }
  alpha(kind) { return this.globalAlpha < 1 ? ` ${kind}-opacity="${this.n(this.globalAlpha)}"` : ""; }
  stroke() {
    if (!this.path) return;
    const dash = this.dash.length ? ` stroke-dasharray="${this.dash.join(" ")}"` : "";
    this.body.push(`<path d="${this.path}" fill="none" stroke="${this.strokeStyle}" stroke-width="${
      this.n(this.lineWidth)}" stroke-linejoin="round" stroke-linecap="${this.lineCap}"${dash}${this.alpha("stroke")}/>`);
  }
  fill() { if (this.path) this.body.push(`<path d="${this.path}" fill="${this.fillStyle}"${this.alpha("fill")}/>`); }
  fillRect(x, y, w, h) {
    this.body.push(`<rect x="${this.n(x)}" y="${this.n(y)}" width="${this.n(w)}" height="${this.n(h)}" fill="${
      this.fillStyle}"${this.alpha("fill")}/>`);
  }
  clip() {
    const id = `c${++clipNumber}`;
    this.body.push(`<clipPath id="${id}"><path d="${this.path}"/></clipPath>`);
    this.open(`clip-path="url(#${id})"`);
  }
  measureText(t) {
    this.measure.font = this.font;
    return this.measure.measureText(t);
  }
  text(t, x, y, more) {
    const bold = this.font.startsWith("bold") ? ' font-weight="bold"' : "";
    const size = this.font.match(/([\d.]+)px/)[1];
    const anchor = { center: "middle", right: "end", end: "end" }[this.textAlign] || "start";
    this.body.push(`<text x="${this.n(x)}" y="${this.n(y)}" font-size="${size}"${bold} text-anchor="${anchor}" ${more}>${this.esc(t)}</text>`);
  }
  fillText(t, x, y) { this.text(t, x, y, `fill="${this.fillStyle}"`); }
  strokeText(t, x, y) {
    this.text(t, x, y, `fill="none" stroke="${this.strokeStyle}" stroke-width="${this.lineWidth}" stroke-linejoin="round"`);
  }
  drawImage(image, x, y, w, h) {
    this.body.push(`<image x="${this.n(x)}" y="${this.n(y)}" width="${this.n(w)}" height="${this.n(h)}" preserveAspectRatio="none" style="image-rendering:pixelated" href="${image.toDataURL()}"/>`);
  }
  document() {
    return `<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg" width="${this.width}" height="${
      this.height}" viewBox="0 0 ${this.width} ${this.height}" font-family="Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif">\n${
      this.body.join("\n")}\n</svg>\n`;
  }
}

// ---------------------------------------------------------------- figures

const FONT = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";
const SMALL_PLOT = 560;  // panels below this width, of figures that want to be wider, are small
/** Rooms of small panels, where others than the style's; names of y stand in a line above them. */
const SMALL_ROOMS = { name: 16, leader: 12, bar: 8, bar_width: 10, bar_room: 80, per_label_y: 30,
  line: 16, edge: 16, frameless: 9, gap: 3 };
/** Lines by which names in small panels that hover does not tell may be moved, the nearest first. */
const ANY_LINE = [0, -1, 1, -2, 2, -3, 3, -4, 4, -5, 5, -6, 6];
const NARROW_PANEL = 260;  // panels beside each other are no narrower

function drawMarker(ctx, shape, x, y, size) {
  const r = 0.5 * size;
  ctx.beginPath();
  if (shape === "circle") {
    ctx.arc(x, y, r, 0, 2 * Math.PI);
  } else {
    const a = 0.88 * r, t = 1.25 * r, o = 1.1 * r, w = 0.4 * r;
    const corners = {
      square: [[-a, -a], [a, -a], [a, a], [-a, a]],
      diamond: [[0, -t], [t, 0], [0, t], [-t, 0]],
      triangle: [[0, -t], [1.1 * r, 0.75 * r], [-1.1 * r, 0.75 * r]],
      triangle_down: [[0, t], [1.1 * r, -0.75 * r], [-1.1 * r, -0.75 * r]],
      cross: [[-w, -o], [w, -o], [w, -w], [o, -w], [o, w], [w, w], [w, o], [-w, o], [-w, w], [-o, w], [-o, -w], [-w, -w]],
    }[shape];
    corners.forEach(([dx, dy], i) => (i ? ctx.lineTo(x + dx, y + dy) : ctx.moveTo(x + dx, y + dy)));
    ctx.closePath();
  }
  ctx.fill();
}

/** Whether a line of a panel is named at its end; names of horizontal rules are among these then. */
function hasEndNames(p) {
  return p.curves.some((c) => c.end_name);
}

/** Places as near as possible to those wanted (ascending), some distance apart. */
function spread(wanted, distance, low, high) {
  const groups = [];
  for (const place of wanted) {
    groups.push({ sum: place, count: 1 });
    while (groups.length > 1) {
      const last = groups[groups.length - 1], before = groups[groups.length - 2];
      if (before.sum / before.count + before.count * distance <= last.sum / last.count) break;
      before.sum += last.sum - last.count * before.count * distance;
      before.count += last.count;
      groups.pop();
    }
  }
  const places = groups.flatMap((g) => Array.from({ length: g.count }, (_, i) => g.sum / g.count + i * distance));
  places.forEach((p, i) => (places[i] = Math.max(p, low + i * distance)));
  for (let i = places.length; i-- > 0; ) places[i] = Math.min(places[i], high - (places.length - 1 - i) * distance);
  return places;
}

/** Edges between middles, and half a step beyond the outermost. */
function edgesOf(middles) {
  const n = middles.length, edges = new Float64Array(n + 1);
  for (let i = 1; i < n; ++i) edges[i] = 0.5 * (middles[i - 1] + middles[i]);
  edges[0] = middles[0] - 0.5 * (n > 1 ? middles[1] - middles[0] : 1);
  edges[n] = middles[n - 1] + 0.5 * (n > 1 ? middles[n - 1] - middles[n - 2] : 1);
  return edges;
}

const isEven = (edges) => {
  const step = (edges[edges.length - 1] - edges[0]) / (edges.length - 1);
  return edges.every((e, i) => Math.abs(e - edges[0] - i * step) < 0.02 * Math.abs(step));
};

/** What a figure looks like at a size: places of its panels, and how to draw them. */
class Drawing {
  constructor(figure, arrays) {
    this.figure = figure;
    this.hidden = new Set();
    this.dark = null;
    this.panels = figure.panels.map((p) => ({
      ...p,
      view: { x: [p.x.first, p.x.last], y: [p.y.first, p.y.last] },
      curves: p.curves.map((c) => ({ ...c, x: arrays.get(c.x), y: arrays.get(c.y),
        along: c.along === undefined ? null : arrays.get(c.along) })),
      cells: p.cells && { ...p.cells, x: arrays.get(p.cells.x), y: arrays.get(p.cells.y), values: arrays.get(p.cells.values) },
    }));
  }

  color(name, isText) { return paint(name, isText, this.dark ?? isDark()); }

  reset() {
    for (const p of this.panels) p.view = { x: [p.x.first, p.x.last], y: [p.y.first, p.y.last] };
  }

  /** Panels beside each other at a width: one on a phone. */
  columnsAt(width) { return width < NARROW_PANEL * this.figure.columns ? 1 : this.figure.columns; }

  /** Height that fits a width, the figure's own where it has room for what it wants. */
  heightAt(width) {
    const { height, columns } = this.figure, count = this.panels.length;
    const rows = Math.ceil(count / columns), stacked = Math.ceil(count / this.columnsAt(width));
    return height * (stacked / rows);
  }

  /** Whether a panel shares x with the one below it; panels of equal scales have ranges of their own. */
  sharesBelow(p) {
    const below = this.panels[this.panels.indexOf(p) + this.columns];
    return below && p.x.title !== "" && below.x.title === p.x.title && !p.equal && !below.equal;
  }

  roomRight(ctx, p) {
    const { name, bar_room, edge, frameless } = this.rooms;
    let room = !this.isSmall ? 22 : p.frame === false ? frameless : edge;
    ctx.font = `bold 13px ${FONT}`;
    for (const c of p.curves) {
      if (c.end_name) room = Math.max(room, name + (this.isSmall ? 4 : 12) + ctx.measureText(c.end_name).width);
    }
    for (const r of this.isSmall ? [] : p.rules) {  // small panels name them inside
      if (r.kind === "vertical" || !r.name) continue;
      const isAmong = r.kind === "horizontal" && hasEndNames(p);
      ctx.font = `${isAmong ? 13 : 12}px ${FONT}`;
      room = Math.max(room, 12 + (isAmong ? name : 0) + ctx.measureText(r.name).width);
    }
    if (p.cells && !p.cells.categories) room = Math.max(room, bar_room);
    return room;
  }

  /** Room left of a small panel that its numbers need. */
  roomLeft(ctx, p) {
    if (p.frame === false) return this.rooms.frameless;
    ctx.font = `12px ${FONT}`;
    return 14 + Math.max(...this.ticksUp(p).map((t) => ctx.measureText(t.label).width), 0);
  }

  isNamedAbove(p) { return this.isSmall && p.frame !== false && p.y.title !== ""; }
  roomAbove(row) {
    const { title, above, line } = this.rooms;
    return (row[0].title ? title : above) + (row.some((p) => this.isNamedAbove(p)) ? line : 0);
  }
  roomBelow(row) {
    if (this.isSmall && row.every((p) => p.frame === false)) return this.rooms.above;  // without numbers
    return this.sharesBelow(row[0]) ? this.rooms.between : this.rooms.under;
  }

  layout(ctx, width, height, top = 4) {
    this.width = width;
    this.columns = this.columnsAt(width);
    this.isShrunk = width < this.figure.width;
    this.isSmall = this.isShrunk && width / this.columns < SMALL_PLOT;
    this.rooms = this.isSmall ? { ...page.style, ...SMALL_ROOMS } : page.style;
    this.left = this.rooms.left;
    this.right = Math.max(...this.panels.map((p) => this.roomRight(ctx, p)));
    this.placePanels(height, top);
    for (let pass = 0; this.isSmall && pass < 2; ++pass) {  // the numbers follow the width of what they leave
      this.left = Math.max(...this.panels.map((p) => this.roomLeft(ctx, p)));
      this.placePanels(height, top);
    }
  }

  get rows() {
    return Array.from({ length: Math.ceil(this.panels.length / this.columns) },
      (_, r) => this.panels.slice(r * this.columns, (r + 1) * this.columns));
  }

  placePanels(height, top) {
    const { rows, left, right } = this, pitch = this.width / this.columns, sum = (values) => values.reduce((a, b) => a + b, 0);
    const shares = sum(rows.map((row) => row[0].share)), rooms = sum(rows.map((row) => this.roomAbove(row) + this.roomBelow(row)));
    let y = top;
    for (const row of rows) {
      const h = ((height - top - rooms) * row[0].share) / shares;
      y += this.roomAbove(row);
      row.forEach((p, c) => {
        p.box = { x: pitch * c + left, y, w: pitch - left - right, h };
        p.lowest = !this.sharesBelow(p);
        this.place(p);
      });
      y += h + this.roomBelow(row);
    }
  }

  /** Height at which small panels of equal scales fill the width, no higher than wide; not below another height. */
  filledHeight(ctx, width, height) {
    this.layout(ctx, width, height);
    const wanted = (p) => p.box.w * Math.min(1, (p.y.last - p.y.first) / (p.x.last - p.x.first));
    const lacks = this.panels.filter((p) => this.isSmall && p.equal).map((p) => wanted(p) / p.box.h - 1);
    return height + Math.max(0, ...lacks) * this.rows.reduce((sum, row) => sum + row[0].box.h, 0);
  }

  /** Axes of a panel in its box. */
  place(p) {
    p.ax = new Axis(p.x.log, ...p.view.x);
    p.ay = new Axis(p.y.log, ...p.view.y);
    if (p.equal) {
      const ratio = (p.ax.last - p.ax.first) / p.box.w / ((p.ay.last - p.ay.first) / p.box.h);
      const widen = (a, f) => {
        const m = 0.5 * (a.first + a.last), half = 0.5 * (a.last - a.first);
        a.first = m - f * half;
        a.last = m + f * half;
      };
      if (ratio < 1) widen(p.ax, 1 / ratio);
      else widen(p.ay, ratio);
    }
  }

  px(p, v) { return p.box.x + p.box.w * p.ax.place(v); }
  py(p, v) { return p.box.y + p.box.h * (1 - p.ay.place(v)); }
  isShown(c) { return !this.hidden.has(c.name || c.end_name); }

  draw(ctx, width, height, top) {
    this.layout(ctx, width, height, top);
    for (const p of this.panels) {
      const { x, y, w, h } = p.box;
      p.taken = [];  // places of texts
      p.ruleNames = [];  // drawn later, over lines
      ctx.save();
      ctx.beginPath();
      ctx.rect(x, y, w, h);
      ctx.clip();
      if (p.cells) this.drawCells(ctx, p);
      ctx.restore();
      this.drawAxes(ctx, p);
      if (p.cells && !p.cells.categories) this.drawColorBar(ctx, p);
      this.drawRules(ctx, p);
      ctx.save();
      ctx.beginPath();
      ctx.rect(x - 1, y - 1, w + 2, h + 2);
      ctx.clip();
      for (const c of p.curves) if (this.isShown(c)) this.drawLine(ctx, p, c);
      ctx.restore();
      ctx.save();  // markers at the edge are whole
      ctx.beginPath();
      ctx.rect(x - 5, y - 5, w + 10, h + 10);
      ctx.clip();
      for (const c of p.curves) if (this.isShown(c)) this.drawMarkers(ctx, p, c);
      ctx.restore();
      this.drawEndNames(ctx, p);
      for (const draw of p.ruleNames) draw();
      for (const l of p.labels) this.drawLabel(ctx, p, l);
    }
  }

  /** The parts of a title, divided by " | ", that fit a width; of a small panel words, too. */
  fittingTitle(ctx, title, width) {
    const parts = title.split(" | ");
    while (parts.length > 1 && ctx.measureText(parts.join(" | ")).width > width) parts.pop();
    return this.isSmall ? this.shortened(ctx, parts.join(" | "), "", width) : parts.join(" | ");
  }

  /** The name of an axis, without its last letters where it is wider than a shrunk picture; the unit stays. */
  fittingName(ctx, title) {
    const name = withoutUnit(title);
    return this.isShrunk ? this.shortened(ctx, name, title.slice(name.length), this.width / this.columns - 8) : title;
  }

  /** A text and its end that fit a width: the last letters of the text are left out. */
  shortened(ctx, text, end, width) {
    const letters = [...text];
    let fitting = text + end;
    while (letters.length && ctx.measureText(fitting).width > width) {
      letters.pop();
      fitting = `${letters.join("").trimEnd()}…${end}`;
    }
    return fitting;
  }

  /** Middle of a text nearest to a wanted one that keeps it within a shrunk picture. */
  middleOf(ctx, text, p, wanted) {
    if (!this.isShrunk) return wanted;
    const half = 0.5 * ctx.measureText(text).width + 2, [first, last] = this.columnOf(p);
    return Math.max(first + half, Math.min(wanted, last - half));
  }
  /** Left and right end of what belongs to a panel and those above and below it. */
  columnOf(p) {
    const first = p.box.x - this.left;
    return [first, first + this.width / this.columns];
  }

  /**
   * A text within a panel. In a small one a text that would lie on another one, or reach out, is moved by lines, those
   * that may be tried, or left out: libio/drawing/panel_svg.cpp has the same for pictures of a given size.
   */
  addText(ctx, p, text, x, y, color, lines) {
    if (!text) return;
    if (!this.isSmall) return this.halo(ctx, text, x, y, color);
    const { width } = ctx.measureText(text), size = Number(ctx.font.match(/([\d.]+)px/)[1]);
    const before = { left: 0, center: 0.5, right: 1 }[ctx.textAlign] * width;
    const [first, last] = this.columnOf(p), least = p.frame === false ? first + 2 : p.box.x - 4;  // right of the numbers
    const left = Math.max(least, Math.min(x - before, last - 2 - width));
    for (const line of lines) {
      const floor = y + line * (size + 1);
      const place = { text, left, right: left + width, top: floor - 0.8 * size, floor: floor + 0.25 * size };
      const others = p.taken.filter((other) => this.areNear(place, other));
      if (others.some((other) => other.text === text)) return;  // it is said there
      if (others.length || !this.isWithin(p, place)) continue;
      p.taken.push(place);
      return this.halo(ctx, text, left + before, floor, color);
    }
  }
  /** Lines by which a label may be moved: up in the upper half of a panel, down in the lower one, or back where an edge is near. */
  linesFrom({ box: { y, h } }, at) {
    const isUp = at < y + h / 2, lines = (isUp ? at - y : y + h - at) / 12.5;
    return [0, 1, 2, ...(lines < 2 ? [-1] : []), ...(lines < 1 ? [-2] : [])].map((n) => (isUp ? -n : n));
  }
  isWithin(p, { top, floor }) { return top >= p.box.y - 2 && floor <= p.box.y + p.box.h + 2; }
  areNear(a, b) {
    const { gap } = this.rooms;
    return a.left < b.right + gap && b.left < a.right + gap && a.top < b.floor && b.top < a.floor;
  }

  halo(ctx, text, x, y, color) {
    ctx.lineWidth = 3;
    ctx.lineJoin = "round";
    ctx.setLineDash([]);
    ctx.strokeStyle = this.dark ?? isDark() ? "#16191d" : "#ffffff";
    ctx.strokeText(text, x, y);
    ctx.fillStyle = color;
    ctx.fillText(text, x, y);
  }

  /** Ticks at the middles of named columns or rows, as many as have room. */
  namedTicks(middles, names, length, room) {
    const every = Math.ceil((room * names.length) / length);
    return names.map((label, i) => ({ value: middles[i], label })).filter((_, i) => i % every === 0);
  }
  ticksOf(axis, step, length, room) {
    if (!step || axis.last - axis.first <= 2 * step) return axis.ticks(Math.max(2, Math.floor(length / room)));
    while ((axis.last - axis.first) / step > 8) step *= 2;
    return axis.every(step);
  }
  ticksAlong(p) {
    if (p.cells?.x_names) return this.namedTicks(p.cells.x, p.cells.x_names, p.box.w, 66);
    const rounding = 1e-9 * (p.ax.last - p.ax.first);
    return this.ticksOf(p.ax, p.x.step, p.box.w, this.rooms.per_label_x)
      .filter((t) => t.value >= p.ax.first - rounding && t.value <= p.ax.last + rounding);
  }
  ticksUp(p) {
    if (p.cells?.y_names) return this.namedTicks(p.cells.y, p.cells.y_names, p.box.h, 15);
    return this.ticksOf(p.ay, p.y.step, p.box.h, this.rooms.per_label_y);
  }

  drawAxes(ctx, p) {
    const { x, y, w, h } = p.box, ink = this.color("ink"), faint = this.color("faint");
    ctx.setLineDash([]);
    ctx.lineWidth = 1;
    if (p.title) {
      ctx.font = `bold 13px ${FONT}`;
      ctx.textAlign = "center";
      ctx.fillStyle = ink;
      const above = this.isNamedAbove(p) ? this.rooms.line : 0, title = this.fittingTitle(ctx, p.title, w + 24);
      ctx.fillText(title, this.middleOf(ctx, title, p, x + w / 2), y - 9 - above);
    }
    if (p.frame === false) return;
    const { tick_label, axis_title } = this.rooms, along = this.ticksAlong(p), up = this.ticksUp(p);
    ctx.font = `12px ${FONT}`;
    for (const [ticks, isX] of [[along, true], [up, false]]) {
      for (const t of ticks) {
        const at = isX ? this.px(p, t.value) : this.py(p, t.value), long = t.label ? 6 : 3;
        if (isX ? at < x - 1 || at > x + w + 1 : at < y - 1 || at > y + h + 1) continue;
        if (t.label && !p.cells) {
          ctx.strokeStyle = faint;
          ctx.beginPath();
          if (isX) { ctx.moveTo(at, y); ctx.lineTo(at, y + h); } else { ctx.moveTo(x, at); ctx.lineTo(x + w, at); }
          ctx.stroke();
        }
        ctx.strokeStyle = ink;
        ctx.fillStyle = ink;
        ctx.beginPath();
        if (isX) { ctx.moveTo(at, y + h); ctx.lineTo(at, y + h + long); } else { ctx.moveTo(x - long, at); ctx.lineTo(x, at); }
        ctx.stroke();
        ctx.textAlign = isX ? "center" : "right";
        if (isX && p.lowest) ctx.fillText(t.label, this.middleOf(ctx, t.label, p, at), y + h + tick_label);
        if (!isX) ctx.fillText(t.label, x - 10, at + 4.5);
      }
    }
    ctx.strokeStyle = ink;
    ctx.beginPath();
    ctx.moveTo(x, y);
    ctx.lineTo(x, y + h);
    ctx.lineTo(x + w, y + h);
    ctx.stroke();
    ctx.font = `13px ${FONT}`;
    ctx.textAlign = "center";
    ctx.fillStyle = ink;
    if (p.lowest) {
      const name = this.fittingName(ctx, p.x.title);
      ctx.fillText(name, this.middleOf(ctx, name, p, x + w / 2), y + h + axis_title);
    }
    if (this.isNamedAbove(p)) {
      ctx.textAlign = "left";
      ctx.fillText(this.fittingName(ctx, p.y.title), x - this.left + 4, y - 8);
      return;
    }
    ctx.save();
    ctx.translate(x - this.left + 19, y + h / 2);
    ctx.rotate(-Math.PI / 2);
    ctx.fillText(p.y.title, 0, 0);
    ctx.restore();
  }

  cellColor(cells, value) {
    if (!Number.isFinite(value)) return null;
    if (cells.categories) return hexToRgb(this.color(cells.categories[value]?.paint || "gray"));
    return mapColor(cells.map, (value - cells.first) / (cells.last - cells.first));
  }

  isCellShown(cells, value) { return !cells.categories || !this.hidden.has(cells.categories[value]?.name); }

  drawCells(ctx, p) {
    const cells = p.cells, nx = cells.x.length, ny = cells.y.length;
    const ex = edgesOf(cells.x), ey = edgesOf(cells.y);
    if (isEven(ex) && isEven(ey) && !p.ax.log && !p.ay.log) {
      const image = document.createElement("canvas");
      image.width = nx;
      image.height = ny;
      const inner = image.getContext("2d"), data = inner.createImageData(nx, ny);
      for (let j = 0; j < ny; ++j) {
        for (let i = 0; i < nx; ++i) {
          const value = cells.values[j * nx + i], rgb = this.isCellShown(cells, value) && this.cellColor(cells, value);
          if (rgb) data.data.set([...rgb, 255], 4 * ((ny - 1 - j) * nx + i));
        }
      }
      inner.putImageData(data, 0, 0);
      ctx.imageSmoothingEnabled = false;
      const left = this.px(p, ex[0]), top = this.py(p, ey[ny]);
      ctx.drawImage(image, left, top, this.px(p, ex[nx]) - left, this.py(p, ey[0]) - top);
    } else {
      for (let j = 0; j < ny; ++j) {
        for (let i = 0; i < nx; ++i) {
          const value = cells.values[j * nx + i], rgb = this.isCellShown(cells, value) && this.cellColor(cells, value);
          if (!rgb) continue;
          ctx.fillStyle = `rgb(${rgb})`;
          const left = this.px(p, ex[i]), top = this.py(p, ey[j + 1]);
          ctx.fillRect(left, top, this.px(p, ex[i + 1]) - left + 0.5, this.py(p, ey[j]) - top + 0.5);
        }
      }
    }
    if (!cells.prints_values || p.box.w / nx < (this.isSmall ? 30 : 25)) return;
    ctx.font = `11px ${FONT}`;
    ctx.textAlign = "center";
    for (let j = 0; j < ny; ++j) {
      for (let i = 0; i < nx; ++i) {
        const value = cells.values[j * nx + i];
        ctx.fillStyle = (value - cells.first) / (cells.last - cells.first) > 0.5 ? "#ffffff" : "#222222";
        ctx.fillText(value.toFixed(2), this.px(p, cells.x[i]), this.py(p, cells.y[j]) + 4);
      }
    }
  }

  drawColorBar(ctx, p) {
    const { bar, bar_width: thick, bar_room } = this.rooms;
    const { x, y, w, h } = p.box, left = x + w + bar, cells = p.cells;
    for (let i = 0; i < 64; ++i) {
      ctx.fillStyle = `rgb(${mapColor(cells.map, (i + 0.5) / 64)})`;
      ctx.fillRect(left, y + h * (1 - (i + 1) / 64), thick, h / 64 + 0.5);
    }
    const scale = new Axis(false, cells.first, cells.last);
    ctx.font = `11px ${FONT}`;
    ctx.textAlign = "left";
    ctx.fillStyle = ctx.strokeStyle = this.color("ink");
    for (const t of scale.ticks(Math.min(5, Math.max(2, Math.floor(h / 24))))) ctx.fillText(t.label, left + thick + 7, y + h * (1 - scale.place(t.value)) + 4);
    ctx.save();
    ctx.translate(x + w + bar_room - 8, y + h / 2);
    ctx.rotate(-Math.PI / 2);
    ctx.textAlign = "center";
    ctx.font = `12px ${FONT}`;
    ctx.fillText(cells.title, 0, 0);
    ctx.restore();
  }

  drawRules(ctx, p) {
    const { x, y, w, h } = p.box;
    for (const r of p.rules) {
      ctx.save();
      ctx.beginPath();
      ctx.rect(x, y, w, h);
      ctx.clip();
      ctx.strokeStyle = this.color(r.paint);
      ctx.lineWidth = 1.1;
      ctx.setLineDash(page.style.dashes[r.dash]);
      ctx.beginPath();
      ctx.font = `12px ${FONT}`;
      let end = null, align = "left";
      if (r.kind === "vertical") {
        const at = this.px(p, r.at);
        ctx.moveTo(at, y);
        ctx.lineTo(at, y + h);
        const fits = at + 5 + ctx.measureText(r.name).width < (this.isSmall ? x + w : this.width);
        if (!fits) align = "right";
        if (at >= x - 1 && at <= x + w + 1) end = [fits ? at + 5 : at - 5, y + h - 8];
      } else if (r.kind === "horizontal") {
        const at = this.py(p, r.at);
        ctx.moveTo(x, at);
        ctx.lineTo(x + w, at);
        const isSeen = at >= y - 1 && at <= y + h + 1;
        if (isSeen && this.isSmall) end = [x + w - 3, at - 4], align = "right";
        else if (isSeen && !hasEndNames(p)) end = [x + w + 5, at + 4];
      } else {
        ctx.moveTo(this.px(p, p.ax.first), this.py(p, r.at * p.ax.first));
        ctx.lineTo(this.px(p, p.ax.last), this.py(p, r.at * p.ax.last));
        const right = r.at * p.ax.last;
        const isRight = right <= p.ay.last && right >= p.ay.first;
        if (isRight && this.isSmall) end = [x + w - 4, this.py(p, right) - 3], align = "right";
        else if (isRight) end = [x + w + 5, this.py(p, right) + 4];
        else if (r.at < 0 && p.ay.first >= 0) {  // it falls, and is seen to the left of zero
          const isLeft = p.ay.last / r.at <= p.ax.first;
          end = isLeft ? [x + 4, this.py(p, r.at * p.ax.first) - 3] : [this.px(p, p.ay.last / r.at) + 4, y + 14];
        } else if (p.ay.last / r.at > p.ax.first && right > p.ay.last) end = [this.px(p, p.ay.last / r.at) - 4, y + 14], align = "right";
      }
      ctx.stroke();
      ctx.restore();
      if (!end || !r.name) continue;
      const drawName = () => {
        ctx.font = `12px ${FONT}`;
        ctx.textAlign = align;
        this.addText(ctx, p, r.name, ...end, this.color(r.paint, true), ANY_LINE);
      };
      if (this.isSmall) p.ruleNames.push(drawName);
      else drawName();
    }
  }

  drawLine(ctx, p, c) {
    const color = this.color(c.paint), n = c.x.length;
    ctx.setLineDash([]);
    ctx.globalAlpha = 1;
    const isFree = (v, log) => Number.isFinite(v) && (!log || v > 0);
    const { x: bx, y: by, w, h } = p.box, far = w + h;
    if (c.line !== undefined || c.fill) {
      const isSorted = (c.sorted ??= c.x.every((v, i) => i === 0 || !(v < c.x[i - 1])));
      let from = 0, to = n;
      if (isSorted && !c.fill) {  // only what is seen
        while (from < n && c.x[from] < p.ax.first) ++from;
        while (to > from && c.x[to - 1] > p.ax.last) --to;
        from = Math.max(0, from - 1);
        to = Math.min(n, to + 1);
      }
      ctx.beginPath();
      let isDown = false, lastX = 0, lastY = 0;
      for (let i = from; i < to; ++i) {
        if (!isFree(c.x[i], p.ax.log) || !isFree(c.y[i], p.ay.log)) { isDown = false; continue; }
        const X = this.px(p, c.x[i]), Y = Math.min(by + h + far, Math.max(by - far, this.py(p, c.y[i])));
        if (X < bx - 50 * far || X > bx + w + 50 * far) { isDown = false; continue; }
        if (isDown && i + 1 < to && Math.abs(X - lastX) < 0.3 && Math.abs(Y - lastY) < 0.3) continue;
        if (isDown) ctx.lineTo(X, Y); else ctx.moveTo(X, Y);
        isDown = true;
        lastX = X;
        lastY = Y;
      }
      if (c.fill) {
        ctx.globalAlpha = c.fill;
        ctx.fillStyle = color;
        ctx.fill();
        ctx.globalAlpha = 1;
      }
      if (c.line !== undefined) {
        ctx.strokeStyle = color;
        ctx.lineWidth = c.line;
        ctx.lineJoin = "round";
        ctx.setLineDash(page.style.dashes[c.dash]);
        ctx.stroke();
        ctx.setLineDash([]);
      }
    }
  }

  drawMarkers(ctx, p, c) {
    if (!c.marker) return;
    const color = this.color(c.paint), n = c.x.length, { x: bx, y: by, w, h } = p.box;
    const isFree = (v, log) => Number.isFinite(v) && (!log || v > 0);
    ctx.setLineDash([]);
    ctx.fillStyle = color;
    if (c.size < 3 && ctx instanceof SvgContext) {
      const seen = new Set();
      ctx.beginPath();
      for (let i = 0; i < n; ++i) {
        const X = Math.round(this.px(p, c.x[i]) * 4) / 4, Y = Math.round(this.py(p, c.y[i]) * 4) / 4;
        const key = X * 1e5 + Y;
        if (!(X >= bx && X <= bx + w && Y >= by && Y <= by + h) || seen.has(key)) continue;
        seen.add(key);
        ctx.path += `M${X} ${Y}h0`;
      }
      ctx.lineCap = "round";
      ctx.strokeStyle = color;
      ctx.lineWidth = c.size;
      ctx.stroke();
      ctx.lineCap = "butt";
    } else if (c.size < 3) {  // many dots
      const s = Math.max(1, c.size), half = s / 2;
      for (let i = 0; i < n; ++i) {
        const X = this.px(p, c.x[i]), Y = this.py(p, c.y[i]);
        if (X >= bx && X <= bx + w && Y >= by && Y <= by + h) ctx.fillRect(X - half, Y - half, s, s);
      }
    } else {
      const every = c.every || 1;
      for (let i = Math.floor(every / 2); i < n; i += every) {
        if (!isFree(c.x[i], p.ax.log) || !isFree(c.y[i], p.ay.log)) continue;
        const X = this.px(p, c.x[i]), Y = this.py(p, c.y[i]);
        if (X > bx - 0.5 && X < bx + w + 0.5 && Y > by - 0.5 && Y < by + h + 0.5) drawMarker(ctx, c.marker, X, Y, c.size);
      }
    }
  }

  drawEndNames(ctx, p) {
    const { x, y, w, h } = p.box, ends = [];
    for (const c of p.curves) {
      if (!c.end_name || !this.isShown(c)) continue;
      let end = null;
      for (let i = 0; i < c.x.length; ++i) {
        const X = this.px(p, c.x[i]), Y = this.py(p, c.y[i]);
        if (X >= x - 1 && X <= x + w + 1 && Y >= y - 1 && Y <= y + h + 1 && (!end || X > end[0])) end = [X, Y];
      }
      if (!end) continue;
      let leaves = false;  // up or down: the name is where it leaves
      for (let i = 0; i < c.x.length && c.line !== undefined; ++i) {
        const X = this.px(p, c.x[i]);
        leaves ||= Number.isFinite(c.y[i]) && X > end[0] + 1 && X <= x + w + 1;
      }
      if (leaves) {
        ctx.font = `bold 13px ${FONT}`;
        ctx.textAlign = "right";
        this.addText(ctx, p, c.end_name, end[0] - 7, end[1] + (end[1] < y + h / 2 ? 16 : -8), this.color(c.paint, true), ANY_LINE);
        continue;
      }
      ends.push({ name: c.end_name, paint: c.paint, font: `bold 13px ${FONT}`, end });
    }
    for (const r of hasEndNames(p) && !this.isSmall ? p.rules : []) {
      const at = this.py(p, r.at), isSeen = at >= y - 1 && at <= y + h + 1;
      if (r.kind === "horizontal" && r.name && isSeen) ends.push({ name: r.name, paint: r.paint, font: `13px ${FONT}`, end: [x + w, at] });
    }
    ends.sort((a, b) => a.end[1] - b.end[1]);
    const places = spread(ends.map((e) => e.end[1]), 17, y, y + h);
    ends.forEach(({ name, paint, font, end }, i) => {
      const X = x + w + this.rooms.name, Y = places[i];
      ctx.strokeStyle = this.color(paint);
      ctx.lineWidth = 0.8;
      ctx.setLineDash([1, 3]);
      ctx.beginPath();
      ctx.moveTo(...end);
      ctx.lineTo(X - this.rooms.leader, Y);
      ctx.lineTo(X - 5, Y);
      ctx.stroke();
      ctx.font = font;
      ctx.textAlign = "left";
      this.halo(ctx, name, X, Y + 0.35 * 13, this.color(paint, true));
    });
  }

  drawLabel(ctx, p, l) {
    const { x, y, w, h } = p.box, X = this.px(p, l.x), Y = this.py(p, l.y);
    if (!(X >= x - 1 && X <= x + w + 1 && Y >= y - 9 && Y <= y + h + 9)) return;
    ctx.font = `11.5px ${FONT}`;
    ctx.textAlign = { start: "left", middle: "center", end: "right" }[l.anchor];
    this.addText(ctx, p, l.text, X + l.dx, Y + l.dy, this.color(l.paint, true), this.linesFrom(p, Y));
  }

  /** Names of the legend, each once. */
  legend() {
    const entries = new Map();
    for (const p of this.panels) {
      for (const c of p.cells?.categories || []) entries.set(c.name, { name: c.name, category: c });
      for (const c of p.curves) if (c.name && !entries.has(c.name)) entries.set(c.name, { name: c.name, curve: c });
    }
    return [...entries.values()];
  }

  drawSample(ctx, entry, x, y) {
    const c = entry.curve;
    ctx.setLineDash([]);
    if (!c || c.fill) {
      ctx.globalAlpha = c ? c.fill : 1;
      ctx.fillStyle = this.color((c || entry.category).paint);
      ctx.fillRect(x + 5, y - 5, 20, 11);
      ctx.globalAlpha = 1;
      return;
    }
    ctx.strokeStyle = ctx.fillStyle = this.color(c.paint);
    if (c.line !== undefined) {
      ctx.lineWidth = Math.max(1.3, c.line);
      ctx.setLineDash(page.style.dashes[c.dash]);
      ctx.beginPath();
      ctx.moveTo(x, y);
      ctx.lineTo(x + 30, y);
      ctx.stroke();
    }
    if (c.marker) drawMarker(ctx, c.marker, x + 15, y, Math.min(9, Math.max(4, c.size)));
  }

  /** The legend from a height on; the height below it. */
  drawLegend(ctx, width, y) {
    const left = this.left;
    let x = left;
    ctx.textAlign = "left";
    for (const e of this.legend()) {
      if (this.hidden.has(e.name)) continue;
      ctx.font = `12px ${FONT}`;
      const wide = 56 + ctx.measureText(e.name).width;
      if (x > left && x + wide > width) x = left, y += 18;
      this.drawSample(ctx, e, x, y);
      ctx.textAlign = "left";
      ctx.fillStyle = this.color("ink");
      ctx.fillText(e.name, x + 36, y + 4);
      x += wide;
    }
    return y + 12;
  }

  /** The whole figure with its titles and legend, for a file. */
  drawWhole(ctx, width, height) {
    ctx.fillStyle = "#ffffff";
    ctx.fillRect(0, 0, width, height + 40);
    ctx.textAlign = "left";
    ctx.fillStyle = this.color("ink");
    ctx.font = `bold 15px ${FONT}`;
    ctx.fillText(this.figure.title, page.style.left, 28);
    ctx.fillStyle = this.color("gray", true);
    ctx.font = `12px ${FONT}`;
    ctx.fillText(this.figure.subtitle, page.style.left, 46);
    this.draw(ctx, width, height, 52);
    this.drawLegend(ctx, width, height + 12);
  }

  /** Panels and legend for paper, in SVG; the page has its titles beside it. */
  printed(width) {
    this.dark = false;
    const rows = Math.ceil(this.panels.length / this.columnsAt(width)), most = rows > 1 ? 640 : 0.85 * Math.min(width, 460);
    const shrink = Math.min(1, Math.max(0.62, width / this.figure.width));
    const least = rows > 1 ? 60 + 135 * rows : 0;  // names of y stand beside or above their panels
    const height = Math.round(Math.max(least, Math.min(this.heightAt(width) * shrink, most)));
    const ctx = new SvgContext(width, height);
    this.draw(ctx, width, height);
    ctx.height = this.drawLegend(ctx, width, height + 6);
    this.dark = null;
    return ctx.document();
  }
}
